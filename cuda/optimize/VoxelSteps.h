// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Steps of a descent that are independent for each voxel.

#ifndef limpid_optimize_VoxelSteps_h
#define limpid_optimize_VoxelSteps_h

#include "backend/Backend.h"
#include "backend/HostDevice.h"
#include "backend/Simd.h"
#include "optimize/Terms.h"

#include <algorithm>

namespace limpid
{
namespace detail
{
/// A step at a voxel that writes the change over the derivative.
template <class Step>
struct StepAndChange
{
  Step step;
  float* gradient;

  LIMPID_HD LIMPID_INLINE void operator()(Index voxel) const
  {
    const float before = this->step.extinction[voxel];
    this->step(voxel);
    this->gradient[voxel] = this->step.extinction[voxel] - before;
  }
};

template <class Step>
void StepRange(const Step& body, Index begin, Index end)
{
  RunMultiversioned(
    [&body, begin, end]() LIMPID_INLINE_LAMBDA
    {
      const Step step = body;
      LIMPID_IVDEP
      for (Index i = begin; i < end; ++i)
      {
        step(i);
      }
    });
}

/// Performs a step in [begin, end), vectorised. Returns the sum of the changes [1/length].
template <class Step>
double StepBlock(const Step& step, Index begin, Index end)
{
  constexpr Index chunk = 1024;
  float before[chunk];
  double sum = 0;
  for (Index first = begin; first < end; first += chunk)
  {
    const Index last = std::min(first + chunk, end);
    std::copy(step.extinction + first, step.extinction + last, before);
    StepRange(step, first, last);
    sum += SumOfChanges(step.extinction + first, before, last - first);
  }
  return sum;
}
}

/// Performs a step at all voxels and sums the changes for the next record. `step(voxel)` changes
/// `step.extinction[voxel]`. `gradient` is overwritten.
template <class AnyDevice, class Step>
void StepAll(AnyDevice& device, const Problem& problem, const Step& step, float* gradient,
  Terms<AnyDevice>& terms)
{
  device.ForIndices(
    Step::label, problem.grid.NodeCount(), detail::StepAndChange<Step>{ step, gradient });
  terms.SumChanges(gradient);
}

/// The processor does both in one pass, and keeps the gradient.
template <class Step>
void StepAll(
  HostDevice&, const Problem& problem, const Step& step, float*, Terms<HostDevice>& terms)
{
  const Int3& nodes = problem.grid.nodes;
  terms.Moved()->changes = problem.SumOverRows(
    [&](int y, int z)
    {
      const Index first = (Index(z) * nodes.y + y) * nodes.x;
      return detail::StepBlock(step, first, first + nodes.x);
    });
}
}

#endif
