// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Visits rays one at a time, on a device. RowSampler.h has the same members for rows of rays;
// kernels call both.

#ifndef limpid_sweep_RaySampler_h
#define limpid_sweep_RaySampler_h

#include "sweep/FaceFrustum.h"
#include "sweep/RaySteps.h"

#include <cmath>
#include <cstdint>

namespace limpid
{
/// One ray of a frustum, which enters the layers one by one.
class RaySampler
{
public:
  using Field = const float*;

  /// `here`: the values of this ray only; steps receive the index 0.
  LIMPID_HD LIMPID_INLINE RaySampler(
    const FaceFrustum& frustum, const RayStates& here, int column, int row)
    : Frustum(frustum)
    , I(column)
    , J(row)
    , Number(frustum.RayAt(column, row))
    , Here(here)
  {
  }

  LIMPID_HD LIMPID_INLINE bool EnterLayer(int s, bool areaWeighted)
  {
    const Slice& slice = this->Frustum.SliceAt(s);
    this->S = s;
    this->Ray.layer = slice.layer;
    if (!areaWeighted)
    {
      this->Ray.layer.frontScale = this->Ray.layer.backScale = 1;
    }
    this->Ray.length = this->Frustum.Row(this->Frustum.length)[this->Number];
    this->Ray.column = this->Frustum.StayOfColumn(this->I);
    this->Ray.row = this->Frustum.StayOfRow(this->J);
    const bool active = this->Frustum.ActiveRays(s, this->J).Contains(this->I);
    if (active)
    {
      this->FindCorner(0, slice);
      this->FindCorner(1, slice);
    }
    return active;
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
    const Corner& corner = this->Corners[1];
    const Node strideV = this->StrideV();
    const Node near = corner.back;
    const Node far = near + this->StrideU();
    const float left = field[near] + corner.across * (field[near + strideV] - field[near]);
    const float right = field[far] + corner.across * (field[far + strideV] - field[far]);
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
    this->Here[RayChannel::RearImportance][0] = this->Ray.importance[1];
  }

  LIMPID_HD LIMPID_INLINE void RecallRearImportance()
  {
    this->Ray.importance[1] = this->Here[RayChannel::RearImportance][0];
  }

  LIMPID_HD LIMPID_INLINE void SampleKept(Field extinction, Field base)
  {
    for (int half = 0; half < 2; ++half)
    {
      this->Ray.kept[half] = this->BlendLayer(LesserOf{ extinction, base }, this->Corners[half]);
    }
  }

  LIMPID_HD LIMPID_INLINE void SampleAlternative(Field extinction)
  {
    this->Ray.kept[0] = this->SamplePlane(extinction, 0);
    this->Ray.kept[1] = this->SamplePlane(extinction, 1);
  }

  LIMPID_HD LIMPID_INLINE void SampleLeast(Field extinction)
  {
    this->Ray.kept[0] = extinction ? this->SamplePlane(extinction, 0) : 0.0f;
    this->Ray.kept[1] = extinction ? this->SamplePlane(extinction, 1) : 0.0f;
  }

  /// A device keeps an image of all rays for every slice, so every ray is selected.
  LIMPID_HD LIMPID_INLINE bool SelectReadBySlice(int, bool entered, const Range<int>&)
  {
    if (!entered)
    {
      this->SampleNothing();
    }
    return true;
  }

  /// On a device every ray is selected.
  LIMPID_HD LIMPID_INLINE bool SelectBeside(int) { return true; }

  LIMPID_HD LIMPID_INLINE const FaceFrustum& Plan() const { return this->Frustum; }

  /// The column of this ray.
  LIMPID_HD LIMPID_INLINE int FirstColumn() const { return this->I; }
  LIMPID_HD LIMPID_INLINE int FirstRow() const { return this->J; }

  LIMPID_HD LIMPID_INLINE RayStates States() const { return this->Here; }

  template <class Resolve, class Step>
  LIMPID_HD LIMPID_INLINE void ForEachResolved(
    const RayFields<Field>& fields, const Resolve& resolve, const Step& step) const
  {
    StepResolved(this->Ray, *this, fields, resolve, this->I, 0, step,
      [&](Index) { this->ForEachInLayer(step); });
  }

  /// See FaceFrustum.
  LIMPID_HD LIMPID_INLINE Range<float> FacesCrossed(int) const
  {
    return this->Frustum.FacesCrossed(this->Ray.layer, this->I, this->J);
  }

  LIMPID_HD LIMPID_INLINE PointSample SampleAt(
    const RayFields<Field>& fields, float share, int) const
  {
    const Corner corner = this->CornerOf(share);
    PointSample found;
    found.extinction = this->SampleLayer(fields.extinction, corner);
    found.importance = this->InView() * this->SampleLayer(fields.importance, corner);
    found.kept = fields.base ? this->BlendLayer(LesserOf{ fields.extinction, fields.base }, corner)
                             : found.extinction;
    return found;
  }

  template <class Step>
  LIMPID_HD LIMPID_INLINE void ForEachInLayer(const Step& step) const
  {
    if (this->Ray.StaysInside())
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
    step(RayInLayer<LayerCrossing::Through>{ this->Ray.layer, this->Ray.length, this->Ray.column,
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

  /// See FaceFrustum::IsNearSides.
  template <class Step>
  LIMPID_HD LIMPID_INLINE void ForEachNearSides(const Step& step) const
  {
    if (this->Frustum.IsNearSides(this->I, this->J))
    {
      this->ForEachRegardless(step);
    }
  }

protected:
  /// Index of a node. Volumes on devices have less than 2^31 nodes (ChooseBackend).
  using Node = std::int32_t;

  /// The lesser of two fields at a node.
  struct LesserOf
  {
    Field field;
    Field other;

    LIMPID_HD LIMPID_INLINE float operator()(Node node) const
    {
      return std::fmin(this->field[node], this->other[node]);
    }
  };

  /// The nodes and weights for sampling where a ray meets a plane across the depth axis.
  struct Corner
  {
    Node front;     ///< first of four nodes in the front slice
    Node back;      ///< first of four nodes in the back slice
    float sideways; ///< weight of the second node along u
    float across;   ///< weight of the second node along v
    float along;    ///< weight of the back slice
  };

  LIMPID_HD LIMPID_INLINE Node StrideU() const { return static_cast<Node>(this->Frustum.strideU); }
  LIMPID_HD LIMPID_INLINE Node StrideV() const { return static_cast<Node>(this->Frustum.strideV); }

  /// A sampling position along one axis.
  struct Place
  {
    int index;    ///< index of the lower node
    float weight; ///< weight of the next node
  };

  /// `along`: weight of the back slice.
  LIMPID_HD LIMPID_INLINE Corner CornerAt(const Place& column, const Place& row, float along) const
  {
    const Slice& slice = this->Frustum.SliceAt(this->S);
    const auto strideW = static_cast<Node>(this->Frustum.strideW);
    const Node offset = this->StrideU() * column.index + this->StrideV() * row.index;
    return { strideW * slice.nodes[0] + offset, strideW * slice.nodes[1] + offset, column.weight,
      row.weight, along };
  }

  /// `share`: fraction of the layer's thickness.
  LIMPID_HD LIMPID_INLINE Corner CornerOf(float share) const
  {
    const double depth = this->Ray.layer.front + double(share) * this->Ray.layer.thickness;
    const NodePair u = NodesAt(
      this->Frustum.Row(this->Frustum.columnLines)[this->I].At(depth), this->Frustum.nodesU);
    const NodePair v =
      NodesAt(this->Frustum.Row(this->Frustum.rowLines)[this->J].At(depth), this->Frustum.nodesV);
    return this->CornerAt({ u.first, u.weight }, { v.first, v.weight },
      this->Frustum.SliceAt(this->S).FractionAt(share));
  }

  /// Samples a field trilinearly in the layer.
  LIMPID_HD LIMPID_INLINE float SampleLayer(Field field, const Corner& corner) const
  {
    return this->BlendLayer([field](Node node) { return field[node]; }, corner);
  }

  /// Interpolates the values at(node) trilinearly.
  template <class ValueAt>
  LIMPID_HD LIMPID_INLINE float BlendLayer(const ValueAt& at, const Corner& corner) const
  {
    const Node strideU = this->StrideU();
    const Node strideV = this->StrideV();
    const float along = corner.along;
    const auto column = [&](Node front, Node back)
    {
      const float first = at(front) + along * (at(back) - at(front));
      const float second = at(front + strideV) + along * (at(back + strideV) - at(front + strideV));
      return first + corner.across * (second - first);
    };
    const float left = column(corner.front, corner.back);
    const float right = column(corner.front + strideU, corner.back + strideU);
    return left + corner.sideways * (right - left);
  }

  LIMPID_HD LIMPID_INLINE float InView() const
  {
    return this->Frustum.seesAll ? 1.0f : this->Frustum.Row(this->Frustum.inView)[this->Number];
  }

  const FaceFrustum& Frustum;
  int I;
  int J;
  int Number; ///< see FaceFrustum::RayAt
  int S = 0;  ///< slice in front of the layer
  RayInLayer<LayerCrossing::Clipped> Ray{};
  Corner Corners[2]{}; ///< at the Gauss points of a layer in which the ray is active

private:
  /// Prepares sampling on the plane of a Gauss point.
  LIMPID_HD LIMPID_INLINE void FindCorner(int half, const Slice& slice)
  {
    const int plane = 2 * this->S + half;
    const auto placeOf = [&](const MapTable& table, int ray)
    {
      return Place{ this->Frustum.At(table.index, plane, ray),
        this->Frustum.At(table.weight, plane, ray) };
    };
    this->Corners[half] =
      this->CornerAt(placeOf(this->Frustum.planeColumns, this->I - slice.rayColumns.begin),
        placeOf(this->Frustum.planeRows, this->J - slice.rayRows.begin), slice.fractions[half]);
  }

  LIMPID_HD LIMPID_INLINE float SamplePlane(Field field, int half) const
  {
    return this->SampleLayer(field, this->Corners[half]);
  }

  RayStates Here;
};
}

#endif
