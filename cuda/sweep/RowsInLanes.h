// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What resolved layers of sixteen rays side by side are made of; for files that compile them for
// several instruction sets (backend/Simd.h), with multiplications and additions apart.

#ifndef limpid_sweep_RowsInLanes_h
#define limpid_sweep_RowsInLanes_h

#include "backend/Simd.h"
#include "math/FloatLanes.h"
#include "sweep/ResolvedRows.h"
#include "sweep/RowSampler.h"

namespace limpid
{
constexpr int laneCount = FloatLanes::count;
static_assert(laneCount == RaysInLanes::most, "a ray for every lane");

/// A number per lane in memory, for loops that become vector instructions.
template <class Number>
struct InMemory
{
  alignas(64) Number of[laneCount];

  InMemory() = default;
  LIMPID_INLINE explicit InMemory(const FloatLanes& lanes) { lanes.Store(this->of); }
};

/// The two slices of a field that a layer interpolates.
struct TwoSlices
{
  const float* slices[2]; ///< row 0, column 0
  Index stride;           ///< from row to row

  LIMPID_INLINE TwoSlices(SliceWindow* field, const int nodes[2])
    : slices{ field->Row(nodes[0], 0), field->Row(nodes[1], 0) }
    , stride(field->Row(nodes[0], 1) - this->slices[0])
  {
  }
};

/// Values at the eight nodes about every ray: [slice][row][column].
struct EightNodes
{
  InMemory<float> at[2][2][2];

  /// Interpolates. `sideways`, `across`, `along`: weights of the second column, row and slice.
  LIMPID_INLINE FloatLanes Blended(
    const FloatLanes& sideways, const FloatLanes& across, const FloatLanes& along) const
  {
    const auto row = [&](const InMemory<float>(&nodes)[2]) LIMPID_INLINE_LAMBDA
    {
      const FloatLanes first = FloatLanes::Load(nodes[0].of);
      return first + sideways * (FloatLanes::Load(nodes[1].of) - first);
    };
    const auto slice = [&](const InMemory<float>(&nodes)[2][2]) LIMPID_INLINE_LAMBDA
    {
      const FloatLanes first = row(nodes[0]);
      return first + across * (row(nodes[1]) - first);
    };
    const FloatLanes front = slice(this->at[0]);
    return front + along * (slice(this->at[1]) - front);
  }
};

/// Samples fields on several rays of a row; RowSampler::SampleAt does so for one. The nodes about a
/// ray are read again only when it has come to another cell.
class LaneSampler
{
public:
  /// `columns`: one for each lane.
  LIMPID_INLINE LaneSampler(const RowBetweenSlices& layer, const int* columns)
    : Frustum(layer.frustum)
    , Front(layer.frustum.SliceAt(layer.slice))
    , Here(layer.rays.layer)
    , Line(layer.frustum.Row(layer.frustum.rowLines)[layer.row])
    , Extinction(layer.fields.extinction, this->Front.nodes)
    , Importance(layer.fields.importance, this->Front.nodes)
    , Base(layer.fields.base ? layer.fields.base : layer.fields.extinction, this->Front.nodes)
    , CountsKept(layer.fields.base != nullptr)
  {
    const RayLine* lines = this->Frustum.Row(this->Frustum.columnLines);
    const float* inView =
      this->Frustum.seesAll ? nullptr : this->Frustum.OfRow(this->Frustum.inView, layer.row);
    for (int lane = 0; lane < laneCount; ++lane)
    {
      this->Start.of[lane] = lines[columns[lane]].start;
      this->Slope.of[lane] = lines[columns[lane]].slope;
      this->InView.of[lane] = inView ? inView[columns[lane]] : 1.0f;
      this->Column.of[lane] = -1; // no nodes yet
      this->Row.of[lane] = -1;
    }
  }

  /// Samples at fractions of the layer's thickness.
  LIMPID_INLINE PointSampleOf<FloatLanes> At(const FloatLanes& share)
  {
    this->MoveTo(share);
    const FloatLanes sideways = FloatLanes::Load(this->Sideways.of);
    const FloatLanes across = FloatLanes::Load(this->Across.of);
    const FloatLanes along = this->Front.FractionAt(share);
    PointSampleOf<FloatLanes> found;
    found.extinction = this->ExtinctionThere.Blended(sideways, across, along);
    found.importance =
      FloatLanes::Load(this->InView.of) * this->ImportanceThere.Blended(sideways, across, along);
    found.kept = found.extinction;
    if (this->CountsKept)
    {
      found.kept = this->KeptThere.Blended(sideways, across, along);
    }
    return found;
  }

private:
  LIMPID_INLINE void MoveTo(const FloatLanes& share)
  {
    const InMemory<float> shares(share);
    InMemory<int> moved;
    const double front = this->Here.front;
    const double thickness = this->Here.thickness;
    const RayLine row = this->Line;
    const int nodesU = this->Frustum.nodesU;
    const int nodesV = this->Frustum.nodesV;
    LIMPID_IVDEP
    for (int lane = 0; lane < laneCount; ++lane)
    {
      const double depth = front + double(shares.of[lane]) * thickness;
      const RayLine column{ this->Start.of[lane], this->Slope.of[lane] };
      const NodePair u = NodesAt(column.At(depth), nodesU);
      const NodePair v = NodesAt(row.At(depth), nodesV);
      moved.of[lane] = (u.first ^ this->Column.of[lane]) | (v.first ^ this->Row.of[lane]);
      this->Column.of[lane] = u.first;
      this->Row.of[lane] = v.first;
      this->Sideways.of[lane] = u.weight;
      this->Across.of[lane] = v.weight;
    }
    for (int lane = 0; lane < laneCount; ++lane)
    {
      if (moved.of[lane] != 0)
      {
        this->ReadNodes(lane);
      }
    }
  }

  LIMPID_INLINE void ReadNodes(int lane)
  {
    const Index row = this->Row.of[lane];
    const Index column = this->Column.of[lane];
    for (int node = 0; node < 8; ++node)
    {
      const int slice = node / 4;
      const int nextRow = node / 2 % 2;
      const int nextColumn = node % 2;
      const auto read = [&](const TwoSlices& field) LIMPID_INLINE_LAMBDA
      { return field.slices[slice][field.stride * (row + nextRow) + column + nextColumn]; };
      const float extinction = read(this->Extinction);
      this->ExtinctionThere.at[slice][nextRow][nextColumn].of[lane] = extinction;
      this->ImportanceThere.at[slice][nextRow][nextColumn].of[lane] = read(this->Importance);
      if (this->CountsKept)
      {
        const float base = read(this->Base);
        this->KeptThere.at[slice][nextRow][nextColumn].of[lane] =
          base < extinction ? base : extinction;
      }
    }
  }

  const FaceFrustum& Frustum;
  const Slice& Front;
  Layer Here;
  RayLine Line; ///< of the row
  TwoSlices Extinction;
  TwoSlices Importance;
  TwoSlices Base;
  bool CountsKept;
  InMemory<double> Start; ///< of the columns' lines
  InMemory<double> Slope;
  InMemory<float> InView;
  InMemory<int> Column; ///< first node of each ray's cell
  InMemory<int> Row;
  InMemory<float> Sideways;
  InMemory<float> Across;
  EightNodes ExtinctionThere;
  EightNodes ImportanceThere;
  EightNodes KeptThere;
};

/// The values of some rays of a row side by side: lanes instead of columns.
class PackedRow
{
public:
  PackedRow(const RayRow& rays, const int* columns)
    : Row(rays)
  {
    this->Row.columns = { 0, laneCount };
    this->Pack(columns, this->Row.columnEntry, 0);
    this->Pack(columns, this->Row.columnExit, 1);
    this->Pack(columns, this->Row.length, 2);
    for (int half = 0; half < 2; ++half)
    {
      this->Pack(columns, this->Row.extinction[half], 3 + half);
      this->Pack(columns, this->Row.importance[half], 5 + half);
      this->Pack(columns, this->Row.kept[half], 7 + half);
    }
  }

  PackedRow(const PackedRow&) = delete;
  void operator=(const PackedRow&) = delete;

  const RayRow& Rays() const { return this->Row; }

private:
  /// Lets `values` point to a packed copy.
  void Pack(const int* columns, const float*& values, int copy)
  {
    for (int lane = 0; lane < laneCount; ++lane)
    {
      this->Copies[copy].of[lane] = values[columns[lane]];
    }
    values = this->Copies[copy].of;
  }

  InMemory<float> Copies[9];
  RayRow Row;
};

/// The layer of every ray as two halves.
struct HalvesInLanes
{
  InMemory<float> begin; ///< range inside the box, as fractions of the layer's thickness
  InMemory<float> end;
  InMemory<float> way;    ///< length of the ray in the layer [length]
  InMemory<float> passed; ///< see LayerLight
  InMemory<float> unattenuated;
  InMemory<float> keptUnattenuated;
  InMemory<float> opticalDepth;

  explicit HalvesInLanes(const PackedRow& rays)
  {
    detail::StepAllAs<LayerCrossing::Clipped>(rays.Rays(),
      [this](const RayInLayer<LayerCrossing::Clipped>& ray, int lane) LIMPID_INLINE_LAMBDA
      {
        const Range<float> inside = ray.Inside();
        const LayerLight light = ray.Light();
        this->begin.of[lane] = inside.begin;
        this->end.of[lane] = inside.end;
        this->way.of[lane] = ray.layer.thickness * ray.length;
        this->passed.of[lane] = light.passed;
        this->unattenuated.of[lane] = light.unattenuated;
        this->keptUnattenuated.of[lane] = light.keptUnattenuated;
        this->opticalDepth.of[lane] = light.opticalDepth;
      });
  }

  LIMPID_INLINE Range<float> Inside(int lane) const
  {
    return { this->begin.of[lane], this->end.of[lane] };
  }

  LIMPID_INLINE LayerLight At(int lane) const
  {
    return { this->passed.of[lane], 0.0f, this->unattenuated.of[lane], 0.0f,
      this->keptUnattenuated.of[lane], this->opticalDepth.of[lane] };
  }
};

/// In which order the parts of a layer are visited.
enum class PartOrder
{
  FrontToBack,
  BackToFront
};

/// The parts of the layer for every ray: [part][lane].
template <class Cuts, PartOrder order>
struct PartsInLanes
{
  static constexpr int most = Cuts::atFaces ? 3 * mostPartsOfLayer : mostPartsOfLayer;

  InMemory<float> begin[most];
  InMemory<float> size[most];
  InMemory<float> length[most]; ///< of a segment [length]
  InMemory<int> counts;
  int count = 0; ///< the largest

  /// `densest`: of each ray, see ResolvedRay [1/length].
  LIMPID_INLINE PartsInLanes(const RowBetweenSlices& layer, const HalvesInLanes& halves,
    const RaysInLanes& lanes, const float* densest)
  {
    constexpr Range<float> none{ 1.0f, 1.0f };
    for (int lane = 0; lane < laneCount; ++lane)
    {
      this->counts.of[lane] = 0;
    }
    for (int lane = 0; lane < lanes.count; ++lane)
    {
      const float way = halves.way.of[lane];
      const Stretches stretches(halves.Inside(lane),
        Cuts::atFaces ? layer.frustum.FacesCrossed(layer.rays.layer, lanes.column[lane], layer.row)
                      : none);
      for (int number = 0; number < stretches.count; ++number)
      {
        this->Add(lane,
          Parts::Of<Cuts>(stretches.At(InOrder(number, stretches.count)), densest[lane], way), way);
      }
      const int counted = this->counts.of[lane];
      this->count = counted > this->count ? counted : this->count;
    }
  }

  /// Returns part `number`, without samples; all 0 for rays that do not have it.
  LIMPID_INLINE PartOfLayer<FloatLanes> At(int number) const
  {
    const IntLanes there = this->Has(number);
    PartOfLayer<FloatLanes> part;
    part.begin = Select(there, FloatLanes::Load(this->begin[number].of), 0.0f);
    part.size = Select(there, FloatLanes::Load(this->size[number].of), 0.0f);
    part.length = Select(there, FloatLanes::Load(this->length[number].of), 0.0f);
    return part;
  }

  LIMPID_INLINE IntLanes Has(int number) const { return IntLanes::Load(this->counts.of) > number; }

private:
  static LIMPID_INLINE int InOrder(int number, int count)
  {
    return order == PartOrder::FrontToBack ? number : count - 1 - number;
  }

  LIMPID_INLINE void Add(int lane, const Parts& parts, float way)
  {
    const float piece = way * parts.size * (1.0f / piecesOfPart);
    for (int part = 0; part < parts.count; ++part)
    {
      const int number = this->counts.of[lane]++;
      this->begin[number].of[lane] = parts.BeginOf(InOrder(part, parts.count));
      this->size[number].of[lane] = parts.size;
      this->length[number].of[lane] = piece;
    }
  }
};
}

#endif
