// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicySweep_h
#define limpid_optimize_PolicySweep_h

#include "optimize/PolicyVoxel.h"
#include "optimize/Problem.h"
#include "optimize/Sums.h"
#include "sweep/Sweep.h"

namespace limpid
{
/// Fields of a policy sweep, grid.NodeCount() values each.
struct PolicyFields
{
  const float* base;           ///< [1/length]
  const float* importance;     ///< [0, 1]
  const float* nodeImportance; ///< see NodeImportance.h [0, 1]
  const float* extinction;     ///< the last iterate [1/length]
  const float* lagged;         ///< T (V - g) of the other term; null: none
  float* next;                 ///< the next iterate [1/length]
};

/// Which transmittance a policy sweep believes in.
enum class Trust
{
  Clear,      ///< nothing is in the way: T = 1
  LastIterate ///< that of the last iterate, whose optical depths are in the images
};

/// What the sweeps of all frusta have in common.
struct PolicyTask
{
  const Grid* grid;
  const Occupancy* occupancy;
  PolicyVoxel<float> voxel;
  PolicyFields fields;
  Trust trust;
  Derivative derivative;
};

/// What the sweeps for a problem have in common; iterates and trust are left to the caller.
/// `weight`: that of the term that is swept; `lagWeight`: that of the other one.
PolicyTask TaskOf(const Problem& problem, double weight, double lagWeight);

/// What a policy sweep of a frustum has found.
struct PolicyFound
{
  Visible met;       ///< score of what its rays have met, see MetNextIterate
  Differences moved; ///< of its voxels
};

/// One backward policy sweep: finds the next iterate in all voxels of a frustum. Leaves the optical
/// depths of what its rays have met in the images.
PolicyFound SweepPolicy(const FaceFrustum& frustum, const PolicyTask& task, RayImages& images);

/// Whether what the rays of a frustum have met in their policy sweep was the next iterate, whose
/// score and optical depths are known then: not the voxels of a frustum that is swept later. With
/// Derivative::Ray what rays carry is not the score.
inline bool MetNextIterate(std::size_t frustum, std::size_t frusta, Derivative derivative)
{
  return frustum + 1 == frusta && derivative == Derivative::Volume;
}
}

#endif
