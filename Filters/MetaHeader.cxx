// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Headers of MetaImage.

#include "ImageFile.h"
#include "TextHeader.h"

#include "vtkType.h"

#include "math/Require.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace limpid
{
namespace
{
const std::map<std::string, int>& MetaTypes()
{
  static const std::map<std::string, int> types{ { "met_char", VTK_SIGNED_CHAR },
    { "met_uchar", VTK_UNSIGNED_CHAR }, { "met_short", VTK_SHORT },
    { "met_ushort", VTK_UNSIGNED_SHORT }, { "met_int", VTK_INT }, { "met_uint", VTK_UNSIGNED_INT },
    { "met_long", VTK_INT }, { "met_ulong", VTK_UNSIGNED_INT }, { "met_long_long", VTK_LONG_LONG },
    { "met_ulong_long", VTK_UNSIGNED_LONG_LONG }, { "met_float", VTK_FLOAT },
    { "met_double", VTK_DOUBLE } };
  return types;
}

// Returns whether a field says yes: "True", "T" or "1".
bool IsTrue(const TextHeader& header, TextHeader::Names names)
{
  const std::string text = header.Lower(names);
  return !text.empty() && (text.front() == 't' || text.front() == '1');
}
}

ImageFile ReadMetaHeader(const std::string& path)
{
  const TextHeader header(path, '=', "elementdatafile");
  const std::vector<double> sizes = header.Numbers({ "dimsize" });
  const std::size_t count = sizes.size(); // of axes
  LIMPID_REQUIRE(count == 3 || (count == 4 && sizes.back() == 1),
    "It has " << count
              << " axes (a volume has 3; one more may have a single entry). Give a volume as a "
                 "MetaImage.");
  LIMPID_REQUIRE(header.WholeNumber({ "elementnumberofchannels" }, 1, 1) == 1,
    "It has several numbers per point (labels are one). Extract one channel.");
  ImageFile file;
  const std::vector<double> spacing =
    header.Numbers({ "elementspacing", "elementsize" }, std::vector<double>(count, 1));
  const std::vector<double> origin =
    header.Numbers({ "offset", "origin", "position" }, std::vector<double>(count, 0));
  std::vector<double> axes(count * count, 0);
  for (std::size_t axis = 0; axis < count; ++axis)
  {
    axes[axis * (count + 1)] = 1;
  }
  axes = header.Numbers({ "transformmatrix", "rotation", "orientation" }, axes);
  Mat3 steps;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    steps[static_cast<int>(axis)] =
      spacing[axis] * Vec3(axes[count * axis], axes[count * axis + 1], axes[count * axis + 2]);
  }
  file.grid = GridOfSteps(NodesOf(sizes, 0), Vec3(origin[0], origin[1], origin[2]), steps);
  file.type = TypeOf(MetaTypes(), header.Lower({ "elementtype" }));
  LIMPID_REQUIRE(!header.Has("binarydata") || IsTrue(header, { "binarydata" }),
    "Its values are written as text (only binary ones are read). Write it with BinaryData = True.");
  file.voxels.isCompressed = IsTrue(header, { "compresseddata" });
  file.voxels.isBigEndian = IsTrue(header, { "binarydatabyteordermsb", "elementbyteordermsb" });
  const std::string dataFile = header.Text({ "elementdatafile" });
  SetVoxels(path, header.Lower({ "elementdatafile" }) == "local" ? "" : dataFile, header.Length(),
    file.voxels);
  const std::int64_t skip = header.WholeNumber({ "headersize" }, 0, VoxelFile::atEnd);
  file.voxels.offset = skip != 0 ? skip : file.voxels.offset;
  return file;
}
}
