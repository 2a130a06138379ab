// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What the solver has found, as arrays of the output image and as a table.

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
struct Light;
struct SceneArrays;

/// Adds the point arrays of a solved scene.
void AddFields(
  const Solver& solver, const SceneArrays& arrays, double unitDistance, vtkImageData* output);

/// Adds the point arrays and scores of a scene in which nothing can hide, because the image has
/// no volume: the base extinction, seen and lit without loss. `separate`: that of the light, too.
void AddUnsolvedFields(
  const SceneArrays& arrays, double unitDistance, bool separate, vtkImageData* output);

/// What an optimisation achieved; by itself: of a scene in which nothing can hide.
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

/// Adds scores, energy and effort.
void AddSummary(const OptimizationSummary& summary, vtkFieldData* output);

/// Adds what the extinction alone achieved before the camera was moved, and what was proved of the
/// new view, as far as that is known.
void AddViewpoint(const ConcurrentResult& result, vtkFieldData* output);

/// Adds what the result was made for: camera, light, unit distance of opacities.
void AddPlacement(
  const Camera& camera, const Light& light, double unitDistance, vtkFieldData* output);

/// One row per iteration, first the base extinction.
void FillConvergence(const OptimizationSummary& summary, vtkTable* table);
}

#endif
