// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What the solver has found, as arrays of the output image and as a table.

#ifndef limpid_OptimizedImage_h
#define limpid_OptimizedImage_h

class vtkFieldData;
class vtkImageData;
class vtkTable;

namespace limpid
{
struct Camera;
struct ConcurrentResult;
struct Light;
struct SceneArrays;
class Solver;

/// Adds the point arrays of a solved scene.
void AddFields(
  const Solver& solver, const SceneArrays& arrays, double unitDistance, vtkImageData* output);

/// Adds the point arrays and scores of a scene in which nothing can hide, because the image has
/// no volume: the base extinction, seen and lit without loss.
void AddUnsolvedFields(const SceneArrays& arrays, double unitDistance, vtkImageData* output);

/// Adds scores, energy and effort.
void AddSummary(const Solver& solver, vtkFieldData* output);

/// Adds what the extinction alone achieved before the camera was moved, and what was proved of the
/// new view, as far as that is known.
void AddViewpoint(const ConcurrentResult& result, vtkFieldData* output);

/// Adds what the result was made for: camera, light, unit distance of opacities.
void AddPlacement(
  const Camera& camera, const Light& light, double unitDistance, vtkFieldData* output);

/// One row per iteration, first the base extinction.
void FillConvergence(const Solver& solver, vtkTable* table);
}

#endif
