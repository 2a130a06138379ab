// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/ControlledScene.h"

#include "optimize/CoarseScene.h"
#include "optimize/SceneStructures.h"
#include "optimize/Solver.h"
#include "scene/Resampling.h"

namespace limpid
{
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
  return this->IsCoarser() ? this->Coarse->Prepared()->Arrays() : this->OfData;
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

std::unique_ptr<Solver> ControlledScene::OnData(const Solver& found) const
{
  auto solver = std::make_unique<Solver>(this->Prepared, found.MainCamera(), found.OnlyLight(),
    found.Options(), this->ExtinctionOnData(found));
  solver->Run();
  return solver;
}
}
