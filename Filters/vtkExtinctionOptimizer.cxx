// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkExtinctionOptimizer.h"

#include "Abort.h"
#include "Choices.h"
#include "ControllerRanks.h"
#include "Memory.h"
#include "OptimizedImage.h"
#include "OwnArrays.h"
#include "PropertyPrinter.h"
#include "SettingsConversion.h"
#include "StructureTable.h"
#include "Vectors.h"
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

#include "backend/Interruption.h"
#include "distributed/Communicator.h"
#include "math/Require.h"
#include "optimize/DistributedBackend.h"
#include "scene/Placement.h"
#include "scene/ViewSet.h"
#include "viewpoint/Concurrent.h"
#include "viewpoint/MeetTargets.h"

#include <algorithm>
#include <array>
#include <exception>
#include <optional>
#include <string>
#include <vector>

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

// Converts the properties for the core, and its results for the output.
struct vtkExtinctionOptimizer::Internals
{
  explicit Internals(vtkExtinctionOptimizer* self)
    : Self(self)
    , Reader(self)
  {
  }

  bool HasTwoExtinctions() const;
  double BytesPerPoint() const;
  bool RanksShare(vtkInformation* outInfo) const;
  limpid::ImageScene Read(vtkInformationVector** inputVector) const;
  limpid::Camera MakeCamera(const limpid::Grid& grid) const;
  limpid::Light MakeLight(const limpid::Camera& camera) const;
  limpid::ConcurrentResult Optimize(const limpid::SceneFields& scene, const limpid::Camera& camera,
    const limpid::Light& light) const;
  void StartFromLastResult(const limpid::SceneFields& scene, limpid::Solver& solver) const;
  bool AnyRank(bool here) const { return this->Ranks->AnyOf(here); }
  limpid::Progress MakeProgress() const;
  std::optional<limpid::TargetsFound> MeetTargets(
    const limpid::ImageScene& scene, std::unique_ptr<limpid::Solver>& solver) const;
  void WriteStructures(const limpid::ImageScene& scene, const limpid::TargetsFound& found,
    vtkImageData* output, vtkTable* table) const;
  void WriteUnsolved(const limpid::ImageScene& scene, vtkImageData* output) const;
  void ReportReplaced(
    const limpid::ImageScene& scene, vtkImageData* input, vtkImageData* output) const;

  vtkExtinctionOptimizer* Self;
  SceneReader Reader;
  std::shared_ptr<const limpid::Communicator> Ranks = limpid::ThisProcess(); // of the present run
  vtkSmartPointer<vtkFloatArray> LastExtinction; // for a warm start; also an output
  limpid::Int3 LastNodes{ 0 };
  std::shared_ptr<const limpid::ScenePiece> LastPiece; // at the last run; null: one process
  limpid::CarriedChange LastChange;                    // for temporal coherence
  vtkMTimeType LastTime = 0;                           // of the data of LastChange
};

vtkExtinctionOptimizer::vtkExtinctionOptimizer()
  : State(new Internals(this))
{
  this->SetNumberOfOutputPorts(3);
}

vtkExtinctionOptimizer::~vtkExtinctionOptimizer() = default;

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
  if (port > 0)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkExtinctionOptimizer::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  const int result = this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  if (this->State->RanksShare(outInfo))
  {
    SceneReader::RequestPiece(outInfo, inputVector);
  }
  return result;
}

// Returns whether each process computes its piece of one result. All of them return the same, since
// all have pieces and equal properties.
bool vtkExtinctionOptimizer::Internals::RanksShare(vtkInformation* outInfo) const
{
  const limpid::Settings settings = limpid::SettingsOf(this->Self->Settings);
  return limpid::AllRanksUpdate(outInfo) && limpid::NotOnRanks(settings).empty() &&
    settings.backend != limpid::BackendKind::Cuda && !this->Self->OptimizeViewpoint;
}

limpid::ImageScene vtkExtinctionOptimizer::Internals::Read(vtkInformationVector** inputVector) const
{
  if (this->Ranks->IsAlone())
  {
    return this->Reader.Read(
      this->Reader.RequireWholeImage(inputVector), this->Self->ExtinctionSource);
  }
  return this->Reader.ReadShared(this->Ranks, inputVector, this->Self->ExtinctionSource);
}

int vtkExtinctionOptimizer::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* output = vtkImageData::GetData(outputVector, 0);
  vtkTable* convergence = vtkTable::GetData(outputVector, 1);
  vtkTable* structures = vtkTable::GetData(outputVector, 2);
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
  const bool isOther = state.AnyRank(input->GetMTime() != state.LastTime);
  state.LastChange.likeness = isOther ? limpid::likenessInTime : 1;
  state.LastTime = input->GetMTime();
  limpid::ConcurrentResult result = state.Optimize(scene.Fields(), camera, light);
  const std::optional<limpid::TargetsFound> targets = state.MeetTargets(scene, result.solver);
  this->SetProgressText(nullptr);
  limpid::AddFields(*result.solver, scene.arrays, scene.unitDistance, output);
  const limpid::OptimizationSummary summary = limpid::SummaryOf(*result.solver);
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
  state.LastPiece = scene.Fields().piece;
  state.LastExtinction = this->WarmStart
    ? vtkFloatArray::SafeDownCast(output->GetPointData()->GetArray("Extinction"))
    : nullptr;
  const bool coherent = this->GetTemporalCoherence() > 0 && this->GetMethod() == OPTIMIZED;
  state.LastChange = coherent ? result.solver->Change() : limpid::CarriedChange();
}

// Optimises with other importances of structures until their targets are met. Returns what is seen
// of each structure; none if there are no structures.
std::optional<limpid::TargetsFound> vtkExtinctionOptimizer::Internals::MeetTargets(
  const limpid::ImageScene& scene, std::unique_ptr<limpid::Solver>& solver) const
{
  if (!scene.structures)
  {
    return {};
  }
  const limpid::LabelledScene labelled{ scene.Fields(), scene.arrays.importance->GetPointer(0),
    *scene.structures, scene.arrays.structureRows->GetPointer(0) };
  return limpid::MeetTargets(labelled, this->LastChange, this->MakeProgress(), solver);
}

// Writes what is seen of each structure, and what has become of targets.
void vtkExtinctionOptimizer::Internals::WriteStructures(const limpid::ImageScene& scene,
  const limpid::TargetsFound& found, vtkImageData* output, vtkTable* table) const
{
  if (!found.warning.empty())
  {
    vtkWarningWithObjectMacro(this->Self, << found.warning);
  }
  const std::string missing = limpid::StructuresWithoutMatter(*scene.structures, found.shares);
  if (!missing.empty())
  {
    vtkWarningWithObjectMacro(this->Self,
      << "Of these structures there is nothing to see in the image: " << missing
      << " (no point has the label, the points have no extinction, or they are out of view; their "
         "shares are 0). Check the labels, the structure array and the opacity function.");
  }
  limpid::FillStructures(*scene.structures, found, table);
  if (!found.text.empty())
  {
    limpid::AddTargets(found, output->GetFieldData());
  }
}

// Returns whether the light has its own extinction.
bool vtkExtinctionOptimizer::Internals::HasTwoExtinctions() const
{
  return this->Self->GetMode() == SEPARATE || this->Self->GetMethod() == AMENT_2017;
}

// Memory of a run in addition to its input, including results. Measured by
// Testing/Benchmarks/filter_memory.py at 512^3 points: 34 with the policy, 40 with Adam, 63 in
// separate mode, 46 if the policy also optimises the viewpoint; up to three more at 256^3. Counted:
// smoothed importance and its derived fields, of which there may be a copy in another order of
// axes; the pull of neighbours; the last change, and the fields derived from it in two orders.
double vtkExtinctionOptimizer::Internals::BytesPerPoint() const
{
  const bool adam = this->Self->GetSolver() == ADAM;
  const bool two = this->HasTwoExtinctions();
  const double separate = two ? 22 : 0;
  const double viewpoint = this->Self->OptimizeViewpoint ? (adam ? 30 : 12) : 0;
  const double despeckled = this->Self->GetImportanceSmoothing() == MEDIAN ? 20 : 0;
  const double smoothed = this->Self->GetSmoothness() > 0 ? 4 : 0;
  const double coherent = this->Self->GetTemporalCoherence() > 0 ? (two ? 24 : 12) : 0;
  return (adam ? 42 : 36) + separate + viewpoint + despeckled + smoothed + coherent;
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
      "CameraViewAngle is " << camera.viewAngle
                            << " degrees (no camera distance would show the whole image). Set an "
                               "angle between 0 and 180 degrees.");
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

limpid::Progress vtkExtinctionOptimizer::Internals::MakeProgress() const
{
  return [this](double share, const std::string& text)
  {
    this->Self->SetProgressText(text.c_str());
    this->Self->UpdateProgress(share);
    if (limpid::IsAborted(this->Self))
    {
      throw limpid::Interrupted();
    }
    return true;
  };
}

// Optimises the extinction and, with OptimizeViewpoint, the camera.
limpid::ConcurrentResult vtkExtinctionOptimizer::Internals::Optimize(
  const limpid::SceneFields& scene, const limpid::Camera& camera, const limpid::Light& light) const
{
  const limpid::Progress progress = this->MakeProgress();
  const std::vector<limpid::Camera> cameras = limpid::CamerasOf(
    limpid::ViewSetOf(this->Self->Settings), camera, limpid::OrbitStart::AtCamera);
  limpid::Settings settings = limpid::ForCameras(limpid::SettingsOf(this->Self->Settings), cameras);
  settings.scoreIterations = true; // for the table Convergence
  limpid::ConcurrentResult result;
  result.camera = camera;
  if (this->Self->OptimizeViewpoint)
  {
    LIMPID_REQUIRE(settings.method == limpid::Method::Optimized,
      "OptimizeViewpoint is on and Method is " << limpid::InfoOf(settings.method).name
                                               << " (only the method Optimized supports this). Set "
                                                  "Method to Optimized or OptimizeViewpoint off.");
    LIMPID_REQUIRE(cameras.size() == 1,
      "OptimizeViewpoint is on and Views is not Single View (only a single camera can be "
      "optimised). Set Views to Single View or OptimizeViewpoint off.");
    const auto guide = static_cast<limpid::Guide>(this->Self->ViewpointGuide);
    result = limpid::OptimizeConcurrently(scene, camera, light, settings, guide, progress);
  }
  else
  {
    result.solver =
      std::make_unique<limpid::Solver>(scene, cameras.front(), light, settings, this->LastChange);
    this->StartFromLastResult(scene, *result.solver);
    result.solver->Run(progress);
  }
  return result;
}

void vtkExtinctionOptimizer::Internals::StartFromLastResult(
  const limpid::SceneFields& scene, limpid::Solver& solver) const
{
  if (!this->Self->WarmStart || this->Self->GetMethod() != OPTIMIZED ||
    this->Self->GetMode() != JOINT)
  {
    return;
  }
  const bool fits = this->LastNodes == scene.grid.nodes &&
    limpid::HaveSameBoxes(this->LastPiece.get(), scene.piece.get());
  const bool isThere = this->LastExtinction || scene.ValueCount() == 0;
  if (!this->AnyRank(!fits || !isThere))
  {
    solver.SetInitialExtinction(
      this->LastExtinction ? this->LastExtinction->GetPointer(0) : nullptr);
  }
}

void vtkExtinctionOptimizer::Internals::WriteUnsolved(
  const limpid::ImageScene& scene, vtkImageData* output) const
{
  vtkWarningWithObjectMacro(this->Self,
    "The image has " << scene.grid.nodes.x << " x " << scene.grid.nodes.y << " x "
                     << scene.grid.nodes.z
                     << " points (it has no volume, so nothing is occluded): the extinction is not "
                        "changed. Give an image with at least two points per axis.");
  limpid::AddUnsolvedFields(scene.arrays, scene.unitDistance, this->HasTwoExtinctions(), output);
}

// Scripts find results by their names, so results replace arrays of the same name.
void vtkExtinctionOptimizer::Internals::ReportReplaced(
  const limpid::ImageScene& scene, vtkImageData* input, vtkImageData* output) const
{
  std::vector<vtkAbstractArray*> replaced =
    limpid::MarkResults(input->GetPointData(), output->GetPointData());
  const std::vector<vtkAbstractArray*> fields =
    limpid::MarkResults(input->GetFieldData(), output->GetFieldData());
  replaced.insert(replaced.end(), fields.begin(), fields.end());
  std::string names;
  for (vtkAbstractArray* array : replaced)
  {
    const auto& taken = scene.taken;
    if (std::find(taken.begin(), taken.end(), array) == taken.end())
    {
      names += (names.empty() ? "\"" : ", \"") + std::string(array->GetName()) + "\"";
    }
  }
  if (!names.empty())
  {
    vtkWarningWithObjectMacro(this->Self,
      "The input has arrays with the names of results, "
        << names
        << " (array names are unique, so the output has the results instead). Rename them before "
           "this filter if you need them after it.");
  }
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
