// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/StructureLedger.h"

#include "backend/Backend.h"
#include "backend/Interruption.h"
#include "distributed/Neighbourhood.h"
#include "distributed/OccupancyOnRanks.h"
#include "energy/CeilingKernel.h"
#include "energy/SceneSurvey.h"
#include "energy/StructureSampler.h"
#include "math/ExactSum.h"
#include "sweep/BandDecomposition.h"
#include "sweep/PlanSweep.h"
#include "sweep/RayHere.h"

#include <algorithm>
#include <array>
#include <limits>
#include <mutex>
#include <utility>

namespace limpid
{
namespace
{
/// Sums over rays, per row of the structures.
struct LedgerSums
{
  std::vector<ExactSum> visible;
  std::vector<ExactSum> kept;   ///< without attenuation
  std::vector<ExactSum> hidden; ///< [row][row of what hides it]; empty: not counted
  std::vector<ExactSum> most;

  /// `tellsHiders`: whether `hidden` is counted.
  LedgerSums(std::size_t rows, bool tellsHiders)
    : visible(rows)
    , kept(rows)
    , hidden(tellsHiders ? rows * rows : 0)
    , most(rows)
  {
  }

  void SumOver(const Communicator& ranks)
  {
    for (std::vector<ExactSum>* sums : { &this->visible, &this->kept, &this->hidden, &this->most })
    {
      ranks.Sum(sums->data(), sums->size());
    }
  }
};

/// Returns boxes of nodes that the rays of each rank read, in empty parts of the scene, too.
std::vector<NodeBox> BoxesRead(const FaceFrustum& frustum, const BandDecomposition& bands)
{
  std::vector<NodeBox> boxes;
  for (int rank = 0; rank < bands.Ranks().Size(); ++rank)
  {
    Range<int> rows;
    for (int node = 0; node < bands.Depth(); ++node)
    {
      rows = Hull(rows, bands.VoxelsNeeded(rank, node));
    }
    boxes.push_back(BoxOf(frustum, { 0, frustum.nodesU }, Grown(rows, 1, frustum.nodesV),
      { 0, rows.Empty() ? 0 : bands.Depth() }));
  }
  return boxes;
}

/// The rays of a frustum that this rank has, and the fields that they read.
class LedgerRays
{
public:
  /// `given`: the nodes of this rank's box in `piece`, which has all nodes if it is alone.
  LedgerRays(const FaceFrustum& planned, const ScenePiece& piece, const LedgerFields& given)
    : Frustum(planned)
    , Bands(planned, *piece.ranks)
    , Boxes(piece.IsWhole() ? piece.boxes : BoxesRead(planned, this->Bands))
    , Extinction(FieldIn(piece, this->Boxes, given.extinction))
    , Base(given.base ? FieldIn(piece, this->Boxes, given.base) : FieldInBox(nullptr))
  {
    const NodeBox& box = this->Boxes[std::size_t(piece.ranks->Rank())];
    const FieldView view = FieldView::Part(const_cast<float*>(this->Extinction.Data()), box);
    this->Frustum.strideU = view.stride[std::size_t(planned.axisU)];
    this->Frustum.strideV = view.stride[std::size_t(planned.axisV)];
    this->Frustum.strideW = view.stride[std::size_t(planned.axisW)];
    const Int3 first = box.First();
    const Index toFirst = box.Empty() ? 0 : view.At(first.x, first.y, first.z);
    this->Given.extinction = this->Extinction.Data() - toFirst;
    this->Given.base = given.base ? this->Base.Data() - toFirst : nullptr;
    this->Given.rows = this->RowsFor(piece, given.rows) - toFirst;
    this->Given.bounded = given.bounded;
  }

  const FaceFrustum& Plan() const { return this->Frustum; }
  const LedgerFields& Fields() const { return this->Given; }
  Range<int> Here() const { return this->Bands.RaysHere(this->Frustum.lastSlice); }

private:
  /// Returns the rows of structures at the nodes that are read; numbers of 16 bits are exact as
  /// floats.
  const StructureRow* RowsFor(const ScenePiece& piece, const StructureRow* given)
  {
    if (piece.IsWhole())
    {
      return given;
    }
    NodeValues numbers(piece.nodes.Count());
    std::copy(given, given + piece.nodes.Count(), numbers.Data());
    const FieldInBox read = FieldIn(piece, this->Boxes, There(numbers.Data()));
    const Index count = this->Boxes[std::size_t(piece.ranks->Rank())].Count();
    this->Rows.resize(std::size_t(count));
    std::transform(read.Data(), read.Data() + count, this->Rows.begin(),
      [](float number) { return static_cast<StructureRow>(number); });
    return this->Rows.data();
  }

  FaceFrustum Frustum; ///< with strides of the fields here
  BandDecomposition Bands;
  std::vector<NodeBox> Boxes;
  FieldInBox Extinction;
  FieldInBox Base;
  std::vector<StructureRow> Rows; ///< empty where those given are read
  LedgerFields Given{};
};

/// The values of a structure in a layer of a ray.
struct OfLayer
{
  double unattenuated; ///< of all its extinction
  double visible;      ///< of the kept base extinction
  double kept;         ///< `visible` without attenuation
};

/// One ray after the other, with what it carries of each structure.
template <class Cuts>
class LedgerRay
{
public:
  /// `tellsHiders`: whether what hides structures is counted.
  LedgerRay(const LedgerFields& fields, const Structures& structures, bool tellsHiders)
    : Fields(fields)
    , Importance(structures.Count() + 1)
    , Only(this->Importance.size(), 0.0f)
    , Depth(this->Importance.size())
    , Visible(this->Importance.size())
    , Kept(this->Importance.size())
    , Hidden(tellsHiders ? this->Importance.size() * this->Importance.size() : 0)
    , IsMet(this->Importance.size())
  {
    for (std::size_t row = 0; row < this->Importance.size(); ++row)
    {
      this->Importance[row] =
        static_cast<float>(structures.ImportanceOf(static_cast<StructureRow>(row)));
    }
  }

  /// Carries light front to back through the layers of a ray, and adds it to `sums`.
  void See(const FaceFrustum& frustum, int column, int row, double weight, LedgerSums& sums,
    std::mutex& access)
  {
    detail::RayHere here;
    StructureSampler sampler(frustum, here.States(), column, row);
    const Range<int> layers = Intersection({ 0, frustum.lastSlice }, frustum.LayersOf(row));
    for (int s = layers.begin; s < layers.end; ++s)
    {
      if (sampler.EnterLayer(s, true))
      {
        this->Enter(sampler);
        this->Pass(sampler, here);
      }
    }
    const std::lock_guard<std::mutex> lock(access);
    for (const StructureRow met : this->Met)
    {
      sums.visible[met].Add(weight * this->Visible[met]);
      sums.kept[met].Add(weight * this->Kept[met]);
      for (std::size_t i = 0; !this->Hidden.empty() && i < this->Met.size(); ++i)
      {
        const StructureRow by = this->Met[i];
        double& hidden = this->HiddenBy(met, by);
        sums.hidden[met * this->Importance.size() + by].Add(weight * hidden);
        hidden = 0;
      }
    }
    this->Forget();
  }

  /// Finds back to front the most that a ray can show of each structure, and adds it to `sums`.
  void FindMost(const FaceFrustum& frustum, int column, int row, double weight, LedgerSums& sums,
    std::mutex& access)
  {
    detail::RayHere here;
    StructureSampler sampler(frustum, here.States(), column, row);
    const Range<int> layers = Intersection({ 0, frustum.lastSlice }, frustum.LayersOf(row));
    const MostExtinction<float> base{ 0, std::numeric_limits<float>::max() };
    for (int s = layers.end; s-- > layers.begin;)
    {
      if (sampler.EnterLayer(s, true))
      {
        this->Enter(sampler);
        // Nothing of a structure in the layer: the ray clears it.
        for (std::size_t i = 0; i < this->CountHere; ++i)
        {
          const StructureRow of = this->Here[i];
          if (of > 0)
          {
            detail::RayHere alone;
            *alone.States()[RayChannel::Behind] = static_cast<float>(this->Visible[of]);
            this->SampleOnly(of, sampler,
              [&]
              {
                sampler.ForEachResolved(ResolveImportant<Cuts>{ base },
                  CeilingStep<limpid::Kept::Ignored>{ alone.States(), base });
              });
            this->Visible[of] = *alone.States()[RayChannel::Behind];
          }
        }
      }
    }
    const std::lock_guard<std::mutex> lock(access);
    for (const StructureRow met : this->Met)
    {
      sums.most[met].Add(weight * this->Visible[met]);
    }
    this->Forget();
  }

private:
  double& HiddenBy(StructureRow row, StructureRow by)
  {
    return this->Hidden[row * this->Importance.size() + by];
  }

  /// Finds the structures in a layer.
  void Enter(StructureSampler& sampler)
  {
    this->CountHere = 0;
    sampler.ForRowsNear(this->Fields.rows,
      [this](StructureRow row)
      {
        const auto end = this->Here.begin() + static_cast<std::ptrdiff_t>(this->CountHere);
        if (std::find(this->Here.begin(), end, row) == end)
        {
          this->Here[this->CountHere] = row;
          ++this->CountHere;
          if (!this->IsMet[row])
          {
            this->IsMet[row] = true;
            this->Met.push_back(row);
          }
        }
      });
    sampler.SetOneRow(this->CountHere == 1);
  }

  void Forget()
  {
    for (const StructureRow met : this->Met)
    {
      this->IsMet[met] = false;
      this->Depth[met] = this->Visible[met] = this->Kept[met] = 0;
    }
    this->Met.clear();
  }

  /// Samples the layer with the importance of one structure only, and acts on it.
  template <class Act>
  void SampleOnly(StructureRow row, StructureSampler& sampler, const Act& act)
  {
    this->Only[row] = 1;
    sampler.SetShares(this->Only.data());
    sampler.Sample(this->Fields);
    act();
    this->Only[row] = 0;
  }

  /// Whether a score resolves the same layers for the structure as its own importance does, or its
  /// depth does not depend on that.
  bool IsSeenAlike(StructureRow row) const { return !Cuts::atFaces || this->Importance[row] > 0; }

  /// Returns what light finds of one structure. `depth`: at the front of the layer; becomes that at
  /// its back.
  OfLayer SeeOnly(StructureRow row, StructureSampler& sampler, double& depth)
  {
    detail::RayHere alone;
    alone.toSlice = depth;
    const RayStates states = alone.States();
    this->SampleOnly(row, sampler, [&] { this->Score(sampler, states); });
    depth = alone.toSlice;
    return { *states[RayChannel::Unattenuated], *states[RayChannel::KeptVisible],
      *states[RayChannel::KeptUnattenuated] };
  }

  void Score(const StructureSampler& sampler, const RayStates& states) const
  {
    sampler.ForEachResolved(
      ResolveLit<Cuts>{ states[RayDepth::ToSlice] }, ScoreStep<limpid::Kept::Counted>{ states });
  }

  /// Lets light pass through the layer.
  void Pass(StructureSampler& sampler, detail::RayHere& here)
  {
    const double before = here.toSlice;
    // The depth of a layer with one structure is that of the structure alone, unless it is resolved
    // because of the structure, but not in a score.
    const StructureRow first = this->Here[0];
    const bool isOne = this->CountHere == 1 && (first == 0 || this->IsSeenAlike(first));
    if (!isOne)
    {
      sampler.SetShares(this->Importance.data());
      sampler.Sample(this->Fields);
      this->Score(sampler, here.States());
    }
    std::array<OfLayer, mostNear> found;
    double all = 0;
    for (std::size_t i = 0; i < this->CountHere; ++i)
    {
      const StructureRow row = this->Here[i];
      if (isOne && row == 0)
      {
        sampler.SampleExtinction(this->Fields.extinction);
        sampler.ForEachInLayer(DeepenStep{ here.States() });
        found[i] = { 1, 0, 0 };
      }
      else
      {
        double after = before;
        found[i] = this->SeeOnly(row, sampler, after);
        here.toSlice = isOne ? after : here.toSlice;
      }
      all += found[i].unattenuated;
    }
    const double perShare = all > 0 ? 0.5 * (here.toSlice - before) / all : 0.0;
    const auto deepen = [&] // to the middle of the layer, and to its end
    {
      for (std::size_t i = 0; i < this->CountHere; ++i)
      {
        this->Depth[this->Here[i]] += perShare * found[i].unattenuated;
      }
    };
    deepen();
    for (std::size_t i = 0; i < this->CountHere; ++i)
    {
      const StructureRow row = this->Here[i];
      if (row > 0)
      {
        this->Visible[row] += found[i].visible;
        this->Kept[row] += found[i].kept;
        this->Hide(row, found[i].kept - found[i].visible);
      }
    }
    deepen();
  }

  /// Divides what is hidden of a structure among those in front, to the middle of the layer.
  void Hide(StructureRow row, double hidden)
  {
    if (this->Hidden.empty())
    {
      return;
    }
    double depth = 0;
    for (const StructureRow by : this->Met)
    {
      depth += std::max(this->Depth[by], 0.0);
    }
    for (const StructureRow by : this->Met)
    {
      const double share = depth > 0 ? std::max(this->Depth[by], 0.0) / depth : by == row ? 1 : 0;
      this->HiddenBy(row, by) += share * hidden;
    }
  }

  static constexpr std::size_t mostNear = 32; ///< nodes that the samples of a layer may read

  const LedgerFields& Fields;
  std::vector<float> Importance; ///< per row
  std::vector<float> Only;       ///< 1 for one row
  std::vector<double> Depth;     ///< optical depth from the entry on
  std::vector<double> Visible;   ///< of the kept base extinction; back to front: the most
  std::vector<double> Kept;
  std::vector<double> Hidden; ///< [row][row of what hides it]; empty: not counted
  std::vector<char> IsMet;
  std::vector<StructureRow> Met; ///< by the ray
  std::array<StructureRow, mostNear> Here{};
  std::size_t CountHere = 0;
};
}

struct StructureLedger::Internals
{
  limpid::Grid grid;
  std::shared_ptr<const ScenePiece> piece;
  const Structures* structures;
  const StructureRow* rows;
  const float* base;
  std::shared_ptr<const Occupancy> occupancy; ///< of what absorbs and is part of a structure

  Occupancy FindOccupancy() const
  {
    NodeValues isPart(this->piece->nodes.Count());
    std::transform(this->rows, this->rows + this->piece->nodes.Count(), isPart.Data(),
      [](StructureRow row) { return row > 0 ? 1.0f : 0.0f; });
    const Neighbourhood around(*this->piece, this->grid);
    const FieldInBox extinctions = around.Extended(this->base);
    const FieldInBox parts = around.Extended(There(isPart.Data()));
    NodeValues nodes;
    if (!around.Empty())
    {
      nodes = around.Inside(SurveyScene(
        around.Around(), extinctions.Data(), std::numeric_limits<float>::max(), parts.Data(), 1)
                              .nodeImportance);
    }
    const auto view = [this](const float* field)
    { return FieldView::Part(const_cast<float*>(field), this->piece->nodes); };
    return OccupancyOnRanks(*this->piece->ranks, this->grid, this->piece->Owned(), view(this->base),
      view(nodes.Data()), /*skip=*/true);
  }

  std::size_t RowCount() const { return this->structures->Count() + 1; }

  /// Sums what act(ray, frustum, column, row, weight, sums, access) adds for all rays that count,
  /// in parallel.
  template <class Cuts, class Act>
  LedgerSums SumOverRays(const std::vector<PlannedFrustum>& frusta, const LedgerFields& fields,
    bool tellsHiders, const Act& act) const
  {
    LedgerSums sums(this->RowCount(), tellsHiders);
    std::mutex access;
    for (const PlannedFrustum& planned : frusta)
    {
      const LedgerRays rays(planned, *this->piece, fields);
      const FaceFrustum& frustum = rays.Plan();
      const float* inView = frustum.seesAll ? nullptr : frustum.Row(frustum.inView);
      const Range<int> here = rays.Here();
      constexpr int rowsPerTask = 8;
      ParallelFor((here.Length() + rowsPerTask - 1) / rowsPerTask, 1,
        [&](Index task)
        {
          LedgerRay<Cuts> ray(rays.Fields(), *this->structures, tellsHiders);
          const int begin = here.begin + static_cast<int>(task) * rowsPerTask;
          for (int row = begin; row < std::min(begin + rowsPerTask, here.end); ++row)
          {
            Interruptible::Check();
            for (int column = 0; column < frustum.columns; ++column)
            {
              const Index number = Index(row) * frustum.columns + column;
              const double share = frustum.cellMeasure *
                double(frustum.Row(frustum.columnShare)[column]) *
                double(frustum.Row(frustum.rowShare)[row]);
              if (share > 0 && (!inView || inView[number] > 0))
              {
                act(ray, frustum, column, row, share / double(frustum.Row(frustum.length)[number]),
                  sums, access);
              }
            }
          }
        });
    }
    sums.SumOver(*this->piece->ranks);
    return sums;
  }

  template <class Cuts>
  LedgerSums See(
    const std::vector<PlannedFrustum>& frusta, const float* extinction, bool tellsHiders) const
  {
    // A rank without nodes cannot tell whether this is the base extinction.
    const bool isBase = !this->piece->ranks->AnyOf(extinction != this->base);
    const LedgerFields fields{ extinction, isBase ? nullptr : this->base, this->rows };
    return this->SumOverRays<Cuts>(
      frusta, fields, tellsHiders, [](LedgerRay<Cuts>& ray, auto&&... rest) { ray.See(rest...); });
  }

  template <class Cuts>
  LedgerSums FindMost(const std::vector<PlannedFrustum>& frusta, const float* least) const
  {
    return this->SumOverRays<Cuts>(frusta, { this->base, least, this->rows, true }, false,
      [](LedgerRay<Cuts>& ray, auto&&... rest) { ray.FindMost(rest...); });
  }

  template <class Cuts>
  std::vector<StructureShares> Shares(
    const std::vector<PlannedFrustum>& frusta, const float* extinction, const float* least) const
  {
    const LedgerSums data = this->See<Cuts>(frusta, this->base, false);
    const LedgerSums seen =
      this->See<Cuts>(frusta, extinction, this->structures->Count() <= mostHiders);
    const LedgerSums most = this->FindMost<Cuts>(frusta, least);
    std::vector<StructureShares> result(this->structures->Count());
    for (std::size_t row = 1; row < this->RowCount(); ++row)
    {
      StructureShares& shares = result[row - 1];
      shares.important = data.kept[row].Value();
      const auto shareOf = [&shares](const ExactSum& sum)
      { return shares.important > 0 ? std::clamp(sum.Value() / shares.important, 0.0, 1.0) : 0.0; };
      shares.visible = shareOf(seen.visible[row]);
      shares.baseVisible = shareOf(data.visible[row]);
      shares.removed = shares.important > 0 ? 1 - shareOf(seen.kept[row]) : 0;
      shares.attainable = shareOf(most.most[row]);
      for (std::size_t by = 0; !seen.hidden.empty() && by < this->RowCount(); ++by)
      {
        shares.hiddenBy.push_back(shareOf(seen.hidden[row * this->RowCount() + by]));
      }
    }
    return result;
  }
};

StructureLedger::StructureLedger(const limpid::Grid& grid, std::shared_ptr<const ScenePiece> piece,
  const Structures& structures, const StructureRow* rows, const float* base)
  : State(std::make_unique<Internals>(
      Internals{ grid, std::move(piece), &structures, rows, There(base), nullptr }))
{
  this->State->occupancy = std::make_shared<const Occupancy>(this->State->FindOccupancy());
}

StructureLedger::~StructureLedger() = default;

std::vector<StructureShares> StructureLedger::SharesFrom(const RaySource& camera,
  const Sampling& sampling, const float* extinction, const float* least) const
{
  const std::vector<PlannedFrustum> frusta = PlanSweep(this->State->grid, *this->State->occupancy,
    camera, { sampling.rayDensity, RayPlacement::ForIntegrals, Readers::Rays });
  return sampling.fine ? this->State->Shares<FineCuts>(frusta, extinction, least)
                       : this->State->Shares<UsualCuts>(frusta, extinction, least);
}
}
