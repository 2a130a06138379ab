// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Which rays to march for an integral over the whole box.

#ifndef limpid_testing_Bundles_h
#define limpid_testing_Bundles_h

#include "RayMarch.h"

#include <vector>

namespace truth
{
/// The middle of an interval of u or v, and its width.
struct Stripe
{
  double middle;
  double width;
};

/// Rays through a grid of (u, v), in index space. From a point source they start in one point with
/// directions n + u a + v b, parallel ones start in u a + v b and run along n. The axes a and b of
/// the grid and the n-th component of n, 1 or -1, make the determinant of the parametrisation 1.
struct Bundle
{
  Vector n;
  int a, b;
  std::vector<Stripe> columns, rows;
};

/// One bundle where it sees the whole box under moderate angles, otherwise six frusta.
std::vector<Bundle> Bundles(const Lattice& lattice, const Source& source, const Sampling& sampling);
}

#endif
