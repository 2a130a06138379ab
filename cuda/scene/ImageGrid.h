// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_ImageGrid_h
#define limpid_scene_ImageGrid_h

#include "scene/Grid.h"

namespace limpid
{
/// Bound of the entries of M^T M - 1 for an orthonormal matrix M whose entries are rounded to three
/// digits. If the entries of two columns d and e are off by at most 0.5e-3, d . e changes by at
/// most 0.5e-3 times the sums of their absolute values, which are at most sqrt(3).
constexpr double mostRounding = 0.5e-3 * 2 * 1.7320508075688772 + 1e-6;

/// Returns the largest entry of |M^T M - 1|; zero for an orthonormal matrix.
double DistanceFromOrthonormal(const Mat3& matrix);

/// Returns the grid of an image in the form of files and scripts: node `index` is at origin +
/// direction (spacing index). A negative spacing becomes positive and its axis is reversed, so that
/// every node keeps its place. A direction matrix that was rounded to three digits or more becomes
/// the nearest orthonormal one. Throws like Grid::Require.
Grid ImageGrid(const Int3& nodes, const Vec3& origin, const Vec3& spacing, const Mat3& direction);
}

#endif
