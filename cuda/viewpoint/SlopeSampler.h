// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Samplers for ViewDerivativeKernel: they sample on the planes of its plan and differentiate the
// extinction across the rays.

#ifndef limpid_viewpoint_SlopeSampler_h
#define limpid_viewpoint_SlopeSampler_h

#include "backend/HostDevice.h"
#include "sweep/RaySampler.h"
#include "sweep/RowSampler.h"
#include "viewpoint/ViewDerivativeKernel.h"

#include <type_traits>

namespace limpid
{
/// Samples a row of rays, on the processor.
class SlopeRowSampler : public RowSampler
{
public:
  SlopeRowSampler(const FaceFrustum& frustum, const RayStates& states, int row);

  /// Enters a part of the current layer.
  void EnterPart(const ViewDerivativePlan& plan, int part);

  /// Samples at both Gauss points of the part.
  void SampleImportance(Field field);
  void SampleExtinctionAndSlopes(Field field);

  const RaySlopes& Slopes() const { return this->Differences; }

  template <class Step>
  void ForEachClipped(const Step& step) const
  {
    detail::StepAllAs<LayerCrossing::Clipped>(this->Rays, step);
  }

private:
  struct Plane;
  Plane PlaneAt(int half) const;
  Range<int> ReadBy(const Plane& plane, Field field) const;
  void Blend(Field field, const Plane& plane, const Range<int>& read);
  void BlendDifference(Field field, const Plane& plane, const Range<int>& read);

  const ViewDerivativePlan* Sampled = nullptr;
  int Part = 0;
  float* Values[4][2]; ///< [importance, extinction, slope across, down][Gauss point]
  float* Edges;        ///< values at the edges between rays
  float* Blended;      ///< a row of voxels
  RaySlopes Differences{};
};

/// Samples a single ray, on a device.
class SlopeRaySampler : public RaySampler
{
public:
  using RaySampler::RaySampler;

  LIMPID_HD LIMPID_INLINE void EnterPart(const ViewDerivativePlan& plan, int part)
  {
    this->Ray.layer = PartOf(this->Frustum.SliceAt(this->S).layer, part, plan.parts);
    this->Sampled = &plan;
    this->FirstPlane = plan.PlaneOf(this->S, part, 0);
  }

  LIMPID_HD LIMPID_INLINE void SampleImportance(Field field)
  {
    const Slice& slice = this->Frustum.SliceAt(this->S);
    for (int half = 0; half < 2; ++half)
    {
      const LinearMap columns = this->MapOf(this->Sampled->columns, slice.rayColumns, half);
      const LinearMap rows = this->MapOf(this->Sampled->rows, slice.rayRows, half);
      this->Ray.importance[half] = this->Sample(field, half, columns, this->I, rows, this->J);
    }
  }

  LIMPID_HD LIMPID_INLINE void SampleExtinctionAndSlopes(Field field)
  {
    const ViewDerivativePlan& plan = *this->Sampled;
    const Slice& slice = this->Frustum.SliceAt(this->S);
    for (int half = 0; half < 2; ++half)
    {
      const LinearMap columns = this->MapOf(plan.columns, slice.rayColumns, half);
      const LinearMap rows = this->MapOf(plan.rows, slice.rayRows, half);
      this->Ray.extinction[half] = this->Sample(field, half, columns, this->I, rows, this->J);
      const LinearMap columnEdges = this->MapOf(plan.columnEdges, slice.rayColumns, half);
      const LinearMap rowEdges = this->MapOf(plan.rowEdges, slice.rayRows, half);
      float across = 0;
      float down = 0;
      for (int k = 0; k < 4; ++k)
      {
        across += plan.Row(plan.columnStencil, k)[this->I] *
          this->Sample(field, half, columnEdges, this->I + k, rows, this->J);
        down += plan.Row(plan.rowStencil, k)[this->J] *
          this->Sample(field, half, columns, this->I, rowEdges, this->J + k);
      }
      const float perIndex = plan.Row(plan.perIndex)[this->FirstPlane + half];
      this->Across[half] = perIndex * across;
      this->Down[half] = perIndex * down;
    }
  }

  LIMPID_HD LIMPID_INLINE RaySlopes Slopes() const
  {
    return { { &this->Across[0], &this->Across[1] }, { &this->Down[0], &this->Down[1] } };
  }

  template <class Step>
  LIMPID_HD LIMPID_INLINE void ForEachClipped(const Step& step) const
  {
    step(this->Ray, 0);
  }

private:
  LIMPID_HD LIMPID_INLINE LinearMap MapOf(
    const MapTable& table, const Range<int>& described, int half) const
  {
    return this->Sampled->MapOf(table, this->FirstPlane + half, described);
  }

  LIMPID_HD LIMPID_INLINE float Sample(Field field, int half, const LinearMap& columns, int column,
    const LinearMap& rows, int row) const
  {
    const float along = this->Sampled->Row(this->Sampled->fractions)[this->FirstPlane + half];
    return this->SampleLayer(field,
      this->CornerAt({ columns.index[column], columns.weight[column] },
        { rows.index[row], rows.weight[row] }, along));
  }

  const ViewDerivativePlan* Sampled = nullptr;
  Index FirstPlane = 0;
  float Across[2];
  float Down[2];
};

/// The sampler for a device.
template <class AnyDevice>
using SlopeSampler =
  std::conditional_t<std::is_same_v<AnyDevice, HostDevice>, SlopeRowSampler, SlopeRaySampler>;
}

#endif
