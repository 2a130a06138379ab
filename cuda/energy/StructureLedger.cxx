// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/StructureLedger.h"

#include "distributed/Neighbourhood.h"
#include "distributed/OccupancyOnRanks.h"
#include "energy/MostSeenRow.h"
#include "energy/SceneSurvey.h"
#include "energy/SeenRow.h"
#include "energy/TransmittanceOnRanks.h"
#include "sweep/Sweeps.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace limpid
{
struct StructureLedger::Internals
{
  limpid::Grid grid;
  std::shared_ptr<const ScenePiece> piece;
  const float* base;
  std::vector<float> importance; ///< [row]
  NodeValues rows;               ///< number of the row of the structure of each node
  float majorant = 0;            ///< of the base extinction [1/length]
  double mostImportant = 0;      ///< upper bound of the integral of the base extinction [length^2]
  std::shared_ptr<const Occupancy> occupancy = {}; ///< of what absorbs and is part of a structure

  Internals(const limpid::Grid& nodes, std::shared_ptr<const ScenePiece> given,
    const Structures& structures, const StructureRow* rowOf, const float* baseExtinction)
    : grid(nodes)
    , piece(std::move(given))
    , base(There(baseExtinction))
    , rows(this->piece->nodes.Count())
  {
    for (std::size_t row = 0; row <= structures.Count(); ++row)
    {
      this->importance.push_back(
        static_cast<float>(structures.ImportanceOf(static_cast<StructureRow>(row))));
    }
    const Index count = this->piece->nodes.Count();
    ParallelFor(count, 65536, [&](Index node) { this->rows.Data()[node] = NumberOf(rowOf[node]); });
    const float most = count > 0 ? *std::max_element(this->base, this->base + count) : 0.0f;
    this->majorant = this->piece->ranks->LargestOf(most);
    this->mostImportant = this->majorant * this->grid.CellVolume() * double(this->grid.NodeCount());
    this->occupancy = std::make_shared<const Occupancy>(this->FindOccupancy());
  }

  Occupancy FindOccupancy() const
  {
    const Neighbourhood around(*this->piece, this->grid);
    const FieldInBox extinctions = around.Extended(this->base);
    const FieldInBox parts = around.Extended(There(this->rows.Data()));
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

  std::size_t RowCount() const { return this->importance.size(); }

  /// Calls act(row of rays) for rows, in parallel.
  template <class Row, class Act>
  static void ForRowsOfRays(FrustumRays<HostDevice>& rays, const Range<int>& rows,
    const LedgerSweep& sweep, SumsOfThreads& sums, const Act& act)
  {
    const RayStates states = rays.States();
    ForRows(rows, rowsPerTask / 2,
      [&](int row)
      {
        sums.With(
          [&](SumsByStructure& here)
          {
            Row ofRow(rays.Plan(), states, row, sweep, here);
            act(ofRow);
          });
      });
  }

  /// Sweeps the rays of a frustum. `Row`: SeenRow or MostSeenRow; `fields`: of this rank's nodes.
  template <class Row, bool backward>
  void Sweep(FrustumRays<HostDevice>& rays, const LedgerFields<const float*>& fields,
    SumsOfThreads& sums) const
  {
    const FaceFrustum& frustum = rays.Plan();
    ForRaysReached(rays,
      [](const RayStates& ray)
      {
        ForValues(StartInFront{ ray }, RayDepth::ToSlice, RayChannel::Behind,
          RayChannel::KeptVisible, RayChannel::KeptUnattenuated);
      });
    LedgerRays remembered(frustum);
    FieldWindows windows(rays, nullptr); // there are structures where there is no extinction
    const auto open = [&](const float* field) { return windows(field, FieldUse{ 1 }); };
    const LedgerSweep sweep{ { open(fields.extinction), open(fields.bound), open(fields.rows) },
      this->importance, this->majorant, remembered };
    std::vector<Range<int>> slabs = windows.Slabs();
    if (backward)
    {
      std::reverse(slabs.begin(), slabs.end());
    }
    for (const Range<int>& slab : slabs)
    {
      windows.Load(slab);
      ForRowsOfRays<Row>(rays, RowsNear(rays, slab), sweep, sums,
        [&](Row& row)
        {
          const Range<int> layers = LayersIn(frustum, slab, row.FirstRow());
          for (int layer = 0; layer < layers.Length(); ++layer)
          {
            row.Cross(backward ? layers.end - 1 - layer : layers.begin + layer);
          }
        });
    }
    ForRowsOfRays<Row>(rays, rays.RaysAtRest(), sweep, sums, [](Row& row) { row.Finish(); });
  }

  template <class Cuts>
  LedgerSums See(
    std::vector<FrustumRays<HostDevice>>& frusta, const float* extinction, bool tellsHiders) const
  {
    // A rank without nodes cannot tell whether this is the base extinction.
    const bool isBase = !this->piece->ranks->AnyOf(extinction != this->base);
    const LedgerFields<const float*> fields{ extinction, isBase ? nullptr : this->base,
      There(this->rows.Data()) };
    return this->SumOver<SeenRow<Cuts>, false>(frusta, fields, tellsHiders);
  }

  template <class Cuts>
  LedgerSums FindMost(std::vector<FrustumRays<HostDevice>>& frusta, const float* least) const
  {
    return this->SumOver<MostSeenRow<Cuts>, true>(
      frusta, { this->base, least, There(this->rows.Data()) }, false);
  }

  /// Sums over frusta, threads and ranks.
  template <class Row, bool backward>
  LedgerSums SumOver(std::vector<FrustumRays<HostDevice>>& frusta,
    const LedgerFields<const float*>& fields, bool tellsHiders) const
  {
    SumsOfThreads sums(SumsByStructure(this->RowCount(), tellsHiders, this->mostImportant));
    for (FrustumRays<HostDevice>& rays : frusta)
    {
      this->Sweep<Row, backward>(rays, fields, sums);
    }
    LedgerSums all(this->RowCount(), tellsHiders);
    sums.AddTo(all);
    for (std::vector<ExactSum>* some : { &all.visible, &all.kept, &all.hidden, &all.most })
    {
      this->piece->ranks->Sum(some->data(), some->size());
    }
    return all;
  }

  template <class Cuts>
  std::vector<StructureShares> Shares(
    std::vector<FrustumRays<HostDevice>>& frusta, const float* extinction, const float* least) const
  {
    const LedgerSums data = this->See<Cuts>(frusta, this->base, false);
    const LedgerSums seen = this->See<Cuts>(frusta, extinction, this->RowCount() <= mostHiders + 1);
    const LedgerSums most = this->FindMost<Cuts>(frusta, least);
    std::vector<StructureShares> result(this->RowCount() - 1);
    for (std::size_t row = 1; row < this->RowCount(); ++row)
    {
      StructureShares& shares = result[row - 1];
      shares.important = data.kept[row].Value();
      const auto shareOf = [&shares](const ExactSum& sum)
      { return shares.important > 0 ? std::clamp(sum.Value() / shares.important, 0.0, 1.0) : 0.0; };
      shares.visible = shareOf(seen.visible[row]);
      shares.baseVisible = shareOf(data.visible[row]);
      shares.removed = shares.important > 0 ? 1 - shareOf(seen.kept[row]) : 0;
      // Its quadrature may stay below what is seen by a little.
      shares.attainable = std::max({ shareOf(most.most[row]), shares.visible, shares.baseVisible });
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
  : State(std::make_unique<Internals>(grid, std::move(piece), structures, rows, base))
{
}

StructureLedger::~StructureLedger() = default;

std::vector<StructureShares> StructureLedger::SharesFrom(const RaySource& camera,
  const Sampling& sampling, const float* extinction, const float* least) const
{
  std::vector<FrustumRays<HostDevice>> frusta =
    PlanRays(HostDevice::Shared(), this->State->grid, *this->State->occupancy, camera,
      { sampling.rayDensity, RayPlacement::ForIntegrals, Readers::Rays });
  if (!this->State->piece->IsWhole())
  {
    SweepSubdomains(frusta, *this->State->piece, nullptr);
  }
  return sampling.fine ? this->State->Shares<FineCuts>(frusta, extinction, least)
                       : this->State->Shares<UsualCuts>(frusta, extinction, least);
}
}
