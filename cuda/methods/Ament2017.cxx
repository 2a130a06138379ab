// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "methods/Ament2017.h"

#include "backend/CompiledDevice.h"
#include "energy/TransmittanceSweep.h"
#include "sweep/Sweeps.h"

#include <utility>

namespace limpid
{
namespace
{
/// Squares of importance, scaled so that no ray through the box accumulates more than 1.
struct SquareNode
{
  const float* importance;
  float unit;
  float* squares;

  LIMPID_HD LIMPID_INLINE void operator()(Index node) const
  {
    const float importanceHere = this->importance[node];
    this->squares[node] = this->unit * importanceHere * importanceHere;
  }
};

/// Back to front: accumulates the field along rays, also in front of their entry into the box.
struct CollectStep
{
  RayStates rays;

  template <class RayHere>
  LIMPID_HD LIMPID_INLINE void operator()(const RayHere& here, Index i) const
  {
    const TwoHalves halves = TwoHalves::ToExit(here);
    this->rays[RayChannel::Behind][i] += halves.front.opticalDepth + halves.rear.opticalDepth;
  }
};

struct TakeStep
{
  const float* seen;
  float* behind;

  LIMPID_HD LIMPID_INLINE void operator()(Index u) const
  {
    this->behind[u] = this->seen[u]; // NOLINT(clang-analyzer-core.NullDereference): it is there
  }
};

/// The integral of a field along the rays from every voxel on.
template <class Input, class Output>
struct BehindKernel
{
  static constexpr const char* label = "importance behind nodes";
  static constexpr RayChannel readByVoxels = RayChannel::Behind; ///< see ForRead

  Input field; ///< [1/length]
  Output behind;

  template <class Windows>
  BehindKernel<SliceWindow*, SliceWindow*> With(Windows& windows) const
  {
    return { windows(this->field, FieldUse{ 1 }), windows(this->behind, FieldUse{ 0, true }) };
  }

  /// Calls visit for the values that rays carry.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForCarried(const Visit& visit) const
  {
    visit(RayChannel::Behind);
  }

  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    if (s < rays.Plan().lastSlice && rays.EnterLayer(s, false))
    {
      rays.SampleExtinction(this->field);
      rays.ForEachInLayer(CollectStep{ rays.States() });
    }
  }

  template <class Rays>
  LIMPID_HD LIMPID_INLINE void LeaveStep(Rays&) const
  {
  }

  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void VoxelStep(Voxels& voxels, const typename Voxels::Rays& rays) const
  {
    if (voxels.FindSeen(rays))
    {
      voxels.ForActive(TakeStep{ voxels.SeenHere().behind, voxels.Row(this->behind) });
    }
  }
};

/// Computes the share of base extinction that a node keeps.
struct KeptNode
{
  AmentKeptShare kept;
  float radii; ///< radii per unit of the integrals
  const float* importance;
  const float* passed; ///< exp of minus the integral in front
  const float* behind;
  float* share; ///< may alias one of the inputs

  LIMPID_HD LIMPID_INLINE void operator()(Index node) const
  {
    const float front = -std::log(this->passed[node]);
    this->share[node] =
      this->kept(this->importance[node], this->radii * front, this->radii * this->behind[node]);
  }
};

/// One pass of smoothing, see FindAment2017.
struct SmoothedDensity
{
  Int3 nodes;
  const float* base;
  const float* share;
  float* smoothed;

  LIMPID_HD void operator()(Index node, int i, int j, int k) const
  {
    float sum = 0;
    float weights = 0;
    for (int neighbour = 0; neighbour < 27; ++neighbour)
    {
      const int x = neighbour % 3 - 1;
      const int y = neighbour / 3 % 3 - 1;
      const int z = neighbour / 9 - 1;
      const bool inside = i + x >= 0 && i + x < this->nodes.x && j + y >= 0 &&
        j + y < this->nodes.y && k + z >= 0 && k + z < this->nodes.z;
      if (inside)
      {
        const Index at = node + x + this->nodes.x * (y + Index(this->nodes.y) * z);
        const int halvings = (x != 0) + (y != 0) + (z != 0);
        const float weight = this->base[at] > 0.0f ? float(8 >> halvings) : 0.0f;
        sum += weight * this->share[at];
        weights += weight;
      }
    }
    this->smoothed[node] = weights > 0.0f ? sum / weights : this->share[node];
  }
};

struct ShownNode
{
  const float* share;
  float* extinction; ///< in: the base extinction

  LIMPID_HD LIMPID_INLINE void operator()(Index node) const
  {
    this->extinction[node] *= this->share[node];
  }
};

/// Computes for every node exp of minus the integral from the source (`passed`) and the integral
/// behind it (`behind`). `field`: [1/length].
template <class AnyDevice>
void Integrate(const MethodScene<AnyDevice>& scene, const Occupancy& occupancy, const float* field,
  float* passed, float* behind)
{
  const RaySource source = scene.WholeSource();
  TransmittanceSweep<AnyDevice>(scene.device, scene.grid, occupancy, source, scene.rayDensity)
    .Fill(field, passed);
  for (FrustumRays<AnyDevice>& rays :
    PlanRays(scene.device, scene.grid, occupancy, source, { scene.rayDensity }))
  {
    SweepBackward(
      *scene.device, rays, occupancy, BehindKernel<const float*, float*>{ field, behind });
  }
}
}

template <class AnyDevice>
void FindAment2017(const MethodScene<AnyDevice>& scene, float* extinction)
{
  const AmentWeights& weights = scene.ament;
  const Index count = scene.grid.NodeCount();
  const auto size = static_cast<std::size_t>(count);
  const double radius = scene.grid.Radius();
  const char* what = "importance along rays";
  DeviceArray<AnyDevice, float> squares(scene.device, size, what);
  DeviceArray<AnyDevice, float> passed(scene.device, size, what);
  auto behind = DeviceArray<AnyDevice, float>::Zeros(scene.device, size, what);
  scene.device->ForIndices("squares of importance", count,
    SquareNode{ scene.importance, static_cast<float>(0.5 / radius), squares.Data() });
  Integrate(scene, *scene.occupancy, squares.Data(), passed.Data(), behind.Data());

  const double occluders = scene.forLight ? weights.lightOccluders : weights.occluders;
  const double background = scene.forLight ? weights.lightBackground : weights.background;
  const AmentKeptShare kept{ static_cast<float>(2 * weights.exponent),
    static_cast<float>(weights.regularization), static_cast<float>(occluders),
    static_cast<float>(background) };
  float* share = squares.Data();
  float* other = passed.Data();
  scene.device->ForIndices("kept shares", count,
    KeptNode{ kept, 2, scene.importance, passed.Data(), behind.Data(), share });
  for (int pass = 0; pass < weights.smoothingPasses; ++pass)
  {
    scene.device->ForNodes(
      "smooth", scene.grid.nodes, SmoothedDensity{ scene.grid.nodes, scene.base, share, other });
    std::swap(share, other);
  }
  scene.device->ForIndices("shown extinction", count, ShownNode{ share, extinction });
}

template void FindAment2017(const MethodScene<CompiledDevice>&, float*);
}
