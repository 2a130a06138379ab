// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Visits rays row by row, on the processor, several columns per vector register. It samples fields
// and calls the steps of a kernel (RaySteps.h). RaySampler.h does so for single rays.

#ifndef limpid_sweep_RowSampler_h
#define limpid_sweep_RowSampler_h

#include "backend/Simd.h"
#include "sweep/RaySteps.h"
#include "sweep/ResolvedRows.h"
#include "sweep/SliceWindow.h"

#include <type_traits>

namespace limpid
{
/// One row of rays in one layer. All arrays are indexed by column.
struct RayRow
{
  Layer layer;
  Range<float> row;         ///< relative depths between which this row of rays is inside the box
  const float* columnEntry; ///< relative depths where the columns enter the box
  const float* columnExit;
  const float* length;        ///< world length per unit of depth
  const float* extinction[2]; ///< at the Gauss points, front and rear [1/length]
  const float* importance[2]; ///< [0, 1]
  const float* kept[2]; ///< kept base extinction: min of extinction and base extinction [1/length]
  Range<int> columns;   ///< columns to visit
  Range<int> inside;    ///< columns that are not clipped in u

  /// Sets the values of row `number` that do not depend on the layer.
  void EnterRow(const FaceFrustum& frustum, int number);

  /// Sets the values of row `number` in the layer behind slice `s`, except the samples. Returns
  /// whether any ray of the row has to be visited there.
  bool EnterLayer(const FaceFrustum& frustum, int s, int number);

  template <LayerCrossing passage>
  LIMPID_INLINE RayInLayer<passage> At(int i) const
  {
    return { this->layer, this->length[i], { this->columnEntry[i], this->columnExit[i] }, this->row,
      { this->extinction[0][i], this->extinction[1][i] },
      { this->importance[0][i], this->importance[1][i] }, { this->kept[0][i], this->kept[1][i] } };
  }

  /// Columns that are inside the box throughout the layer.
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
      const RayRow rays = row; // local copies: a step cannot alias them
      const Step body = step;
      const Range<int> through = rays.Through();
      const Range<int> clipped[2] = { { rays.columns.begin, through.begin },
        { through.end, rays.columns.end } };
      for (const Range<int>& part : clipped)
      {
        LIMPID_IVDEP
        for (int i = part.begin; i < part.end; ++i)
        {
          body(rays.template At<LayerCrossing::Clipped>(i), i);
        }
      }
      LIMPID_IVDEP
      for (int i = through.begin; i < through.end; ++i)
      {
        body(rays.template At<LayerCrossing::Through>(i), i);
      }
    });
}

/// Calls step(ray, column) for all columns of a row; all rays are treated as `passage` says.
template <LayerCrossing passage, class Step>
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

/// Calls step(column) for a range of columns.
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

/// A row of rays of a frustum, which enters the layers one by one.
class RowSampler
{
public:
  using Field = SliceWindow*;

  /// Uses scratch memory of the calling thread; `more`: number of extra values for derived
  /// classes.
  RowSampler(const FaceFrustum& frustum, const RayStates& states, int row, std::size_t more = 0);

  /// Selects the rays to visit in the layer behind slice `s`. With `areaWeighted` rays widen
  /// (Deviation D1). Returns whether any ray is selected.
  bool EnterLayer(int s, bool areaWeighted);

  /// Samples a field at both Gauss points of the layer.
  void SampleExtinction(Field field);
  void SampleImportance(Field field);

  /// Uses the extinction on the slice behind the layer at both Gauss points.
  void SampleExtinctionBehind(Field field);

  /// Sets extinction and importance to 0, where there is no layer.
  void SampleNothing();

  /// Samples the importance at one Gauss point; the rear sample goes to RayChannel::RearImportance.
  void SampleFrontImportance(Field field);
  void SampleRearImportance(Field field);

  /// Uses the rear sample that SampleRearImportance has stored.
  void RecallRearImportance()
  {
    this->Rays.importance[1] = this->States()[RayChannel::RearImportance];
  }

  /// Samples the kept base extinction: the lesser of both fields at the nodes. Call it after
  /// extinction and importance of the layer were sampled.
  void SampleKept(Field extinction, Field base);

  /// Samples an alternative extinction in place of the kept one.
  void SampleAlternative(Field extinction);

  /// Samples a lower bound of the extinction in place of the kept one; null stands for 0.
  void SampleLeast(Field extinction);

  /// Selects instead the rays that voxels of slice `s` read by cubics and that have met anything,
  /// in front of the slice (`dimmed`) or in the layer. `entered`: whether EnterLayer selected any
  /// ray; if not, samples are 0. Returns whether any ray is selected.
  bool SelectReadBySlice(int s, bool entered, const Range<int>& dimmed);

  /// Selects instead the rays to visit in a layer on either side of the slice behind slice `s`.
  /// Returns whether any ray is selected.
  bool SelectBeside(int s);

  const FaceFrustum& Plan() const { return this->Frustum; }

  /// The first column.
  int FirstColumn() const { return 0; }
  int FirstRow() const { return this->RowNumber; }

  /// The values that the rays of this row carry.
  RayStates States() const { return this->All.From(this->First); }

  template <class Step>
  void ForEachInLayer(const Step& step) const
  {
    detail::StepThroughLayer(this->Rays, step);
  }

  /// Calls step for all rays in the layer. A ray is passed as a ResolvedRay if it has important
  /// samples and enters or leaves the box, or if `resolve` asks for it, see ResolveSides. Call it
  /// after sampling at the Gauss points.
  template <class Resolve, class Step>
  void ForEachResolved(
    const RayFields<Field>& fields, const Resolve& resolve, const Step& step) const
  {
    const Range<int>& columns = this->Rays.columns;
    const Range<int> through = this->Rays.Through();
    for (const Range<int>& side :
      { Range<int>{ columns.begin, through.begin }, Range<int>{ through.end, columns.end } })
    {
      this->StepWhere<LayerCrossing::Clipped>(side, fields, resolve, step);
    }
    if (this->HasAbove(through, resolve.LeastOnWay(this->LongestWay(through))))
    {
      this->StepWhere<LayerCrossing::Through>(through, fields, resolve, step);
    }
    else
    {
      this->StepPlain<LayerCrossing::Through>(through, step);
    }
  }

  /// See FaceFrustum.
  Range<float> FacesCrossed(int column) const
  {
    return this->Frustum.FacesCrossed(this->Rays.layer, column, this->RowNumber);
  }

  /// Samples the fields on ray `column` at a fraction of the layer's thickness.
  PointSample SampleAt(const RayFields<Field>& fields, float share, int column) const;

  template <class Step>
  void ForEachRegardless(const Step& step) const
  {
    detail::StepAllAs<LayerCrossing::Through>(this->Rays, step);
  }

  template <class Step>
  void ForEach(const Step& step) const
  {
    detail::StepAlongRow(this->Rays.columns, step);
  }

  /// Visits rays next to the sides of the box, and those that enter through a side.
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
        detail::StepAllAs<LayerCrossing::Through>(part, step);
      }
    }
  }

protected:
  /// The eight nodes about a point of a ray, and their weights.
  struct LayerPlace
  {
    const int (&nodes)[2]; ///< of the two slices
    NodePair row;
    NodePair column;
    float along; ///< weight of the second slice

    /// Interpolates the values at(node of the slice, row, column).
    template <class ValueAt>
    float Blend(const ValueAt& at) const
    {
      const auto across = [&](int node)
      {
        const auto alongRow = [&](int number)
        {
          const float first = at(node, number, this->column.first);
          return first + this->column.weight * (at(node, number, this->column.first + 1) - first);
        };
        const float first = alongRow(this->row.first);
        return first + this->row.weight * (alongRow(this->row.first + 1) - first);
      };
      const float front = across(this->nodes[0]);
      return front + this->along * (across(this->nodes[1]) - front);
    }
  };

  /// Returns the place of ray `column` at a fraction of the layer's thickness.
  LayerPlace PlaceAt(float share, int column) const;

  /// Returns a function for LayerPlace::Blend.
  static auto ValuesOf(Field field)
  {
    return [field](int node, int row, int at) { return field->Row(node, row)[at]; };
  }

  const FaceFrustum& Frustum;
  int RowNumber;
  int S = 0; ///< slice in front of the layer
  RayRow Rays{};
  float* More; ///< the extra scratch memory

private:
  /// Rows of samples; `blend` holds temporary values.
  struct Scratch
  {
    float* extinction[2];
    float* importance[2];
    float* kept[2];
    float* blend[2];
    float* lesser[2][2]; ///< rows of voxels, see RowsOfLesser
    float* densest;      ///< see FindResolved
    float* important;    ///< largest importance in the layer; see FindResolved
  };

  /// Returns the longest path of the given rays through the layer [length].
  float LongestWay(const Range<int>& columns) const;

  /// Returns whether any of the given rays has an extinction sample above a bound.
  bool HasAbove(const Range<int>& columns, float bound) const;

  /// Calls step for the given rays, with the resolved layer where it is resolved: several rays at
  /// once (stepsLanes), a LitRay if the step accepts one, a ResolvedRay otherwise.
  template <LayerCrossing passage, class Resolve, class Step>
  void StepWhere(const Range<int>& columns, const RayFields<Field>& fields, const Resolve& resolve,
    const Step& step) const
  {
    if constexpr (stepsLanes<Step> || std::is_invocable_v<Step, const LitRay&, Index>)
    {
      this->StepInLanes<passage>(columns, fields, resolve, step);
    }
    else
    {
      this->StepOneByOne<passage>(columns, fields, resolve, step);
    }
  }

  /// Calls step for the given rays, with a ResolvedRay where the layer is resolved.
  template <LayerCrossing passage, class Resolve, class Step>
  void StepOneByOne(const Range<int>& columns, const RayFields<Field>& fields,
    const Resolve& resolve, const Step& step) const
  {
    const RowBetweenSlices layer{ this->Frustum, this->S, this->RowNumber, this->Rays, fields };
    const float* densest = this->FindResolved(columns, layer, resolve);
    int begin = columns.begin;
    for (int i = columns.begin; i < columns.end; ++i)
    {
      if (densest[i] < 0.0f)
      {
        continue;
      }
      StepResolved(
        this->Rays.template At<LayerCrossing::Clipped>(i), *this, fields, resolve, i, i,
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

  /// Calls step for the given rays, with several rays or a LitRay where the layer is resolved.
  template <LayerCrossing passage, class Resolve, class Step>
  void StepInLanes(const Range<int>& columns, const RayFields<Field>& fields,
    const Resolve& resolve, const Step& step) const
  {
    using Cuts = typename Resolve::Cuts;
    const RowBetweenSlices layer{ this->Frustum, this->S, this->RowNumber, this->Rays, fields };
    const float* densest = this->FindResolved(columns, layer, resolve);
    const float* sampled = this->Samples.important;
    const float* behind = this->States()[RayChannel::Behind];
    RaysInLanes lanes;
    int begin = columns.begin;
    const auto stepAll = [&]
    {
      if (lanes.count == 0)
      {
        return;
      }
      lanes.FillRest();
      if constexpr (stepsLanes<Step>)
      {
        step.template Lanes<Cuts>(layer, lanes);
      }
      else
      {
        layer.FindLight<Cuts, findsEffects<Step> ? Effects::Found : Effects::Ignored>(lanes);
      }
      for (int lane = 0; lane < lanes.count; ++lane)
      {
        const int i = lanes.column[lane];
        this->StepPlain<passage>({ begin, i }, step);
        if constexpr (!stepsLanes<Step>)
        {
          const RayInLayer<LayerCrossing::Clipped> ray =
            this->Rays.template At<LayerCrossing::Clipped>(i);
          step(LitRay{ ray, lanes.light[lane], lanes.effect[lane] }, i);
        }
        begin = i + 1;
      }
      lanes.count = 0;
    };
    for (int i = columns.begin; i < columns.end; ++i)
    {
      if (densest[i] >= 0.0f)
      {
        lanes.Add(i, sampled[i], densest[i], behind[i]);
        if (lanes.count == RaysInLanes::most)
        {
          stepAll();
        }
      }
    }
    stepAll();
    this->StepPlain<passage>({ begin, columns.end }, step);
  }

  /// Finds the rays whose layers are resolved, see StepResolved. Returns their densest extinction,
  /// and -1 for all others. Their largest samples are then in Samples.important [1/length].
  template <class Resolve>
  const float* FindResolved(
    const Range<int>& columns, const RowBetweenSlices& layer, const Resolve& resolve) const
  {
    using Cuts = typename Resolve::Cuts;
    float* const densest = this->Samples.densest;
    float* const important = this->Samples.important;
    detail::StepAllAs<LayerCrossing::Clipped>(this->RaysAt(columns),
      [densest, important](const RayInLayer<LayerCrossing::Clipped>& ray, int i)
        LIMPID_INLINE_LAMBDA
      {
        const float front = ray.importance[0];
        const float rear = ray.importance[1];
        densest[i] = DensestOf(ray);
        important[i] = front > rear ? front : rear;
      });
    if (Cuts::atFaces)
    {
      layer.IncludeEnds(columns, densest, important);
    }
    detail::StepAllAs<LayerCrossing::Clipped>(this->RaysAt(columns),
      [densest, important, resolve](const RayInLayer<LayerCrossing::Clipped>& ray, int i)
        LIMPID_INLINE_LAMBDA
      {
        const bool inside = ray.StaysInside();
        const float most = resolve.Densest(densest[i]);
        const bool thick =
          most * ray.layer.thickness * ray.length > Cuts::thick && resolve.Reaches(i);
        const bool lit = important[i] > 0.0f && !ray.StaysOutside();
        important[i] = densest[i];
        densest[i] = lit && (!inside || thick) ? most : -1.0f;
      });
    return densest;
  }

  RayRow RaysAt(const Range<int>& columns) const
  {
    RayRow part = this->Rays;
    part.columns = columns;
    return part;
  }

  /// Calls step for the given rays; all are treated as `passage` says.
  template <LayerCrossing passage, class Step>
  void StepPlain(const Range<int>& columns, const Step& step) const
  {
    if (!columns.Empty())
    {
      detail::StepAllAs<passage>(this->RaysAt(columns), step);
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
  Index First; ///< index of the first ray of the row
  Scratch Samples{};
};

/// Number of values to allocate for a row of samples: InterpolateRow reads beyond its end.
std::size_t RowScratch(int columns);
}

#endif
