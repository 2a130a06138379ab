// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Colours of structures in pictures.

#ifndef limpid_StructureTint_h
#define limpid_StructureTint_h

#include "scene/Structures.h"

#include <array>
#include <string>
#include <vector>

namespace limpid
{
/// The colour that a user has given to a label: red, green and blue in [0, 1].
struct LabelColor
{
  double label = 0; ///< a whole number
  std::array<double, 3> color{};
};

/// Returns the colours of structures by row, from row 1 on: the given ones, else those of
/// structurePalette in the order of rows, again and again. Throws Error if a given one is not
/// possible.
std::vector<std::array<float, 3>> ColorsOf(
  const Structures& structures, const std::vector<LabelColor>& given);

/// A line of a legend.
struct LegendLine
{
  std::string name;
  std::array<float, 3> color{};
};

/// Returns the important structures that have names, the most important ones first. `colors`: by
/// row, from row 1 on.
std::vector<LegendLine> LegendOf(
  const Structures& structures, const std::vector<std::array<float, 3>>& colors);

/// Returns a warning about given colours of labels that are not among the structures; may be empty.
std::string WarningOf(const Structures& structures, const std::vector<LabelColor>& given);
}

#endif
