// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The implementation of vtkExtinctionOptimizer between a request and its end; it is the interface
// to the core.

#ifndef vtkExtinctionOptimizerInternals_h
#define vtkExtinctionOptimizerInternals_h

#include "OptimizedImage.h"
#include "vtkExtinctionOptimizer.h"
#include "vtkVisibilityAlgorithmScene.h"

#include "vtkFloatArray.h"
#include "vtkSmartPointer.h"

#include "distributed/Communicator.h"
#include "optimize/ControlledScene.h"
#include "viewpoint/Concurrent.h"

#include <memory>
#include <optional>
#include <string>

namespace limpid
{
struct TargetsFound;
}

struct vtkExtinctionOptimizer::Internals
{
  explicit Internals(vtkExtinctionOptimizer* self)
    : Self(self)
    , Reader(self)
  {
  }

  bool HasTwoExtinctions() const;
  double BytesPerPoint() const;
  int ArraysOfSweeps() const;
  limpid::NeedPerNode Need(const limpid::Grid& data) const;
  bool IsInLayers(const limpid::ImageScene& scene);
  bool RanksShare(vtkInformation* outInfo) const;
  limpid::ImageScene Read(vtkInformationVector** inputVector);
  limpid::Camera MakeCamera(const limpid::Grid& grid) const;
  limpid::Light MakeLight(const limpid::Camera& camera) const;
  const limpid::ControlGrid& ChooseControl(const limpid::SceneFields& scene);
  limpid::ControlledScene Control(const limpid::ImageScene& scene);
  limpid::ConcurrentResult Optimize(const limpid::ControlledScene& scene,
    const limpid::Camera& camera, const limpid::Light& light) const;
  void StartFromLastResult(const limpid::ControlledScene& scene, limpid::Solver& solver) const;
  bool AnyRank(bool here) const { return this->Ranks->AnyOf(here); }
  limpid::Progress MakeProgress() const;
  std::optional<limpid::TargetsFound> MeetTargets(const limpid::ImageScene& scene,
    limpid::ControlledScene& controlled, std::unique_ptr<limpid::Solver>& solver) const;
  limpid::OptimizationSummary AddResults(const limpid::ImageScene& scene,
    limpid::ControlledScene& controlled, std::unique_ptr<limpid::Solver>& solver,
    vtkImageData* output) const;
  void WriteStructures(const limpid::ImageScene& scene, const limpid::TargetsFound& found,
    vtkImageData* output, vtkTable* table) const;
  limpid::ResultArrays WantedArrays() const;
  void KeepExtinction(vtkImageData* input, vtkImageData* output);
  void WriteUnsolved(const limpid::ImageScene& scene, vtkImageData* output) const;
  void ReportReplaced(
    const limpid::ImageScene& scene, vtkImageData* input, vtkImageData* output) const;

  vtkExtinctionOptimizer* Self;
  SceneReader Reader;
  std::shared_ptr<const limpid::Communicator> Ranks = limpid::ThisProcess(); // of the present run
  vtkSmartPointer<vtkFloatArray> LastExtinction; // for a warm start; may also be an output
  limpid::Int3 LastNodes{ 0 };
  std::shared_ptr<const limpid::ScenePiece> LastPiece; // at the last run; null: one process
  limpid::CarriedChange LastChange;                    // for temporal coherence
  vtkMTimeType LastTime = 0;                           // of the data of LastChange
  limpid::ControlGrid Grid;                            // on which the change is found
  std::string GridIsFor;                               // what it was chosen for
  bool SuitsLayers = false; // whether the fields of this run can be converted in layers
};

#endif
