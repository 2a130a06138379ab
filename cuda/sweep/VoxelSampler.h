// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How a device visits voxels: one at a time. VoxelRow.h has the same members for rows; the kernels
// call both.

#ifndef limpid_sweep_VoxelSampler_h
#define limpid_sweep_VoxelSampler_h

#include "sweep/Cubic.h"
#include "sweep/FaceFrustum.h"
#include "sweep/HatMean.h"
#include "sweep/RaySteps.h"

namespace limpid
{
/// One voxel on a slice of a frustum.
class VoxelSampler
{
public:
  using Field = const float*;

  /// `row`, `column` etc. of a step are the voxel's own: steps have the index 0.
  LIMPID_HD LIMPID_INLINE VoxelSampler(const FaceFrustum& frustum, int s, int u, int v)
    : Frustum(frustum)
    , Here(frustum.SliceAt(s))
    , S(s)
    , U(u)
    , V(v)
  {
  }

  LIMPID_HD LIMPID_INLINE const Slice& SliceHere() const { return this->Here; }

  template <class Value>
  LIMPID_HD LIMPID_INLINE Value* Row(Value* field) const
  {
    return field ? field + this->Frustum.VoxelAt(this->Here.node, this->U, this->V) : nullptr;
  }

  /// Only rows can be brought ahead of time.
  LIMPID_HD LIMPID_INLINE void Prefetch(const float*) const {}

  LIMPID_HD LIMPID_INLINE bool FindSeen(const RayStates& rays, const float* behind)
  {
    if (!this->IsActive())
    {
      return false;
    }
    this->Average(rays.transmittance, behind);
    if (!this->IsBetweenFrontRays())
    {
      const float here = this->TransmitFromSide(rays);
      this->Behind = Exchanged(this->Behind, this->Transmittance, here);
      this->Transmittance = here;
    }
    return true;
  }

  /// See FindSeen.
  struct SeenByVoxel
  {
    const float* transmittance;
    const float* behind;
  };

  LIMPID_HD LIMPID_INLINE SeenByVoxel SeenHere() const
  {
    return { &this->Transmittance, &this->Behind };
  }

  LIMPID_HD LIMPID_INLINE const float* ImportanceInView(Field nodeImportance)
  {
    this->Importance = *this->Row(nodeImportance);
    if (!this->Frustum.seesAll)
    {
      this->Importance *=
        this->SampleRays(this->Frustum.Row(this->Frustum.inView), this->U, this->V);
    }
    return &this->Importance;
  }

  template <class Step>
  LIMPID_HD LIMPID_INLINE void ForActive(const Step& step) const
  {
    if (this->IsActive())
    {
      step(0);
    }
  }

  template <class Step>
  LIMPID_HD LIMPID_INLINE void ForIdle(const Step& step) const
  {
    if (this->Frustum.FilledVoxels(this->S, this->V).Contains(this->U) && !this->IsActive())
    {
      step(0);
    }
  }

  LIMPID_HD LIMPID_INLINE void FindTransmittance(const RayStates& rays, float* transmittance) const
  {
    const int column = this->Columns().index[this->U];
    const int row = this->Rows().index[this->V];
    // Ahead of its entry into the box a ray says nothing that four rays could bend by.
    const float depth = this->Here.RelativeDepth();
    const bool entered = HaveEntered(this->Frustum.Row(this->Frustum.columnEntry),
                           this->Frustum.columns, column, depth) &&
      HaveEntered(this->Frustum.Row(this->Frustum.rowEntry), this->Frustum.rows, row, depth);
    if (!entered)
    {
      *transmittance = this->IsBetweenFrontRays()
        ? this->SampleRays(rays.transmittance, this->U, this->V)
        : this->TransmitFromSide(rays);
      return;
    }
    if (HoldsFour(this->Frustum.frontColumns, column) && HoldsFour(this->Frustum.frontRows, row))
    {
      *transmittance = Clamp(this->SampleCubic(rays.transmittance), 0.0f, 1.0f);
      return;
    }
    *transmittance = this->TransmitDensity(this->SampleCubic(rays.density));
  }

private:
  LIMPID_HD LIMPID_INLINE LinearMap Columns() const
  {
    return this->Frustum.Row(this->Frustum.voxelColumns, this->S);
  }

  LIMPID_HD LIMPID_INLINE LinearMap Rows() const
  {
    return this->Frustum.Row(this->Frustum.voxelRows, this->S);
  }

  LIMPID_HD LIMPID_INLINE bool IsActive() const
  {
    return this->Frustum.ActiveVoxels(this->S, this->V).Contains(this->U);
  }

  LIMPID_HD LIMPID_INLINE bool IsBetweenFrontRays() const
  {
    const int column = this->Columns().index[this->U];
    const int row = this->Rows().index[this->V];
    const Range<int>& columns = this->Frustum.frontColumns;
    const Range<int>& rows = this->Frustum.frontRows;
    return column >= columns.begin && column + 1 < columns.end && row >= rows.begin &&
      row + 1 < rows.end;
  }

  /// Whether a cubic between `index` and the next one has its four rays.
  LIMPID_HD static LIMPID_INLINE bool HoldsFour(const Range<int>& among, int index)
  {
    return index > among.begin && index + 2 < among.end;
  }

  /// HoldsFour among the rays that have entered the box at a depth, which are neighbours.
  LIMPID_HD static LIMPID_INLINE bool HaveEntered(
    const float* entries, int count, int index, float depth)
  {
    return index > 1 && index + 2 < count - 1 && !(entries[index - 1] > depth) &&
      !(entries[index + 2] > depth);
  }

  LIMPID_HD LIMPID_INLINE float SampleRays(const float* image, int u, int v) const
  {
    const LinearMap columns = this->Columns();
    const LinearMap rows = this->Rows();
    const float* first = image + this->Frustum.RayAt(columns.index[u], rows.index[v]);
    const float* second = first + this->Frustum.columns;
    const float left = first[0] + rows.weight[v] * (second[0] - first[0]);
    const float right = first[1] + rows.weight[v] * (second[1] - first[1]);
    return left + columns.weight[u] * (right - left);
  }

  /// Transmittance, and what it leaves of what is behind, at one voxel of the slice.
  struct Pair
  {
    float transmittance;
    float behind;
  };

  LIMPID_HD LIMPID_INLINE Pair SeeAt(
    const float* transmittance, const float* behind, int u, int v) const
  {
    const LinearMap columns = this->Columns();
    const LinearMap rows = this->Rows();
    const Index first = this->Frustum.RayAt(columns.index[u], rows.index[v]);
    const float weights[2] = { 1.0f - rows.weight[v], rows.weight[v] };
    Pair sides[2] = { { 0, 0 }, { 0, 0 } };
    for (int corner = 0; corner < 4; ++corner)
    {
      const Index ray = first + corner % 2 + Index(corner / 2) * this->Frustum.columns;
      const float passed = weights[corner / 2] * transmittance[ray];
      sides[corner % 2].transmittance += passed;
      sides[corner % 2].behind += passed * behind[ray];
    }
    const float sideways = columns.weight[u];
    return { sides[0].transmittance + sideways * (sides[1].transmittance - sides[0].transmittance),
      sides[0].behind + sideways * (sides[1].behind - sides[0].behind) };
  }

  LIMPID_HD static LIMPID_INLINE Pair Mean(
    const Pair& before, const Pair& own, const Pair& after, float side)
  {
    return { HatMean(before.transmittance, own.transmittance, after.transmittance, side),
      HatMean(before.behind, own.behind, after.behind, side) };
  }

  LIMPID_HD LIMPID_INLINE Pair AverageAlongRow(
    const float* transmittance, const float* behind, int v) const
  {
    const float side = this->Frustum.Row(this->Frustum.columnSides, this->S)[this->U];
    const Pair own = this->SeeAt(transmittance, behind, this->U, v);
    if (side == 0)
    {
      return own;
    }
    const Pair before = this->U > 0 ? this->SeeAt(transmittance, behind, this->U - 1, v) : own;
    const Pair after =
      this->U + 1 < this->Frustum.nodesU ? this->SeeAt(transmittance, behind, this->U + 1, v) : own;
    return Mean(before, own, after, side);
  }

  /// Means over the hat function of the voxel, across the rays.
  LIMPID_HD LIMPID_INLINE void Average(const float* transmittance, const float* behind)
  {
    const float side = this->Frustum.Row(this->Frustum.rowSides, this->S)[this->V];
    Pair mean = this->AverageAlongRow(transmittance, behind, this->V);
    if (side != 0)
    {
      const Pair before =
        this->V > 0 ? this->AverageAlongRow(transmittance, behind, this->V - 1) : mean;
      const Pair after = this->V + 1 < this->Frustum.nodesV
        ? this->AverageAlongRow(transmittance, behind, this->V + 1)
        : mean;
      mean = Mean(before, mean, after, side);
    }
    this->Transmittance = mean.transmittance;
    this->Behind = mean.behind;
  }

  LIMPID_HD LIMPID_INLINE float TransmitFromSide(const RayStates& rays) const
  {
    return this->TransmitDensity(this->SampleRays(rays.density, this->U, this->V));
  }

  LIMPID_HD LIMPID_INLINE float TransmitDensity(float density) const
  {
    const float inRow = this->Frustum.Row(this->Frustum.voxelRowEntry, this->S)[this->V];
    const float inColumn = this->Frustum.Row(this->Frustum.voxelColumnEntry, this->S)[this->U];
    const float row = inRow > this->Frustum.frontDepth ? inRow : this->Frustum.frontDepth;
    const float entry = row > inColumn ? row : inColumn;
    return Transmitted(density * (this->Here.RelativeDepth() - entry));
  }

  LIMPID_HD LIMPID_INLINE float SampleCubic(const float* image) const
  {
    const LinearMap columns = this->Columns();
    const LinearMap rows = this->Rows();
    const Index stride = this->Frustum.columns;
    const float* first =
      image + this->Frustum.RayAt(columns.index[this->U] - 1, rows.index[this->V] - 1);
    float blend[4];
    for (int i = 0; i < 4; ++i)
    {
      const float* at = first + i;
      blend[i] =
        CubicBetween(at[0], at[stride], at[2 * stride], at[3 * stride], rows.weight[this->V]);
    }
    const float sideways = columns.weight[this->U];
    const float front = Curvature(blend[0], blend[1], blend[2]);
    const float back = Curvature(blend[1], blend[2], blend[3]);
    return Bent(
      blend[1] + sideways * (blend[2] - blend[1]), front + sideways * (back - front), sideways);
  }

  const FaceFrustum& Frustum;
  const Slice& Here;
  int S;
  int U;
  int V;
  float Transmittance = 1; ///< mean, see FindSeen
  float Behind = 0;
  float Importance = 0;
};
}

#endif
