// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ControlledScene_h
#define limpid_optimize_ControlledScene_h

#include "optimize/CarriedChange.h"
#include "optimize/CoarseFields.h"
#include "optimize/ControlGrid.h"
#include "optimize/FineSweep.h"
#include "optimize/SceneFields.h"
#include "scene/Structures.h"

#include <memory>
#include <optional>
#include <vector>

namespace limpid
{
class CoarseScene;
class PreparedScene;

/// A scene whose change is found on a control grid and applied to the data. All of it is
/// collective.
class ControlledScene
{
public:
  /// The caller owns the fields. Throws limpid::Error if they are invalid and the grid is coarser.
  ControlledScene(
    const SceneFields& data, const ControlGrid& control, ImportanceSmoothing smoothing);

  /// A scene whose fields are made a few layers at a time, since they do not fit into memory as a
  /// whole. Of `data`, only the grid and the majorant are read. A process alone only; the control
  /// grid is coarser. Throws limpid::Error if the fields are invalid.
  ControlledScene(const SceneFields& data, const FieldsOfBox& ofBox, const ControlGrid& control,
    ImportanceSmoothing smoothing);
  ControlledScene(ControlledScene&&) noexcept;
  ~ControlledScene();

  const ControlGrid& Control() const { return this->Chosen; }
  const SceneFields& Data() const { return this->OfData; }
  bool IsCoarser() const { return this->Coarse || this->Layered; }

  /// Whether the fields of the data are made a few layers at a time.
  bool IsInLayers() const { return this->Layered.has_value(); }

  /// Whether results of a coarser grid are to be measured on the data, for which there is room.
  bool MeasuresData() const { return this->Coarse && this->Chosen.measuresData; }

  /// The scene to solve: on the control grid, which may be that of the data.
  SceneFields Fields() const;

  // Not for fields that are made in layers, up to OnData:

  /// Sets the initial extinction of a solver of Fields(). `extinction`: at the nodes of the data
  /// [1/length].
  void Start(Solver& solver, const float* extinction) const;

  /// Replaces the data by those with another importance. Has no effect on Fields().
  void PrepareData(const SceneFields& data);

  /// Returns the rows of structures at the nodes of Fields(). `rows`: at those of the data.
  std::vector<StructureRow> Rows(const StructureRow* rows) const;

  /// Whether a result of a coarser grid is to be improved by a sweep of the data, see
  /// limpid::CanSweepData: not where the user has chosen the grid and it is measured on the data.
  bool SweepsData(const Settings& settings) const;

  /// Returns the progress of a solver of Fields(). `all`: that of solver and sweep.
  Progress OfSolver(const Progress& all, const Settings& settings) const;

  /// Returns a solver for the data, in which nothing is left to do: its extinction has the change
  /// that another one found on the control grid, improved by a sweep if SweepsData. If it shows
  /// less of the important structures than the base extinction does, it has none (Solver). Requires
  /// IsCoarser().
  std::unique_ptr<Solver> OnData(const Solver& found, const Progress& all) const;

  /// Writes the extinctions of the data with this change, within their bounds [1/length]. It takes
  /// less memory than OnData, and nothing is measured. `light`: out: of a separate extinction for
  /// the light; null if there is none. Requires IsCoarser().
  void FillExtinction(const Solver& found, float* extinction, float* light) const;

  /// Writes the extinctions of the data that a sweep at their own resolution makes of this change,
  /// and measures them there, see SweepAndMeasureData. It frees Fields() and takes the solver that
  /// has found the change. Requires SweepsData.
  ScoresOnData SweepData(std::unique_ptr<Solver>&& found, const Progress& all, float* extinction);

  /// Returns them in arrays of their own. Not for fields that are made in layers.
  CarriedExtinction ExtinctionOnData(const Solver& found) const;

private:
  FieldsOfBox Boxes() const;
  CarriedChange ChangeOf(const Solver& found) const;
  void FillLayers(const Solver& found, const std::vector<float>& ofBase, float* extinction) const;

  ControlGrid Chosen;
  SceneFields OfData;
  std::shared_ptr<PreparedScene> Prepared; ///< of the data; null: there is no other grid
  std::unique_ptr<CoarseScene> Coarse;     ///< on the control grid; null: there is none like that
  FieldsOfBox OfBox;                       ///< empty: the data are here
  std::optional<CoarseFields> Layered;     ///< on the control grid, made of layers
};
}

#endif
