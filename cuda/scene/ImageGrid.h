// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_ImageGrid_h
#define limpid_scene_ImageGrid_h

#include "scene/Grid.h"

namespace limpid
{
/// What rounding the entries of an orthonormal matrix M to three digits changes in M^T M at most:
/// a column d and another one e, with entries off by 0.5e-3 at most, change d . e by 0.5e-3 times
/// the sums of their absolute values, which are at most sqrt(3).
constexpr double mostRounding = 0.5e-3 * 2 * 1.7320508075688772 + 1e-6;

/// Largest entry of M^T M - 1; zero for an orthonormal matrix.
double DistanceFromOrthonormal(const Mat3& matrix);

/// The grid of an image as files and scripts place it: node `index` is at
/// origin + direction (spacing index). A negative spacing becomes positive and turns its axis
/// round, which leaves every node where it is. A direction matrix that was rounded to three digits
/// or more becomes the nearest orthonormal one. Throws as Grid::Require does.
Grid ImageGrid(const Int3& nodes, const Vec3& origin, const Vec3& spacing, const Mat3& direction);
}

#endif
