// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "StructureTint.h"

#include "StructurePalette.h"

#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <sstream>

namespace limpid
{
namespace
{
std::array<float, 3> DefaultColor(std::size_t row)
{
  const std::array<std::uint8_t, 3>& bytes = PaletteColor(row);
  std::array<float, 3> color{};
  std::transform(bytes.begin(), bytes.end(), color.begin(),
    [](std::uint8_t channel) { return float(channel) / 255; });
  return color;
}

void RequireColor(const LabelColor& given)
{
  LIMPID_REQUIRE(given.label == std::floor(given.label) && std::abs(given.label) < 0x1p53,
    "A label in LabelColors is " << given.label
                                 << " (labels are whole numbers). Set the label of a structure.");
  for (const double channel : given.color)
  {
    LIMPID_REQUIRE(channel >= 0 && channel <= 1,
      "A channel of the color of label "
        << given.label << " in LabelColors is " << channel
        << " (it is a fraction). Set red, green and blue to numbers from 0 to 1.");
  }
}

StructureRow RowOf(const Structures& structures, const LabelColor& given)
{
  return structures.HasAnyLabel() ? StructureRow(0)
                                  : structures.RowOf(static_cast<std::int64_t>(given.label));
}
}

std::vector<std::array<float, 3>> ColorsOf(
  const Structures& structures, const std::vector<LabelColor>& given)
{
  std::vector<std::array<float, 3>> colors;
  while (colors.size() < structures.Count())
  {
    colors.push_back(DefaultColor(colors.size()));
  }
  std::set<double> labels;
  for (const LabelColor& one : given)
  {
    RequireColor(one);
    LIMPID_REQUIRE(labels.insert(one.label).second,
      "Two rows of LabelColors have the label "
        << one.label << " (a structure has one color). Remove one of them.");
    if (const StructureRow row = RowOf(structures, one))
    {
      std::transform(one.color.begin(), one.color.end(), colors[row - std::size_t(1)].begin(),
        [](double channel) { return static_cast<float>(channel); });
    }
  }
  return colors;
}

std::vector<LegendLine> LegendOf(
  const Structures& structures, const std::vector<std::array<float, 3>>& colors)
{
  std::vector<StructureRow> rows;
  for (std::size_t row = 1; row <= structures.Count() && !structures.HasAnyLabel(); ++row)
  {
    const Structure& structure = structures.At(static_cast<StructureRow>(row));
    if (structure.importance > 0 && !structure.name.empty())
    {
      rows.push_back(static_cast<StructureRow>(row));
    }
  }
  std::stable_sort(rows.begin(), rows.end(),
    [&structures](StructureRow one, StructureRow other)
    { return structures.ImportanceOf(one) > structures.ImportanceOf(other); });
  std::vector<LegendLine> lines;
  lines.reserve(rows.size());
  for (const StructureRow row : rows)
  {
    lines.push_back({ structures.At(row).name, colors[row - std::size_t(1)] });
  }
  return lines;
}

std::string WarningOf(const Structures& structures, const std::vector<LabelColor>& given)
{
  std::ostringstream unknown;
  for (const LabelColor& one : given)
  {
    if (RowOf(structures, one) == 0)
    {
      unknown << (unknown.str().empty() ? "" : ", ") << one.label;
    }
  }
  return unknown.str().empty() ? ""
                               : "LabelColors has labels that are not in Structures (these have no "
                                 "color): " +
      unknown.str() + ". Add them to Structures, or remove their colors.";
}
}
