// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The independent truth of what can be seen at most: a march in double precision that shares no
// code with cuda/. Every ray chooses its own extinction between two bounds, from its end on in
// small steps (Documentation/Method.md, section on the ceiling).

#ifndef limpid_testing_CeilingMarch_h
#define limpid_testing_CeilingMarch_h

#include "RayMarch.h"

namespace truth
{
/// Fields on a lattice, first axis fastest; the caller owns them.
struct BoundedVolume
{
  Lattice lattice;
  const float* importance = nullptr; ///< [0, 1]
  const float* least = nullptr;      ///< lower bound of the extinction [1/length]
  const float* most = nullptr;       ///< upper bound [1/length]
};

/// The largest integral of importance x extinction x transmittance over the box, if each ray has an
/// extinction of its own between the bounds [length^2]. `samplesPerVoxel`: steps in a cell; more
/// where it is opaque.
double CeilingOf(const BoundedVolume& volume, const Source& source, const Sampling& sampling);
}

#endif
