// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "TextHeader.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <locale>
#include <sstream>

namespace limpid
{
std::string Trimmed(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

TextHeader::TextHeader(const std::string& path, char delimiter, const std::string& last)
{
  vtksys::ifstream stream(path.c_str(), std::ios::in | std::ios::binary);
  std::string line;
  while (!this->Has(last) && std::getline(stream, line) && !(last.empty() && Trimmed(line).empty()))
  {
    const std::size_t at = line.find(delimiter);
    if (line.compare(0, 1, "#") != 0 && at != std::string::npos)
    {
      const std::size_t value = at + (line.compare(at, 2, ":=") == 0 ? 2 : 1);
      this->Fields[vtksys::SystemTools::LowerCase(Trimmed(line.substr(0, at)))] =
        Trimmed(line.substr(value));
    }
  }
  this->Bytes = stream ? static_cast<std::int64_t>(stream.tellg()) : 0;
}

std::string TextHeader::Text(Names names) const
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

std::string TextHeader::Lower(Names names) const
{
  return vtksys::SystemTools::LowerCase(this->Text(names));
}

std::vector<double> TextHeader::Numbers(Names names) const
{
  std::istringstream words(this->Text(names));
  std::vector<double> numbers;
  for (std::string word; words >> word;)
  {
    double number = std::numeric_limits<double>::quiet_NaN();
    std::istringstream digits(word);
    digits.imbue(std::locale::classic());
    const bool isNumber = (digits >> number) && digits.peek() == EOF;
    LIMPID_REQUIRE(isNumber || vtksys::SystemTools::LowerCase(word) == "nan",
      "Its field \"" << *names.begin() << "\" is \"" << words.str()
                     << "\" (it has to be numbers). Correct the header.");
    numbers.push_back(isNumber ? number : std::numeric_limits<double>::quiet_NaN());
  }
  return numbers;
}

std::vector<double> TextHeader::Numbers(Names names, const std::vector<double>& otherwise) const
{
  std::vector<double> numbers = this->Numbers(names);
  numbers = numbers.empty() ? otherwise : numbers;
  LIMPID_REQUIRE(numbers.size() == otherwise.size(),
    "Its field \"" << *names.begin() << "\" has " << numbers.size() << " numbers (there should be "
                   << otherwise.size() << "). Correct the header.");
  return numbers;
}

std::int64_t TextHeader::WholeNumber(Names names, std::int64_t otherwise, double least) const
{
  const double number = this->Numbers(names, { static_cast<double>(otherwise) }).front();
  LIMPID_REQUIRE(number >= least && number < 0x1p53 && number == std::floor(number),
    "Its field \"" << *names.begin() << "\" is " << number << " (it is a whole number from "
                   << least << " on). Correct the header.");
  return static_cast<std::int64_t>(number);
}

std::vector<std::optional<Vec3>> TextHeader::Vectors(const char* name) const
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
}
