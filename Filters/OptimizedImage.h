// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Converts the results of the solver to arrays of the output image and to a table.

#ifndef limpid_OptimizedImage_h
#define limpid_OptimizedImage_h

#include "optimize/Solver.h"

#include <string>
#include <vector>

class vtkFieldData;
class vtkImageData;
class vtkTable;

namespace limpid
{
struct Camera;
struct ConcurrentResult;
struct TargetsFound;
struct Light;
struct SceneArrays;

/// Adds the point arrays of an optimised scene.
void AddFields(
  const Solver& solver, const SceneArrays& arrays, double unitDistance, vtkImageData* output);

/// Adds the point arrays and scores of a scene in which nothing can be hidden, because the image
/// has no volume: the base extinction with transmittances of 1. `separate`: also the extinction for
/// the light.
void AddUnsolvedFields(
  const SceneArrays& arrays, double unitDistance, bool separate, vtkImageData* output);

/// The results of an optimisation. Defaults are those of a scene in which nothing can be hidden.
struct OptimizationSummary
{
  Score score;
  Score baseScore;
  Ceiling ceiling;
  double energy = 0;
  int iterations = 0;
  bool settled = true;
  double seconds = 0;
  std::string backend;                  ///< empty: none
  std::vector<IterationRecord> history; ///< empty: no iteration
};

OptimizationSummary SummaryOf(const Solver& solver);

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
