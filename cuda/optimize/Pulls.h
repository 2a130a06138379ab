// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// All that draws an extinction towards a reference, as a list.

#ifndef limpid_optimize_Pulls_h
#define limpid_optimize_Pulls_h

#include "backend/Simd.h"
#include "optimize/CarriedChange.h"
#include "optimize/Settings.h"

#include <array>
#include <cstddef>
#include <vector>

namespace limpid
{
/// The most references beside the base extinction that kernels take at a time: one per further
/// term of the energy, and the last iterate.
constexpr std::size_t mostReferences = furtherTerms + 1;

/// Returns a summand of the energy. A function, since nvcc cannot declare pointers to members
/// without warnings.
using SummandOf = double& (*)(Energy&);

/// A pull towards a reference extinction r: the summand w/2 (mu - r)^2 of the energy at every
/// voxel.
struct Pull
{
  const float* reference = nullptr; ///< r, one value per node [1/length]
  double weight = 0;                ///< w [length]
  SummandOf summand = nullptr; ///< where records report its energy; null: it only shapes a step
  /// If not null, `reference` is the place of this extinction in the memory of the device that
  /// computes.
  const FoundExtinction* onDevice = nullptr;

  const float* ReferenceOnHost() const
  {
    return this->onDevice ? this->onDevice->OnHost().data() : this->reference;
  }
};

/// A pull whose references are its own. Camera and light have one reference each.
struct PullWithReferences
{
  FoundExtinctions references;
  double share; ///< see Problem::WeightOfRange
  SummandOf summand;

  /// Returns the pull for the camera or for the light. `onDevice`: whether a device may read the
  /// reference where it is.
  Pull Of(bool forLight, double weight, bool onDevice) const
  {
    const FoundExtinction& reference = this->references.Of(forLight);
    const ExtinctionOnDevice there = onDevice ? reference.OnDevice() : ExtinctionOnDevice();
    return there.extinction ? Pull{ there.extinction, weight, this->summand, &reference }
                            : Pull{ reference.OnHost().data(), weight, this->summand };
  }
};

/// Pulls as kernels take them: the weights of all pulls to the base extinction added up, and a slot
/// for each other reference.
struct PullsOfKernel
{
  std::array<const float*, mostReferences> references{}; ///< null: no pull [1/length]
  std::array<double, mostReferences> weights{};          ///< [length]
  double toBase = 0;                                     ///< [length]
  double all = 0;                                        ///< sum of all weights [length]

  PullsOfKernel(const std::vector<Pull>& pulls, const float* base);
};

/// The pulls at the voxels of a step along the derivative.
template <class Real>
struct PullsAtVoxels
{
  Real toBase;                            ///< sum of the weights of pulls to the base [length]
  const Real* references[mostReferences]; ///< the base where there is no pull [1/length]
  Real weights[mostReferences];           ///< [length]

  static PullsAtVoxels Of(const std::vector<Pull>& pulls, const float* base)
  {
    const PullsOfKernel given(pulls, base);
    PullsAtVoxels at{};
    at.toBase = static_cast<Real>(given.toBase);
    for (std::size_t i = 0; i < mostReferences; ++i)
    {
      at.references[i] = given.references[i] ? given.references[i] : base;
      at.weights[i] = static_cast<Real>(given.weights[i]);
    }
    return at;
  }

  /// Returns `slope` plus the derivative of the pulls' energy. `now`: the extinction, `base`: the
  /// base extinction of the voxel [1/length].
  LIMPID_HD LIMPID_INLINE Real AddedTo(Real slope, Real now, Real base, Index voxel) const
  {
    Real sum = slope + this->toBase * (now - base);
    for (std::size_t i = 0; i < mostReferences; ++i)
    {
      // Selected rather than branched to, so that the loop over voxels vectorises.
      const Real pull = this->weights[i] * (now - this->references[i][voxel]);
      sum += this->weights[i] > 0 ? pull : Real(0);
    }
    return sum;
  }

  /// Sum of all weights [length].
  LIMPID_HD LIMPID_INLINE Real Weight() const
  {
    Real sum = this->toBase;
    for (std::size_t i = 0; i < mostReferences; ++i)
    {
      sum += this->weights[i];
    }
    return sum;
  }
};
}

#endif
