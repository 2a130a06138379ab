// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Visits voxels one at a time, on a device. VoxelRow.h has the same members for rows of voxels;
// kernels call both.

#ifndef limpid_sweep_VoxelSampler_h
#define limpid_sweep_VoxelSampler_h

#include "backend/Prefetch.h"
#include "sweep/Cubic.h"
#include "sweep/FaceFrustum.h"
#include "sweep/HatMean.h"
#include "sweep/HatOfVoxel.h"
#include "sweep/RaySteps.h"

namespace limpid
{
/// What a ray passes to the voxels next to it: two numbers that are read together.
struct alignas(8) SeenOfRay
{
  float transmittance; ///< [0, 1]
  float behind;        ///< visible importance behind, attenuated [scale^2]
};

/// Images of the rays on one slice, see ForRead; null if there is none.
struct SliceImages
{
  const SeenOfRay* seen;
  const float* transmittance;
  const float* effect;
  const float* density; ///< see RayChannel
  const HatOfVoxel* columnHats;
  const HatOfVoxel* rowHats;
};

/// One voxel on a slice of a frustum.
class VoxelSampler
{
public:
  using Field = const float*;
  using Rays = SliceImages;

  /// Pointers such as Row refer to this voxel; steps receive the index 0.
  LIMPID_HD LIMPID_INLINE VoxelSampler(const FaceFrustum& frustum, int s, int u, int v)
    : Frustum(frustum)
    , Here(frustum.SliceAt(s))
    , S(s)
    , U(u)
    , V(v)
    , Own(static_cast<int>(frustum.VoxelAt(this->Here.node, u, v)))
  {
  }

  LIMPID_HD LIMPID_INLINE const Slice& SliceHere() const { return this->Here; }

  template <class Value>
  LIMPID_HD LIMPID_INLINE Value* Row(Value* field) const
  {
    return field + this->Own;
  }

  /// Does nothing: only whole rows are prefetched.
  LIMPID_HD LIMPID_INLINE void Prefetch(const float*) const {}

  /// Prefetches, on a device, the values two slices in front, which the next phase reads.
  template <int count>
  LIMPID_HD LIMPID_INLINE void PrefetchInFront(const Field (&fields)[count]) const
  {
    constexpr int slices = 2;
    if (this->S - slices < this->Frustum.firstNodeSlice)
    {
      return;
    }
    const Index way = this->Frustum.strideW * (this->Here.nodes[0] - this->Here.nodes[1]) * slices;
    for (const Field field : fields)
    {
      if (field)
      {
        PrefetchOnDevice(this->Row(field) + way);
      }
    }
  }

  LIMPID_HD LIMPID_INLINE bool FindSeen(const SliceImages& rays)
  {
    if (!this->IsActive())
    {
      return false;
    }
    const Hats hats = this->FindSeenInside(rays);
    if (!this->IsBetweenFrontRays(hats))
    {
      const float here = this->TransmitFromSide(rays.density, hats);
      this->Behind = Exchanged(this->Behind, this->Transmittance, here);
      this->Transmittance = here;
    }
    return true;
  }

  /// The results of FindSeen.
  struct SeenByVoxel
  {
    const float* transmittance;
    const float* behind;
  };

  LIMPID_HD LIMPID_INLINE SeenByVoxel SeenHere() const
  {
    return { &this->Transmittance, &this->Behind };
  }

  LIMPID_HD LIMPID_INLINE bool FindEffect(const SliceImages& rays)
  {
    if (!this->IsActive())
    {
      return false;
    }
    const FaceFrustum& plan = this->Frustum;
    const float depth = this->Here.RelativeDepth();
    const Range<int> columns = plan.ColumnsAbout(this->S, this->U);
    const Range<int> rows = plan.RowsAbout(this->S, this->V);
    float effect = 0;
    for (int row = rows.begin; row < rows.end; ++row)
    {
      float sum = 0;
      for (int column = columns.begin; column < columns.end; ++column)
      {
        const float weight = plan.Row(plan.columnShare)[column] *
          HatAt(plan.Row(plan.columnLines)[column].At(depth), this->U, plan.nodesU);
        // Values of guard rays, whose share is 0, may be NaN.
        sum += weight > 0.0f ? weight * rays.effect[plan.RayAt(column, row)] : 0.0f;
      }
      const float weight = plan.Row(plan.rowShare)[row] *
        HatAt(plan.Row(plan.rowLines)[row].At(depth), this->V, plan.nodesV);
      effect += weight > 0.0f ? weight * sum : 0.0f;
    }
    this->Behind = this->Here.hatGain * plan.Row(plan.rowHatGain, this->S)[this->V] *
      plan.Row(plan.columnHatGain, this->S)[this->U] * effect;
    return true;
  }

  LIMPID_HD LIMPID_INLINE const float* EffectHere() const { return &this->Behind; }

  LIMPID_HD LIMPID_INLINE const float* ImportanceInView(Field nodeImportance)
  {
    this->Importance = *this->Row(nodeImportance);
    if (!this->Frustum.seesAll)
    {
      const LinearMap columns = this->Frustum.Row(this->Frustum.voxelColumns, this->S);
      const LinearMap rows = this->Frustum.Row(this->Frustum.voxelRows, this->S);
      this->Importance *= this->SampleRays(this->Frustum.Row(this->Frustum.inView),
        { columns.index[this->U], rows.index[this->V], columns.weight[this->U],
          rows.weight[this->V] });
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

  LIMPID_HD LIMPID_INLINE void FindTransmittance(
    const SliceImages& rays, float* transmittance) const
  {
    const Hats hats = this->HatsIn(rays);
    const Pair pair = hats.Own();
    // In front of its entry into the box a ray has no values suitable for a cubic of four rays.
    const float depth = this->Here.RelativeDepth();
    const bool entered = HaveEntered(this->Frustum.Row(this->Frustum.columnEntry),
                           this->Frustum.columns, pair.column, depth) &&
      HaveEntered(this->Frustum.Row(this->Frustum.rowEntry), this->Frustum.rows, pair.row, depth);
    if (!entered)
    {
      *transmittance = this->IsBetweenFrontRays(hats) ? this->SampleRays(rays.transmittance, pair)
                                                      : this->TransmitFromSide(rays.density, hats);
      return;
    }
    if (HoldsFour(this->Frustum.frontColumns, pair.column) &&
      HoldsFour(this->Frustum.frontRows, pair.row))
    {
      *transmittance = Clamp(this->SampleCubic(rays.transmittance, pair), 0.0f, 1.0f);
      return;
    }
    *transmittance = this->TransmitDensity(this->SampleCubic(rays.density, pair), hats);
  }

protected:
  /// The rays around the voxel: the first of two along each axis, and the weights of the second
  /// ones.
  struct Pair
  {
    int column;
    int row;
    float sideways;
    float across;
  };

  struct Hats
  {
    HatOfVoxel column;
    HatOfVoxel row;

    LIMPID_HD LIMPID_INLINE Pair Own() const
    {
      return { this->column.first[1], this->row.first[1], this->column.weight, this->row.weight };
    }
  };

  /// FindSeen for voxels between rays that enter the box in front.
  LIMPID_HD LIMPID_INLINE Hats FindSeenInside(const SliceImages& rays)
  {
    const Hats hats = this->HatsIn(rays);
    this->Average(rays.seen, hats);
    return hats;
  }

private:
  LIMPID_HD LIMPID_INLINE Hats HatsIn(const SliceImages& rays) const
  {
    return { rays.columnHats[this->U], rays.rowHats[this->V] };
  }

  LIMPID_HD LIMPID_INLINE bool IsActive() const
  {
    return this->Frustum.ActiveVoxels(this->S, this->V).Contains(this->U);
  }

  LIMPID_HD LIMPID_INLINE bool IsBetweenFrontRays(const Hats& hats) const
  {
    const int column = hats.column.first[1];
    const int row = hats.row.first[1];
    const Range<int>& columns = this->Frustum.frontColumns;
    const Range<int>& rows = this->Frustum.frontRows;
    return column >= columns.begin && column + 1 < columns.end && row >= rows.begin &&
      row + 1 < rows.end;
  }

  /// Whether all four rays of a cubic between `index` and the next one are in `among`.
  LIMPID_HD static LIMPID_INLINE bool HoldsFour(const Range<int>& among, int index)
  {
    return index > among.begin && index + 2 < among.end;
  }

  /// Like HoldsFour, for the rays that have entered the box at a depth, which are contiguous.
  LIMPID_HD static LIMPID_INLINE bool HaveEntered(
    const float* entries, int count, int index, float depth)
  {
    return index > 1 && index + 2 < count - 1 && !(entries[index - 1] > depth) &&
      !(entries[index + 2] > depth);
  }

  /// `image`: a value per ray.
  LIMPID_HD LIMPID_INLINE float SampleRays(const float* image, const Pair& pair) const
  {
    const int first = this->Frustum.RayAt(pair.column, pair.row);
    const int second = first + this->Frustum.columns;
    const float left = image[first] + pair.across * (image[second] - image[first]);
    const float right = image[first + 1] + pair.across * (image[second + 1] - image[first + 1]);
    return left + pair.sideways * (right - left);
  }

  /// Computes means over the hat function of the voxel, across the rays.
  LIMPID_HD LIMPID_INLINE void Average(const SeenOfRay* seen, const Hats& hats)
  {
    const HatOfVoxel& columns = hats.column;
    const HatOfVoxel& rows = hats.row;
    float transmittance = 0;
    float behind = 0;
    for (int i = 0; i < 6; ++i)
    {
      const int row = this->Frustum.RayAt(0, rows.first[i / 2] + i % 2);
      float transmittanceOfRow = 0;
      float behindOfRow = 0;
      for (int j = 0; j < 3; ++j)
      {
        const SeenOfRay* pair = seen + (row + columns.first[j]);
        transmittanceOfRow += columns.low[j] * pair[0].transmittance;
        behindOfRow += columns.low[j] * pair[0].behind;
        transmittanceOfRow += columns.high[j] * pair[1].transmittance;
        behindOfRow += columns.high[j] * pair[1].behind;
      }
      const float share = i % 2 == 0 ? rows.low[i / 2] : rows.high[i / 2];
      transmittance += share * transmittanceOfRow;
      behind += share * behindOfRow;
    }
    this->Transmittance = transmittance;
    this->Behind = behind;
  }

  LIMPID_HD LIMPID_INLINE float TransmitFromSide(const float* density, const Hats& hats) const
  {
    return this->TransmitDensity(this->SampleRays(density, hats.Own()), hats);
  }

  LIMPID_HD LIMPID_INLINE float TransmitDensity(float density, const Hats& hats) const
  {
    const float row = AtLeast(hats.row.entry, this->Frustum.frontDepth);
    const float entry = AtLeast(row, hats.column.entry);
    return Transmitted(density * (this->Here.RelativeDepth() - entry));
  }

  LIMPID_HD LIMPID_INLINE float SampleCubic(const float* image, const Pair& pair) const
  {
    const int stride = this->Frustum.columns;
    const int first = this->Frustum.RayAt(pair.column - 1, pair.row - 1);
    float blend[4];
    for (int i = 0; i < 4; ++i)
    {
      const int at = first + i;
      blend[i] = CubicBetween(
        image[at], image[at + stride], image[at + 2 * stride], image[at + 3 * stride], pair.across);
    }
    const float sideways = pair.sideways;
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
  int Own; ///< index of its node; volumes on devices have less than 2^31 nodes (ChooseBackend)
  float Transmittance = 1; ///< mean over the hat function, see FindSeen
  float Behind = 0;
  float Importance = 0;
};
}

#endif
