// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Headers of NRRD (teem.sourceforge.net/nrrd/format.html) and MetaImage, which are lines of text.

#include "ImageFile.h"

#include "vtkType.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include "math/Require.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <locale>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace limpid
{
namespace
{
std::string Trimmed(const std::string& text)
{
  const char* const blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

// The fields of a header, by their names in lower case.
class TextHeader
{
public:
  // Reads up to an empty line, or up to the field `last`.
  TextHeader(const std::string& path, char delimiter, const std::string& last)
  {
    vtksys::ifstream stream(path.c_str(), std::ios::in | std::ios::binary);
    std::string line;
    while (!this->Has(last) && std::getline(stream, line) && !Trimmed(line).empty())
    {
      const std::size_t at = line.find(delimiter);
      if (line.front() != '#' && at != std::string::npos)
      {
        const std::size_t value = at + (line.compare(at, 2, ":=") == 0 ? 2 : 1);
        this->Fields[vtksys::SystemTools::LowerCase(Trimmed(line.substr(0, at)))] =
          Trimmed(line.substr(value));
      }
    }
    this->Length = stream ? static_cast<std::int64_t>(stream.tellg()) : 0;
  }

  bool Has(const std::string& name) const { return this->Fields.count(name) != 0; }

  // Returns a field by one of its names; empty: there is none.
  std::string Text(std::initializer_list<const char*> names) const
  {
    for (const char* name : names)
    {
      const auto found = this->Fields.find(name);
      if (found != this->Fields.end())
      {
        return found->second;
      }
    }
    return "";
  }

  std::string Lower(std::initializer_list<const char*> names) const
  {
    return vtksys::SystemTools::LowerCase(this->Text(names));
  }

  // Returns the numbers of a field. Throws Error if it has anything else.
  std::vector<double> Numbers(std::initializer_list<const char*> names) const
  {
    std::istringstream text(this->Text(names));
    text.imbue(std::locale::classic());
    std::vector<double> numbers;
    for (double number = 0; text >> number;)
    {
      numbers.push_back(number);
    }
    LIMPID_REQUIRE(text.eof(),
      "Its field \"" << *names.begin() << "\" is \"" << text.str()
                     << "\" (it has to be numbers). Correct the header.");
    return numbers;
  }

  // Returns the numbers of a field, `count` of them, or `otherwise` if there is no such field.
  std::vector<double> Numbers(
    std::initializer_list<const char*> names, const std::vector<double>& otherwise) const
  {
    std::vector<double> numbers = this->Numbers(names);
    numbers = numbers.empty() ? otherwise : numbers;
    LIMPID_REQUIRE(numbers.size() == otherwise.size(),
      "Its field \"" << *names.begin() << "\" has " << numbers.size()
                     << " numbers (there should be " << otherwise.size()
                     << "). Correct the header.");
    return numbers;
  }

  // Returns an axis for each vector, or none for "none": (1,0,0) none (0,1,0).
  std::vector<std::optional<Vec3>> Vectors(const char* name) const
  {
    std::string text = this->Text({ name });
    std::replace_if(
      text.begin(), text.end(), [](char letter) { return letter == ',' || letter == '('; }, ' ');
    std::vector<std::optional<Vec3>> vectors;
    std::istringstream parts(text);
    parts.imbue(std::locale::classic());
    while (parts >> std::ws && !parts.eof())
    {
      std::string part;
      if (parts.peek() == 'n')
      {
        parts >> part;
        vectors.emplace_back();
        continue;
      }
      Vec3 vector(0.0);
      char close = ' ';
      parts >> vector.x >> vector.y >> vector.z >> close;
      LIMPID_REQUIRE(parts && close == ')',
        "Its field \"" << name << "\" is \"" << this->Text({ name })
                       << "\" (it has to be vectors of three numbers). Correct the header.");
      vectors.emplace_back(vector);
    }
    return vectors;
  }

  const std::map<std::string, std::string>& All() const { return this->Fields; }

  std::int64_t Length = 0; // bytes of the header

private:
  std::map<std::string, std::string> Fields;
};

Int3 NodesOf(const std::vector<double>& sizes, std::size_t first)
{
  for (const double size : sizes)
  {
    LIMPID_REQUIRE(size >= 1 && size <= 65536 && size == static_cast<int>(size),
      "It has " << size
                << " points along an axis (whole numbers from 1 to 65536 are supported). "
                   "Correct the header.");
  }
  return Int3(sizes[first], sizes[first + 1], sizes[first + 2]);
}

int TypeOf(const std::map<std::string, int>& types, const std::string& name)
{
  const auto found = types.find(name);
  LIMPID_REQUIRE(found != types.end(),
    "Its values are of type \"" << name
                                << "\" (numbers of 8 to 64 bits are read). Convert it to one of "
                                   "these.");
  return found->second;
}

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

// Sets where the values are: behind the header, or in a file that it names.
void SetVoxels(const std::string& path, const std::string& dataFile, std::int64_t headerLength,
  VoxelFile& voxels)
{
  if (dataFile.empty())
  {
    voxels.path = path;
    voxels.offset = headerLength;
    return;
  }
  const bool isOne = dataFile.find('%') == std::string::npos && dataFile.rfind("LIST", 0) != 0;
  LIMPID_REQUIRE(isOne,
    "Its values are in several files, \"" << dataFile
                                          << "\" (one file is read). Write them into one file.");
  voxels.path = vtksys::SystemTools::CollapseFullPath(
    dataFile, vtksys::SystemTools::GetFilenamePath(vtksys::SystemTools::CollapseFullPath(path)));
}

// Returns the segments of 3D Slicer. Without its newer keys, each has a layer of its own.
std::vector<Segment> SegmentsOf(const TextHeader& header, bool hasLayers)
{
  std::vector<Segment> segments;
  for (int number = 0; header.Has("segment" + std::to_string(number) + "_name"); ++number)
  {
    const std::string key = "segment" + std::to_string(number) + "_";
    const auto value = [&](const char* name, int otherwise)
    {
      const std::string field = key + name;
      return static_cast<std::int64_t>(
        header.Numbers({ field.c_str() }, { static_cast<double>(otherwise) }).front());
    };
    const std::string name = key + "name";
    segments.push_back({ value("labelvalue", 1), header.Text({ name.c_str() }),
      static_cast<int>(value("layer", hasLayers ? number : 0)) });
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
  SetVoxels(path, header.Text({ "data file", "datafile" }), header.Length, file.voxels);
  const double skip = header.Numbers({ "byte skip", "byteskip" }, { 0 }).front();
  LIMPID_REQUIRE(
    skip >= VoxelFile::atEnd && header.Numbers({ "line skip", "lineskip" }, { 0 }).front() == 0,
    "It skips lines or " << skip
                         << " bytes (at least 0, or -1 for values at the end, are read). "
                            "Write it without.");
  if (skip == VoxelFile::atEnd)
  {
    file.voxels.offset = VoxelFile::atEnd;
  }
  else
  {
    file.voxels.skip = static_cast<std::int64_t>(skip);
  }
  return file;
}

ImageFile ReadMetaHeader(const std::string& path)
{
  const TextHeader header(path, '=', "elementdatafile");
  const std::vector<double> sizes = header.Numbers({ "dimsize" });
  LIMPID_REQUIRE(sizes.size() == 3,
    "It has " << sizes.size() << " axes (a volume has 3). Give a volume as a MetaImage.");
  LIMPID_REQUIRE(header.Numbers({ "elementnumberofchannels" }, { 1 }).front() == 1,
    "It has several numbers per point (labels are one). Extract one channel.");
  ImageFile file;
  const std::vector<double> spacing =
    header.Numbers({ "elementspacing", "elementsize" }, { 1, 1, 1 });
  const std::vector<double> origin =
    header.Numbers({ "offset", "origin", "position" }, { 0, 0, 0 });
  const std::vector<double> axes =
    header.Numbers({ "transformmatrix", "rotation", "orientation" }, { 1, 0, 0, 0, 1, 0, 0, 0, 1 });
  Mat3 steps;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    steps[static_cast<int>(axis)] =
      spacing[axis] * Vec3(axes[3 * axis], axes[3 * axis + 1], axes[3 * axis + 2]);
  }
  file.grid = GridOfSteps(NodesOf(sizes, 0), Vec3(origin[0], origin[1], origin[2]), steps);
  file.type = TypeOf(MetaTypes(), header.Lower({ "elementtype" }));
  file.voxels.isCompressed = header.Lower({ "compresseddata" }) == "true";
  file.voxels.isBigEndian =
    header.Lower({ "binarydatabyteordermsb", "elementbyteordermsb" }) == "true";
  const std::string dataFile = header.Text({ "elementdatafile" });
  SetVoxels(path, dataFile == "LOCAL" ? "" : dataFile, header.Length, file.voxels);
  const double skip = header.Numbers({ "headersize" }, { 0 }).front();
  file.voxels.offset = skip != 0 ? static_cast<std::int64_t>(skip) : file.voxels.offset;
  return file;
}
}
