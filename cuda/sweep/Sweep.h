// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_Sweep_h
#define limpid_sweep_Sweep_h

#include "backend/Backend.h"
#include "sweep/Plan.h"
#include "sweep/Rows.h"
#include "sweep/Slices.h"

#include <algorithm>
#include <vector>

namespace limpid
{
/// One value per ray of a frustum; what travels with the rays while a sweep moves from slice to
/// slice. Row by row, FaceFrustum::columns values each.
struct RayImages
{
  explicit RayImages(const FaceFrustum& frustum);

  /// What a backward sweep carries of a row.
  RaysBehind Behind(const FaceFrustum& frustum, int row);

  std::vector<float> length;        ///< world length per unit of depth [length]
  std::vector<double> opticalDepth; ///< from the eye to the slice that the sweep has reached
  std::vector<float> behind;        ///< visible importance behind, times scale^2
  std::vector<float> visible;       ///< ... from the entry into the box on, see RaysBehind
  std::vector<float> unattenuated;  ///< the same without attenuation
  std::vector<float> transmittance; ///< from the eye to the slice [0, 1]
  std::vector<float> density;       ///< near the sides: see DensifyRow
  SlabPool slabs;                   ///< of the fields that a sweep moves through
};

/// Integrals over the domain of importance times extinction, with and without transmittance.
struct Visible
{
  double visible = 0;      ///< S of Eq. (32) [length^2]
  double unattenuated = 0; ///< its upper bound [length^2]

  Visible& operator+=(const Visible& other)
  {
    this->visible += other.visible;
    this->unattenuated += other.unattenuated;
    return *this;
  }
};

/// Fields that rays go through, grid.NodeCount() values each.
struct RayFields
{
  const Grid* grid;
  const Occupancy* occupancy; ///< see SliceWindow; null: nothing is known
  const float* extinction;    ///< [1/length]
  const float* importance;    ///< [0, 1]
};

/// Sum of one value per ray, for an integral over the domain of what these are integrals of along
/// their rays times scale^2; in a fixed order.
double SumOfRays(const FaceFrustum& frustum, const RayImages& images, const float* values);

/// The layer between slices `front` and `front + 1`.
Layer LayerOf(const FaceFrustum& frustum, int front);

/// Row `row` of the rays in the layer behind slice `front`; the sampled fields are left open.
RayRow RaysOf(const FaceFrustum& frustum, const RayImages& images, int front, int row);

/// Which slices a plane is sampled from.
enum class SliceBlend
{
  Both,     ///< blended at the Gauss point
  RearAlone ///< the slice behind alone
};

/// Samples a plane at `columns` of a row of rays. `scratch`: ScratchSize(frustum) values.
void SamplePlane(const Plane& plane, int row, const Range<int>& columns, SliceBlend blend,
  SliceWindow& field, float* scratch, float* out);

/// Samples both planes of a layer at `columns` of a row of rays, from both slices. `scratch`: twice
/// ScratchSize(frustum) values.
void SamplePlanes(const std::array<Plane, 2>& planes, int row, const Range<int>& columns,
  SliceWindow& field, float* scratch, float* const out[2]);

/// Number of values that sampling needs as scratch.
std::size_t ScratchSize(const FaceFrustum& frustum);

/// Interpolates an image of the rays at `columns` of voxel row `v`. `scratch`:
/// ScratchSize(frustum) values.
void SampleRays(const FaceFrustum& frustum, const Slice& slice, int v, const Range<int>& columns,
  const std::vector<float>& image, float* scratch, float* out);

/// Whether optical depths are those of a sweep from the front, 0 ahead of a ray's entry into the
/// box, or unwound from the back, negative there.
enum class Depths
{
  Wound,
  Unwound
};

/// Moves the optical depths of `columns` of a row of rays at slice `s` into what voxels read:
/// transmittance, and density where rays enter through a side. `extinction`: of the row just behind
/// the slice; null: there is nothing.
void TransmitRays(const FaceFrustum& frustum, int s, int row, const Range<int>& columns,
  const float* extinction, Depths depths, RayImages& images);

/// Those of `columns` of voxel row `v` that lie between rays that enter in front; where there are
/// none, the interval ends with `columns`.
Range<int> ColumnsBetweenFrontRays(
  const FaceFrustum& frustum, const Slice& slice, int v, const Range<int>& columns);

/// Transmittance at `columns` of voxel row `v`, made from the rays' density [0, 1].
void TransmitFromSide(const FaceFrustum& frustum, const Slice& slice, int v,
  const Range<int>& columns, const RayImages& images, float* scratch, float* out);

/// Transmittance at `columns` of voxel row `v` on slice `s` [0, 1]. Between rays that enter
/// through a side, it is made from their density, which knows where the voxel's own ray enters.
void SampleTransmittance(const FaceFrustum& frustum, const Slice& slice, int v,
  const Range<int>& columns, const RayImages& images, float* scratch, float* out);

/// Samples the extinction of a row of rays at both Gauss points of the layer behind slice `s` and
/// lets `rays` point to the samples, for its importance, too, which is not to be used. `memory`:
/// LayerMemory(frustum) values, the front samples first.
void SampleExtinction(
  const FaceFrustum& frustum, int s, int row, SliceWindow& extinction, float* memory, RayRow& rays);

/// The same of extinction and importance.
void SampleLayer(const FaceFrustum& frustum, int s, int row, SliceWindow& extinction,
  SliceWindow& importance, float* memory, RayRow& rays);

/// Number of values that the samples of a row of rays in a layer need, scratch included; the
/// scratch begins at the fifth row of rays.
std::size_t LayerMemory(const FaceFrustum& frustum);

/// Multiplies by 0 what the picture does not show, see Settings::restrictToView.
void HideOutOfView(
  const FaceFrustum& frustum, int row, const Range<int>& columns, float* importance);

/**
 * Front to back over all slices: leaves in `images` the optical depth of every ray through
 * the layers in its `work`, and returns the score of the frustum.
 */
Visible SweepForward(const FaceFrustum& frustum, const RayFields& fields, RayImages& images);

/// Front to back over all slices: leaves the optical depths alone in `images`. The importance is
/// not read.
void SweepDepths(const FaceFrustum& frustum, const RayFields& fields, RayImages& images);

/// Rays that are worth a task of their own where little is done with each.
constexpr Index raysPerTask = 8192;

/// Gives all rays the same value.
template <class Value>
void FillImage(std::vector<Value>& image, Value value)
{
  const auto count = static_cast<Index>(image.size());
  ParallelFor((count + raysPerTask - 1) / raysPerTask,
    [&](Index task)
    {
      const Index first = task * raysPerTask;
      std::fill_n(image.data() + first, std::min(raysPerTask, count - first), value);
    });
}

/// Prepares the images for a sweep from the back, where nothing is behind. Optical depths stay.
void StartBehind(RayImages& images);

/// The score of a frustum when a sweep from the back has come to its front.
Visible SumBehind(const FaceFrustum& frustum, RayImages& images);

/**
 * Front to back over all slices, the eye's own included. On each slice the visitor first lets the
 * rays tell what they have met (RayRow), which may carry them on to the next slice, and then does
 * its work on the voxels of the slice (VoxelRow). Load and Store tell it which slices come next.
 */
template <class Visitor>
void SweepFrontToBack(const FaceFrustum& frustum, Visitor& visitor)
{
  constexpr Index rowsPerTask = 8;
  for (const Range<int>& slab : SlabsOf(frustum))
  {
    visitor.Load(slab);
    for (int s = slab.begin; s < slab.end; ++s)
    {
      const Slice& slice = frustum.slices[std::size_t(s)];
      const Range<int> rows = slice.node < 0 ? Range<int>{} : slice.ownedRows;
      ParallelFor(frustum.rows, rowsPerTask, [&](Index row) { visitor.RayRow(s, int(row)); });
      ParallelFor(rows.end - rows.begin, rowsPerTask,
        [&](Index v) { visitor.VoxelRow(s, rows.begin + int(v)); });
    }
    visitor.Store(slab);
  }
}

/**
 * Back to front over all slices of voxels. On each slice the visitor first moves all rays to it
 * (RayRow) and then does its work on the voxels of the slice (VoxelRow), which may depend on the
 * rays of the whole slice; in the end it moves all rays out of the volume (Leave). Load and Store
 * tell it which slices come next.
 */
template <class Visitor>
void SweepBackward(const FaceFrustum& frustum, Visitor& visitor)
{
  constexpr Index rowsPerTask = 8;
  const std::vector<Range<int>> slabs = SlabsOf(frustum);
  for (std::size_t index = slabs.size(); index-- > 0;)
  {
    const Range<int>& slab = slabs[index];
    visitor.Load(slab);
    for (int s = slab.end; s-- > std::max(slab.begin, frustum.FirstNodeSlice());)
    {
      const Range<int> rows = frustum.slices[std::size_t(s)].ownedRows;
      ParallelFor(frustum.rows, rowsPerTask, [&](Index row) { visitor.RayRow(s, int(row)); });
      ParallelFor(rows.end - rows.begin, rowsPerTask,
        [&](Index v) { visitor.VoxelRow(s, rows.begin + int(v)); });
    }
    if (index == 0)
    {
      ParallelFor(frustum.rows, rowsPerTask, [&](Index row) { visitor.Leave(int(row)); });
    }
    visitor.Store(slab);
  }
}
}

#endif
