// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What vtkExtinctionOptimizer does between a request and its end: the border to the core.

#ifndef vtkExtinctionOptimizerInternals_h
#define vtkExtinctionOptimizerInternals_h

#include "vtkExtinctionOptimizer.h"
#include "vtkVisibilityAlgorithmScene.h"

#include "vtkFloatArray.h"
#include "vtkSmartPointer.h"

#include "viewpoint/Concurrent.h"

#include <array>

struct vtkExtinctionOptimizer::Internals
{
  explicit Internals(vtkExtinctionOptimizer* self)
    : Self(self)
    , Reader(self)
  {
  }

  void Optimize(vtkInformationVector** inputVector, vtkImageData* output, vtkTable* convergence);
  void RequireAvailableChoices() const;
  limpid::Camera MakeCamera(const limpid::Grid& grid) const;
  limpid::Light MakeLight(const limpid::Camera& camera) const;
  limpid::Settings MakeSettings() const;
  void StartFromLastResult(const limpid::Grid& grid, limpid::Solver& solver) const;
  limpid::ConcurrentResult OptimizeExtinction(const limpid::SceneFields& scene,
    const limpid::Camera& camera, const limpid::Light& light) const;
  limpid::ConcurrentResult OptimizeBoth(const limpid::SceneFields& scene,
    const limpid::Camera& camera, const limpid::Light& light) const;
  limpid::Progress ReportTo(bool& aborted) const;
  void KeepResult(vtkImageData* output);

  vtkExtinctionOptimizer* Self;
  SceneReader Reader;
  vtkSmartPointer<vtkFloatArray> LastExtinction; // for a warm start: shared with the last output
  std::array<int, 3> LastNodes{ { 0, 0, 0 } };
};

#endif
