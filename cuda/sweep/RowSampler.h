// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How the processor visits rays: one row at a time, several columns in a vector register. It
// samples fields and calls the steps of a kernel (RaySteps.h); RaySampler.h does so for one ray.

#ifndef limpid_sweep_RowSampler_h
#define limpid_sweep_RowSampler_h

#include "backend/Simd.h"
#include "sweep/RaySteps.h"
#include "sweep/SliceWindow.h"

namespace limpid
{
/// One row of rays in one layer. All arrays are indexed by column.
struct RayRow
{
  Layer layer;
  Range<float> row;         ///< where this row of rays is inside the box, as relative depths
  const float* columnEntry; ///< where the columns are
  const float* columnExit;
  const float* length;        ///< world length per unit of depth
  const float* extinction[2]; ///< at the Gauss points, front and rear [1/length]
  const float* importance[2]; ///< [0, 1]
  const float* kept[2];       ///< what the extinction keeps of the base extinction [1/length]
  Range<int> columns;         ///< to be visited
  Range<int> inside;          ///< those that are not clipped in u

  /// Takes what row `number` is in all layers.
  void EnterRow(const FaceFrustum& frustum, int number);

  /// Takes what that row is in the layer behind slice `s`; the samples are left open. Returns
  /// whether any of its rays have to be visited there.
  bool EnterLayer(const FaceFrustum& frustum, int s, int number);

  template <Passage passage>
  LIMPID_INLINE RayInLayer<passage> At(int i) const
  {
    return { this->layer, this->length[i], { this->columnEntry[i], this->columnExit[i] }, this->row,
      { this->extinction[0][i], this->extinction[1][i] },
      { this->importance[0][i], this->importance[1][i] }, { this->kept[0][i], this->kept[1][i] } };
  }

  /// Columns that are inside the box from the front of the layer to its back.
  LIMPID_INLINE Range<int> Through() const
  {
    const float back = this->layer.front + this->layer.thickness;
    const bool rowInside = this->row.begin <= this->layer.front && this->row.end >= back;
    const Range<int> through = Intersection(this->columns, this->inside);
    return rowInside && !through.Empty() ? through
                                         : Range<int>{ this->columns.end, this->columns.end };
  }
};

namespace detail
{
/// Calls step(ray, column) for all columns of a row.
template <class Step>
void StepThroughLayer(const RayRow& row, const Step& step)
{
  RunMultiversioned(
    [&row, &step]() LIMPID_INLINE_LAMBDA
    {
      const RayRow rays = row; // copies: nothing that a step writes can be part of them
      const Step body = step;
      const Range<int> through = rays.Through();
      const Range<int> clipped[2] = { { rays.columns.begin, through.begin },
        { through.end, rays.columns.end } };
      for (const Range<int>& part : clipped)
      {
        for (int i = part.begin; i < part.end; ++i)
        {
          body(rays.template At<Passage::Clipped>(i), i);
        }
      }
      LIMPID_IVDEP
      for (int i = through.begin; i < through.end; ++i)
      {
        body(rays.template At<Passage::Through>(i), i);
      }
    });
}

/// Calls step(ray, column) for all columns of a row, all of which are taken to pass in one way.
template <Passage passage, class Step>
void StepAllAs(const RayRow& row, const Step& step)
{
  RunMultiversioned(
    [&row, &step]() LIMPID_INLINE_LAMBDA
    {
      const RayRow rays = row;
      const Step body = step;
      LIMPID_IVDEP
      for (int i = rays.columns.begin; i < rays.columns.end; ++i)
      {
        body(rays.template At<passage>(i), i);
      }
    });
}

/// Calls step(column) for some columns.
template <class Step>
void StepAlongRow(const Range<int>& columns, const Step& step)
{
  RunMultiversioned(
    [&columns, &step]() LIMPID_INLINE_LAMBDA
    {
      const Step body = step;
      const int end = columns.end;
      LIMPID_IVDEP
      for (int i = columns.begin; i < end; ++i)
      {
        body(i);
      }
    });
}
}

/// A row of rays of a frustum, which enters one layer after the other.
class RowSampler
{
public:
  using Field = SliceWindow*;

  /// Takes the calling thread's scratch memory; `more`: values of it that are for others.
  RowSampler(const FaceFrustum& frustum, const RayStates& states, int row, std::size_t more = 0);

  /// Selects the rays that have to be visited in the layer behind slice `s`; with `areaWeighted`
  /// they widen (Deviation D1). Returns whether there are any.
  bool EnterLayer(int s, bool areaWeighted);

  /// Samples at both Gauss points of the layer.
  void SampleExtinction(Field field);
  void SampleImportance(Field field);

  /// Takes the extinction on the slice behind the layer for that at both Gauss points.
  void SampleExtinctionBehind(Field field);

  /// Where there is no layer: nothing.
  void SampleNothing();

  /// Samples the importance at one Gauss point, at the rear one into RayStates::rearImportance.
  void SampleFrontImportance(Field field);
  void SampleRearImportance(Field field);

  /// Takes what SampleRearImportance has left.
  void RecallRearImportance() { this->Rays.importance[1] = this->States().rearImportance; }

  /// Samples what the extinction keeps of the base extinction: the lesser of both at the nodes.
  /// After SampleExtinction and SampleImportance in the same layer, or what stands for them.
  void SampleKept(Field extinction, Field base);

  /// Samples another extinction in the place of what is kept.
  void SampleAlternative(Field extinction);

  /// Samples a lower bound of the extinction in the place of what is kept; null: 0.
  void SampleLeast(Field extinction);

  /// Selects instead the rays that voxels of slice `s` read with cubics, as far as they have met
  /// anything: the `dimmed` ones before, others in the layer if they entered it (`entered`). Where
  /// they did not, samples are 0. Returns whether there are any.
  bool SelectReadBySlice(int s, bool entered, const Range<int>& dimmed);

  /// Selects instead the rays that have to be visited in a layer on either side of the slice behind
  /// slice `s`. Returns whether there are any.
  bool SelectBeside(int s);

  const FaceFrustum& Plan() const { return this->Frustum; }

  /// The first ray.
  int FirstColumn() const { return 0; }
  int FirstRow() const { return this->RowNumber; }

  /// What the rays of this row carry.
  RayStates States() const { return this->All.From(this->First); }

  template <class Step>
  void ForEachInLayer(const Step& step) const
  {
    detail::StepThroughLayer(this->Rays, step);
  }

  /// Calls step for all rays in the layer: with a ResolvedRay where something important is met and
  /// the ray enters or leaves the box or `resolve` says so, see ResolveSides. After the samples at
  /// the Gauss points.
  template <class Resolve, class Step>
  void ForEachResolved(
    const RayFields<Field>& fields, const Resolve& resolve, const Step& step) const
  {
    const Range<int>& columns = this->Rays.columns;
    const Range<int> through = this->Rays.Through();
    for (const Range<int>& side :
      { Range<int>{ columns.begin, through.begin }, Range<int>{ through.end, columns.end } })
    {
      this->StepWhere<Passage::Clipped>(side, fields, resolve, step);
    }
    if (this->HasAbove(through, resolve.LeastOnWay(this->LongestWay(through))))
    {
      this->StepWhere<Passage::Through>(through, fields, resolve, step);
    }
    else
    {
      this->StepPlain<Passage::Through>(through, step);
    }
  }

  /// See FaceFrustum.
  Range<float> FacesCrossed(int column) const
  {
    return this->Frustum.FacesCrossed(this->Rays.layer, column, this->RowNumber);
  }

  /// Samples fields where ray `column` is at a share of the layer's thickness.
  PointSample SampleAt(const RayFields<Field>& fields, float share, int column) const;

  template <class Step>
  void ForEachRegardless(const Step& step) const
  {
    detail::StepAllAs<Passage::Through>(this->Rays, step);
  }

  template <class Step>
  void ForEach(const Step& step) const
  {
    detail::StepAlongRow(this->Rays.columns, step);
  }

  /// Rays next to the sides of the box, and those that enter through one.
  template <class Step>
  void ForEachNearSides(const Step& step) const
  {
    const Range<int>& all = this->Rays.columns;
    const Range<int> inner = this->ColumnsFarFromSides();
    for (const Range<int>& columns :
      { Range<int>{ all.begin, inner.begin }, Range<int>{ inner.end, all.end } })
    {
      RayRow part = this->Rays;
      part.columns = Intersection(all, columns);
      if (!part.columns.Empty())
      {
        detail::StepAllAs<Passage::Through>(part, step);
      }
    }
  }

protected:
  const FaceFrustum& Frustum;
  int RowNumber;
  int S = 0; ///< slice in front of the layer
  RayRow Rays{};
  float* More; ///< scratch memory that was asked for

private:
  /// Rows of samples; `blend` is for what is not kept.
  struct Scratch
  {
    float* extinction[2];
    float* importance[2];
    float* kept[2];
    float* blend[2];
    float* lesser[2][2]; ///< rows of voxels, see RowsOfLesser
  };

  /// The longest way of some rays through the layer [length].
  float LongestWay(const Range<int>& columns) const;

  /// Whether any of some rays has a sample of the extinction above a bound.
  bool HasAbove(const Range<int>& columns, float bound) const;

  /// Calls step for some rays: with a ResolvedRay where the layer is resolved.
  template <Passage passage, class Resolve, class Step>
  void StepWhere(const Range<int>& columns, const RayFields<Field>& fields, const Resolve& resolve,
    const Step& step) const
  {
    int begin = columns.begin;
    for (int i = columns.begin; i < columns.end; ++i)
    {
      StepResolved(
        this->Rays.template At<Passage::Clipped>(i), *this, fields, resolve, i, i,
        [&](const auto& ray, Index)
        {
          this->StepPlain<passage>({ begin, i }, step);
          step(ray, i);
          begin = i + 1;
        },
        [](Index) {});
    }
    this->StepPlain<passage>({ begin, columns.end }, step);
  }

  /// Calls step for some rays, which all pass in one way.
  template <Passage passage, class Step>
  void StepPlain(const Range<int>& columns, const Step& step) const
  {
    if (!columns.Empty())
    {
      RayRow part = this->Rays;
      part.columns = columns;
      detail::StepAllAs<passage>(part, step);
    }
  }

  Range<int> ColumnsFarFromSides() const;
  template <class Source>
  void SamplePlane(const Source& source, int half, float* out);
  template <class Source>
  void SamplePlanes(const Source& source, float* const out[2]);
  void SampleBehind(Field field, float* out);
  void HideOutOfView(float* importance) const;
  void Prefetch(Field field, const Range<int>& columns) const;

  RayStates All;
  Index First; ///< ray of the row
  Scratch Samples{};
};

/// Values that a row of samples takes: InterpolateRow reads beyond its end.
std::size_t RowScratch(int columns);
}

#endif
