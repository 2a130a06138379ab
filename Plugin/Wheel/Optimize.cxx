// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Arrays.h"
#include "Bindings.h"
#include "Computing.h"

#include "optimize/ControlledScene.h"
#include "optimize/SceneStructures.h"
#include "optimize/Solver.h"
#include "scene/ViewSet.h"
#include "viewpoint/Concurrent.h"
#include "viewpoint/MeetTargets.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace nb = nanobind;
using namespace nb::literals;

namespace limpid::python
{
namespace
{
// Memory of an optimisation beside its input: that of the filter without both fields, see
// Filters/vtkExtinctionOptimizerInternals.cxx.
constexpr NeedPerNode need{ 13, 26, 2 };

// The input and the settings of an optimisation.
struct Run
{
  Run(const Grid& grid, const Field& extinction, const Field& importance, float majorant)
    : scene{ grid, extinction.data(), importance.data(), majorant }
  {
  }

  SceneFields scene;
  std::optional<ControlledScene> controlled; ///< the scene and the grid of its change
  std::vector<float> changing;               ///< importance of the scene where targets change it
  Camera camera;
  Light light;
  Settings settings;
  ViewSet views;
  std::optional<Guide> guide;        ///< if set, the camera is optimised as well
  const float* initial = nullptr;    ///< start of the optimisation; null: the base extinction
  CarriedChange* previous = nullptr; ///< reference to stay near; null: none
  Progress progress;

  /// Chooses the grid of the change.
  void Control()
  {
    const ControlGrid grid = InfoOf(this->settings.method).iterates
      ? ChooseControlGrid(
          this->settings, this->scene.grid, *ScenePiece::Whole(this->scene.grid), need)
      : ControlGrid();
    this->controlled.emplace(this->scene, grid, this->settings.importanceSmoothing);
  }

  ConcurrentResult Solve(const SceneFields& fields) const
  {
    if (this->guide)
    {
      return OptimizeConcurrently(
        fields, this->camera, this->light, this->settings, *this->guide, this->OfSolver());
    }
    const std::vector<Camera> cameras = CamerasOf(this->views, this->camera, OrbitStart::AtCamera);
    ConcurrentResult result;
    result.camera = this->camera;
    result.solver = std::make_unique<Solver>(fields, cameras.front(), this->light,
      ForCameras(this->settings, cameras), this->previous ? *this->previous : CarriedChange());
    if (this->initial)
    {
      this->controlled->Start(*result.solver, this->initial);
    }
    result.solver->Run(this->OfSolver());
    return result;
  }

  Progress OfSolver() const { return this->controlled->OfSolver(this->progress, this->settings); }

  /// Solves the scene, again if structures have targets.
  TargetsFound SolveFor(
    const Structures& structures, const StructureRow* rows, ConcurrentResult& found)
  {
    SceneFields fields = this->controlled->Fields();
    const std::vector<StructureRow> there = this->controlled->Rows(rows);
    this->changing.assign(fields.importance, fields.importance + fields.ValueCount());
    fields.importance = this->changing.data();
    found = this->Solve(fields);
    TargetsFound seen = MeetTargets({ fields, this->changing.data(), structures, there.data() },
      this->previous ? *this->previous : CarriedChange(), this->OfSolver(), found.solver);
    if (this->controlled->IsCoarser())
    {
      this->changing.resize(std::size_t(this->scene.ValueCount()));
      FillImportance(seen.structures, rows, this->scene.ValueCount(), this->changing.data());
      this->scene.importance = this->changing.data();
      this->controlled->PrepareData(this->scene);
    }
    return seen;
  }
};

// Returns one row per iteration, in the order of CONVERGENCE in optimization.py.
nb::list RowsOf(const std::vector<IterationRecord>& history)
{
  nb::list rows;
  for (const IterationRecord& record : history)
  {
    const Energy& energy = record.energy;
    const Score& score = record.score;
    rows.append(nb::make_tuple(record.iteration, record.level, energy.Total(),
      energy.regularization, energy.view, energy.light, score.visibility, score.fraction,
      score.sacrificed, record.seconds));
  }
  return rows;
}

/// Label, name, importance and target.
using StructureTuple = std::tuple<std::int64_t, std::string, double, std::optional<double>>;
using Rows = nb::ndarray<const StructureRow, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

Structures StructuresOf(const std::vector<StructureTuple>& given)
{
  std::vector<Structure> all;
  for (const auto& [label, name, importance, target] : given)
  {
    all.push_back({ label, name, importance, target });
  }
  return Structures(std::move(all));
}

// Returns one row per structure, in the order of StructureShares in structures.py.
nb::list RowsOf(const TargetsFound& found)
{
  nb::list rows;
  for (const StructureShares& shares : found.shares)
  {
    const auto row = static_cast<StructureRow>(rows.size() + 1);
    rows.append(nb::make_tuple(found.structures.ImportanceOf(row), shares.visible,
      shares.baseVisible, shares.removed, shares.attainable, shares.hiddenBy));
  }
  return rows;
}

void SetScores(nb::dict& results, const Score& base, const Score& best, const Ceiling& ceiling)
{
  results["visibility_score"] = best.visibility;
  results["base_visibility_score"] = base.visibility;
  results["visible_fraction"] = best.fraction;
  results["base_visible_fraction"] = base.fraction;
  results["sacrificed_fraction"] = best.sacrificed;
  results["attainable_fraction"] = ceiling.fraction;
  results["attainable_score"] = ceiling.visibility;
  results["attainable_light_score"] = ceiling.lightVisibility;
}

// `onGrid`: the solver that has iterated, which may be another one than that of the data.
nb::dict ResultsOf(const Solver& solver, const Solver& onGrid, const Camera& camera)
{
  nb::dict results;
  SetScores(results, solver.BaseScore(), solver.BestScore(), solver.FindCeiling());
  results["energy"] = solver.BestEnergy().Total();
  results["iterations"] = onGrid.Iterations();
  results["settled"] = onGrid.Settled();
  results["seconds"] = onGrid.Seconds();
  results["backend"] = onGrid.BackendName();
  results["convergence"] = RowsOf(onGrid.History());
  results["camera_position"] = ToTriple(camera.position);
  results["camera_view_up"] = ToTriple(camera.viewUp);
  return results;
}

nb::dict Optimize(const Grid& grid, const Field& extinction, const Field& importance,
  float majorant, const Camera& camera, const Light& light, const Settings& settings,
  const ViewSet& views, std::optional<Guide> guide, const std::vector<OptionalField>& references,
  const OptionalField& initial, CarriedChange* previous,
  const std::optional<std::vector<StructureTuple>>& structures, const std::optional<Rows>& rows,
  const nb::object& progress)
{
  Run run(grid, extinction, importance, majorant);
  run.camera = camera;
  run.light = light;
  run.settings = settings;
  run.settings.scoreIterations = true;
  run.views = views;
  run.guide = guide;
  std::transform(references.begin(), references.end(), run.scene.references.begin(), DataOf);
  run.initial = DataOf(initial);
  run.previous = previous;
  run.progress = ToProgress(progress);
  ConcurrentResult found;
  std::unique_ptr<Solver> onData;   // null: the grid of the change is that of the data
  std::optional<TargetsFound> seen; // of structures; none: there are none
  ComputeBesidePython(
    [&]
    {
      run.Control();
      if (structures && rows)
      {
        seen = run.SolveFor(StructuresOf(*structures), rows->data(), found);
      }
      else
      {
        found = run.Solve(run.controlled->Fields());
      }
      if (run.controlled->MeasuresData())
      {
        onData = run.controlled->OnData(*found.solver, run.progress);
        if (seen)
        {
          seen->shares = onData->SharesOf(seen->structures, rows->data());
        }
      }
      const Solver& judged = onData ? *onData : *found.solver;
      judged.BestScore(); // it may take a sweep
      judged.FindCeiling();
    });

  const bool isSwept = !onData && run.controlled->SweepsData(found.solver->Options());
  const bool isMeasured = !run.controlled->IsCoarser() || onData || isSwept;
  nb::dict results = ResultsOf(onData ? *onData : *found.solver, *found.solver, found.camera);
  results["control_factor"] = run.controlled->Control().factor;
  results["resolution"] = isMeasured ? std::string() : run.controlled->Control().Text();
  if (seen)
  {
    results["structures"] = RowsOf(*seen);
    results["targets"] = seen->text;
    results["target_warning"] = seen->warning;
  }
  std::vector<float> forCamera;
  std::vector<float> forLight; // empty: the light has none of its own
  CarriedChange change;
  ScoresOnData swept;
  ComputeBesidePython(
    [&]
    {
      if (settings.temporalCoherence > 0)
      {
        change = found.solver->Change();
      }
      if (isSwept)
      {
        forCamera.resize(std::size_t(run.scene.ValueCount()));
        swept = run.controlled->SweepData(std::move(found.solver), run.progress, forCamera.data());
        return;
      }
      if (!isMeasured)
      {
        CarriedExtinction drawn = run.controlled->ExtinctionOnData(*found.solver);
        forCamera = std::move(drawn.extinction);
        forLight = std::move(drawn.light);
        return;
      }
      std::array<FoundExtinction, 2> taken = (onData ? onData : found.solver)->TakeExtinctions();
      forCamera = taken[0].Take();
      forLight = taken[1].Take();
    });
  if (isSwept)
  {
    SetScores(results, swept.base, swept.result, swept.ceiling);
    results["seconds"] = nb::cast<double>(results["seconds"]) + swept.seconds;
  }
  if (!change.ofExtinction.empty())
  {
    results["change"] = std::move(change);
  }
  results["extinction"] = ToNumpy(std::move(forCamera));
  if (!forLight.empty())
  {
    results["light_extinction"] = ToNumpy(std::move(forLight));
  }
  return results;
}
}

void BindOptimize(nb::module_& module)
{
  nb::class_<CarriedChange>(module, "CarriedChange").def_rw("likeness", &CarriedChange::likeness);
  module.attr("likeness_in_time") = likenessInTime;
  module.def("optimize", Optimize, "grid"_a, "extinction"_a.noconvert(), "importance"_a.noconvert(),
    "majorant"_a, "camera"_a, "light"_a, "settings"_a, "views"_a, "guide"_a.none(),
    "references"_a.noconvert(), "initial"_a.noconvert().none(), "previous"_a.none(),
    "structures"_a.none(), "rows"_a.noconvert().none(), "progress"_a.none());
}
}
