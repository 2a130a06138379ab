// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkExtinctionOptimizerInternals.h"

#include "Abort.h"
#include "ControllerRanks.h"
#include "Log.h"
#include "OwnArrays.h"
#include "SettingsConversion.h"
#include "StructureTable.h"
#include "Vectors.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkTable.h"

#include "backend/Interruption.h"
#include "math/Require.h"
#include "optimize/DistributedBackend.h"
#include "optimize/SceneStructures.h"
#include "scene/Placement.h"
#include "scene/ViewSet.h"
#include "viewpoint/MeetTargets.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <vector>

// Returns whether each process computes its piece of one result. All of them return the same, since
// all have pieces and equal properties.
bool vtkExtinctionOptimizer::Internals::RanksShare(vtkInformation* outInfo) const
{
  const limpid::Settings settings = limpid::SettingsOf(this->Self->Settings);
  return limpid::AllRanksUpdate(outInfo) && limpid::NotOnRanks(settings).empty() &&
    settings.backend != limpid::BackendKind::Cuda && !this->Self->OptimizeViewpoint;
}

limpid::ImageScene vtkExtinctionOptimizer::Internals::Read(vtkInformationVector** inputVector)
{
  this->SuitsLayers = false;
  if (this->Ranks->IsAlone())
  {
    return this->Reader.Read(this->Reader.RequireWholeImage(inputVector),
      this->Self->ExtinctionSource,
      [this](const limpid::ImageScene& scene) { return this->IsInLayers(scene); });
  }
  return this->Reader.ReadShared(this->Ranks, inputVector, this->Self->ExtinctionSource);
}

// Returns whether the fields of a scene, which are not there yet, are to be converted in layers:
// because they do not fit into memory as a whole.
bool vtkExtinctionOptimizer::Internals::IsInLayers(const limpid::ImageScene& scene)
{
  if (!scene.grid.HasVolume() || this->Self->WarmStart ||
    !limpid::InfoOf(limpid::SettingsOf(this->Self->Settings).method).iterates)
  {
    return false;
  }
  this->SuitsLayers = true;
  limpid::SceneFields fields;
  fields.grid = scene.grid;
  const limpid::ControlGrid& control = this->ChooseControl(fields);
  return control.factor > 1 && !control.measuresData;
}

// Returns the scene with the grid on which the change is found.
limpid::ControlledScene vtkExtinctionOptimizer::Internals::Control(const limpid::ImageScene& scene)
{
  const limpid::SceneFields fields = scene.Fields();
  const auto smoothing =
    static_cast<limpid::ImportanceSmoothing>(this->Self->GetImportanceSmoothing());
  if (!scene.layered)
  {
    return { fields, this->ChooseControl(fields), smoothing };
  }
  const auto fill = [layered = scene.layered](const limpid::NodeBox& box, float* baseExtinction,
                      float* importance) { layered->Fill(box, baseExtinction, importance); };
  limpid::ControlledScene controlled(fields, fill, this->ChooseControl(fields), smoothing);
  this->Reader.WarnOfValues(scene);
  return controlled;
}

// Adds the arrays of the result. `solver`: on the control grid; becomes that of the data if results
// are measured there, and null if the change was improved there.
limpid::OptimizationSummary vtkExtinctionOptimizer::Internals::AddResults(
  const limpid::ImageScene& scene, limpid::ControlledScene& controlled,
  std::unique_ptr<limpid::Solver>& solver, vtkImageData* output) const
{
  const limpid::ResultArrays wanted = this->WantedArrays();
  if (!controlled.IsCoarser())
  {
    limpid::AddFields(*solver, scene.arrays, scene.unitDistance, wanted, output);
    return limpid::SummaryOf(*solver);
  }
  if (controlled.MeasuresData())
  {
    std::unique_ptr<limpid::Solver> onData = controlled.OnData(*solver, this->MakeProgress());
    limpid::AddFields(*onData, scene.arrays, scene.unitDistance, wanted, output);
    limpid::OptimizationSummary summary = limpid::SummaryOf(*solver, *onData);
    summary.controlFactor = controlled.Control().factor;
    solver = std::move(onData);
    return summary;
  }
  limpid::OptimizationSummary summary = limpid::SummaryOf(*solver);
  summary.controlFactor = controlled.Control().factor;
  const std::optional<limpid::ScoresOnData> onData =
    limpid::AddFields(controlled, solver, scene.arrays, scene.unitDistance,
      this->HasTwoExtinctions(), wanted, this->MakeProgress(), output);
  if (onData)
  {
    summary.score = onData->result;
    summary.baseScore = onData->base;
    summary.ceiling = onData->ceiling;
    summary.seconds += onData->seconds;
  }
  const std::string left =
    (controlled.IsInLayers() ? wanted.NotInLayers() : wanted.OfSweeps()).Text();
  vtkWarningWithObjectMacro(
    this->Self, << "Optimised at " << controlled.Control().Text()
                << " (more does not fit into the memory limit)"
                << (onData ? ", and swept once at the resolution of the data."
                           : ". Scores are those of this resolution.")
                << (left.empty() ? "" : " These arrays are left out: " + left + ".")
                << " Raise MemoryLimit if there is more memory.");
  return summary;
}

// Returns the grid on which the change is found. It is chosen again only if what it depends on has
// changed, since the memory that is left changes with every run.
const limpid::ControlGrid& vtkExtinctionOptimizer::Internals::ChooseControl(
  const limpid::SceneFields& scene)
{
  const limpid::Settings settings = limpid::SettingsOf(this->Self->Settings);
  const limpid::NeedPerNode need = this->Need(scene.grid);
  std::ostringstream what;
  what << scene.grid.nodes.x << ' ' << scene.grid.nodes.y << ' ' << scene.grid.nodes.z << ' '
       << need.ofData << ' ' << need.ofControl << ' ' << need.measuring << ' '
       << settings.memoryLimit << ' ' << int(settings.controlResolution) << ' '
       << int(settings.method);
  if (this->AnyRank(what.str() != this->GridIsFor))
  {
    this->Grid = limpid::InfoOf(settings.method).iterates
      ? limpid::ChooseControlGrid(
          settings, scene.grid, *limpid::OrWhole(scene.piece, scene.grid), need)
      : limpid::ControlGrid();
    this->GridIsFor = what.str();
    constexpr double gigabyte = 1e9;
    limpidLog(
      "%s, %.2f GB of memory needed", this->Grid.Text().c_str(), this->Grid.bytes / gigabyte);
  }
  return this->Grid;
}

// Returns the arrays to write. A warm start needs the extinction.
limpid::ResultArrays vtkExtinctionOptimizer::Internals::WantedArrays() const
{
  std::set<std::string> names = this->Self->ResultArrays;
  if (this->Self->WarmStart)
  {
    names.insert("Extinction");
  }
  return limpid::ResultArrays(names);
}

// Keeps the extinction for the next start, and removes it from the output if it is not a result.
void vtkExtinctionOptimizer::Internals::KeepExtinction(vtkImageData* input, vtkImageData* output)
{
  const char* name = "Extinction";
  this->LastExtinction = this->Self->WarmStart
    ? vtkFloatArray::SafeDownCast(output->GetPointData()->GetArray(name))
    : nullptr;
  if (this->LastExtinction && this->Self->ResultArrays.count(name) == 0)
  {
    output->GetPointData()->RemoveArray(name);
    if (vtkAbstractArray* own = input->GetPointData()->GetAbstractArray(name))
    {
      output->GetPointData()->AddArray(own);
    }
  }
}

// Optimises with other importances of structures until their targets are met. Returns what is seen
// of each structure; none if there are no structures.
std::optional<limpid::TargetsFound> vtkExtinctionOptimizer::Internals::MeetTargets(
  const limpid::ImageScene& scene, limpid::ControlledScene& controlled,
  std::unique_ptr<limpid::Solver>& solver) const
{
  if (!scene.structures)
  {
    return {};
  }
  if (!controlled.IsCoarser())
  {
    const limpid::LabelledScene labelled{ scene.Fields(), scene.arrays.importance->GetPointer(0),
      *scene.structures, scene.arrays.structureRows->GetPointer(0) };
    return limpid::MeetTargets(labelled, this->LastChange, this->MakeProgress(), solver);
  }
  limpid::SceneFields fields = controlled.Fields();
  const limpid::StructureRow* ofData = scene.arrays.structureRows->GetPointer(0);
  const std::vector<limpid::StructureRow> rows = controlled.Rows(ofData);
  std::vector<float> importance(fields.importance, fields.importance + fields.ValueCount());
  fields.importance = fields.despeckled = importance.data();
  const limpid::LabelledScene labelled{ fields, importance.data(), *scene.structures, rows.data() };
  limpid::TargetsFound found = limpid::MeetTargets(labelled, this->LastChange,
    controlled.OfSolver(this->MakeProgress(), solver->Options()), solver);
  limpid::FillImportance(
    found.structures, ofData, scene.Fields().ValueCount(), scene.arrays.importance->GetPointer(0));
  controlled.PrepareData(scene.Fields());
  return found;
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

// Returns the number of result arrays that need a sweep through the data. Names that do not exist
// are refused elsewhere.
int vtkExtinctionOptimizer::Internals::ArraysOfSweeps() const
{
  const std::set<std::string>& wanted = this->Self->ResultArrays;
  return static_cast<int>(wanted.count("Transmittance") + wanted.count("LightTransmittance") +
    wanted.count("MissedImportance"));
}

// Returns the memory of a run in addition to its input, including results, for an image in which
// every point matters. Measured by Testing/Benchmarks/filter_memory.py with 192^3 and 256^3 points,
// a camera along y and a thick medium: 46 bytes per point with the policy and the extinction alone,
// 55 with all arrays, 57 and 71 in separate mode, 59 with temporal coherence (73 in separate mode),
// 94 if the viewpoint is optimised, and 86 with Adam; 5 less without despeckling.
double vtkExtinctionOptimizer::Internals::BytesPerPoint() const
{
  const bool adam = this->Self->GetSolver() == ADAM;
  const bool two = this->HasTwoExtinctions();
  const double minimised = adam ? 82 : 42;
  const double results = this->ArraysOfSweeps() > 0 && !adam ? 9 : 0;
  const double separate = two && !adam ? (results > 0 ? 15 : 12) : 0;
  const double viewpoint = this->Self->OptimizeViewpoint ? 47 : 0;
  const double despeckled = this->Self->GetImportanceSmoothing() == MEDIAN ? 5 : 0;
  const double coherent = this->Self->GetTemporalCoherence() > 0 ? (two ? 16 : 12) : 0;
  return minimised + results + separate + viewpoint + despeckled + coherent;
}

// Returns this memory in parts. Of the data, there are the extinctions that are written; both
// fields and what is derived from them, unless they are converted in layers: then some slices of
// them, and rays; and if results are measured, what sweeps need. Measured like the above at half
// and a third of the resolution: 22 bytes per point of the data and 5 of an eighth of them, 40 and
// 7 with all arrays, 32 and 7 in separate mode. In layers, 192^3, 256^3 and 512^3 points
// take 13.8, 10.7 and 7.2 bytes per point at a third of the resolution.
limpid::NeedPerNode vtkExtinctionOptimizer::Internals::Need(const limpid::Grid& data) const
{
  const bool two = this->HasTwoExtinctions();
  const double extinctions = two ? 8 : 4;
  const double written = extinctions + (this->Self->ResultArrays.count("Opacity") > 0 ? 4 : 0);
  const int swept = this->ArraysOfSweeps();
  const double ofSweeps = swept > 0 ? 4 * swept + 2 : 0;
  limpid::NeedPerNode need;
  constexpr double inSlices = 1600; // bytes per point of a slice
  const double slices = std::cbrt(double(std::max<limpid::Index>(data.NodeCount(), 1)));
  const double whole = 13 + extinctions;
  need.ofData = written + (this->SuitsLayers ? std::min(inSlices / slices, whole) : whole);
  need.measuring = written + extinctions + ofSweeps + (two ? 17 : 15) - need.ofData;
  need.ofControl = this->BytesPerPoint() - need.ofData;
  return need;
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
    limpidLog("%s", text.c_str());
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
  const limpid::ControlledScene& controlled, const limpid::Camera& camera,
  const limpid::Light& light) const
{
  const limpid::SceneFields scene = controlled.Fields();
  const std::vector<limpid::Camera> cameras = limpid::CamerasOf(
    limpid::ViewSetOf(this->Self->Settings), camera, limpid::OrbitStart::AtCamera);
  limpid::Settings settings = limpid::ForCameras(limpid::SettingsOf(this->Self->Settings), cameras);
  const limpid::Progress progress = controlled.OfSolver(this->MakeProgress(), settings);
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
    this->StartFromLastResult(controlled, *result.solver);
    result.solver->Run(progress);
  }
  return result;
}

void vtkExtinctionOptimizer::Internals::StartFromLastResult(
  const limpid::ControlledScene& scene, limpid::Solver& solver) const
{
  if (!this->Self->WarmStart || this->Self->GetMethod() != OPTIMIZED ||
    this->Self->GetMode() != JOINT)
  {
    return;
  }
  const limpid::SceneFields& data = scene.Data();
  const bool fits = this->LastNodes == data.grid.nodes &&
    limpid::HaveSameBoxes(this->LastPiece.get(), data.piece.get());
  const bool isThere = this->LastExtinction || data.ValueCount() == 0;
  if (!this->AnyRank(!fits || !isThere))
  {
    scene.Start(solver, this->LastExtinction ? this->LastExtinction->GetPointer(0) : nullptr);
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
  limpid::AddUnsolvedFields(
    scene.arrays, scene.unitDistance, this->HasTwoExtinctions(), this->WantedArrays(), output);
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
