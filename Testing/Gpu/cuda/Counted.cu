// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What happens to one ray on a slice, and to one voxel, each in a kernel of its own, so that the
// compiler's output tells what they cost (../count.sh). Nothing runs these.

#include "energy/GradientKernel.h"
#include "optimize/PolicyKernel.h"
#include "sweep/SweepLaunches.h"

namespace limpid::counted
{
using OfPolicy = PolicyKernel<const float*, float*>;
using OfDerivative = GradientKernel<const float*, float*>;

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
  kernel.base = nullptr;
  return kernel;
}

template <class Kernel>
__device__ void MoveRay(
  const FaceFrustum& frustum, const RayStates& states, const Kernel& kernel, int s)
{
  const auto column = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto row = static_cast<int>(blockIdx.y);
  RaySampler ray(frustum, states.From(frustum.RayAt(column, row)), column, row);
  Usual(kernel).RayStep(ray, s);
}

template <class Kernel>
__device__ void VisitVoxel(
  const FaceFrustum& frustum, const SliceImages& images, const Kernel& kernel, int s)
{
  const auto u = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  VoxelSampler voxel(frustum, s, u, static_cast<int>(blockIdx.y));
  Usual(kernel).VoxelStep(voxel, images);
}

extern "C" __global__ void PolicyRay(FaceFrustum frustum, RayStates states, OfPolicy kernel, int s)
{
  MoveRay(frustum, states, kernel, s);
}

extern "C" __global__ void PolicyVoxel(
  FaceFrustum frustum, SliceImages images, OfPolicy kernel, int s)
{
  VisitVoxel(frustum, images, kernel, s);
}

extern "C" __global__ void DerivativeRay(
  FaceFrustum frustum, RayStates states, OfDerivative kernel, int s)
{
  MoveRay(frustum, states, kernel, s);
}

extern "C" __global__ void DerivativeVoxel(
  FaceFrustum frustum, SliceImages images, OfDerivative kernel, int s)
{
  VisitVoxel(frustum, images, kernel, s);
}
}
