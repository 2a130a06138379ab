// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkVisibilityAlgorithmScene.h"

#include "Choices.h"
#include "InputArrays.h"
#include "Memory.h"
#include "OptimizedImage.h"
#include "SettingsConversion.h"
#include "SharedArray.h"
#include "StructureLabels.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace
{
double MeanCellLength(const limpid::Grid& grid)
{
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    cells *= std::max(grid.nodes[axis] - 1, 1);
  }
  const double length = 2 * grid.Radius() / std::cbrt(cells);
  return length > 0 ? length : grid.spacing[0]; // a single point has no length
}

bool AreSeveralProcesses()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1;
}

// Returns whether one extent contains another; every extent contains an empty one.
bool Covers(const int extent[6], const int part[6])
{
  bool covers = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int* own = extent + 2 * axis;
    const int* wanted = part + 2 * axis;
    if (wanted[1] < wanted[0])
    {
      return true;
    }
    covers = covers && own[0] <= wanted[0] && wanted[1] <= own[1];
  }
  return covers;
}

std::string FormatExtent(const int extent[6])
{
  std::ostringstream words;
  words << extent[0] << ".." << extent[1] << " " << extent[2] << ".." << extent[3] << " "
        << extent[4] << ".." << extent[5];
  return words.str();
}
}

namespace limpid
{
SceneFields ImageScene::Fields() const
{
  SceneFields fields;
  fields.grid = this->grid;
  fields.majorant = this->majorant;
  if (this->layered)
  {
    return fields;
  }
  fields.baseExtinction = this->arrays.baseExtinction->GetPointer(0);
  fields.importance = this->arrays.importance->GetPointer(0);
  SetReferences(this->arrays.references, fields);
  fields.despeckled = this->structures ? fields.importance : nullptr; // labels have no noise
  fields.piece = this->piece;
  return fields;
}
}

vtkImageData* vtkVisibilityAlgorithm::SceneReader::RequireWholeImage(
  vtkInformationVector** inputVector) const
{
  const std::string refusal =
    limpid::RefusalOf(vtkDataObject::GetData(inputVector[0]), "this filter works on");
  LIMPID_REQUIRE(refusal.empty(), refusal);
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  LIMPID_REQUIRE(input && input->GetNumberOfPoints() > 0,
    "The input has no points (there is nothing to process). Give it an image with data.");
  vtkInformation* info = inputVector[0]->GetInformationObject(0);
  const int* whole = info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  const int* extent = input->GetExtent();
  LIMPID_REQUIRE(!whole || Covers(extent, whole),
    (AreSeveralProcesses() ? "This process has only the extent " : "The input has only the extent ")
      << FormatExtent(extent) << " of " << FormatExtent(whole)
      << " (occluders in the rest would be missed, and filters after this one would read the rest "
         "from uninitialized memory). "
      << (AreSeveralProcesses()
             ? "Run with one process, or read from a source that can give the whole image to each "
               "process."
             : "Give an image that covers the whole extent its source announces, or let the source "
               "announce the extent it produces."));
  return input;
}

bool vtkVisibilityAlgorithm::SceneReader::IsMesh(vtkInformationVector** inputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  return input && !vtkImageData::SafeDownCast(input);
}

limpid::SampledData vtkVisibilityAlgorithm::SceneReader::Sample(
  vtkDataObject* data, const limpid::Communicator& ranks, bool isWholeOnAll) const
{
  limpid::DataSampling sampling;
  sampling.isWholeOnAll = isWholeOnAll;
  sampling.labels = { limpid::ChosenName(this->Self, limpid::structureArray) };
  sampling.wanted = limpid::ChosenNames(this->Self);
  // FindArray takes some of them, and the user is warned if others are replaced.
  const std::vector<std::string>& results = limpid::ResultArrays::All();
  sampling.further.insert(results.begin(), results.end());
  return limpid::SampleData(data, sampling, ranks);
}

void vtkVisibilityAlgorithm::SceneReader::RequireUnitDistance() const
{
  const double unitDistance = this->Self->ScalarOpacityUnitDistance;
  LIMPID_REQUIRE(unitDistance >= 0 && std::isfinite(unitDistance),
    "ScalarOpacityUnitDistance is " << unitDistance
                                    << " (it is the distance over which opacities apply). Set a "
                                       "length above zero, or zero for the mean length of a cell.");
  LIMPID_REQUIRE(unitDistance == 0 ||
      (unitDistance >= limpid::leastLength && unitDistance <= limpid::mostLength),
    "ScalarOpacityUnitDistance is "
      << unitDistance << " (extinctions in single precision allow distances from "
      << limpid::leastLength << " to " << limpid::mostLength
      << "). Set a distance in this range, or zero for the mean length of a cell.");
}

limpid::ImageScene vtkVisibilityAlgorithm::SceneReader::Read(vtkImageData* input,
  int extinctionSource, const std::function<bool(const limpid::ImageScene&)>& inLayers) const
{
  limpid::ImageScene scene;
  scene.grid = limpid::GridOfImage(input);
  this->ReadUnits(extinctionSource, scene);
  Assumed assumed;
  if (extinctionSource != ARRAY && !this->HasOpacityFunction())
  {
    assumed.range = this->RangeOfScalars(input);
  }
  const limpid::ImportanceChoice importance = this->ChooseImportance(input);
  if (importance.IsAssumed(this->Self->Settings))
  {
    assumed.importance =
      limpid::StartingImportance(limpid::SharedArray(importance.scalars, input, nullptr, nullptr));
  }
  const Sources sources = this->SourcesOf(input, extinctionSource, assumed, scene);
  const std::vector<limpid::FieldSource> references = limpid::ReferenceSources(this->Self, input);
  const bool hasReferences = std::any_of(references.begin(), references.end(),
    [](const limpid::FieldSource& reference) { return reference.array != nullptr; });
  if (inLayers && !hasReferences &&
    limpid::LayeredFields::Suit(input, sources.extinction, sources.importance) && inLayers(scene))
  {
    scene.layered =
      std::make_shared<limpid::LayeredFields>(input, sources.extinction, sources.importance);
  }
  else
  {
    this->Convert(input, sources, scene);
  }
  this->Warn(assumed, scene);
  return scene;
}

std::array<int, 6> vtkVisibilityAlgorithm::SceneReader::WholeExtentOf(
  vtkInformationVector** inputVector)
{
  vtkInformation* info = inputVector[0]->GetInformationObject(0);
  vtkImageData* image = vtkImageData::GetData(info);
  std::array<int, 6> whole{ { 0, -1, 0, -1, 0, -1 } };
  if (info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
  {
    info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole.data());
  }
  else if (image)
  {
    image->GetExtent(whole.data());
  }
  return whole;
}

void vtkVisibilityAlgorithm::SceneReader::RequestPiece(
  vtkInformation* outInfo, vtkInformationVector** inputVector)
{
  // One layer of ghost cells is requested, so that averages of cells at the piece's points are
  // complete.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* info = inputVector[0]->GetInformationObject(0);
  info->Set(Pipeline::UPDATE_PIECE_NUMBER(), outInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()));
  info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), outInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()));
  info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(),
    std::max(outInfo->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()), 1));
}

limpid::ImageScene vtkVisibilityAlgorithm::SceneReader::ReadShared(
  const std::shared_ptr<const limpid::Communicator>& all, vtkInformationVector** inputVector,
  int extinctionSource) const
{
  const std::string refusal =
    limpid::RefusalOf(vtkDataObject::GetData(inputVector[0]), "this filter works on");
  LIMPID_REQUIRE(refusal.empty(), refusal);
  const limpid::SharedImage shared(
    all, vtkImageData::GetData(inputVector[0]), WholeExtentOf(inputVector));
  const limpid::Communicator& ranks = *shared.piece->ranks;
  const bool empty = shared.piece->nodes.Empty(); // and has no arrays
  limpid::ImageScene scene;
  scene.grid = shared.grid;
  scene.piece = shared.piece;
  this->ReadUnits(extinctionSource, scene);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Assumed assumed;
  ScalarRange& range = assumed.range = { none, none };
  if (extinctionSource != ARRAY && !this->HasOpacityFunction())
  {
    limpid::RequireOnAllRanks(
      ranks, [&] { range = empty ? range : this->RangeOfScalars(shared.image); });
    limpid::JoinRange(ranks, range[0], range[1]);
  }
  this->AssumeShared(shared, WholeExtentOf(inputVector), assumed);
  limpid::RequireOnAllRanks(ranks,
    [&]
    {
      if (empty)
      {
        scene.arrays.baseExtinction = limpid::NewArray<vtkFloatArray>("BaseExtinction", 0);
        scene.arrays.importance = limpid::NewArray<vtkFloatArray>("Importance", 0);
        return;
      }
      this->Convert(
        shared.image, this->SourcesOf(shared.image, extinctionSource, assumed, scene), scene);
    });
  shared.CopyFromOwners(scene.arrays.baseExtinction);
  shared.CopyFromOwners(scene.arrays.importance);
  for (vtkSmartPointer<vtkFloatArray>& reference : scene.arrays.references)
  {
    if (ranks.AnyOf(reference != nullptr))
    {
      reference = empty ? limpid::NewArray<vtkFloatArray>("Reference", 0) : reference;
      shared.CopyFromOwners(reference);
    }
  }
  this->Warn(assumed, scene);
  return scene;
}

// Makes the assumptions for an image that ranks share. If some ranks have an importance array, all
// should have one.
void vtkVisibilityAlgorithm::SceneReader::AssumeShared(
  const limpid::SharedImage& shared, const std::array<int, 6>& whole, Assumed& assumed) const
{
  const limpid::Communicator& ranks = *shared.piece->ranks;
  limpid::FieldSource scalars;
  bool isThere = false;
  bool assumes = false;
  limpid::RequireOnAllRanks(ranks,
    [&]
    {
      if (!shared.piece->nodes.Empty())
      {
        const limpid::ImportanceChoice importance = this->ChooseImportance(shared.image);
        assumes = importance.IsAssumed(this->Self->Settings);
        isThere = importance.array.array != nullptr;
        scalars = importance.scalars;
      }
    });
  assumed.isThere = ranks.AnyOf(isThere);
  if (!assumed.isThere && ranks.AnyOf(assumes))
  {
    assumed.importance = limpid::StartingImportance(limpid::SharedArray(scalars, shared.image,
      whole.data(), vtkMultiProcessController::GetGlobalController(), &shared.piece->Owned()));
  }
}

void vtkVisibilityAlgorithm::SceneReader::Warn(
  const Assumed& assumed, const limpid::ImageScene& scene) const
{
  if (assumed.importance)
  {
    vtkWarningWithObjectMacro(this->Self, << limpid::WarningOf(*assumed.importance));
  }
  if (!scene.warning.empty())
  {
    vtkWarningWithObjectMacro(this->Self, << scene.warning);
  }
  if (!scene.layered)
  {
    this->WarnOfValues(scene);
  }
}

void vtkVisibilityAlgorithm::SceneReader::WarnOfValues(const limpid::ImageScene& scene) const
{
  const std::string warning = scene.layered
    ? scene.layered->Warning()
    : scene.arrays.unusable.Warning(scene.arrays.baseExtinction->GetNumberOfTuples());
  if (!warning.empty())
  {
    vtkWarningWithObjectMacro(this->Self, << warning);
  }
}

bool vtkVisibilityAlgorithm::SceneReader::HasOpacityFunction() const
{
  vtkPiecewiseFunction* function = this->Self->ScalarOpacityFunction;
  return function && function->GetSize() > 0;
}

void vtkVisibilityAlgorithm::SceneReader::ReadUnits(
  int extinctionSource, limpid::ImageScene& scene) const
{
  scene.unitDistance = this->Self->ScalarOpacityUnitDistance == 0
    ? MeanCellLength(scene.grid)
    : this->Self->ScalarOpacityUnitDistance;
  vtkPiecewiseFunction* opacity = this->Self->ScalarOpacityFunction;
  if (extinctionSource == OPACITY_FUNCTION && opacity)
  {
    scene.majorant = static_cast<float>(
      limpid::ExtinctionOfOpacity(limpid::LargestValue(opacity), scene.unitDistance));
  }
}

vtkVisibilityAlgorithm::SceneReader::Sources vtkVisibilityAlgorithm::SceneReader::SourcesOf(
  vtkImageData* input, int extinctionSource, const Assumed& assumed,
  limpid::ImageScene& scene) const
{
  Sources sources;
  sources.extinction = extinctionSource == ARRAY
    ? this->ExtinctionArray(input)
    : this->OpacityOfScalars(input, scene.unitDistance, assumed.range);
  sources.importance = this->ImportanceSource(input, assumed);
  if (extinctionSource == ARRAY)
  {
    scene.taken.push_back(sources.extinction.array);
  }
  scene.structures = sources.importance.structures;
  scene.warning = limpid::WarningOf(sources.importance);
  if (!assumed.importance && !scene.structures && !this->Self->GetUseImportanceFunction() &&
    sources.importance.array->GetNumberOfComponents() == 1)
  {
    scene.taken.push_back(sources.importance.array);
  }
  return sources;
}

void vtkVisibilityAlgorithm::SceneReader::Convert(
  vtkImageData* input, const Sources& sources, limpid::ImageScene& scene) const
{
  scene.arrays = limpid::ConvertScene(input, sources.extinction, sources.importance);
  std::size_t number = 0;
  for (const limpid::FieldSource& reference : limpid::ReferenceSources(this->Self, input))
  {
    scene.arrays.references[number] =
      reference.array ? limpid::ConvertField(input, reference, "Reference") : nullptr;
    scene.taken.push_back(reference.array);
    ++number;
  }
}

// Returns the chosen array, or else the array named `fallback`, or, if that is null, the active
// scalars. The array is null if there is none.
limpid::FieldSource vtkVisibilityAlgorithm::SceneReader::FindArray(
  int index, const char* fallback, vtkImageData* input) const
{
  const std::string chosen = limpid::ChosenName(this->Self, index);
  if (!chosen.empty())
  {
    vtkInformation* information = this->Self->GetInputArrayInformation(index);
    return limpid::FindField(input, chosen, information->Get(vtkDataObject::FIELD_ASSOCIATION()));
  }
  if (fallback)
  {
    return limpid::FindField(input, fallback, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS);
  }
  limpid::FieldSource active;
  active.array = input->GetPointData()->GetScalars();
  return active;
}

limpid::FieldSource vtkVisibilityAlgorithm::SceneReader::RequireArray(
  int index, const char* role, const char* fallback, vtkImageData* input) const
{
  limpid::FieldSource source = this->FindArray(index, fallback, input);
  const std::string chosen = limpid::ChosenName(this->Self, index);
  LIMPID_REQUIRE(source.array,
    "The " << role << " array \""
           << (chosen.empty() ? (fallback ? fallback : "(the active scalars)") : chosen)
           << "\" is not among the input's numeric arrays (the scene cannot be built without it). "
              "Choose one of these: "
           << limpid::ArrayNames(input) << ".");
  return source;
}

limpid::ImportanceChoice vtkVisibilityAlgorithm::SceneReader::ChooseImportance(
  vtkImageData* input) const
{
  const std::string name = limpid::ChosenName(this->Self, 1);
  limpid::ImportanceChoice choice;
  choice.name = name.empty() ? "Importance" : name;
  choice.isChosen = !name.empty();
  choice.array = this->FindArray(1, "Importance", input);
  choice.labels = limpid::StructureSource(this->Self, this->Self->Settings, input);
  if (!choice.labels.array && !choice.array.array && !choice.isChosen &&
    this->FindArray(0, nullptr, input).array)
  {
    choice.scalars = this->Scalars(input);
  }
  return choice;
}

limpid::FieldSource vtkVisibilityAlgorithm::SceneReader::ImportanceSource(
  vtkImageData* input, const Assumed& assumed) const
{
  const limpid::ScalarMapping mapping =
    assumed.importance ? limpid::MappingOf(*assumed.importance) : limpid::KeepValue();
  limpid::ImportanceChoice choice = this->ChooseImportance(input);
  choice.isChosen = choice.isChosen || assumed.isThere;
  return choice.Source(this->Self->Settings, mapping, input);
}

limpid::FieldSource vtkVisibilityAlgorithm::SceneReader::ExtinctionArray(vtkImageData* input) const
{
  limpid::FieldSource source = this->RequireArray(2, "extinction", "BaseExtinction", input);
  LIMPID_REQUIRE(source.array->GetNumberOfComponents() == 1,
    "The extinction array \""
      << limpid::NameOf(source.array) << "\" has " << source.array->GetNumberOfComponents()
      << " components (extinction is one number per point). Choose an array with one component.");
  return source;
}

limpid::FieldSource vtkVisibilityAlgorithm::SceneReader::Scalars(vtkImageData* input) const
{
  limpid::FieldSource source = this->RequireArray(0, "scalar", nullptr, input);
  source.component = this->Self->Settings->GetScalarComponent();
  limpid::RequireComponent("ScalarComponent", source.array, source.component);
  return source;
}

vtkVisibilityAlgorithm::SceneReader::ScalarRange
vtkVisibilityAlgorithm::SceneReader::RangeOfScalars(vtkImageData* input) const
{
  const limpid::FieldSource scalars = this->Scalars(input);
  ScalarRange range{};
  limpid::FiniteRange(scalars.array, scalars.component, range[0], range[1]);
  return range;
}

/// `range`: of the ramp that is used if there is no opacity function.
limpid::FieldSource vtkVisibilityAlgorithm::SceneReader::OpacityOfScalars(
  vtkImageData* input, double unitDistance, const ScalarRange& range) const
{
  limpid::FieldSource source = this->Scalars(input);
  const limpid::ScalarMapping opacity = this->HasOpacityFunction()
    ? limpid::Evaluate(this->Self->ScalarOpacityFunction)
    : limpid::Ramp(range[0], range[1]);
  source.mapping = [opacity, unitDistance](double value)
  { return limpid::ExtinctionOfOpacity(opacity(value), unitDistance); };
  return source;
}
