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

LIMPID_FORWARD(ImportanceComponent, int)
LIMPID_FORWARD(UseImportanceFunction, int)
LIMPID_FORWARD(ImportanceFunction, vtkPiecewiseFunction*)
LIMPID_FORWARD(Method, int)
LIMPID_FORWARD(Optimization, int)
LIMPID_FORWARD(PauseOptimization, int)
LIMPID_FORWARD(ViewWeight, double)
LIMPID_FORWARD(LightWeight, double)
LIMPID_FORWARD(RegularizationWeight, double)
LIMPID_FORWARD(Mode, int)
LIMPID_FORWARD(RestrictToView, int)
LIMPID_FORWARD(Solver, int)
LIMPID_FORWARD(MaximumIterations, int)
LIMPID_FORWARD(LearningRate, double)
LIMPID_FORWARD(Tolerance, double)
LIMPID_FORWARD(MaximumSeconds, double)
LIMPID_FORWARD(Derivative, int)
LIMPID_FORWARD(RayDensity, double)
LIMPID_FORWARD(SkipUnneeded, int)
LIMPID_FORWARD(Backend, int)
LIMPID_FORWARD(Shadows, int)
LIMPID_FORWARD(ShadowStrength, double)
LIMPID_FORWARD(LightSource, int)
LIMPID_FORWARD(LightType, int)
LIMPID_FORWARD(LightIntensity, double)
LIMPID_FORWARD(SampleDistance, double)
LIMPID_FORWARD(Jitter, int)
LIMPID_FORWARD(AdaptiveQuality, int)
LIMPID_FORWARD(InteractiveFrameTime, double)
LIMPID_FORWARD(EaseTime, double)
LIMPID_FORWARD(ProgressiveStill, int)

#undef LIMPID_FORWARD

void vtkOptimizedVolumeRepresentation::SetImportanceArray(int vtkNotUsed(index),
  int vtkNotUsed(port), int vtkNotUsed(connection), int association, const char* name)
{
  this->State->ImportanceAssociation = association;
  this->State->ImportanceArray = name ? name : "";
}

void vtkOptimizedVolumeRepresentation::SetIterationsPerLevel(int quarter, int half, int full)
{
  this->State->Mapper->SetIterationsPerLevel(quarter, half, full);
}

void vtkOptimizedVolumeRepresentation::SetLightPosition(double x, double y, double z)
{
  this->State->Mapper->SetLightPosition(x, y, z);
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
