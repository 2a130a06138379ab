// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "StructureTableFile.h"

#include "TextHeader.h"
#include "Utf8.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

namespace limpid
{
namespace
{
using Fields = std::vector<std::string>;
using Row = std::pair<std::int64_t, StructureLook>; // label, name and colour

// Splits a line at any of some characters outside of double quotes, which stay.
Fields Split(const std::string& line, const std::string& delimiters)
{
  Fields fields(1);
  bool isQuoted = false;
  for (const char letter : line)
  {
    isQuoted = isQuoted != (letter == '"');
    if (!isQuoted && delimiters.find(letter) != std::string::npos)
    {
      fields.emplace_back();
    }
    else
    {
      fields.back() += letter;
    }
  }
  return fields;
}

Fields WordsOf(const std::string& line)
{
  Fields words = Split(line, blanks);
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  return words;
}

// Returns what a field says: without blanks around it, and without its quotes.
std::string TextOf(const std::string& field)
{
  std::string text = Trimmed(field);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
  {
    text = text.substr(1, text.size() - 2);
    vtksys::SystemTools::ReplaceString(text, "\"\"", "\"");
  }
  return text;
}

std::optional<std::int64_t> LabelIn(const std::string& field)
{
  const std::string text = TextOf(field);
  std::int64_t label = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), label);
  const bool isAll = end == text.data() + text.size();
  return error == std::errc() && isAll ? std::optional<std::int64_t>(label) : std::nullopt;
}

// Returns the colour in three words with numbers from 0 to 255; none if they are no such numbers.
std::optional<Color> ColorIn(const Fields& words, std::size_t first)
{
  Color color;
  for (std::size_t channel = 0; channel < color.size(); ++channel)
  {
    color[channel] = static_cast<double>(LabelIn(words[first + channel]).value_or(-1));
  }
  return ColorOf(color, 255);
}

// Reads the rows of a table, line by line.
class TableReader
{
public:
  // Returns what a line that is not empty says; none: nothing that can be read.
  std::optional<Row> Read(const std::string& line)
  {
    const bool isFirst = std::exchange(this->IsFirst, false);
    const Fields words = WordsOf(line);
    if (words.size() == 8 && words.back().front() == '"' && LabelIn(words[0]))
    {
      return Row(*LabelIn(words[0]), { TextOf(words.back()), ColorIn(words, 1) }); // of ITK-SNAP
    }
    const bool hasColor = words.size() >= 5 &&
      std::all_of(words.begin() + 2, words.begin() + 5,
        [](const auto& word) { return LabelIn(word).has_value(); });
    const bool hasCommas = Split(line, ",;").size() > 1;
    if (!hasCommas && (words.size() == 2 || hasColor) && LabelIn(words[0]) && !LabelIn(words[1]))
    {
      // of FreeSurfer
      return Row(
        *LabelIn(words[0]), { TextOf(words[1]), hasColor ? ColorIn(words, 2) : std::nullopt });
    }
    return this->ReadDelimited(line, isFirst);
  }

  // Returns whether the last line was the names of columns.
  bool WasHeader() const { return this->IsHeader; }

private:
  std::optional<Row> ReadDelimited(const std::string& line, bool isFirst)
  {
    const std::size_t at = line.find_first_of(",;\t");
    const Fields fields = Split(line, at == std::string::npos ? "," : line.substr(at, 1));
    this->IsHeader =
      isFirst && fields.size() > 1 && std::none_of(fields.begin(), fields.end(), LabelIn);
    if (this->IsHeader)
    {
      this->UseColumns(fields);
      return std::nullopt;
    }
    if (fields.size() <= std::max(this->LabelColumn, this->NameColumn))
    {
      return std::nullopt;
    }
    const auto label = LabelIn(fields[this->LabelColumn]);
    return label ? std::optional<Row>({ *label, { TextOf(fields[this->NameColumn]), {} } })
                 : std::nullopt;
  }

  void UseColumns(const Fields& header)
  {
    std::optional<std::size_t> label;
    std::optional<std::size_t> name;
    for (std::size_t column = 0; column < header.size(); ++column)
    {
      const std::string title = vtksys::SystemTools::LowerCase(TextOf(header[column]));
      label = title == "label" ? column : label;
      name = title == "name" ? column : name;
    }
    if (label && name)
    {
      this->LabelColumn = *label;
      this->NameColumn = *name;
    }
  }

  bool IsFirst = true;
  bool IsHeader = false;
  std::size_t LabelColumn = 0;
  std::size_t NameColumn = 1;
};

// Returns the beginning of a line for a message.
std::string Excerpt(const std::string& line)
{
  constexpr std::size_t most = 40;
  std::string text = line.substr(0, most) + (line.size() > most ? "..." : "");
  std::replace_if(
    text.begin(), text.end(), [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  return text;
}
}

StructureTableFile ReadStructureTable(const std::string& path)
{
  StructureTableFile table;
  const std::string subject = "The table file \"" + path + "\" ";
  vtksys::ifstream file(path.c_str());
  if (!file || vtksys::SystemTools::FileIsDirectory(path))
  {
    table.warning = subject +
      "cannot be opened (it has the names of structures, which stay as they are in the data). "
      "Correct TableFile, or leave it empty.";
    return table;
  }
  TableReader reader;
  std::size_t wrong = 0;
  std::ostringstream first; // of the wrong lines
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number)
  {
    const std::string byteOrderMark = "\xEF\xBB\xBF";
    const bool isMarked = number == 1 && line.compare(0, 3, byteOrderMark) == 0;
    line = AsUtf8(Trimmed(isMarked ? line.substr(3) : line));
    if (line.empty() || line.front() == '#')
    {
      continue;
    }
    if (const auto row = reader.Read(line))
    {
      table.looks[row->first] = row->second;
    }
    else if (!reader.WasHeader() && wrong++ == 0)
    {
      first << ", the first is line " << number << ", \"" << Excerpt(line) << "\"";
    }
  }
  if (table.looks.empty() || wrong > 0)
  {
    table.warning = subject +
      (table.looks.empty() ? "has no row that can be read"
                           : "has " + std::to_string(wrong) + " rows that cannot be read") +
      first.str() +
      " (a row has a label, which is a whole number, and a name). Correct it; rows that can be "
      "read "
      "are used.";
  }
  return table;
}
}
