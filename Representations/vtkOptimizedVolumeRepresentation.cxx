// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkOptimizedVolumeRepresentation.h"

#include "CapturedView.h"
#include "ControllerRanks.h"
#include "InputArrays.h"
#include "Memory.h"
#include "ScoreText.h"
#include "StructureLabels.h"
#include "vtkOptimizedVolumeRepresentationInternals.h"

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkOutlineSource.h"
#include "vtkPVRenderView.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkVolumeCollection.h"
#include "vtkVolumeProperty.h"

#include "distributed/Communicator.h"

#include <algorithm>
#include <array>
#include <exception>
#include <set>
#include <sstream>

vtkStandardNewMacro(vtkOptimizedVolumeRepresentation);
vtkStandardNewMacro(vtkRepresentedVolumeMapper);

namespace
{
void GetBounds(vtkDataObject* input, double bounds[6])
{
  if (auto* data = vtkDataSet::SafeDownCast(input))
  {
    data->GetBounds(bounds);
  }
  else if (auto* blocks = vtkCompositeDataSet::SafeDownCast(input))
  {
    blocks->GetBounds(bounds);
  }
}

bool HasSeveralOptimizedVolumes(vtkRenderer* renderer)
{
  int count = 0;
  vtkVolumeCollection* volumes = renderer->GetVolumes();
  vtkCollectionSimpleIterator position;
  volumes->InitTraversal(position);
  while (vtkVolume* volume = volumes->GetNextVolume(position))
  {
    const bool optimized = vtkTransmittanceVolumeMapper::SafeDownCast(volume->GetMapper());
    count += optimized && volume->GetVisibility() ? 1 : 0;
  }
  return count > 1;
}
}

vtkOptimizedVolumeRepresentation::vtkOptimizedVolumeRepresentation()
  : State(new Internals)
{
  this->VolumeMapper = this->State->Mapper;
  this->Property->SetInterpolationTypeToLinear(); // other requests are reported by AddUnavailable
  this->State->Mapper->Prop = this->Actor;
  this->State->Mapper->SharesImageOn();
  this->State->Annotation->SetTextSource(
    [this]()
    {
      const Internals& state = *this->State;
      const std::string name = state.TellsName ? state.SourceName : std::string();
      const bool speaks = !this->Others() || this->Others()->GetLocalProcessId() == 0;
      const bool isSaved = state.View && limpid::IsCaptured(state.View);
      const bool isWanted = state.ShowScore && (!isSaved || state.ScoreInScreenshots);
      const bool hasDrawn = state.Mapper->HasDrawn;
      std::string text = speaks && isWanted && (hasDrawn || this->HasSomethingToDraw())
        ? limpid::ScoreText(state.Mapper, hasDrawn, name)
        : std::string();
      text += text.empty() || state.Sampled.text.empty() ? "" : "\n" + state.Sampled.text;
      return text;
    });
  this->State->Annotation->SetLegendSource(
    [this]()
    {
      const Internals& state = *this->State;
      state.Annotation->SetLegendColor(state.Mapper->GetMissedColor());
      return state.Mapper->HasDrawn ? limpid::MissedText(state.Mapper) : std::string();
    });
  this->State->Annotation->SetStructureSource(
    [this]()
    {
      const Internals& state = *this->State;
      const bool isWanted = state.StructureLegend && state.Mapper->HasDrawn;
      return isWanted ? state.Mapper->GetStructureLegendTable() : nullptr;
    });
}

// The renderer skips what is not in view. A client whose server draws has no data.
bool vtkOptimizedVolumeRepresentation::HasSomethingToDraw()
{
  vtkDataSet* input = this->State->Mapper->GetDataSetInput();
  return this->State->Refusal.empty() && this->Actor->GetVisibility() && input &&
    input->GetNumberOfPoints() > 0;
}

vtkOptimizedVolumeRepresentation::~vtkOptimizedVolumeRepresentation()
{
  this->State->Annotation->SetTextSource(nullptr); // a renderer may outlive this object's text
  this->State->Annotation->SetLegendSource(nullptr);
  this->State->Annotation->SetStructureSource(nullptr);
}

int vtkOptimizedVolumeRepresentation::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

// Returns the names of the arrays that are used; empty: any may be.
std::set<std::string> vtkOptimizedVolumeRepresentation::ArraysUsed()
{
  const Internals& state = *this->State;
  std::set<std::string> names = limpid::ChosenNames(this);
  if (names.count("") > 0)
  {
    return {}; // without a choice, whatever there is may be shown
  }
  const std::string& importance = state.ImportanceArray;
  const bool isNamed = !importance.empty() && importance.front() != '(';
  if (state.ImportanceGiven && isNamed)
  {
    names.insert(importance);
  }
  if (state.Mapper->GetExtinctionSource() == vtkTransmittanceVolumeMapper::ARRAY)
  {
    names.insert(state.Mapper->GetExtinctionArray());
  }
  return names;
}

// Returns whether the samples have all arrays that are used.
bool vtkOptimizedVolumeRepresentation::HasSampled(const std::set<std::string>& names) const
{
  const std::set<std::string>& sampled = this->State->SampledArrays;
  return sampled.empty() ||
    (!names.empty() && std::includes(sampled.begin(), sampled.end(), names.begin(), names.end()));
}

// Samples input that is no image, unless that was done. Returns why it cannot be drawn; empty if it
// can.
std::string vtkOptimizedVolumeRepresentation::Sample(vtkDataObject* input)
{
  Internals& state = *this->State;
  if (!input || vtkImageData::SafeDownCast(input))
  {
    state.Sampled = {};
    return {};
  }
  limpid::DataSampling sampling;
  sampling.dimensions = state.ImageDimensions;
  sampling.labels = { limpid::ChosenName(this, limpid::structureArray) };
  sampling.wanted = this->ArraysUsed();
  sampling.further = { "Importance" };
  std::ostringstream of;
  of << input->GetMTime() << ' ' << *sampling.labels.begin();
  for (const int points : sampling.dimensions)
  {
    of << ' ' << points;
  }
  try
  {
    const std::shared_ptr<const limpid::Communicator> ranks = limpid::MakeRanks();
    const bool isOther = ranks->AnyOf(!state.Sampled.image || of.str() != state.SampledOf);
    if (!isOther && this->HasSampled(sampling.wanted))
    {
      return {};
    }
    if (!isOther)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        sampling.dimensions[axis] = state.Sampled.extent[2 * axis + 1] + 1;
      }
      if (!sampling.wanted.empty())
      {
        sampling.wanted.insert(state.SampledArrays.begin(), state.SampledArrays.end());
      }
    }
    state.Sampled = {};
    state.Sampled = limpid::NotifyingOnFailure(
      *ranks, [&] { return limpid::SampleData(input, sampling, *ranks); });
    state.SampledOf = of.str();
    state.SampledArrays = sampling.wanted;
    return {};
  }
  catch (const std::exception& error)
  {
    vtkImageData* none = nullptr;
    return limpid::MessageOf(error, none, limpid::MemoryNeed{ 100, limpid::fewerPoints });
  }
}

// Samples arrays that are used now and were not when the input was read.
void vtkOptimizedVolumeRepresentation::SampleFurther()
{
  Internals& state = *this->State;
  if (!state.Sampled.image || this->HasSampled(this->ArraysUsed()))
  {
    return;
  }
  state.Refusal = this->Sample(this->GetInputDataObject(0, 0));
  for (vtkDataObject* shown : { vtkDataObject::SafeDownCast(this->Cache),
         vtkDataObject::SafeDownCast(this->VolumeMapper->GetDataSetInput()) })
  {
    auto* image = vtkImageData::SafeDownCast(shown);
    if (image && state.Sampled.image)
    {
      image->GetPointData()->ShallowCopy(state.Sampled.image->GetPointData());
      image->GetCellData()->ShallowCopy(state.Sampled.image->GetCellData());
    }
  }
}

int vtkOptimizedVolumeRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = inputVector[0]->GetNumberOfInformationObjects() > 0
    ? vtkDataObject::GetData(inputVector[0], 0)
    : nullptr;
  this->State->Refusal = this->Sample(input);
  if (this->State->Refusal.empty())
  {
    vtkSmartPointer<vtkInformationVector> image = inputVector[0];
    if (this->State->Sampled.image)
    {
      image = limpid::WithImage(inputVector[0], this->State->Sampled);
    }
    vtkInformationVector* inputs = image;
    const int result = this->Superclass::RequestData(request, &inputs, outputVector);
    this->State->Mapper->SetWholeExtent(this->WholeExtent);
    return result;
  }
  // Displays an outline, which shows where the data are.
  GetBounds(input, this->DataBounds);
  this->OutlineSource->SetBounds(this->DataBounds);
  this->OutlineSource->Update();
  this->DataSize = 0;
  this->Cache = vtkSmartPointer<vtkImageData>::New();
  this->Actor->SetEnableLOD(1);
  // The direct base class would require an image to draw.
  // NOLINTNEXTLINE(bugprone-parent-virtual-call)
  return this->vtkVolumeRepresentation::RequestData(request, inputVector, outputVector);
}

void vtkOptimizedVolumeRepresentation::UpdateMapperParameters()
{
  this->Superclass::UpdateMapperParameters();
  this->SampleFurther();
  std::vector<std::string> messages;
  if (!this->State->Refusal.empty())
  {
    messages.push_back(this->State->Refusal);
    this->Actor->SetVisibility(1); // the outline
    this->State->Mapper->ClearResults();
  }
  else if (auto* image = vtkImageData::SafeDownCast(this->VolumeMapper->GetDataSetInput()))
  {
    vtkDataArray* scalars = this->ApplyScalars(image, messages);
    this->AddUnavailable(scalars ? scalars->GetNumberOfComponents() : 0, messages);
  }
  this->Say(messages);
}

void vtkOptimizedVolumeRepresentation::SetVisibility(bool visible)
{
  if (this->GetVisibility() && !visible)
  {
    this->State->Mapper->ReleaseMemory();
  }
  this->Superclass::SetVisibility(visible);
  this->State->Annotation->SetVisibility(visible);
}

bool vtkOptimizedVolumeRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView || !this->Superclass::AddToView(view))
  {
    return false;
  }
  vtkRenderer* renderer = renderView->GetRenderer();
  this->State->View = renderView;
  renderer->AddViewProp(this->State->Annotation);
  this->State->Observers = { renderer->AddObserver(vtkCommand::StartEvent, this,
                               &vtkOptimizedVolumeRepresentation::BeginFrame),
    renderer->AddObserver(
      vtkCommand::EndEvent, this, &vtkOptimizedVolumeRepresentation::EndFrame) };
  return true;
}

bool vtkOptimizedVolumeRepresentation::RemoveFromView(vtkView* view)
{
  if (auto* renderView = vtkPVRenderView::SafeDownCast(view))
  {
    vtkRenderer* renderer = renderView->GetRenderer();
    renderer->RemoveViewProp(this->State->Annotation);
    for (const unsigned long observer : this->State->Observers)
    {
      renderer->RemoveObserver(observer);
    }
    this->State->Observers.clear();
    this->State->Mapper->ReleaseMemory();
  }
  return this->Superclass::RemoveFromView(view);
}

void vtkOptimizedVolumeRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ImportanceArray: " << this->State->ImportanceArray << "\n";
  os << indent << "ShowScore: " << this->State->ShowScore << "\n";
  os << indent << "ScoreInScreenshots: " << this->State->ScoreInScreenshots << "\n";
  os << indent << "StructureLegend: " << this->State->StructureLegend << "\n";
  os << indent << "SourceName: " << this->State->SourceName << "\n";
  os << indent << "Messages: " << this->GetMessages() << "\n";
}

// By default, ParaView peels volumes even if nothing needs it. If no volume of the view does, the
// picture is drawn in one pass and need not be read back.
void vtkOptimizedVolumeRepresentation::BeginFrame(vtkObject* object, unsigned long, void*)
{
  this->State->Mapper->HasDrawn = false;
  auto* renderer = static_cast<vtkRenderer*>(object);
  this->State->TellsName = HasSeveralOptimizedVolumes(renderer);
  const bool needed = !this->State->Mapper->DrawsOnSeveralRanks() &&
    vtkTransmittanceVolumeMapper::NeedsDepthPeeling(renderer);
  this->State->PeelsVolumes =
    this->GetVisibility() && renderer->GetUseDepthPeelingForVolumes() && !needed;
  if (this->State->PeelsVolumes)
  {
    renderer->UseDepthPeelingForVolumesOff();
  }
  // Whether a picture is saved is known to one process only, and all must measure together.
  const bool isSaved =
    !this->Others() && this->State->View && limpid::IsCaptured(this->State->View);
  this->State->Mapper->TellsShares =
    this->State->ShowScore && (!isSaved || this->State->ScoreInScreenshots);
  if (this->Others())
  {
    // Processes that draw together wait for each other, so all must take part in every frame.
    this->State->Annotation->ClaimView(renderer);
  }
}

void vtkOptimizedVolumeRepresentation::EndFrame(vtkObject* object, unsigned long, void*)
{
  if (this->State->PeelsVolumes)
  {
    static_cast<vtkRenderer*>(object)->UseDepthPeelingForVolumesOn();
    this->State->PeelsVolumes = false;
  }
  this->State->Annotation->ClaimNothing();
}

void vtkRepresentedVolumeMapper::Render(vtkRenderer* renderer, vtkVolume*)
{
  this->HasDrawn = true;
  this->vtkTransmittanceVolumeMapper::Render(renderer, this->Prop);
  if (this->TellsShares && !this->GetProgressiveStill() && limpid::NeedsShares(this))
  {
    this->GetStructureTable();
  }
}
