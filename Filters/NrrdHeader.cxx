// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Headers of NRRD, see teem.sourceforge.net/nrrd/format.html.

#include "ImageFile.h"
#include "TextHeader.h"
#include "Utf8.h"

#include "vtkType.h"

#include <vtksys/FStream.hxx>

#include "math/Require.h"

#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
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

// Returns the segments of 3D Slicer. Without its newer keys, each has a layer of its own, or, in a
// file without layers, a label of its own.
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
    segments.push_back({ header.WholeNumber({ label.c_str() }, hasLayers ? 1 : number + 1, -0x1p53),
      { AsUtf8(header.Text({ name.c_str() })), ColorIn(header.Text({ color.c_str() })) },
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

// The axes of a file.
struct NrrdAxes
{
  std::vector<double> sizes;
  std::vector<std::optional<Vec3>> directions; ///< empty: not given
  bool hasLayers;                              ///< whether the first one counts layers of segments
  std::size_t first = 0;                       ///< of the three of the volume

  explicit NrrdAxes(const TextHeader& header)
    : sizes(header.Numbers({ "sizes" }))
    , directions(header.Vectors("space directions"))
    , hasLayers(this->sizes.size() == 4 && header.Has("segment0_name"))
  {
    const bool hasFourth = this->sizes.size() == 4;
    const bool isFourthFirst = hasFourth &&
      (this->directions.empty() ? this->sizes.front() == 1 : !this->directions.front().has_value());
    this->first = this->hasLayers || isFourthFirst ? 1 : 0;
    const double entries = isFourthFirst ? this->sizes.front() : this->sizes.back();
    LIMPID_REQUIRE(this->sizes.size() == 3 || this->hasLayers || (hasFourth && entries == 1),
      "It has " << this->sizes.size()
                << " axes (a volume has 3; one more has layers of segments, if it names these, or "
                   "a single entry). Extract one volume.");
  }
};

// Returns the grid of a file that has distances and places along its axes only.
Grid GridAlongAxes(const TextHeader& header, const NrrdAxes& axes, const Int3& nodes)
{
  const std::vector<double> none(axes.sizes.size(), std::numeric_limits<double>::quiet_NaN());
  const std::vector<double> spacings = header.Numbers({ "spacings" }, none);
  const std::vector<double> mins = header.Numbers({ "axis mins", "axismins" }, none);
  const std::vector<double> maxs = header.Numbers({ "axis maxs", "axismaxs" }, none);
  std::istringstream centres(header.Lower({ "centers", "centerings" }));
  const std::vector<std::string> centring{ std::istream_iterator<std::string>(centres), {} };
  Mat3 steps(0.0);
  Vec3 origin(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t at = axes.first + static_cast<std::size_t>(axis);
    const bool isOfCells = at < centring.size() && centring[at] == "cell";
    const double parts = nodes[axis] - (isOfCells ? 0.0 : 1.0);
    const double length = maxs[at] - mins[at];
    const double fromEnds = parts > 0 && std::isfinite(length) ? length / parts : 1.0;
    steps[axis][axis] = std::isnan(spacings[at]) ? fromEnds : spacings[at];
    const double toFirst = isOfCells ? 0.5 * steps[axis][axis] : 0.0;
    origin[axis] = std::isfinite(mins[at]) ? mins[at] + toFirst : 0.0;
  }
  return GridOfSteps(nodes, origin, steps);
}

Grid NrrdGrid(const TextHeader& header, const NrrdAxes& axes, const Int3& nodes)
{
  const std::vector<std::optional<Vec3>> place = header.Vectors("space origin");
  const bool isPlaced = !place.empty() && place.front();
  const Vec3 turn = TurnOf(header.Lower({ "space" }));
  const Vec3 origin = isPlaced ? turn * *place.front() : Vec3(0.0);
  if (axes.directions.empty())
  {
    Grid grid = GridAlongAxes(header, axes, nodes);
    grid.origin = isPlaced ? origin : grid.origin;
    return grid;
  }
  Mat3 steps(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t at = axes.first + static_cast<std::size_t>(axis);
    LIMPID_REQUIRE(at < axes.directions.size() && axes.directions[at],
      "Its field \"space directions\" has no vector for axis "
        << at << " (the values are placed by three of them). Give a volume.");
    steps[axis] = turn * *axes.directions[at];
  }
  return GridOfSteps(nodes, origin, steps);
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
  const NrrdAxes axes(header);
  ImageFile file;
  const Int3 nodes = NodesOf(axes.sizes, axes.first);
  file.grid = NrrdGrid(header, axes, nodes);
  file.layers = axes.hasLayers ? static_cast<int>(axes.sizes.front()) : 1;
  file.type = TypeOf(NrrdTypes(), header.Lower({ "type" }));
  file.segments = SegmentsOf(header, axes.hasLayers);
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
