// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkExtinctionOptimizerInternals.h"

#include "Abort.h"
#include "ControllerRanks.h"
#include "Log.h"
#include "Memory.h"
#include "PropertyPrinter.h"
#include "SampledData.h"
#include "StructureTable.h"

#include "vtkExtentTranslator.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include "backend/Interruption.h"
#include "optimize/TargetSearch.h"
#include "viewpoint/MeetTargets.h"

#include <algorithm>
#include <array>
#include <exception>
#include <iterator>
#include <optional>
#include <string>

vtkStandardNewMacro(vtkExtinctionOptimizer);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

// Crops an image to the piece that was requested from this process; `whole`: extent of the image.
// Points that belong to other pieces are left to them.
void KeepRequestedPiece(
  vtkInformation* outInfo, const std::array<int, 6>& whole, vtkImageData* output)
{
  const int pieces = outInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  if (pieces > 1)
  {
    vtkNew<vtkExtentTranslator> translator;
    int extent[6];
    int all[6];
    std::copy(whole.begin(), whole.end(), all);
    translator->PieceToExtentThreadSafe(outInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()), pieces,
      outInfo->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()), all, extent,
      vtkExtentTranslator::BLOCK_MODE, 0);
    const int* here = output->GetExtent();
    bool isThere = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      isThere =
        isThere && here[2 * axis] <= extent[2 * axis] && extent[2 * axis + 1] <= here[2 * axis + 1];
    }
    if (isThere)
    {
      output->Crop(extent);
    }
  }
}
}

vtkExtinctionOptimizer::vtkExtinctionOptimizer()
  : ResultArrays(limpid::ResultArrays::All().begin(), limpid::ResultArrays::All().end())
  , State(new Internals(this))
{
  this->SetNumberOfOutputPorts(3);
}

vtkExtinctionOptimizer::~vtkExtinctionOptimizer() = default;

void vtkExtinctionOptimizer::AddResultArray(const char* name)
{
  if (name && *name && this->ResultArrays.insert(name).second)
  {
    this->Modified();
  }
}

void vtkExtinctionOptimizer::RemoveAllResultArrays()
{
  if (!this->ResultArrays.empty())
  {
    this->ResultArrays.clear();
    this->Modified();
  }
}

int vtkExtinctionOptimizer::GetNumberOfResultArrays()
{
  return static_cast<int>(this->ResultArrays.size());
}

const char* vtkExtinctionOptimizer::GetResultArray(int index)
{
  const bool isThere = index >= 0 && index < this->GetNumberOfResultArrays();
  return isThere ? std::next(this->ResultArrays.begin(), index)->c_str() : nullptr;
}

vtkTable* vtkExtinctionOptimizer::GetConvergence()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

vtkTable* vtkExtinctionOptimizer::GetStructureTable()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(2));
}

int vtkExtinctionOptimizer::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port > 0 ? "vtkTable" : "vtkDataObject");
  return 1;
}

// Makes an output of the type of the input; an image for all kinds of images.
vtkTypeBool vtkExtinctionOptimizer::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!request->Has(Pipeline::REQUEST_DATA_OBJECT()))
  {
    return this->Superclass::ProcessRequest(request, inputVector, outputVector);
  }
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  vtkDataObject* output = vtkDataObject::GetData(outInfo);
  const bool isMesh = SceneReader::IsMesh(inputVector);
  const int type = isMesh ? input->GetDataObjectType() : VTK_IMAGE_DATA;
  if (!output || output->GetDataObjectType() != type)
  {
    vtkSmartPointer<vtkDataObject> made = vtkSmartPointer<vtkImageData>::New();
    if (isMesh)
    {
      made.TakeReference(input->NewInstance());
    }
    outInfo->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

int vtkExtinctionOptimizer::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  const int result = this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  if (this->State->RanksShare(outInfo) ||
    (limpid::AllRanksUpdate(outInfo) && SceneReader::IsMesh(inputVector)))
  {
    SceneReader::RequestPiece(outInfo, inputVector);
  }
  return result;
}

int vtkExtinctionOptimizer::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* output = vtkImageData::GetData(outputVector, 0);
  vtkTable* convergence = vtkTable::GetData(outputVector, 1);
  vtkTable* structures = vtkTable::GetData(outputVector, 2);
  if (!output)
  {
    return this->RequestOfMesh(inputVector, outputVector);
  }
  try
  {
    vtkInformation* outInfo = outputVector->GetInformationObject(0);
    this->State->Ranks =
      this->State->RanksShare(outInfo) ? limpid::MakeRanks() : limpid::ThisProcess();
    limpid::NotifyingOnFailure(
      *this->State->Ranks, [&] { this->Optimize(inputVector, output, convergence, structures); });
    KeepRequestedPiece(outInfo, SceneReader::WholeExtentOf(inputVector), output);
    return 1;
  }
  catch (const limpid::Interrupted&)
  {
    this->SetProgressText(nullptr);
    output->Initialize();
    output->ShallowCopy(vtkImageData::GetData(inputVector[0])); // the unchanged input
    KeepRequestedPiece(
      outputVector->GetInformationObject(0), SceneReader::WholeExtentOf(inputVector), output);
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< limpid::MessageOf(error, vtkImageData::GetData(inputVector[0]),
                    limpid::MemoryNeed{ this->State->BytesPerPoint(), limpid::fewerPoints }));
    output->Initialize(); // no half-optimised field
    convergence->Initialize();
    structures->Initialize();
    return 0;
  }
}

// Optimises an image of data that are none, and brings the results back to them. Ranks that cannot
// share the work all have the whole image and do the same.
int vtkExtinctionOptimizer::RequestOfMesh(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector, 0);
  vtkTable* convergence = vtkTable::GetData(outputVector, 1);
  vtkTable* structures = vtkTable::GetData(outputVector, 2);
  try
  {
    vtkInformation* outInfo = outputVector->GetInformationObject(0);
    const std::shared_ptr<const limpid::Communicator> ranks = limpid::RanksThatUpdate(outInfo);
    limpid::NotifyingOnFailure(*ranks,
      [&]
      {
        Internals& state = *this->State;
        const bool share = state.RanksShare(outInfo);
        const limpid::SampledData sampled = state.Reader.Sample(input, *ranks, !share);
        const vtkSmartPointer<vtkInformationVector> image =
          limpid::WithImage(inputVector[0], sampled);
        vtkInformationVector* inputs = image;
        vtkNew<vtkImageData> result;
        state.Ranks = share ? ranks : limpid::ThisProcess();
        this->Optimize(&inputs, result, convergence, structures);
        limpid::BringBack(sampled, result, input, output, *state.Ranks);
      });
    return 1;
  }
  catch (const limpid::Interrupted&)
  {
    this->SetProgressText(nullptr);
    output->ShallowCopy(input);
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkImageData* none = nullptr;
    vtkErrorMacro(<< limpid::MessageOf(error, none,
                    limpid::MemoryNeed{ this->State->BytesPerPoint(), limpid::fewerPoints }));
    output->Initialize();
    convergence->Initialize();
    structures->Initialize();
    return 0;
  }
}

// Converts the scene, solves it, and writes the image.
void vtkExtinctionOptimizer::Optimize(vtkInformationVector** inputVector, vtkImageData* output,
  vtkTable* convergence, vtkTable* structures)
{
  Internals& state = *this->State;
  const limpid::Interruptible interruptible(limpid::GoOn(this));
  state.Reader.RequireUnitDistance();
  const limpid::ImageScene scene = state.Read(inputVector);
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  const limpid::Camera camera = state.MakeCamera(scene.grid);
  const limpid::Light light = state.MakeLight(camera);

  output->ShallowCopy(input);
  if (!scene.grid.HasVolume())
  {
    state.WriteUnsolved(scene, output);
    if (scene.structures)
    {
      state.WriteStructures(scene, { *scene.structures, {}, {}, {} }, output, structures);
    }
    const limpid::OptimizationSummary none;
    limpid::AddSummary(none, output->GetFieldData());
    limpid::FillConvergence(none, convergence);
    if (this->OptimizeViewpoint)
    {
      limpid::ConcurrentResult start;
      start.startScore.emplace();
      limpid::AddViewpoint(start, output->GetFieldData());
    }
    limpid::AddPlacement(camera, light, scene.unitDistance, output->GetFieldData());
    state.ReportReplaced(scene, input, output);
    return;
  }
  limpidLogScope("Extinction Optimizer: %d x %d x %d points", scene.grid.nodes.x,
    scene.grid.nodes.y, scene.grid.nodes.z);
  const bool isOther = state.AnyRank(input->GetMTime() != state.LastTime);
  state.LastChange.likeness = isOther ? limpid::likenessInTime : 1;
  state.LastTime = input->GetMTime();
  limpid::ControlledScene controlled = state.Control(scene);
  limpid::ConcurrentResult result = state.Optimize(controlled, camera, light);
  std::optional<limpid::TargetsFound> targets = state.MeetTargets(scene, controlled, result.solver);
  const bool coherent = this->GetTemporalCoherence() > 0 && this->GetMethod() == OPTIMIZED;
  state.LastChange = coherent ? result.solver->Change() : limpid::CarriedChange();
  const limpid::OptimizationSummary summary =
    state.AddResults(scene, controlled, result.solver, output);
  this->SetProgressText(nullptr);
  if (targets && controlled.MeasuresData())
  {
    targets->shares =
      result.solver->SharesOf(targets->structures, scene.arrays.structureRows->GetPointer(0));
    targets->text = limpid::TextOfTargets(targets->structures, targets->shares);
  }
  limpidLog("%s; %d iterations; %.1f %% of the important structures visible, %.1f %% before",
    summary.backend.c_str(), summary.iterations, 100 * summary.score.fraction,
    100 * summary.baseScore.fraction);
  limpid::AddSummary(summary, output->GetFieldData());
  limpid::AddPlacement(result.camera, light, scene.unitDistance, output->GetFieldData());
  if (this->OptimizeViewpoint)
  {
    limpid::AddViewpoint(result, output->GetFieldData());
  }
  state.ReportReplaced(scene, input, output);
  limpid::FillConvergence(summary, convergence);
  if (targets)
  {
    state.WriteStructures(scene, *targets, output, structures);
  }
  state.LastNodes = scene.grid.nodes;
  state.LastPiece = scene.piece;
  state.KeepExtinction(input, output);
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
  print("ResultArrays", limpid::ResultArrays(this->ResultArrays).Text());
}
