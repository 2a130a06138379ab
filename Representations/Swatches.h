// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_Swatches_h
#define limpid_Swatches_h

#include <array>
#include <vector>

class vtkViewport;

namespace limpid
{
/// A colour with its opacity: red, green, blue, alpha in [0, 1].
using Color = std::array<double, 4>;

/// Draws a plate of a colour and, from its top down, a square for each line that has a colour.
/// `place`: a point [width and height of the viewport]. `box`: left, right, lower and upper end of
/// the plate, from there [pixels]. `lines`: number of lines in its height. Returns whether anything
/// was drawn.
int DrawSwatches(vtkViewport* viewport, const double place[2], const double box[4],
  const Color& plate, int lines, const std::vector<Color>& colors);
}

#endif
