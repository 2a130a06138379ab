// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Headers of NRRD, see teem.sourceforge.net/nrrd/format.html.

#include "ImageFile.h"
#include "TextHeader.h"

#include "vtkType.h"

#include <vtksys/FStream.hxx>

#include "math/Require.h"

#include <cstddef>
#include <locale>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace limpid
{
namespace
{
const std::map<std::string, int>& NrrdTypes()
{
  static const std::map<std::string, int> types{ { "signed char", VTK_SIGNED_CHAR },
    { "int8", VTK_SIGNED_CHAR }, { "int8_t", VTK_SIGNED_CHAR }, { "uchar", VTK_UNSIGNED_CHAR },
    { "unsigned char", VTK_UNSIGNED_CHAR }, { "uint8", VTK_UNSIGNED_CHAR },
    { "uint8_t", VTK_UNSIGNED_CHAR }, { "short", VTK_SHORT }, { "short int", VTK_SHORT },
    { "signed short", VTK_SHORT }, { "signed short int", VTK_SHORT }, { "int16", VTK_SHORT },
    { "int16_t", VTK_SHORT }, { "ushort", VTK_UNSIGNED_SHORT },
    { "unsigned short", VTK_UNSIGNED_SHORT }, { "unsigned short int", VTK_UNSIGNED_SHORT },
    { "uint16", VTK_UNSIGNED_SHORT }, { "uint16_t", VTK_UNSIGNED_SHORT }, { "int", VTK_INT },
    { "signed int", VTK_INT }, { "int32", VTK_INT }, { "int32_t", VTK_INT },
    { "uint", VTK_UNSIGNED_INT }, { "unsigned int", VTK_UNSIGNED_INT },
    { "uint32", VTK_UNSIGNED_INT }, { "uint32_t", VTK_UNSIGNED_INT }, { "longlong", VTK_LONG_LONG },
    { "long long", VTK_LONG_LONG }, { "long long int", VTK_LONG_LONG },
    { "signed long long", VTK_LONG_LONG }, { "signed long long int", VTK_LONG_LONG },
    { "int64", VTK_LONG_LONG }, { "int64_t", VTK_LONG_LONG },
    { "ulonglong", VTK_UNSIGNED_LONG_LONG }, { "unsigned long long", VTK_UNSIGNED_LONG_LONG },
    { "unsigned long long int", VTK_UNSIGNED_LONG_LONG }, { "uint64", VTK_UNSIGNED_LONG_LONG },
    { "uint64_t", VTK_UNSIGNED_LONG_LONG }, { "float", VTK_FLOAT }, { "double", VTK_DOUBLE } };
  return types;
}

// Returns the colour in a text "0.5 0.7 0.2"; none if it is no such text.
std::optional<Color> ColorIn(const std::string& text)
{
  Color color;
  std::istringstream numbers(text);
  numbers.imbue(std::locale::classic());
  return numbers >> color[0] >> color[1] >> color[2] ? ColorOf(color, 1) : std::nullopt;
}

// Returns the segments of 3D Slicer. Without its newer keys, each has a layer of its own.
std::vector<Segment> SegmentsOf(const TextHeader& header, bool hasLayers)
{
  std::vector<Segment> segments;
  const auto most = static_cast<int>(header.Count()); // numbers may have gaps
  for (int number = 0; number < most; ++number)
  {
    const std::string key = "segment" + std::to_string(number) + "_";
    if (!header.Has(key + "name"))
    {
      continue;
    }
    const std::string label = key + "labelvalue";
    const std::string layer = key + "layer";
    const std::string name = key + "name";
    const std::string color = key + "color";
    segments.push_back({ header.WholeNumber({ label.c_str() }, 1, -0x1p53),
      { header.Text({ name.c_str() }), ColorIn(header.Text({ color.c_str() })) },
      static_cast<int>(header.WholeNumber({ layer.c_str() }, hasLayers ? number : 0, 0)) });
  }
  return segments;
}

// Returns what turns vectors in the space of a file to the left, to the back and to the head.
Vec3 TurnOf(const std::string& space)
{
  static const std::map<std::string, Vec3> turns{ { "right-anterior-superior", Vec3(-1, -1, 1) },
    { "ras", Vec3(-1, -1, 1) }, { "left-anterior-superior", Vec3(1, -1, 1) },
    { "las", Vec3(1, -1, 1) } };
  const auto found = turns.find(space);
  return found == turns.end() ? Vec3(1.0) : found->second;
}

Grid NrrdGrid(const TextHeader& header, const Int3& nodes, std::size_t first)
{
  const std::vector<std::optional<Vec3>> axes = header.Vectors("space directions");
  const Vec3 turn = TurnOf(header.Lower({ "space" }));
  Mat3 steps(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t at = first + static_cast<std::size_t>(axis);
    LIMPID_REQUIRE(axes.empty() || (at < axes.size() && axes[at]),
      "Its field \"space directions\" has no vector for axis "
        << at << " (the values are placed by three of them). Give a volume.");
    if (!axes.empty())
    {
      steps[axis] = turn * *axes[at];
    }
  }
  if (axes.empty())
  {
    std::vector<double> otherwise(first + 3, 1);
    const std::vector<double> spacings = header.Numbers({ "spacings" }, otherwise);
    for (int axis = 0; axis < 3; ++axis)
    {
      steps[axis][axis] = spacings[first + static_cast<std::size_t>(axis)];
    }
  }
  const std::vector<std::optional<Vec3>> origin = header.Vectors("space origin");
  const bool isPlaced = !origin.empty() && origin.front();
  return GridOfSteps(nodes, isPlaced ? turn * *origin.front() : Vec3(0.0), steps);
}
}

ImageFile ReadNrrdHeader(const std::string& path)
{
  vtksys::ifstream stream(path.c_str(), std::ios::in | std::ios::binary);
  std::string magic(4, ' ');
  stream.read(magic.data(), 4);
  LIMPID_REQUIRE(magic == "NRRD",
    "It does not begin with NRRD (files of this format do). Give a file of NRRD, or name it by its "
    "format.");
  const TextHeader header(path, ':', "");
  const std::vector<double> sizes = header.Numbers({ "sizes" });
  const bool hasLayers = sizes.size() == 4 && header.Has("segment0_name");
  LIMPID_REQUIRE(sizes.size() == 3 || hasLayers,
    "It has " << sizes.size()
              << " axes (a volume has 3; one more are layers of segments, if it names these). "
                 "Extract one volume.");
  const std::size_t first = hasLayers ? 1 : 0;
  ImageFile file;
  const Int3 nodes = NodesOf(sizes, first);
  file.grid = NrrdGrid(header, nodes, first);
  file.layers = hasLayers ? static_cast<int>(sizes.front()) : 1;
  file.type = TypeOf(NrrdTypes(), header.Lower({ "type" }));
  file.segments = SegmentsOf(header, hasLayers);
  const std::string encoding = header.Lower({ "encoding" });
  LIMPID_REQUIRE(std::set<std::string>({ "raw", "gzip", "gz" }).count(encoding) != 0,
    "Its encoding is \"" << encoding << "\" (raw and gzip are read). Write it as one of these.");
  file.voxels.isCompressed = encoding != "raw";
  file.voxels.isBigEndian = header.Lower({ "endian" }) == "big";
  SetVoxels(path, header.Text({ "data file", "datafile" }), header.Length(), file.voxels);
  LIMPID_REQUIRE(header.WholeNumber({ "line skip", "lineskip" }, 0, 0) == 0,
    "It skips lines (only bytes are). Write it without.");
  const std::int64_t skip = header.WholeNumber({ "byte skip", "byteskip" }, 0, VoxelFile::atEnd);
  if (skip == VoxelFile::atEnd)
  {
    file.voxels.offset = skip;
  }
  else
  {
    file.voxels.skip = skip;
  }
  return file;
}
}
