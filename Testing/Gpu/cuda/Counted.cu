// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What happens to one ray on a slice, and to one voxel, each in a kernel of its own, so that the
// compiler's output tells what they cost (../count.sh); and the sweeps that they are part of.
// Nothing runs these.

#include "backend/CudaDevice.h"
#include "energy/GradientKernel.h"
#include "optimize/PolicyKernel.h"
#include "sweep/SweepLaunches.h"
#include "sweep/SweepTiles.h"

namespace limpid::counted
{
using OfPolicy = PolicyKernel<const float*, float*>;
using OfDerivative = GradientKernel<const float*, float*, Kept::Ignored>;

__device__ OfPolicy Usual(OfPolicy kernel)
{
  kernel.transmittance = Transmittance::OfLastIterate;
  kernel.alternative = nullptr;
  kernel.areaWeighted = true;
  kernel.kept = Kept::Counted;
  return kernel;
}

__device__ OfDerivative Usual(OfDerivative kernel)
{
  kernel.areaWeighted = true;
  return kernel;
}

/// A ray that crosses the layer from front to back, far from the sides of the box.
class CrossingRay : public RaySampler
{
public:
  using RaySampler::RaySampler;

  __device__ bool EnterLayer(int s, bool areaWeighted)
  {
    if (!RaySampler::EnterLayer(s, areaWeighted))
    {
      __builtin_unreachable();
    }
    return true;
  }

  template <class Step>
  __device__ void ForEachInLayer(const Step& step) const
  {
    this->ForEachRegardless(step);
  }

  template <class Step>
  __device__ void ForEachNearSides(const Step&) const
  {
  }
};

/// A voxel far from the sides of the box whose rays matter.
class InnerVoxel : public VoxelSampler
{
public:
  using VoxelSampler::VoxelSampler;

  __device__ bool FindSeen(const SliceImages& rays)
  {
    this->FindSeenInside(rays);
    return true;
  }

  template <class Step>
  __device__ void ForActive(const Step& step) const
  {
    step(0);
  }

  template <class Step>
  __device__ void ForIdle(const Step&) const
  {
  }
};

template <class Ray, class Kernel>
__device__ void MoveRay(
  const FaceFrustum& frustum, const RayStates& states, const Kernel& kernel, int s)
{
  const auto column = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto row = static_cast<int>(blockIdx.y);
  Ray ray(frustum, states.From(frustum.RayAt(column, row)), column, row);
  Usual(kernel).RayStep(ray, s);
}

template <class Voxel, class Kernel>
__device__ void VisitVoxel(
  const FaceFrustum& frustum, const SliceImages& images, const Kernel& kernel, int s)
{
  const auto u = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  Voxel voxel(frustum, s, u, static_cast<int>(blockIdx.y));
  Usual(kernel).VoxelStep(voxel, images);
}

#define LIMPID_COUNT_RAY(name, Ray, Kernel)                                                        \
  extern "C" __global__ void name(FaceFrustum frustum, RayStates states, Kernel kernel, int s)     \
  {                                                                                                \
    MoveRay<Ray>(frustum, states, kernel, s);                                                      \
  }

#define LIMPID_COUNT_VOXEL(name, Voxel, Kernel)                                                    \
  extern "C" __global__ void name(FaceFrustum frustum, SliceImages images, Kernel kernel, int s)   \
  {                                                                                                \
    VisitVoxel<Voxel>(frustum, images, kernel, s);                                                 \
  }

LIMPID_COUNT_RAY(PolicyRay, RaySampler, OfPolicy)
LIMPID_COUNT_RAY(PolicyRayInside, CrossingRay, OfPolicy)
LIMPID_COUNT_VOXEL(PolicyVoxel, VoxelSampler, OfPolicy)
LIMPID_COUNT_VOXEL(PolicyVoxelInside, InnerVoxel, OfPolicy)
LIMPID_COUNT_RAY(DerivativeRay, RaySampler, OfDerivative)
LIMPID_COUNT_RAY(DerivativeRayInside, CrossingRay, OfDerivative)
LIMPID_COUNT_VOXEL(DerivativeVoxel, VoxelSampler, OfDerivative)
LIMPID_COUNT_VOXEL(DerivativeVoxelInside, InnerVoxel, OfDerivative)
}

namespace limpid::detail
{
using PolicySweep = BackwardTiles<counted::OfPolicy>;
using DerivativeSweep = SweptSlabs<BackToFront, counted::OfDerivative>;
using DerivativeSweepWithScore =
  SweptSlabs<BackToFront, GradientKernel<const float*, float*, Kept::Counted>>;
template __global__ void VisitTiles<PolicySweep>(const __grid_constant__ PolicySweep);
template __global__ void VisitTiles<DerivativeSweep>(const __grid_constant__ DerivativeSweep);
template __global__ void VisitTiles<DerivativeSweepWithScore>(
  const __grid_constant__ DerivativeSweepWithScore);
}
