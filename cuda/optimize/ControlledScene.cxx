// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/ControlledScene.h"

#include "backend/Backend.h"
#include "math/Require.h"
#include "optimize/CoarseScene.h"
#include "optimize/ExtinctionBounds.h"
#include "optimize/SceneStructures.h"
#include "optimize/Solver.h"
#include "scene/FieldView.h"
#include "scene/Resampling.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// Share of the time of a solver where a sweep of the data follows, of large dense data.
constexpr double shareOfSolver = 0.4;
}

ControlledScene::ControlledScene(
  const SceneFields& data, const ControlGrid& control, ImportanceSmoothing smoothing)
  : Chosen(control)
  , OfData(data)
{
  const Grid grid = CoarseGrid(data.grid, control.factor);
  if (grid.nodes == data.grid.nodes)
  {
    return;
  }
  this->Prepared = PreparedScene::Make(data);
  this->Coarse = std::make_unique<CoarseScene>(this->Prepared, smoothing, grid,
    data.piece ? PieceOn(*data.piece, data.grid, grid) : ScenePiece::Whole(grid));
  this->Prepared->FreeNodeImportance();
}

ControlledScene::ControlledScene(const SceneFields& data, const FieldsOfBox& ofBox,
  const ControlGrid& control, ImportanceSmoothing smoothing)
  : Chosen(control)
  , OfData(data)
  , OfBox(ofBox)
  , Layered(MakeCoarseFields(data.grid, CoarseGrid(data.grid, control.factor), smoothing,
      this->OfBox, NodesAtATime(data.grid)))
{
  const float largest = this->Layered->largestExtinction;
  LIMPID_REQUIRE(largest <= mostExtinction,
    "The base extinction of a voxel is " << largest
                                         << " (the energy of Eq. (21) is not defined for it). Keep "
                                            "it finite and not negative.");
}

ControlledScene::ControlledScene(ControlledScene&&) noexcept = default;
ControlledScene::~ControlledScene() = default;

void ControlledScene::PrepareData(const SceneFields& data)
{
  this->OfData = data;
  if (this->IsCoarser())
  {
    this->Prepared = PreparedScene::Make(this->OfData);
    this->Prepared->FreeNodeImportance();
  }
}

SceneFields ControlledScene::Fields() const
{
  if (this->Layered)
  {
    SceneFields fields = this->Layered->Scene();
    fields.majorant = std::max(this->OfData.majorant, this->Layered->largestExtinction);
    return fields;
  }
  return this->Coarse ? this->Coarse->Prepared()->Arrays() : this->OfData;
}

void ControlledScene::Start(Solver& solver, const float* extinction) const
{
  if (!this->IsCoarser())
  {
    solver.SetInitialExtinction(extinction);
    return;
  }
  const std::vector<float> start = this->Coarse->Resampled(*this->Prepared, extinction);
  solver.SetInitialExtinction(start.data());
}

std::vector<StructureRow> ControlledScene::Rows(const StructureRow* rows) const
{
  if (!this->IsCoarser())
  {
    return { rows, rows + this->OfData.ValueCount() };
  }
  const SceneFields there = this->Fields();
  return RowsOn(this->Prepared->Piece(), this->OfData.grid, rows, *there.piece, there.grid);
}

CarriedExtinction ControlledScene::ExtinctionOnData(const Solver& found) const
{
  CarriedExtinction applied =
    *AppliedTo(this->Prepared->Arrays(), this->Prepared->Majorant(), found.Change());
  const Problem problem =
    this->Prepared->ProblemForEnergy(found.MainCamera(), found.OnlyLight(), found.Options());
  problem.TakeIntoBounds(applied.extinction);
  if (applied.hasLight)
  {
    problem.TakeIntoBounds(applied.light);
  }
  return applied;
}

void ControlledScene::FillExtinction(const Solver& found, float* extinction, float* light) const
{
  if (this->Layered)
  {
    const CarriedChange change = found.Change();
    this->FillLayers(found, change.ofExtinction, extinction);
    if (light)
    {
      this->FillLayers(found, change.ofLight, light);
    }
    return;
  }
  const CarriedExtinction applied = this->ExtinctionOnData(found);
  std::copy(applied.extinction.begin(), applied.extinction.end(), extinction);
  if (light)
  {
    std::copy(applied.light.begin(), applied.light.end(), light);
  }
}

bool ControlledScene::SweepsData(const Settings& settings) const
{
  const bool isWhole = !this->OfData.piece || this->OfData.piece->IsWhole();
  const bool isWanted = this->Chosen.forced || !this->MeasuresData();
  return this->IsCoarser() && isWhole && isWanted && CanSweepData(settings);
}

Progress ControlledScene::OfSolver(const Progress& all, const Settings& settings) const
{
  return this->SweepsData(settings) ? PartOf(all, 0, shareOfSolver) : all;
}

/// Returns what makes the fields of a box of the data.
FieldsOfBox ControlledScene::Boxes() const
{
  if (this->Layered)
  {
    return this->OfBox;
  }
  return [data = this->OfData](const NodeBox& box, float* baseExtinction, float* importance)
  {
    const auto copy = [&](const float* from, float* to)
    {
      CopyNodes(
        box, FieldView::Whole(const_cast<float*>(from), data.grid.nodes), FieldView::Part(to, box));
    };
    copy(data.baseExtinction, baseExtinction);
    copy(data.importance, importance);
  };
}

/// Returns the change for SweepData.
CarriedChange ControlledScene::ChangeOf(const Solver& found) const
{
  CarriedChange change = found.Change();
  if (this->OfData.despeckled == this->OfData.importance && this->OfData.despeckled)
  {
    change.settings.importanceSmoothing = ImportanceSmoothing::Off; // labels have no noise
  }
  return change;
}

ScoresOnData ControlledScene::SweepData(
  std::unique_ptr<Solver>&& found, const Progress& all, float* extinction)
{
  const CarriedChange change = this->ChangeOf(*found);
  const auto majorant = static_cast<float>(found->Majorant());
  found.reset();
  this->Layered = this->Layered ? std::optional<CoarseFields>(CoarseFields()) : std::nullopt;
  this->Coarse = nullptr;
  this->Prepared = nullptr;
  return SweepAndMeasureData(
    this->OfData.grid, this->Boxes(), change, majorant, PartOf(all, shareOfSolver, 1), extinction);
}

/// Writes one of the extinctions, a few layers at a time. `ofBase`: see CarriedChange.
void ControlledScene::FillLayers(
  const Solver& found, const std::vector<float>& ofBase, float* extinction) const
{
  const Settings& settings = found.Options();
  const Grid& grid = this->OfData.grid;
  const bool despeckles =
    settings.protectImportance > 0 && settings.importanceSmoothing == ImportanceSmoothing::Median;
  SceneLayers fields(grid, despeckles, this->OfBox);
  const GridFilter filter(this->Layered->grid.nodes, grid.nodes);
  const auto majorant = static_cast<float>(found.Majorant());
  const ChangedNode changed{ majorant };
  const ExtinctionBounds<float> bounds = BoundsOf(settings, majorant);
  const int atATime = static_cast<int>(std::max<Index>(NodesAtATime(grid) / fields.PerLayer(), 1));
  const Index perCoarseLayer = Index(this->Layered->grid.nodes.x) * this->Layered->grid.nodes.y;
  for (int begin = 0; begin < grid.nodes.z; begin += atATime)
  {
    NodeBox box = NodeBox::Of(grid.nodes);
    const Range<int> layers{ begin, std::min(begin + atATime, grid.nodes.z) };
    box.along[2] = layers;
    fields.MoveTo(layers);
    const float* base = fields.BaseExtinction();
    const float* important = despeckles ? fields.Despeckled() : fields.Importance();
    const std::vector<float> change = ResampledBox(
      filter, ofBase.data() + perCoarseLayer * filter.SourcesOf(box).along[2].begin, box);
    float* out = extinction + fields.PerLayer() * begin;
    ParallelFor(box.Count(), 65536,
      [&](Index node)
      {
        const float value =
          changed(change[std::size_t(node)], base[node], fields.Importance()[node]);
        out[node] = bounds.Within(value, important[node], base[node]);
      });
  }
}

std::unique_ptr<Solver> ControlledScene::OnData(const Solver& found, const Progress& all) const
{
  CarriedExtinction onData;
  if (this->SweepsData(found.Options()))
  {
    onData.extinction.resize(static_cast<std::size_t>(this->OfData.grid.NodeCount()));
    limpid::SweepData(this->OfData.grid, this->Boxes(), this->ChangeOf(found),
      static_cast<float>(found.Majorant()), PartOf(all, shareOfSolver, 1),
      onData.extinction.data());
  }
  else
  {
    onData = this->ExtinctionOnData(found);
  }
  auto solver = std::make_unique<Solver>(
    this->Prepared, found.MainCamera(), found.OnlyLight(), found.Options(), std::move(onData));
  solver->Run();
  return solver;
}
}
