// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What one ray, or one voxel, of a device does to fill a volume of transmittances:
// TransmittanceVolume.cxx, ray by ray and voxel by voxel.

#ifndef limpid_energy_TransmittanceVolumeBodies_h
#define limpid_energy_TransmittanceVolumeBodies_h

#include "energy/EnteredRays.h"
#include "energy/TermKernels.h"
#include "sweep/Cubic.h"

namespace limpid
{
/// From the front to the back through several slices; leaves images of the rays on each of them.
struct TransmittanceRay
{
  FrustumView rays;
  const float* extinction; ///< world grid [1/length]
  int begin;               ///< slices
  int end;
  double* opticalDepth; ///< from the eye, one value per ray
  float* images;        ///< per slice: transmittance, density, one value per ray each

  LIMPID_HD void operator()(int i, int j) const
  {
    const Index ray = this->rays.RayAt(i, j);
    const Index count = Index(this->rays.columns) * this->rays.rows;
    const Reads reads = this->ReadsOf(i, j);
    double depth = this->opticalDepth[ray];
    for (int s = this->begin; s < this->end; ++s)
    {
      LayerOfRay here(this->rays, s, i, j);
      const bool meets = s < this->rays.lastSlice && this->rays.Works(s, i, j);
      if (meets)
      {
        here.extinction[0] = this->rays.SamplePlane(this->extinction, s, 0, i, j);
        here.extinction[1] = this->rays.SamplePlane(this->extinction, s, 1, i, j);
      }
      float* image = this->images + 2 * count * (s - this->begin) + ray;
      if (reads.transmittance)
      {
        image[0] = Transmitted(static_cast<float>(depth));
      }
      if (reads.density)
      {
        image[count] = this->Density(here, i, j, depth);
      }
      if (meets)
      {
        depth += here.Half<Cut::Entry>(0).LimitedDepth() + here.Half<Cut::Entry>(1).LimitedDepth();
      }
    }
    this->opticalDepth[ray] = depth;
  }

private:
  /// What voxels may read of a ray.
  struct Reads
  {
    bool transmittance;
    bool density;
  };

  /// Of the rays that enter in front, a voxel beside one that does not reads up to three.
  LIMPID_HD LIMPID_INLINE Reads ReadsOf(int i, int j) const
  {
    constexpr int reach = 3;
    const Range<int>& columns = this->rays.frontColumns;
    const Range<int>& rows = this->rays.frontRows;
    return { i >= columns.begin && i < columns.end && j >= rows.begin && j < rows.end,
      i < columns.begin + reach || i >= columns.end - reach || j < rows.begin + reach ||
        j >= rows.end - reach };
  }

  LIMPID_HD LIMPID_INLINE float Density(const LayerOfRay& here, int i, int j, double depth) const
  {
    return Densified(static_cast<float>(depth), here.layer.front - this->rays.EntryOfRay(i, j),
      here.extinction[0] * here.length, false, mostDepthBetweenRays);
  }
};

/// The transmittance at the voxels of these slices.
struct TransmittanceVoxel
{
  FrustumView rays;
  int begin;                  ///< slices
  const EnteredRays* entered; ///< per slice
  const float* images;
  float* transmittance; ///< out, world grid [0, 1]

  /// `row`: slice by slice, nodesV each.
  LIMPID_HD void operator()(int u, int row) const
  {
    const int s = this->begin + row / this->rays.nodesV;
    const int v = row % this->rays.nodesV;
    const SliceView& slice = this->rays.slices[s];
    if (slice.node < 0 || u < slice.ownedColumns.begin || u >= slice.ownedColumns.end ||
      v < slice.ownedRows.begin || v >= slice.ownedRows.end)
    {
      return;
    }
    const Index count = Index(this->rays.columns) * this->rays.rows;
    const float* image = this->images + 2 * count * (s - this->begin);
    this->transmittance[this->rays.VoxelAt(slice.node, u, v)] =
      this->Between(s, u, v, image, image + count);
  }

private:
  LIMPID_HD LIMPID_INLINE float Between(
    int s, int u, int v, const float* transmittances, const float* densities) const
  {
    const int column = this->rays.voxelColumns.index[Index(s) * this->rays.nodesU + u];
    const int row = this->rays.voxelRows.index[Index(s) * this->rays.nodesV + v];
    // Ahead of its entry into the box a ray says nothing that four rays could bend by.
    if (!HoldsFour(this->entered[s].columns, column) || !HoldsFour(this->entered[s].rows, row))
    {
      return TransmittanceImages{ transmittances, densities }(this->rays, s, u, v);
    }
    if (HoldsFour(this->rays.frontColumns, column) && HoldsFour(this->rays.frontRows, row))
    {
      const float value = this->SampleCubic(transmittances, s, u, v);
      const float atLeast = value > 0.0f ? value : 0.0f;
      return atLeast < 1.0f ? atLeast : 1.0f;
    }
    return Transmitted(this->SampleCubic(densities, s, u, v) *
      (this->rays.slices[s].layer.front - this->rays.EntryOfVoxel(s, u, v)));
  }

  /// Whether a cubic between `index` and the next one has its four rays.
  LIMPID_HD static LIMPID_INLINE bool HoldsFour(const Range<int>& among, int index)
  {
    return index > among.begin && index + 2 < among.end;
  }

  LIMPID_HD LIMPID_INLINE float SampleCubic(const float* image, int s, int u, int v) const
  {
    const Index atColumn = Index(s) * this->rays.nodesU + u;
    const Index atRow = Index(s) * this->rays.nodesV + v;
    const float across = this->rays.voxelRows.weight[atRow];
    const float* first = image +
      this->rays.RayAt(
        this->rays.voxelColumns.index[atColumn] - 1, this->rays.voxelRows.index[atRow] - 1);
    float blend[4];
    for (int i = 0; i < 4; ++i)
    {
      const float* at = first + i;
      const int stride = this->rays.columns;
      blend[i] = CubicBetween(at[0], at[stride], at[2 * stride], at[3 * stride], across);
    }
    const float sideways = this->rays.voxelColumns.weight[atColumn];
    const float front = Curvature(blend[0], blend[1], blend[2]);
    const float back = Curvature(blend[1], blend[2], blend[3]);
    return Bent(
      blend[1] + sideways * (blend[2] - blend[1]), front + sideways * (back - front), sideways);
  }
};
}

#endif
