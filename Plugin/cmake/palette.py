#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Prints the colors of structures, Representations/Rendering/StructurePalette.h.

    python3 Plugin/cmake/palette.py > Representations/Rendering/StructurePalette.h

Each color is the one whose distance in CIELAB to the nearest of those before is largest, among
colors that are neither gray nor close to black or white, so that they are readable on both.
"""

COUNT = 64
STEP = 15  # of the channels [of 255]
LIGHTNESS = (42, 82)  # L* of black is 0, of white 100
LEAST_CHROMA = 28  # of grays: 0
FIRST = (225, 45, 45)  # red
HEAD = """\
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
constexpr std::array<std::array<std::uint8_t, 3>, %d> structurePalette{ {
"""
TAIL = """\
} };

/// Returns the colour of the structure in a row, from 0 on, unless it was given another.
constexpr const std::array<std::uint8_t, 3>& PaletteColor(std::size_t row)
{
  return structurePalette[row % structurePalette.size()];
}
}

#endif"""


def lab_of(color):
    """CIELAB of a color in sRGB, for the white point D65."""
    def linear(channel):
        share = channel / 255
        return share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055)**2.4

    red, green, blue = map(linear, color)
    x = (0.4124 * red + 0.3576 * green + 0.1805 * blue) / 0.9505
    y = 0.2126 * red + 0.7152 * green + 0.0722 * blue
    z = (0.0193 * red + 0.1192 * green + 0.9505 * blue) / 1.089

    def bent(value):
        return value**(1 / 3) if value > 216 / 24389 else (24389 / 27 * value + 16) / 116

    return 116 * bent(y) - 16, 500 * (bent(x) - bent(y)), 200 * (bent(y) - bent(z))


def squared_distance(one, other):
    return sum((a - b)**2 for a, b in zip(one, other))


def is_readable(lab):
    lightness, a, b = lab
    return LIGHTNESS[0] <= lightness <= LIGHTNESS[1] and a * a + b * b >= LEAST_CHROMA**2


def palette():
    channels = range(0, 256, STEP)
    candidates = {(r, g, b): lab_of((r, g, b)) for r in channels for g in channels for b in channels}
    candidates = {color: lab for color, lab in candidates.items() if is_readable(lab)}
    chosen = [FIRST]
    distances = {color: squared_distance(lab, lab_of(FIRST)) for color, lab in candidates.items()}
    while len(chosen) < COUNT:
        best = max(distances, key=distances.get)
        chosen.append(best)
        for color, lab in candidates.items():
            distances[color] = min(distances[color], squared_distance(lab, candidates[best]))
    return chosen


if __name__ == "__main__":
    print(HEAD % COUNT, end="")
    for each in palette():
        print("  { { %d, %d, %d } }," % each)
    print(TAIL)
