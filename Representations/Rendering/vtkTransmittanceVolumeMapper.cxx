// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkTransmittanceVolumeMapper.h"

#include "PropertyPrinter.h"
#include "vtkTransmittanceVolumeMapperInternals.h"

#include "vtkCollection.h"
#include "vtkCuller.h"
#include "vtkCullerCollection.h"
#include "vtkDataObject.h"
#include "vtkFrustumCoverageCuller.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <array>
#include <utility>

vtkStandardNewMacro(vtkTransmittanceVolumeMapper);

vtkTransmittanceVolumeMapper::vtkTransmittanceVolumeMapper()
  : Settings(vtkSmartPointer<vtkVisibilitySettings>::New())
  , State(new Internals(this))
{
  this->Settings->SetScalarComponent(UNDECIDED);
  this->Settings->SetRestrictToView(1);
  static_assert(vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS == 3,
    "the default of ImportanceArrayAssociation and ExtinctionArrayAssociation in the header");
}

vtkTransmittanceVolumeMapper::~vtkTransmittanceVolumeMapper() = default;

void vtkTransmittanceVolumeMapper::SetVisibilitySettings(vtkVisibilitySettings* settings)
{
  if (settings && settings != this->Settings)
  {
    this->Settings = settings;
    this->Modified();
  }
}

namespace
{
// Sets the name of an array. Returns whether it has changed.
bool Rename(std::string& array, const char* name)
{
  const std::string before = std::exchange(array, name ? name : "");
  return array != before;
}
}

void vtkTransmittanceVolumeMapper::SetImportanceArray(const char* name)
{
  if (Rename(this->ImportanceArray, name))
  {
    this->Modified();
  }
}

const char* vtkTransmittanceVolumeMapper::GetImportanceArray() const
{
  return this->ImportanceArray.c_str();
}

void vtkTransmittanceVolumeMapper::SetExtinctionArray(const char* name)
{
  if (Rename(this->ExtinctionArray, name))
  {
    this->Modified();
  }
}

const char* vtkTransmittanceVolumeMapper::GetExtinctionArray() const
{
  return this->ExtinctionArray.c_str();
}

void vtkTransmittanceVolumeMapper::SetMissedColor(double red, double green, double blue)
{
  std::array<double, 3> color{ { red, green, blue } };
  for (double& channel : color)
  {
    channel = limpid::Clamped(this, "A channel of MissedColor", channel, 0, 1);
  }
  if (!std::equal(color.begin(), color.end(), this->MissedColor))
  {
    std::copy(color.begin(), color.end(), this->MissedColor);
    this->Modified();
  }
}

void vtkTransmittanceVolumeMapper::SetMissedColor(const double color[3])
{
  this->SetMissedColor(color[0], color[1], color[2]);
}

void vtkTransmittanceVolumeMapper::AddLabelColor(
  double label, double red, double green, double blue)
{
  this->State->LabelColors.push_back({ label, { { red, green, blue } } });
  this->Modified();
}

void vtkTransmittanceVolumeMapper::RemoveAllLabelColors()
{
  if (!this->State->LabelColors.empty())
  {
    this->State->LabelColors.clear();
    this->Modified();
  }
}

int vtkTransmittanceVolumeMapper::GetNumberOfLabelColors() const
{
  return static_cast<int>(this->State->LabelColors.size());
}

void vtkTransmittanceVolumeMapper::SetAssumedImportance(vtkPiecewiseFunction* function)
{
  if (function != this->AssumedImportance)
  {
    this->AssumedImportance = function;
    this->Modified();
  }
}

void vtkTransmittanceVolumeMapper::Reset()
{
  for (const auto& view : this->State->Views)
  {
    view->Reset();
  }
  this->Modified();
}

void vtkTransmittanceVolumeMapper::ClearResults()
{
  this->State->Last = limpid::FrameResult();
}

double vtkTransmittanceVolumeMapper::GetVisibilityScore() const
{
  return this->State->Last.score.visibility;
}

double vtkTransmittanceVolumeMapper::GetBaseVisibilityScore() const
{
  return this->State->Last.baseScore.visibility;
}

double vtkTransmittanceVolumeMapper::GetVisibleFraction() const
{
  return this->State->Last.score.fraction;
}

double vtkTransmittanceVolumeMapper::GetBaseVisibleFraction() const
{
  return this->State->Last.baseScore.fraction;
}

double vtkTransmittanceVolumeMapper::GetSacrificedFraction() const
{
  return this->State->Last.score.sacrificed;
}

double vtkTransmittanceVolumeMapper::GetAttainableFraction() const
{
  return this->State->Last.ceiling.fraction;
}

double vtkTransmittanceVolumeMapper::GetAttainableScore() const
{
  return this->State->Last.ceiling.visibility;
}

double vtkTransmittanceVolumeMapper::GetAttainableLightScore() const
{
  return this->State->Last.ceiling.lightVisibility;
}

vtkTable* vtkTransmittanceVolumeMapper::GetStructureLegendTable()
{
  return this->State->LegendOfStructures();
}

vtkTable* vtkTransmittanceVolumeMapper::GetStructureTable()
{
  this->State->MeasureStructures();
  return this->State->KnownStructures();
}

vtkTable* vtkTransmittanceVolumeMapper::GetKnownStructureTable()
{
  return this->State->KnownStructures();
}

bool vtkTransmittanceVolumeMapper::GetStructuresMeasured() const
{
  return !this->State->CanMeasureStructures() || this->State->Shown->SharesOfStructures();
}

vtkIdType vtkTransmittanceVolumeMapper::PickStructure(double x, double y) const
{
  const bool canPick = this->State->Shown && this->State->Ranks->IsAlone();
  return canPick ? vtkIdType(this->State->Shown->PickStructure(x, y, this->State->Data)) - 1 : -1;
}

bool vtkTransmittanceVolumeMapper::GetConverged() const
{
  return this->State->Last.converged;
}

bool vtkTransmittanceVolumeMapper::GetMeasured() const
{
  return this->State->Last.measured;
}

bool vtkTransmittanceVolumeMapper::GetSettled() const
{
  return this->State->Last.settled;
}

int vtkTransmittanceVolumeMapper::GetIterations() const
{
  return this->State->Last.iterations;
}

const char* vtkTransmittanceVolumeMapper::GetLightDescription() const
{
  return this->State->Last.light.c_str();
}

const char* vtkTransmittanceVolumeMapper::GetMethodName()
{
  const int method = this->GetMethod();
  const bool exists = method >= 0 && method < limpid::methodCount;
  return exists ? limpid::InfoOf(static_cast<limpid::Method>(method)).name : "";
}

const char* vtkTransmittanceVolumeMapper::GetBackendName() const
{
  return this->State->Last.backend.c_str();
}

const char* vtkTransmittanceVolumeMapper::GetOptimizedAt() const
{
  return this->State->Last.optimizedAt.c_str();
}

const char* vtkTransmittanceVolumeMapper::GetDrawnBy() const
{
  return this->State->Last.drawnBy.c_str();
}

vtkIdType vtkTransmittanceVolumeMapper::GetUploadedBytes() const
{
  return static_cast<vtkIdType>(this->State->Last.uploadedBytes);
}

const char* vtkTransmittanceVolumeMapper::GetMessages() const
{
  return this->State->Messages.c_str();
}

void vtkTransmittanceVolumeMapper::SortBackToFront(vtkRenderer* renderer)
{
  vtkCullerCollection* cullers = renderer->GetCullers();
  vtkCollectionSimpleIterator position;
  cullers->InitTraversal(position);
  while (vtkCuller* culler = cullers->GetNextCuller(position))
  {
    if (auto* sorting = vtkFrustumCoverageCuller::SafeDownCast(culler))
    {
      sorting->SetSortingStyleToBackToFront();
      return;
    }
  }
  vtkNew<vtkFrustumCoverageCuller> sorting;
  sorting->SetSortingStyleToBackToFront();
  renderer->AddCuller(sorting);
}

void vtkTransmittanceVolumeMapper::ReleaseMemory()
{
  this->State->ReleaseMemory();
}

bool vtkTransmittanceVolumeMapper::PrepareOriginal()
{
  return this->State->PrepareOriginals();
}

void vtkTransmittanceVolumeMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  // An observer may remove this mapper from the volume, which may hold the only reference.
  const vtkSmartPointer<vtkTransmittanceVolumeMapper> alive = this;
  if (vtkHardwareSelector* selector = renderer->GetSelector())
  {
    this->State->RenderSelection(renderer, volume, selector);
  }
  else
  {
    this->State->Render(renderer, volume);
  }
}

void vtkTransmittanceVolumeMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  auto& views = this->State->Views;
  for (const auto& view : views)
  {
    if (view->IsOrphaned() || view->IsIn(window))
    {
      view->ReleaseGraphicsResources(window);
      view->Release();
    }
  }
  const bool unused = std::all_of(views.begin(), views.end(),
    [window](const auto& view) { return view->IsOrphaned() || view->IsIn(window); });
  if (unused)
  {
    this->ReleaseMemory();
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

bool vtkTransmittanceVolumeMapper::DrawsOnSeveralRanks() const
{
  return this->State->IsShared();
}

double* vtkTransmittanceVolumeMapper::GetBounds()
{
  auto* image = vtkImageData::SafeDownCast(this->GetDataObjectInput());
  return image && this->State->IsShared() ? this->State->FindWholeBounds(image, this->Bounds)
                                          : this->Superclass::GetBounds();
}

vtkMTimeType vtkTransmittanceVolumeMapper::GetMTime()
{
  const vtkMTimeType time = std::max(this->Superclass::GetMTime(), this->Settings->GetMTime());
  return this->AssumedImportance ? std::max(time, this->AssumedImportance->GetMTime()) : time;
}

void vtkTransmittanceVolumeMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  const limpid::PropertyPrinter print{ os, indent };

  this->Superclass::PrintSelf(os, indent);
  os << indent << "VisibilitySettings:\n";
  this->Settings->PrintSelf(os, indent.GetNextIndent());
  print("ImportanceArray", this->ImportanceArray);
  print("ImportanceArrayAssociation", this->ImportanceArrayAssociation);
  print("ExtinctionSource", this->ExtinctionSource);
  print("ExtinctionArray", this->ExtinctionArray);
  print("ExtinctionArrayAssociation", this->ExtinctionArrayAssociation);
  print("AssumedImportance", static_cast<void*>(this->AssumedImportance));
  print("Optimization", this->Optimization);
  print("PauseOptimization", this->PauseOptimization);
  print("LightSource", this->LightSource);
  print("DrawOn", this->DrawOn);
  print("Shadows", this->Shadows);
  print("ShadowStrength", this->ShadowStrength);
  print("Ambient", this->Ambient);
  print("Anisotropy", this->Anisotropy);
  print("Specular", this->Specular);
  print("SpecularPower", this->SpecularPower);
  print("LightIntensity", this->LightIntensity);
  print("SampleDistance", this->SampleDistance);
  print("Jitter", this->Jitter);
  print("ShowMissed", this->ShowMissed);
  os << indent << "MissedColor: " << this->MissedColor[0] << " " << this->MissedColor[1] << " "
     << this->MissedColor[2] << "\n";
  print("StructureColors", this->StructureColors);
  print("NumberOfLabelColors", this->GetNumberOfLabelColors());
  print("InteractiveFrameTime", this->InteractiveFrameTime);
  print("EaseTime", this->EaseTime);
  print("AdaptiveQuality", this->AdaptiveQuality);
  print("ProgressiveStill", this->ProgressiveStill);
  print("DeferStill", this->DeferStill);
  print("SharesImage", this->SharesImage);
  const int* whole = this->WholeExtent;
  os << indent << "WholeExtent: " << whole[0] << " " << whole[1] << " " << whole[2] << " "
     << whole[3] << " " << whole[4] << " " << whole[5] << "\n";
  print("VisibilityScore", this->GetVisibilityScore());
  print("VisibleFraction", this->GetVisibleFraction());
  print("SacrificedFraction", this->GetSacrificedFraction());
  print("AttainableFraction", this->GetAttainableFraction());
  print("AttainableScore", this->GetAttainableScore());
  print("AttainableLightScore", this->GetAttainableLightScore());
  print("Converged", this->GetConverged());
  print("LightDescription", this->GetLightDescription());
}
