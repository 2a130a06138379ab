// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_VisibilityTerm_h
#define limpid_energy_VisibilityTerm_h

#include "energy/Derivative.h"
#include "energy/GradientVoxel.h"
#include "sweep/Sweep.h"

#include <vector>

namespace limpid
{
/// What a derivative is taken of; the arrays belong to the caller, NodeCount() values each.
struct TermFields
{
  const float* extinction;     ///< [1/length]
  const float* importance;     ///< [0, 1]
  const float* nodeImportance; ///< see NodeImportance.h [0, 1]
};

/**
 * One of the two visibility terms of the energy, Eq. (23) or (24): what a camera or a light sees.
 *
 * Holds the rays; the fields stay with the caller, grid.NodeCount() values each. So does the
 * occupancy; extinctions and importances are 0 where it is not filled.
 */
class VisibilityTerm
{
public:
  VisibilityTerm(
    const Grid& grid, const Occupancy& occupancy, const RaySource& eye, double rayDensity);

  /// Integral of g mu T and its bound; leaves the optical depths of all rays in their images.
  Visible Forward(const float* extinction, const float* importance);

  /// The same of the rays of one frustum.
  Visible ForwardAt(std::size_t index, const float* extinction, const float* importance);

  /// The same; also adds `weight` times the derivative to `gradient` [1]. Leaves no optical depths.
  Visible AddGradient(
    const TermFields& fields, Derivative derivative, float weight, float* gradient);

  /// The same, but sets the derivative. Only voxels that the term depends on are written, which are
  /// always the same ones.
  Visible SetGradient(const TermFields& fields, Derivative derivative, float* gradient);

  std::size_t FrustumCount() const { return this->Frusta.size(); }
  const FaceFrustum& FrustumAt(std::size_t index) const { return this->Frusta[index]; }
  RayImages& ImagesAt(std::size_t index) { return this->Images[index]; }

private:
  Visible Differentiate(
    const TermFields& fields, Derivative derivative, const GradientTarget& target);

  Grid Nodes;
  const Occupancy* Occupied;
  std::vector<FaceFrustum> Frusta;
  std::vector<RayImages> Images;
};
}

#endif
