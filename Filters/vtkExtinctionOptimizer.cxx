// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkExtinctionOptimizer.h"

#include "Choices.h"
#include "OptimizedImage.h"
#include "PropertyPrinter.h"
#include "ScenePlacement.h"
#include "SettingsConversion.h"
#include "vtkVisibilityAlgorithmScene.h"

#include "vtkExtentTranslator.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include "math/Require.h"
#include "optimize/Solver.h"
#include "viewpoint/Concurrent.h"

#include <exception>

vtkStandardNewMacro(vtkExtinctionOptimizer);

namespace
{
// The part of an image that this process is to hold, of what every process has computed whole.
void KeepRequestedPiece(vtkInformation* outInfo, vtkImageData* output)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int pieces = outInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  if (pieces > 1)
  {
    vtkNew<vtkExtentTranslator> translator;
    int extent[6];
    translator->PieceToExtentThreadSafe(outInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()), pieces,
      outInfo->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()), output->GetExtent(), extent,
      vtkExtentTranslator::BLOCK_MODE, 0);
    output->Crop(extent);
  }
}
}

// From the properties to the core and back.
struct vtkExtinctionOptimizer::Internals
{
  explicit Internals(vtkExtinctionOptimizer* self)
    : Self(self)
    , Reader(self)
  {
  }

  void RequireChoices() const;
  limpid::Camera MakeCamera(const limpid::Grid& grid) const;
  limpid::Light MakeLight(const limpid::Camera& camera) const;
  limpid::ConcurrentResult Optimize(const limpid::SceneFields& scene, const limpid::Camera& camera,
    const limpid::Light& light) const;
  void StartFromLastResult(const limpid::Grid& grid, limpid::Solver& solver) const;
  void WriteUnsolved(const limpid::ImageScene& scene, vtkImageData* output) const;

  vtkExtinctionOptimizer* Self;
  SceneReader Reader;
  vtkSmartPointer<vtkFloatArray> LastExtinction; // for a warm start: shared with the last output
  limpid::Int3 LastNodes{ 0 };
};

vtkExtinctionOptimizer::vtkExtinctionOptimizer()
  : State(new Internals(this))
{
  this->SetNumberOfOutputPorts(2);
}

vtkExtinctionOptimizer::~vtkExtinctionOptimizer() = default;

vtkTable* vtkExtinctionOptimizer::GetConvergence()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkExtinctionOptimizer::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkExtinctionOptimizer::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* output = vtkImageData::GetData(outputVector, 0);
  vtkTable* convergence = vtkTable::GetData(outputVector, 1);
  try
  {
    this->Optimize(inputVector, output, convergence);
    KeepRequestedPiece(outputVector->GetInformationObject(0), output);
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize(); // never a half-optimised field
    convergence->Initialize();
    return 0;
  }
}

// Converts the scene, solves it, and writes the image.
void vtkExtinctionOptimizer::Optimize(
  vtkInformationVector** inputVector, vtkImageData* output, vtkTable* convergence)
{
  Internals& state = *this->State;
  vtkImageData* input = state.Reader.RequireWholeImage(inputVector);
  state.RequireChoices();
  const limpid::ImageScene scene = state.Reader.Read(input, this->ExtinctionSource);
  const limpid::Camera camera = state.MakeCamera(scene.grid);
  const limpid::Light light = state.MakeLight(camera);

  output->ShallowCopy(input);
  if (!scene.grid.HasVolume())
  {
    state.WriteUnsolved(scene, output);
    limpid::AddPlacement(camera, light, scene.unitDistance, output->GetFieldData());
    return;
  }
  const limpid::ConcurrentResult result = state.Optimize(scene.Fields(), camera, light);
  this->SetProgressText(nullptr);
  if (!result.solver)
  {
    return; // aborted: the input as it came
  }

  limpid::AddFields(*result.solver, scene.arrays, scene.unitDistance, output);
  limpid::AddSummary(*result.solver, output->GetFieldData());
  limpid::AddPlacement(result.camera, light, scene.unitDistance, output->GetFieldData());
  if (this->OptimizeViewpoint)
  {
    limpid::AddStart(result.startScore, output->GetFieldData());
  }
  limpid::FillConvergence(*result.solver, convergence);
  state.LastNodes = scene.grid.nodes;
  state.LastExtinction = this->WarmStart
    ? vtkFloatArray::SafeDownCast(output->GetPointData()->GetArray("Extinction"))
    : nullptr;
}

void vtkExtinctionOptimizer::Internals::RequireChoices() const
{
  this->Reader.RequireChoices();
  limpid::RequireChoice("ViewpointGuide", this->Self->ViewpointGuide, 2);
}

limpid::Camera vtkExtinctionOptimizer::Internals::MakeCamera(const limpid::Grid& grid) const
{
  limpid::Camera camera;
  camera.position = limpid::ToVec3(this->Self->CameraPosition);
  camera.focalPoint = limpid::ToVec3(this->Self->CameraFocalPoint);
  camera.viewUp = limpid::ToVec3(this->Self->CameraViewUp);
  camera.viewAngle = this->Self->CameraViewAngle;
  camera.parallel = this->Self->CameraParallelProjection != 0;
  camera.parallelScale = this->Self->CameraParallelScale;
  camera.aspect = this->Self->CameraAspectRatio;
  if (this->Self->AutomaticPlacement && limpid::IsUnplaced(camera))
  {
    LIMPID_REQUIRE(camera.viewAngle > 0 && camera.viewAngle < 180,
      "CameraViewAngle is "
        << camera.viewAngle
        << " degrees (no distance shows all of the data). Set an angle between 0 and 180 degrees.");
    limpid::PlaceCamera(grid, camera);
  }
  return camera;
}

limpid::Light vtkExtinctionOptimizer::Internals::MakeLight(const limpid::Camera& camera) const
{
  limpid::Light light = limpid::LightOf(this->Self->Settings, camera.focalPoint);
  if (this->Self->AutomaticPlacement && limpid::IsUnplaced(light))
  {
    limpid::PlaceLight(camera, light);
  }
  return light;
}

// Optimises the extinction, with OptimizeViewpoint also the camera. The result has no solver if the
// user has had enough.
limpid::ConcurrentResult vtkExtinctionOptimizer::Internals::Optimize(
  const limpid::SceneFields& scene, const limpid::Camera& camera, const limpid::Light& light) const
{
  bool aborted = this->Reader.IsAborted();
  const limpid::Progress progress = [this, &aborted](double share, const std::string& text)
  {
    this->Self->SetProgressText(text.c_str());
    this->Self->UpdateProgress(share);
    aborted = this->Reader.IsAborted();
    return !aborted;
  };
  const limpid::Settings settings = limpid::SettingsOf(this->Self->Settings);
  limpid::ConcurrentResult result;
  result.camera = camera;
  if (aborted)
  {
    return result;
  }
  if (this->Self->OptimizeViewpoint)
  {
    const auto guide = static_cast<limpid::Guide>(this->Self->ViewpointGuide);
    result = limpid::OptimizeConcurrently(scene, camera, light, settings, guide, progress);
  }
  else
  {
    result.solver = std::make_unique<limpid::Solver>(scene, camera, light, settings);
    this->StartFromLastResult(scene.grid, *result.solver);
    result.solver->Run(progress);
  }
  result.solver = aborted ? nullptr : std::move(result.solver);
  return result;
}

void vtkExtinctionOptimizer::Internals::StartFromLastResult(
  const limpid::Grid& grid, limpid::Solver& solver) const
{
  if (this->Self->WarmStart && this->Self->GetMode() == JOINT && this->LastExtinction &&
    this->LastNodes == grid.nodes)
  {
    solver.SetInitialExtinction(this->LastExtinction->GetPointer(0));
  }
}

void vtkExtinctionOptimizer::Internals::WriteUnsolved(
  const limpid::ImageScene& scene, vtkImageData* output) const
{
  vtkWarningWithObjectMacro(this->Self,
    "The image has " << scene.grid.nodes.x << " x " << scene.grid.nodes.y << " x "
                     << scene.grid.nodes.z
                     << " points (without a volume nothing can hide anything): the extinction "
                        "stays as it is. Give an image with at least two points per axis.");
  limpid::AddUnsolvedFields(scene.arrays, scene.unitDistance, output);
}

void vtkExtinctionOptimizer::PrintSelf(ostream& os, vtkIndent indent)
{
  const limpid::PropertyPrinter print{ os, indent };

  this->Superclass::PrintSelf(os, indent);
  print("AutomaticPlacement", this->AutomaticPlacement);
  print("CameraPosition", this->CameraPosition);
  print("CameraFocalPoint", this->CameraFocalPoint);
  print("CameraViewUp", this->CameraViewUp);
  print("CameraViewAngle", this->CameraViewAngle);
  print("CameraParallelProjection", this->CameraParallelProjection);
  print("CameraParallelScale", this->CameraParallelScale);
  print("CameraAspectRatio", this->CameraAspectRatio);
  print("OptimizeViewpoint", this->OptimizeViewpoint);
  print("ViewpointGuide", this->ViewpointGuide);
  print("WarmStart", this->WarmStart);
}
