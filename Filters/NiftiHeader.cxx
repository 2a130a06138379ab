// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Headers of NIfTI-1 and NIfTI-2, whose fields are named as in nifti1.h.

#include "ImageFile.h"
#include "Utf8.h"

#include "vtkType.h"

#include <vtksys/SystemTools.hxx>

#include "math/Require.h"
#include "scene/ImageGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <locale>
#include <map>
#include <optional>
#include <sstream>

namespace limpid
{
namespace
{
constexpr std::int64_t size1 = 348; // sizeof_hdr of NIfTI-1
constexpr std::int64_t size2 = 540; // and of NIfTI-2

// The fields of a header: for both versions, type and place differ.
class Fields
{
public:
  explicit Fields(VoxelFile& file)
  {
    const std::int64_t read =
      ReadBytes(file, this->Bytes.data(), static_cast<std::int64_t>(this->Bytes.size()));
    for (const bool isBigEndian : { false, true })
    {
      file.isBigEndian = isBigEndian;
      this->IsBigEndian = isBigEndian;
      const double size = read < size1 ? 0 : this->At<std::int32_t>(0);
      this->IsFirst = size == size1;
      if (this->IsFirst || (size == size2 && read >= size2))
      {
        return;
      }
    }
    throw Error("It has no header of NIfTI (its first number would be the size of the header). "
                "Give a file of NIfTI, or name it by its format.");
  }

  ///@{
  /// Return a number of type First at a place in NIfTI-1, and of Second in NIfTI-2; of an array,
  /// number `i`.
  template <class First, class Second>
  double Number(std::size_t first, std::size_t second, std::size_t i = 0) const
  {
    return this->IsFirst ? this->At<First>(first + i * sizeof(First))
                         : this->At<Second>(second + i * sizeof(Second));
  }
  double Float(std::size_t first, std::size_t second, std::size_t i = 0) const
  {
    return this->Number<float, double>(first, second, i);
  }
  double Dim(std::size_t i) const { return this->Number<std::int16_t, std::int64_t>(40, 16, i); }
  double Pixdim(std::size_t i) const { return this->Float(76, 104, i); }
  ///@}

  std::int64_t Size() const { return this->IsFirst ? size1 : size2; }

private:
  template <class Value>
  double At(std::size_t place) const
  {
    return static_cast<double>(NumberAt<Value>(this->Bytes.data() + place, this->IsBigEndian));
  }

  std::array<char, size2> Bytes{};
  bool IsBigEndian = false;
  bool IsFirst = true;
};

int TypeOf(int datatype)
{
  static const std::map<int, int> types{ { 2, VTK_UNSIGNED_CHAR }, { 4, VTK_SHORT }, { 8, VTK_INT },
    { 16, VTK_FLOAT }, { 64, VTK_DOUBLE }, { 256, VTK_SIGNED_CHAR }, { 512, VTK_UNSIGNED_SHORT },
    { 768, VTK_UNSIGNED_INT }, { 1024, VTK_LONG_LONG }, { 1280, VTK_UNSIGNED_LONG_LONG } };
  const auto found = types.find(datatype);
  LIMPID_REQUIRE(found != types.end(),
    "Its datatype is " << datatype
                       << " (colors, complex and long numbers are no labels). Convert it to a file "
                          "with one number per point.");
  return found->second;
}

Int3 NodesOf(const Fields& header)
{
  const double axes = header.Dim(0);
  LIMPID_REQUIRE(
    axes >= 1 && axes <= 7, "It has " << axes << " axes (NIfTI has 1 to 7). Write the file again.");
  for (std::size_t axis = 1; axis <= static_cast<std::size_t>(axes); ++axis)
  {
    const double most = axis <= 3 ? 65536 : 1;
    LIMPID_REQUIRE(header.Dim(axis) >= 1 && header.Dim(axis) <= most,
      "It has " << header.Dim(axis) << " points along axis " << axis
                << " (one volume of at most 65536 points per axis is read). Extract one volume.");
  }
  LIMPID_REQUIRE(axes >= 3, "It has " << axes << " axes (a volume has 3). Give a volume.");
  return Int3(header.Dim(1), header.Dim(2), header.Dim(3));
}

// The steps and the origin of one of the two placements that a header has.
struct Placement
{
  Mat3 steps{ 0.0 };
  Vec3 origin{ 0.0 };
};

Placement BySform(const Fields& header)
{
  Placement placement;
  for (std::size_t row = 0; row < 3; ++row)
  {
    const auto srow = [&](std::size_t i) { return header.Float(280, 400, 4 * row + i); };
    for (int axis = 0; axis < 3; ++axis)
    {
      placement.steps[axis][static_cast<int>(row)] = srow(static_cast<std::size_t>(axis));
    }
    placement.origin[static_cast<int>(row)] = srow(3);
  }
  return placement;
}

Placement ByQform(const Fields& header)
{
  const auto quatern = [&](std::size_t i) { return header.Float(256, 352, i); };
  const double b = quatern(0);
  const double c = quatern(1);
  const double d = quatern(2);
  const double a = std::sqrt(std::max(0.0, 1 - b * b - c * c - d * d));
  const double qfac = header.Pixdim(0) < 0 ? -1 : 1;
  Placement placement;
  placement.steps[0] = header.Pixdim(1) *
    Vec3(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c));
  placement.steps[1] = header.Pixdim(2) *
    Vec3(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b));
  placement.steps[2] = header.Pixdim(3) * qfac *
    Vec3(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c);
  placement.origin = Vec3(quatern(3), quatern(4), quatern(5));
  return placement;
}

bool IsSheared(const Placement& placement)
{
  Mat3 direction = placement.steps;
  for (int axis = 0; axis < 3; ++axis)
  {
    direction[axis] = glm::normalize(direction[axis]);
  }
  return !(DistanceFromOrthonormal(direction) <= mostRounding);
}

// The sform is newer than the qform, and may be sheared. Both say where the patient's right, front
// and head are.
Grid GridOf(const Fields& header)
{
  const bool hasQform = header.Number<std::int16_t, std::int32_t>(252, 344) > 0;
  const bool hasSform = header.Number<std::int16_t, std::int32_t>(254, 348) > 0;
  Placement placement;
  if (!hasQform && !hasSform)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      placement.steps[axis][axis] = header.Pixdim(static_cast<std::size_t>(axis) + 1);
    }
    return GridOfSteps(NodesOf(header), placement.origin, placement.steps);
  }
  placement = hasSform ? BySform(header) : ByQform(header);
  if (hasQform && hasSform && IsSheared(placement))
  {
    placement = ByQform(header);
  }
  const Vec3 toLeft(-1, -1, 1);
  for (int axis = 0; axis < 3; ++axis)
  {
    placement.steps[axis] *= toLeft;
  }
  return GridOfSteps(NodesOf(header), toLeft * placement.origin, placement.steps);
}

// Returns the number in an attribute of an element of XML, ' Red="0.5"'.
std::optional<double> AttributeIn(const std::string& element, const std::string& name)
{
  const std::string before = " " + name + "=\"";
  const std::size_t at = element.find(before);
  std::istringstream text(at == std::string::npos ? "" : element.substr(at + before.size()));
  text.imbue(std::locale::classic());
  double number = 0;
  return text >> number && text.peek() == '"' ? std::optional<double>(number) : std::nullopt;
}

// Returns the text of an element of XML.
std::string PlainText(std::string text)
{
  const std::array<std::array<const char*, 2>, 5> entities{ { { "&lt;", "<" }, { "&gt;", ">" },
    { "&quot;", "\"" }, { "&apos;", "'" }, { "&amp;", "&" } } };
  for (const auto& [entity, letter] : entities)
  {
    vtksys::SystemTools::ReplaceString(text, entity, letter);
  }
  return text;
}

// Returns the segments in the extensions between header and values, which are a label table of XML
// as of Connectome Workbench and TotalSegmentator:
// <Label Key="5" Red="1" Green="0.5" Blue="0" Alpha="1"><![CDATA[liver]]></Label>.
std::vector<Segment> SegmentsIn(const std::string& text)
{
  const std::string begin = "<Label ";
  const std::string end = "</Label>";
  std::vector<Segment> segments;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1))
  {
    const std::size_t close = text.find('>', at);
    const std::size_t last = text.find(end, at);
    const std::string element = text.substr(at, std::min(close, text.size()) - at);
    const std::optional<double> label = AttributeIn(element, "Key");
    if (last == std::string::npos || close > last || !label || !(std::abs(*label) < 0x1p53))
    {
      continue;
    }
    std::string name = text.substr(close + 1, last - close - 1);
    const std::string cdata = "<![CDATA[";
    if (name.compare(0, cdata.size(), cdata) == 0 && name.size() >= cdata.size() + 3)
    {
      name = name.substr(cdata.size(), name.size() - cdata.size() - 3);
    }
    else
    {
      name = PlainText(name);
    }
    constexpr double none = -1;
    segments.push_back({ static_cast<std::int64_t>(*label),
      { AsUtf8(name),
        ColorOf({ AttributeIn(element, "Red").value_or(none),
                  AttributeIn(element, "Green").value_or(none),
                  AttributeIn(element, "Blue").value_or(none) },
          1) },
      0 });
  }
  return segments;
}

std::string Extensions(const VoxelFile& file, std::int64_t headerSize)
{
  constexpr std::int64_t mostBytes = 1 << 26;
  VoxelFile from = file;
  from.skip = headerSize;
  std::string text(
    static_cast<std::size_t>(std::clamp<std::int64_t>(file.skip - headerSize, 0, mostBytes)), ' ');
  ReadBytes(from, text.data(), static_cast<std::int64_t>(text.size()));
  return text;
}
}

ImageFile ReadNiftiHeader(const std::string& path)
{
  ImageFile file;
  file.voxels.path = path;
  file.voxels.isCompressed = IsGzip(path);
  const Fields header(file.voxels);
  file.grid = GridOf(header);
  file.type = TypeOf(static_cast<int>(header.Number<std::int16_t, std::int16_t>(70, 12)));
  const double given = header.Number<float, std::int64_t>(108, 168);
  const double offset = given == 0 ? double(header.Size() + 4) : given; // behind the extender
  LIMPID_REQUIRE(offset >= header.Size() && offset < 0x1p40,
    "Its values begin at byte " << offset << " (they follow its header of " << header.Size()
                                << " bytes). Write the file again; two files, .hdr and .img, are "
                                   "not supported.");
  file.voxels.skip = static_cast<std::int64_t>(offset);
  const double slope = header.Float(112, 176);
  if (slope != 0 && std::isfinite(slope))
  {
    file.slope = slope;
    const double intercept = header.Float(116, 184);
    file.intercept = std::isfinite(intercept) ? intercept : 0;
  }
  file.segments = SegmentsIn(Extensions(file.voxels, header.Size()));
  return file;
}
}
