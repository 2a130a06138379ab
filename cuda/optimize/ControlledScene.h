// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ControlledScene_h
#define limpid_optimize_ControlledScene_h

#include "optimize/CarriedChange.h"
#include "optimize/ControlGrid.h"
#include "optimize/SceneFields.h"
#include "scene/Structures.h"

#include <memory>
#include <vector>

namespace limpid
{
class CoarseScene;
class PreparedScene;
class Solver;

/// A scene whose change is found on a control grid and applied to the data. All of it is
/// collective.
class ControlledScene
{
public:
  /// The caller owns the fields. Throws limpid::Error if they are invalid and the grid is coarser.
  ControlledScene(
    const SceneFields& data, const ControlGrid& control, ImportanceSmoothing smoothing);
  ~ControlledScene();

  const ControlGrid& Control() const { return this->Chosen; }
  const SceneFields& Data() const { return this->OfData; }
  bool IsCoarser() const { return this->Coarse != nullptr; }

  /// Whether results of a coarser grid are to be measured on the data, for which there is room.
  bool MeasuresData() const { return this->IsCoarser() && this->Chosen.fitsData; }

  /// The scene to solve: on the control grid, which may be that of the data.
  SceneFields Fields() const;

  /// Sets the initial extinction of a solver of Fields(). `extinction`: at the nodes of the data
  /// [1/length].
  void Start(Solver& solver, const float* extinction) const;

  /// Replaces the data by those with another importance. Has no effect on Fields().
  void PrepareData(const SceneFields& data);

  /// Returns the rows of structures at the nodes of Fields(). `rows`: at those of the data.
  std::vector<StructureRow> Rows(const StructureRow* rows) const;

  /// Returns a solver for the data, in which nothing is left to do: its extinction has the change
  /// that another one found on the control grid. If that shows less of the important structures
  /// than the base extinction does, it has none (Solver). Requires IsCoarser().
  std::unique_ptr<Solver> OnData(const Solver& found) const;

  /// Returns the extinctions of the data with this change, within their bounds. It takes less
  /// memory than OnData, and nothing is measured. Requires IsCoarser().
  CarriedExtinction ExtinctionOnData(const Solver& found) const;

private:
  ControlGrid Chosen;
  SceneFields OfData;
  std::shared_ptr<PreparedScene> Prepared; ///< of the data; null: there is no other grid
  std::unique_ptr<CoarseScene> Coarse;     ///< on the control grid; null: it is that of the data
};
}

#endif
