// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Converts the results of the solver to arrays of the output image and to a table.

#ifndef limpid_OptimizedImage_h
#define limpid_OptimizedImage_h

#include "optimize/Solver.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

class vtkFieldData;
class vtkImageData;
class vtkTable;

namespace limpid
{
struct Camera;
struct ConcurrentResult;
class ControlledScene;
struct TargetsFound;
struct Light;
struct ScoresOnData;
struct SceneArrays;

/// Names of the point arrays that a filter writes.
class ResultArrays
{
public:
  /// Returns all names.
  static const std::vector<std::string>& All();

  /// Throws limpid::Error if a name is not one of All().
  explicit ResultArrays(const std::set<std::string>& names);

  bool Has(const std::string& name) const { return this->Names.count(name) > 0; }

  /// Returns those that need a sweep through the data: transmittances and what is made of them.
  ResultArrays OfSweeps() const;

  /// Returns those that a scene which is converted in layers does not have: OfSweeps, and both
  /// fields of the scene.
  ResultArrays NotInLayers() const;

  /// Returns the names in quotation marks, with commas; may be empty.
  std::string Text() const;

private:
  ResultArrays Among(const std::set<std::string>& names) const;

  std::set<std::string> Names;
};

/// Adds the point arrays of an optimised scene.
void AddFields(const Solver& solver, const SceneArrays& arrays, double unitDistance,
  const ResultArrays& wanted, vtkImageData* output);

/// Adds the point arrays of a change that was found on a coarser grid, without those of sweeps, and
/// without those of a scene that is converted in layers. `separate`: also the extinction for the
/// light. If that is possible, the change is improved at the resolution of the data: then it
/// takes the solver, and returns scores on the data, see ControlledScene::SweepData.
std::optional<ScoresOnData> AddFields(ControlledScene& controlled, std::unique_ptr<Solver>& found,
  const SceneArrays& arrays, double unitDistance, bool separate, const ResultArrays& wanted,
  const Progress& progress, vtkImageData* output);

/// Adds the point arrays and scores of a scene in which nothing can be hidden, because the image
/// has no volume: the base extinction with transmittances of 1. `separate`: also the extinction for
/// the light.
void AddUnsolvedFields(const SceneArrays& arrays, double unitDistance, bool separate,
  const ResultArrays& wanted, vtkImageData* output);

/// The results of an optimisation. Defaults are those of a scene in which nothing can be hidden.
struct OptimizationSummary
{
  Score score;
  Score baseScore;
  Ceiling ceiling;
  double energy = 0;
  int controlFactor = 1; ///< see ControlGrid
  int iterations = 0;
  bool settled = true;
  double seconds = 0;
  std::string backend;                  ///< empty: none
  std::vector<IterationRecord> history; ///< empty: no iteration
};

OptimizationSummary SummaryOf(const Solver& solver);

/// Returns the summary of an optimisation on a control grid, with scores of the data.
/// `onData`: see ControlledScene::OnData.
OptimizationSummary SummaryOf(const Solver& onControlGrid, const Solver& onData);

/// Adds scores, energy and effort as field data.
void AddSummary(const OptimizationSummary& summary, vtkFieldData* output);

/// Adds what has become of targets of structures.
void AddTargets(const TargetsFound& found, vtkFieldData* output);

/// Adds what the extinction alone achieved before the camera was moved, and what was proved about
/// the new view, as far as these are known.
void AddViewpoint(const ConcurrentResult& result, vtkFieldData* output);

/// Adds the camera, the light and the unit distance of opacities that were used.
void AddPlacement(
  const Camera& camera, const Light& light, double unitDistance, vtkFieldData* output);

/// Fills a table with one row per iteration; the first row is the base extinction.
void FillConvergence(const OptimizationSummary& summary, vtkTable* table);
}

#endif
