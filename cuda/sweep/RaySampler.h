// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How a device visits rays: one at a time. RowSampler.h has the same members for rows; the kernels
// call both.

#ifndef limpid_sweep_RaySampler_h
#define limpid_sweep_RaySampler_h

#include "sweep/FaceFrustum.h"
#include "sweep/RaySteps.h"

namespace limpid
{
/// One ray of a frustum, which enters one layer after the other.
class RaySampler
{
public:
  using Field = const float*;

  /// `here`: of this ray alone; steps have the index 0.
  LIMPID_HD LIMPID_INLINE RaySampler(
    const FaceFrustum& frustum, const RayStates& here, int column, int row)
    : Frustum(frustum)
    , I(column)
    , J(row)
    , Here(here)
  {
  }

  LIMPID_HD LIMPID_INLINE bool EnterLayer(int s, bool areaWeighted)
  {
    this->S = s;
    this->Ray.layer = this->Frustum.SliceAt(s).layer;
    if (!areaWeighted)
    {
      this->Ray.layer.frontScale = this->Ray.layer.backScale = 1;
    }
    this->Ray.length = this->Frustum.Row(this->Frustum.length, this->J)[this->I];
    this->Ray.column = this->Frustum.StayOfColumn(this->I);
    this->Ray.row = this->Frustum.StayOfRow(this->J);
    return this->Frustum.ActiveRays(s, this->J).Contains(this->I);
  }

  LIMPID_HD LIMPID_INLINE void SampleExtinction(Field field)
  {
    this->Ray.extinction[0] = this->SamplePlane(field, 0);
    this->Ray.extinction[1] = this->SamplePlane(field, 1);
  }

  LIMPID_HD LIMPID_INLINE void SampleImportance(Field field)
  {
    this->Ray.importance[0] = this->InView() * this->SamplePlane(field, 0);
    this->Ray.importance[1] = this->InView() * this->SamplePlane(field, 1);
  }

  LIMPID_HD LIMPID_INLINE void SampleExtinctionBehind(Field field)
  {
    const Corner corner = this->CornerOf(1);
    const Index strideU = this->Frustum.strideU;
    const Index strideV = this->Frustum.strideV;
    const float* near =
      field + this->Frustum.strideW * this->Frustum.SliceAt(this->S).nodes[1] + corner.offset;
    const float* far = near + strideU;
    const float left = near[0] + corner.across * (near[strideV] - near[0]);
    const float right = far[0] + corner.across * (far[strideV] - far[0]);
    this->Ray.extinction[0] = this->Ray.extinction[1] = left + corner.sideways * (right - left);
  }

  LIMPID_HD LIMPID_INLINE void SampleNothing()
  {
    this->Ray.extinction[0] = this->Ray.extinction[1] = 0;
    this->Ray.importance[0] = this->Ray.importance[1] = 0;
  }

  LIMPID_HD LIMPID_INLINE void SampleFrontImportance(Field field)
  {
    this->Ray.importance[0] = this->InView() * this->SamplePlane(field, 0);
  }

  LIMPID_HD LIMPID_INLINE void SampleRearImportance(Field field)
  {
    this->Ray.importance[0] = this->Ray.importance[1] =
      this->InView() * this->SamplePlane(field, 1);
    this->Here.rearImportance[0] = this->Ray.importance[1];
  }

  LIMPID_HD LIMPID_INLINE void RecallRearImportance()
  {
    this->Ray.importance[1] = this->Here.rearImportance[0];
  }

  LIMPID_HD LIMPID_INLINE void SampleKept(Field extinction, Field base)
  {
    for (int half = 0; half < 2; ++half)
    {
      this->Ray.kept[half] = this->BlendLayer(LesserOf{ extinction, base }, this->CornerOf(half),
        this->Frustum.SliceAt(this->S).fractions[half]);
    }
  }

  LIMPID_HD LIMPID_INLINE void SampleAlternative(Field extinction)
  {
    this->Ray.kept[0] = this->SamplePlane(extinction, 0);
    this->Ray.kept[1] = this->SamplePlane(extinction, 1);
  }

  /// A device keeps an image of all rays for every slice: it selects each of them.
  LIMPID_HD LIMPID_INLINE bool SelectReadBySlice(int, bool entered, const Range<int>&)
  {
    if (!entered)
    {
      this->SampleNothing();
    }
    return true;
  }

  LIMPID_HD LIMPID_INLINE const FaceFrustum& Plan() const { return this->Frustum; }

  /// This one.
  LIMPID_HD LIMPID_INLINE int FirstColumn() const { return this->I; }
  LIMPID_HD LIMPID_INLINE int FirstRow() const { return this->J; }

  LIMPID_HD LIMPID_INLINE RayStates States() const { return this->Here; }

  template <class Step>
  LIMPID_HD LIMPID_INLINE void ForEachInLayer(const Step& step) const
  {
    const float back = this->Ray.layer.front + this->Ray.layer.thickness;
    const float exit =
      this->Ray.column.end < this->Ray.row.end ? this->Ray.column.end : this->Ray.row.end;
    if (this->Ray.Entry() <= this->Ray.layer.front && exit >= back)
    {
      this->ForEachRegardless(step);
    }
    else
    {
      step(this->Ray, 0);
    }
  }

  template <class Step>
  LIMPID_HD LIMPID_INLINE void ForEachRegardless(const Step& step) const
  {
    step(RayInLayer<Passage::Through>{ this->Ray.layer, this->Ray.length, this->Ray.column,
           this->Ray.row, { this->Ray.extinction[0], this->Ray.extinction[1] },
           { this->Ray.importance[0], this->Ray.importance[1] },
           { this->Ray.kept[0], this->Ray.kept[1] } },
      0);
  }

  template <class Step>
  LIMPID_HD LIMPID_INLINE void ForEach(const Step& step) const
  {
    step(0);
  }

  /// Of the rays that enter in front, a voxel beside one that does not reads up to three.
  template <class Step>
  LIMPID_HD LIMPID_INLINE void ForEachNearSides(const Step& step) const
  {
    constexpr int reach = 3;
    const Range<int>& columns = this->Frustum.frontColumns;
    const Range<int>& rows = this->Frustum.frontRows;
    if (this->I < columns.begin + reach || this->I >= columns.end - reach ||
      this->J < rows.begin + reach || this->J >= rows.end - reach)
    {
      this->ForEachRegardless(step);
    }
  }

protected:
  /// The lesser of two fields at a node.
  struct LesserOf
  {
    Field field;
    Field other;

    LIMPID_HD LIMPID_INLINE float operator()(Index node) const
    {
      return this->field[node] < this->other[node] ? this->field[node] : this->other[node];
    }
  };

  /// Where a ray meets a plane across the depth axis.
  struct Corner
  {
    Index offset;   ///< of the first of four nodes in a slice
    float sideways; ///< weight of the second one along u
    float across;   ///< ... along v
  };

  LIMPID_HD LIMPID_INLINE Corner CornerAt(
    const LinearMap& columns, int column, const LinearMap& rows, int row) const
  {
    return { this->Frustum.strideU * columns.index[column] +
        this->Frustum.strideV * rows.index[row],
      columns.weight[column], rows.weight[row] };
  }

  /// Trilinear in the layer; `along`: weight of its second slice.
  LIMPID_HD LIMPID_INLINE float SampleLayer(Field field, const Corner& corner, float along) const
  {
    return this->BlendLayer([field](Index node) { return field[node]; }, corner, along);
  }

  /// The same of values at the nodes.
  template <class ValueAt>
  LIMPID_HD LIMPID_INLINE float BlendLayer(
    const ValueAt& at, const Corner& corner, float along) const
  {
    const Slice& slice = this->Frustum.SliceAt(this->S);
    const Index strideV = this->Frustum.strideV;
    const Index front = this->Frustum.strideW * slice.nodes[0] + corner.offset;
    const Index back = this->Frustum.strideW * slice.nodes[1] + corner.offset;
    const auto column = [&](Index f, Index b)
    {
      const float first = at(f) + along * (at(b) - at(f));
      const float second = at(f + strideV) + along * (at(b + strideV) - at(f + strideV));
      return first + corner.across * (second - first);
    };
    const float left = column(front, back);
    const float right = column(front + this->Frustum.strideU, back + this->Frustum.strideU);
    return left + corner.sideways * (right - left);
  }

  const FaceFrustum& Frustum;
  int I;
  int J;
  int S = 0; ///< slice in front of the layer
  RayInLayer<Passage::Clipped> Ray{};

private:
  /// On the plane at a Gauss point.
  LIMPID_HD LIMPID_INLINE Corner CornerOf(int half) const
  {
    const Index plane = 2 * Index(this->S) + half;
    return this->CornerAt(this->Frustum.Row(this->Frustum.planeColumns, plane), this->I,
      this->Frustum.Row(this->Frustum.planeRows, plane), this->J);
  }

  LIMPID_HD LIMPID_INLINE float SamplePlane(Field field, int half) const
  {
    return this->SampleLayer(
      field, this->CornerOf(half), this->Frustum.SliceAt(this->S).fractions[half]);
  }

  LIMPID_HD LIMPID_INLINE float InView() const
  {
    return this->Frustum.seesAll ? 1.0f : this->Frustum.Row(this->Frustum.inView, this->J)[this->I];
  }

  RayStates Here;
};
}

#endif
