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
/// What a ray passes on to the voxels beside it: two numbers that are read at once.
struct alignas(8) SeenOfRay
{
  float transmittance; ///< [0, 1]
  float behind;        ///< what it leaves of the importance behind [scale^2]
};

/// Images of the rays on a slice.
struct SliceImages
{
  const SeenOfRay* seen;
  const float* density; ///< see RayStates
};

/// Where a mean over the hat function of a voxel reads rays along one axis: at the voxel before,
/// the voxel and the one behind, a pair of rays each.
struct HatOfVoxel
{
  int first[3];  ///< of a pair
  float low[3];  ///< weight of the first of a pair
  float high[3]; ///< ... of the second

  LIMPID_HD LIMPID_INLINE HatOfVoxel(const LinearMap& rays, float side, int voxel, int nodes)
  {
    for (int i = 0; i < 3; ++i)
    {
      const int beside = voxel + i - 1;
      const int at = beside < 0 ? 0 : beside < nodes ? beside : nodes - 1;
      const float share = i == 1 ? 1.0f - 2.0f * side : side;
      this->first[i] = rays.index[at];
      this->high[i] = share * rays.weight[at];
      this->low[i] = share - this->high[i];
    }
  }
};

/// One voxel on a slice of a frustum.
class VoxelSampler
{
public:
  using Field = const float*;
  using Rays = SliceImages;

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

  LIMPID_HD LIMPID_INLINE bool FindSeen(const SliceImages& rays)
  {
    if (!this->IsActive())
    {
      return false;
    }
    this->Average(rays.seen);
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
      this->Importance *= this->SampleRays(ImageOf{ this->Frustum.Row(this->Frustum.inView) });
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
    const int column = this->Columns().index[this->U];
    const int row = this->Rows().index[this->V];
    // Ahead of its entry into the box a ray says nothing that four rays could bend by.
    const float depth = this->Here.RelativeDepth();
    const bool entered = HaveEntered(this->Frustum.Row(this->Frustum.columnEntry),
                           this->Frustum.columns, column, depth) &&
      HaveEntered(this->Frustum.Row(this->Frustum.rowEntry), this->Frustum.rows, row, depth);
    if (!entered)
    {
      *transmittance = this->IsBetweenFrontRays() ? this->SampleRays(TransmittanceOf{ rays.seen })
                                                  : this->TransmitFromSide(rays);
      return;
    }
    if (HoldsFour(this->Frustum.frontColumns, column) && HoldsFour(this->Frustum.frontRows, row))
    {
      *transmittance = Clamp(this->SampleCubic(TransmittanceOf{ rays.seen }), 0.0f, 1.0f);
      return;
    }
    *transmittance = this->TransmitDensity(this->SampleCubic(ImageOf{ rays.density }));
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

  /// A value per ray.
  struct ImageOf
  {
    const float* values;
    LIMPID_HD LIMPID_INLINE float operator()(Index ray) const { return this->values[ray]; }
  };

  struct TransmittanceOf
  {
    const SeenOfRay* seen;
    LIMPID_HD LIMPID_INLINE float operator()(Index ray) const
    {
      return this->seen[ray].transmittance;
    }
  };

  template <class Image>
  LIMPID_HD LIMPID_INLINE float SampleRays(const Image& image) const
  {
    const LinearMap columns = this->Columns();
    const LinearMap rows = this->Rows();
    const Index first = this->Frustum.RayAt(columns.index[this->U], rows.index[this->V]);
    const Index second = first + this->Frustum.columns;
    const float across = rows.weight[this->V];
    const float left = image(first) + across * (image(second) - image(first));
    const float right = image(first + 1) + across * (image(second + 1) - image(first + 1));
    return left + columns.weight[this->U] * (right - left);
  }

  /// Means over the hat function of the voxel, across the rays.
  LIMPID_HD LIMPID_INLINE void Average(const SeenOfRay* rays)
  {
    const HatOfVoxel columns(this->Columns(),
      this->Frustum.Row(this->Frustum.columnSides, this->S)[this->U], this->U,
      this->Frustum.nodesU);
    const HatOfVoxel rows(this->Rows(), this->Frustum.Row(this->Frustum.rowSides, this->S)[this->V],
      this->V, this->Frustum.nodesV);
    float transmittance = 0;
    float behind = 0;
    for (int i = 0; i < 6; ++i)
    {
      const SeenOfRay* row = rays + this->Frustum.RayAt(0, rows.first[i / 2] + i % 2);
      float transmittanceOfRow = 0;
      float behindOfRow = 0;
      for (int j = 0; j < 3; ++j)
      {
        const SeenOfRay low = row[columns.first[j]];
        const SeenOfRay high = row[columns.first[j] + 1];
        transmittanceOfRow +=
          columns.low[j] * low.transmittance + columns.high[j] * high.transmittance;
        behindOfRow += columns.low[j] * low.behind + columns.high[j] * high.behind;
      }
      const float share = i % 2 == 0 ? rows.low[i / 2] : rows.high[i / 2];
      transmittance += share * transmittanceOfRow;
      behind += share * behindOfRow;
    }
    this->Transmittance = transmittance;
    this->Behind = behind;
  }

  LIMPID_HD LIMPID_INLINE float TransmitFromSide(const SliceImages& rays) const
  {
    return this->TransmitDensity(this->SampleRays(ImageOf{ rays.density }));
  }

  LIMPID_HD LIMPID_INLINE float TransmitDensity(float density) const
  {
    const float inRow = this->Frustum.Row(this->Frustum.voxelRowEntry, this->S)[this->V];
    const float inColumn = this->Frustum.Row(this->Frustum.voxelColumnEntry, this->S)[this->U];
    const float row = inRow > this->Frustum.frontDepth ? inRow : this->Frustum.frontDepth;
    const float entry = row > inColumn ? row : inColumn;
    return Transmitted(density * (this->Here.RelativeDepth() - entry));
  }

  template <class Image>
  LIMPID_HD LIMPID_INLINE float SampleCubic(const Image& image) const
  {
    const LinearMap columns = this->Columns();
    const LinearMap rows = this->Rows();
    const Index stride = this->Frustum.columns;
    const Index first = this->Frustum.RayAt(columns.index[this->U] - 1, rows.index[this->V] - 1);
    float blend[4];
    for (int i = 0; i < 4; ++i)
    {
      const Index at = first + i;
      blend[i] = CubicBetween(image(at), image(at + stride), image(at + 2 * stride),
        image(at + 3 * stride), rows.weight[this->V]);
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
