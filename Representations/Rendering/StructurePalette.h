// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Made by Plugin/cmake/palette.py, which says how.

#ifndef limpid_StructurePalette_h
#define limpid_StructurePalette_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace limpid
{
/// Colours of structures, each as different as possible from those before: red, green, blue in 8
/// bits.
constexpr std::array<std::array<std::uint8_t, 3>, 64> structurePalette{ {
  { { 225, 45, 45 } },
  { { 0, 225, 0 } },
  { { 30, 75, 255 } },
  { { 0, 210, 240 } },
  { { 240, 195, 0 } },
  { { 255, 165, 240 } },
  { { 60, 120, 45 } },
  { { 255, 0, 240 } },
  { { 0, 105, 195 } },
  { { 210, 150, 120 } },
  { { 240, 0, 135 } },
  { { 0, 225, 165 } },
  { { 150, 60, 180 } },
  { { 165, 210, 75 } },
  { { 255, 135, 30 } },
  { { 150, 75, 105 } },
  { { 135, 105, 0 } },
  { { 0, 120, 120 } },
  { { 195, 210, 150 } },
  { { 165, 180, 240 } },
  { { 165, 0, 255 } },
  { { 255, 120, 135 } },
  { { 0, 180, 60 } },
  { { 165, 75, 30 } },
  { { 120, 120, 255 } },
  { { 255, 120, 255 } },
  { { 240, 180, 90 } },
  { { 30, 120, 165 } },
  { { 150, 105, 180 } },
  { { 105, 195, 165 } },
  { { 255, 180, 195 } },
  { { 180, 45, 135 } },
  { { 225, 15, 180 } },
  { { 195, 30, 75 } },
  { { 180, 90, 255 } },
  { { 135, 150, 45 } },
  { { 0, 180, 255 } },
  { { 255, 0, 0 } },
  { { 255, 135, 90 } },
  { { 135, 90, 60 } },
  { { 135, 225, 30 } },
  { { 120, 210, 120 } },
  { { 120, 150, 105 } },
  { { 255, 120, 180 } },
  { { 255, 0, 90 } },
  { { 195, 150, 255 } },
  { { 180, 0, 195 } },
  { { 195, 150, 195 } },
  { { 195, 120, 30 } },
  { { 30, 165, 105 } },
  { { 180, 180, 0 } },
  { { 105, 105, 45 } },
  { { 210, 75, 0 } },
  { { 75, 150, 0 } },
  { { 120, 150, 255 } },
  { { 180, 75, 75 } },
  { { 135, 210, 255 } },
  { { 195, 150, 0 } },
  { { 210, 105, 195 } },
  { { 210, 195, 90 } },
  { { 0, 225, 210 } },
  { { 210, 180, 120 } },
  { { 105, 120, 180 } },
  { { 120, 225, 90 } },
} };

/// Returns the colour of the structure in a row, from 0 on, unless it was given another.
constexpr const std::array<std::uint8_t, 3>& PaletteColor(std::size_t row)
{
  return structurePalette[row % structurePalette.size()];
}
}

#endif
