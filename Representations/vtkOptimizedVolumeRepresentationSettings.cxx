// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The properties that are the mapper's.

#include "vtkOptimizedVolumeRepresentationInternals.h"

// Forwards SetName(value) to the method of the same name of the mapper.
#define LIMPID_FORWARD(name, type)                                                                 \
  void vtkOptimizedVolumeRepresentation::Set##name(type value)                                     \
  {                                                                                                \
    this->State->Mapper->Set##name(value);                                                         \
  }

LIMPID_FORWARD(Method, int)
LIMPID_FORWARD(Optimization, int)
LIMPID_FORWARD(PauseOptimization, int)
LIMPID_FORWARD(Shadows, int)
LIMPID_FORWARD(ShadowStrength, double)
LIMPID_FORWARD(LightSource, int)
LIMPID_FORWARD(LightIntensity, double)
LIMPID_FORWARD(SampleDistance, double)
LIMPID_FORWARD(Jitter, int)
LIMPID_FORWARD(AdaptiveQuality, int)
LIMPID_FORWARD(InteractiveFrameTime, double)
LIMPID_FORWARD(EaseTime, double)
LIMPID_FORWARD(ProgressiveStill, int)

#undef LIMPID_FORWARD

vtkVisibilitySettings* vtkOptimizedVolumeRepresentation::GetVisibilitySettings()
{
  return this->State->Mapper->GetVisibilitySettings();
}

void vtkOptimizedVolumeRepresentation::SetImportanceArray(int vtkNotUsed(index),
  int vtkNotUsed(port), int vtkNotUsed(connection), int association, const char* name)
{
  this->State->ImportanceAssociation = association;
  this->State->ImportanceArray = name ? name : "";
}

void vtkOptimizedVolumeRepresentation::SetVolumeAmbient(double ambient)
{
  this->State->Mapper->SetAmbient(ambient);
}

void vtkOptimizedVolumeRepresentation::SetVolumeSpecular(double specular)
{
  this->State->Mapper->SetSpecular(specular);
}

void vtkOptimizedVolumeRepresentation::SetVolumeSpecularPower(double power)
{
  this->State->Mapper->SetSpecularPower(power);
}

void vtkOptimizedVolumeRepresentation::SetScatteringAnisotropy(double anisotropy)
{
  this->State->Mapper->SetAnisotropy(anisotropy);
}

void vtkOptimizedVolumeRepresentation::ResetOptimization()
{
  this->State->Mapper->Reset();
}

void vtkOptimizedVolumeRepresentation::SetShowScore(int show)
{
  this->State->ShowScore = show != 0;
  this->State->Annotation->SetVisibility(this->GetVisibility() && this->State->ShowScore);
}

double vtkOptimizedVolumeRepresentation::GetVisibilityScore()
{
  return this->State->Mapper->GetVisibilityScore();
}

double vtkOptimizedVolumeRepresentation::GetBaseVisibilityScore()
{
  return this->State->Mapper->GetBaseVisibilityScore();
}

double vtkOptimizedVolumeRepresentation::GetVisibleFraction()
{
  return this->State->Mapper->GetVisibleFraction();
}

double vtkOptimizedVolumeRepresentation::GetBaseVisibleFraction()
{
  return this->State->Mapper->GetBaseVisibleFraction();
}

int vtkOptimizedVolumeRepresentation::GetConverged()
{
  // A frame without the volume has left nothing to do.
  return !this->State->Mapper->HasDrawn || this->State->Mapper->GetConverged() ? 1 : 0;
}

int vtkOptimizedVolumeRepresentation::GetIterations()
{
  return this->State->Mapper->GetIterations();
}

const char* vtkOptimizedVolumeRepresentation::GetLightDescription()
{
  return this->State->Mapper->GetLightDescription();
}

const char* vtkOptimizedVolumeRepresentation::GetBackendName()
{
  return this->State->Mapper->GetBackendName();
}
