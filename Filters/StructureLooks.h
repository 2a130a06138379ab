// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Names and colours of labels, in the field data of the image that has these.

#ifndef limpid_StructureLooks_h
#define limpid_StructureLooks_h

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

class vtkImageData;

namespace limpid
{
using Color = std::array<double, 3>; ///< red, green and blue [0, 1]

/// What a label is called, and the colour it is drawn in.
struct StructureLook
{
  std::string name{};
  std::optional<Color> color{};
};

using StructureLooks = std::map<std::int64_t, StructureLook>; ///< by label

/// Returns a colour of numbers from 0 to `most`; none if one is not among these.
std::optional<Color> ColorOf(const Color& numbers, double most);

/// Gives names and colours to an image, as the arrays "StructureLabels", "StructureNames" and
/// "StructureColors", NaN where there is none. The arrays are missing where they would be empty.
void SetStructureLooks(const StructureLooks& looks, vtkImageData* image);

/// Returns the names and colours that an image has.
StructureLooks StructureLooksOf(vtkImageData* image);
}

#endif
