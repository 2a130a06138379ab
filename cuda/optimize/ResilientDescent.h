// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ResilientDescent_h
#define limpid_optimize_ResilientDescent_h

#include "optimize/ResilientVoxel.h"
#include "optimize/Smoothing.h"
#include "optimize/VoxelSteps.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace limpid
{
namespace detail
{
/// Sets all values to the same number.
struct FillWith
{
  float* values;
  float value;

  LIMPID_HD LIMPID_INLINE void operator()(Index i) const { this->values[i] = this->value; }
};
}

/**
 * Resilient steps along the derivative of the energy (ResilientVoxel.h), starting near a good
 * optimum.
 */
template <class AnyDevice>
class ResilientDescent
{
public:
  ResilientDescent(
    std::shared_ptr<AnyDevice> device, const Problem& problem, Terms<AnyDevice>& energy)
    : Device(std::move(device))
    , Given(&problem)
    , Energy(&energy)
    , Own(problem.OwnSlab())
  {
  }

  /// Frees its memory. BeginAt must come before the next step.
  void Clear()
  {
    this->Gradient = {};
    this->State = {};
  }

  /// Restarts from an extinction, with short steps.
  void BeginAt(const float* extinction)
  {
    const auto count = static_cast<std::size_t>(this->Given->grid.NodeCount());
    if (this->Gradient.Empty())
    {
      this->Gradient = DeviceArray<AnyDevice, float>::Zeros(this->Device, count, "the derivative");
    }
    this->State.RoomFor(this->Device, count, "the step lengths");
    this->Device->ForIndices("resilient steps", this->Own.Count(),
      detail::FillWith{
        this->State.Data() + this->Own.Begin(), this->LengthOf(firstChange, firstDepth) });
    this->Energy->Differentiate(extinction, this->Gradient.Data());
  }

  /// Performs the step from the last extinction to the next, which may be the same array, and
  /// returns its record. `smoothing`: sigma of SmoothedChange [length]; 0 for no smoothing.
  IterationRecord Step(const float* last, float* next, double smoothing)
  {
    if (next != last)
    {
      this->Device->Copy(next + this->Own.Begin(), last + this->Own.Begin(),
        std::size_t(this->Own.Count()) * sizeof(float));
    }
    if (smoothing > 0)
    {
      limpid::FindPull(*this->Device,
        { this->Given->grid.nodes, this->Energy->Fields().base.Data(),
          this->Energy->Fields().importance.Data(), last, this->Gradient.Data(),
          static_cast<float>(smoothing), this->Gradient.Data() },
        this->Own.slices);
    }
    StepAll(*this->Device, *this->Given, this->StepWith(next, smoothing), this->Gradient.Data(),
      *this->Energy);
    this->Energy->Distribution().Share(next, FieldDistribution::slabs);
    this->Energy->Differentiate(next, this->Gradient.Data());
    this->Energy->TakeMoved(next, nullptr);
    return this->Energy->Record();
  }

private:
  static constexpr double firstChange = 0.05; ///< length of the first step [majorant]
  static constexpr double mostChange = 0.4;   ///< maximum length of a step [majorant]
  static constexpr double firstDepth = 0.7;   ///< first step as an optical depth between nodes
  static constexpr double mostDepth = 2; ///< maximum step as an optical depth, which hides nearly
                                         ///< all
  static constexpr double roundingOfSum = 1e-6; ///< relative to the weights; smaller derivatives
                                                ///< are 0

  /// Returns a step length [1/length], limited by a change [majorant] and by an optical depth
  /// between nodes.
  float LengthOf(double change, double depth) const
  {
    return static_cast<float>(
      std::min(change * double(this->Given->majorant), depth / this->Given->NodeDistance()));
  }

  ResilientVoxel StepWith(float* extinction, double smoothing) const
  {
    const Weights& weights = this->Given->settings.weights;
    ResilientVoxel step{};
    step.gradient = this->Gradient.Data();
    step.base = this->Energy->Fields().base.Data();
    step.importance = this->Energy->Fields().importance.Data();
    step.state = this->State.Data();
    step.extinction = extinction;
    std::vector<Pull> pulls = this->Energy->Pulls();
    pulls.push_back({ step.base, smoothing });
    step.pulls = PullsAtVoxels<float>::Of(pulls, step.base);
    step.smooths = smoothing > 0;
    step.longest = this->LengthOf(mostChange, mostDepth);
    step.floor = static_cast<float>(roundingOfSum * std::max(weights.view, weights.light));
    step.bounds = BoundsOf(*this->Given);
    return step;
  }

  std::shared_ptr<AnyDevice> Device;
  const Problem* Given;
  Terms<AnyDevice>* Energy;
  Slab Own; ///< see Problem::OwnSlab
  mutable DeviceArray<AnyDevice, float> Gradient;
  mutable DeviceArray<AnyDevice, float> State;
};
}

#endif
