// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Forwards properties to the mapper.

#include "vtkOptimizedVolumeRepresentationInternals.h"

#include "vtkTable.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>

// Forwards SetName(value) to a method of the mapper.
#define LIMPID_FORWARD_AS(name, mapperName, type)                                                  \
  void vtkOptimizedVolumeRepresentation::Set##name(type value)                                     \
  {                                                                                                \
    this->State->Mapper->Set##mapperName(value);                                                   \
  }
#define LIMPID_FORWARD(name, type) LIMPID_FORWARD_AS(name, name, type)

// Forwards GetName() to the method of the same name of the mapper.
#define LIMPID_FORWARD_RESULT(name, type)                                                          \
  type vtkOptimizedVolumeRepresentation::Get##name()                                               \
  {                                                                                                \
    return this->State->Mapper->Get##name();                                                       \
  }

LIMPID_FORWARD(ExtinctionSource, int)
LIMPID_FORWARD(Optimization, int)
LIMPID_FORWARD(PauseOptimization, int)
LIMPID_FORWARD(Shadows, int)
LIMPID_FORWARD(ShadowStrength, double)
LIMPID_FORWARD(LightSource, int)
LIMPID_FORWARD(DrawOn, int)
LIMPID_FORWARD(LightIntensity, double)
LIMPID_FORWARD_AS(VolumeAmbient, Ambient, double)
LIMPID_FORWARD_AS(VolumeSpecular, Specular, double)
LIMPID_FORWARD_AS(VolumeSpecularPower, SpecularPower, double)
LIMPID_FORWARD_AS(ScatteringAnisotropy, Anisotropy, double)
LIMPID_FORWARD(SampleDistance, double)
LIMPID_FORWARD(Jitter, int)
LIMPID_FORWARD(ShowMissed, int)
LIMPID_FORWARD(StructureColors, double)
LIMPID_FORWARD(AdaptiveQuality, int)
LIMPID_FORWARD(InteractiveFrameTime, double)
LIMPID_FORWARD(EaseTime, double)
LIMPID_FORWARD(ProgressiveStill, int)
LIMPID_FORWARD(DeferStill, int)

LIMPID_FORWARD_RESULT(VisibilityScore, double)
LIMPID_FORWARD_RESULT(BaseVisibilityScore, double)
LIMPID_FORWARD_RESULT(VisibleFraction, double)
LIMPID_FORWARD_RESULT(BaseVisibleFraction, double)
LIMPID_FORWARD_RESULT(SacrificedFraction, double)
LIMPID_FORWARD_RESULT(AttainableFraction, double)
LIMPID_FORWARD_RESULT(AttainableScore, double)
LIMPID_FORWARD_RESULT(AttainableLightScore, double)
LIMPID_FORWARD_RESULT(Iterations, int)
LIMPID_FORWARD_RESULT(LightDescription, const char*)
LIMPID_FORWARD_RESULT(BackendName, const char*)
LIMPID_FORWARD_RESULT(OptimizedAt, const char*)
LIMPID_FORWARD_RESULT(DrawnBy, const char*)

#undef LIMPID_FORWARD
#undef LIMPID_FORWARD_AS
#undef LIMPID_FORWARD_RESULT

vtkVisibilitySettings* vtkOptimizedVolumeRepresentation::GetVisibilitySettings()
{
  return this->State->Mapper->GetVisibilitySettings();
}

void vtkOptimizedVolumeRepresentation::SetImportanceArray(int vtkNotUsed(index),
  int vtkNotUsed(port), int vtkNotUsed(connection), int association, const char* name)
{
  this->State->ImportanceAssociation = association;
  this->State->ImportanceArray = name ? name : "";
  this->State->ImportanceGiven = true;
}

void vtkOptimizedVolumeRepresentation::SetExtinctionArray(int vtkNotUsed(index),
  int vtkNotUsed(port), int vtkNotUsed(connection), int association, const char* name)
{
  this->State->Mapper->SetExtinctionArray(name);
  this->State->Mapper->SetExtinctionArrayAssociation(association);
}

void vtkOptimizedVolumeRepresentation::SetMissedColor(double red, double green, double blue)
{
  this->State->Mapper->SetMissedColor(red, green, blue);
}

void vtkOptimizedVolumeRepresentation::AddLabelColor(
  double label, double red, double green, double blue)
{
  this->State->Mapper->AddLabelColor(label, red, green, blue);
}

void vtkOptimizedVolumeRepresentation::RemoveAllLabelColors()
{
  this->State->Mapper->RemoveAllLabelColors();
}

void vtkOptimizedVolumeRepresentation::ResetOptimization()
{
  this->State->Mapper->Reset();
}

void vtkOptimizedVolumeRepresentation::SetShowScore(int show)
{
  this->State->ShowScore = show != 0;
}

void vtkOptimizedVolumeRepresentation::SetScoreInScreenshots(int show)
{
  this->State->ScoreInScreenshots = show != 0;
}

void vtkOptimizedVolumeRepresentation::SetImageDimensions(int x, int y, int z)
{
  const std::array<int, 3> dimensions{ { std::max(x, 0), std::max(y, 0), std::max(z, 0) } };
  if (dimensions != this->State->ImageDimensions)
  {
    this->State->ImageDimensions = dimensions;
    this->MarkModified();
  }
}

const char* vtkOptimizedVolumeRepresentation::GetSampledAt()
{
  return this->State->Sampled.text.c_str();
}

void vtkOptimizedVolumeRepresentation::SetStructureLegend(int show)
{
  this->State->StructureLegend = show != 0;
}

void vtkOptimizedVolumeRepresentation::SetSourceName(const char* name)
{
  this->State->SourceName = name ? name : "";
}

int vtkOptimizedVolumeRepresentation::PrepareOriginal()
{
  return this->State->Mapper->HasDrawn && this->State->Mapper->PrepareOriginal() ? 1 : 0;
}

vtkDoubleArray* vtkOptimizedVolumeRepresentation::GetStructureShares()
{
  vtkDoubleArray* shares = this->State->StructureShares;
  shares->Initialize();
  vtkTable* known =
    this->State->Mapper->HasDrawn ? this->State->Mapper->GetKnownStructureTable() : nullptr;
  if (known && known->GetColumnByName("Visible"))
  {
    for (vtkIdType row = 0; row < known->GetNumberOfRows(); ++row)
    {
      for (const char* column : { "Visible", "BaseVisible", "Removed", "Attainable" })
      {
        shares->InsertNextValue(known->GetValueByName(row, column).ToDouble());
      }
    }
  }
  return shares;
}

void vtkOptimizedVolumeRepresentation::MeasureStructures()
{
  if (this->State->Mapper->HasDrawn)
  {
    this->State->Mapper->GetStructureTable();
  }
}

int vtkOptimizedVolumeRepresentation::PickStructure(double x, double y)
{
  return this->State->Mapper->HasDrawn ? static_cast<int>(this->State->Mapper->PickStructure(x, y))
                                       : -1;
}

int vtkOptimizedVolumeRepresentation::GetStructuresMeasured()
{
  return !this->State->Mapper->HasDrawn || this->State->Mapper->GetStructuresMeasured() ? 1 : 0;
}

int vtkOptimizedVolumeRepresentation::GetConverged()
{
  // If the frame did not draw the volume, there is nothing left to do.
  return !this->State->Mapper->HasDrawn || this->State->Mapper->GetConverged() ? 1 : 0;
}
