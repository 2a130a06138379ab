// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Chooses what is shown and its colours, with messages if this differs from the request.

#include "InputArrays.h"
#include "ScalarChoice.h"
#include "SharedArray.h"
#include "StartingImportance.h"
#include "vtkOptimizedVolumeRepresentationInternals.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkVolumeProperty.h"

#include <algorithm>

namespace
{
// The name for the array that the volume is coloured by; equals none_string in
// LimpidRepresentations.xml.
const char* const COLOR_ARRAY = "(Color Array)";

// The importance array if none was chosen.
const char* const IMPORTANCE = "Importance";

std::string ColorByCall(const limpid::ScalarChoice& scalars)
{
  return std::string("ColorBy(display, (\"") + (scalars.onCells ? "CELLS" : "POINTS") + "\", \"" +
    scalars.array->GetName() + "\"))";
}

// Returns the name of the array that the user has chosen to colour by; empty if none.
std::string ChosenName(vtkInformation* chosen)
{
  const char* name = chosen && chosen->Has(vtkDataObject::FIELD_NAME())
    ? chosen->Get(vtkDataObject::FIELD_NAME())
    : nullptr;
  return name ? name : "";
}

bool IsOnCells(vtkInformation* chosen)
{
  return chosen && chosen->Has(vtkDataObject::FIELD_ASSOCIATION()) &&
    chosen->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS;
}

// Returns the array to show, or why there is none, or both if the user should know.
limpid::ScalarChoice WhatToShow(vtkInformation* chosen, const std::string& importance,
  vtkImageData* image, std::vector<std::string>& messages)
{
  const std::string name = ChosenName(chosen);
  const bool onCells = IsOnCells(chosen);
  const limpid::ScalarChoice scalars = name.empty()
    ? limpid::ChooseScalars(image, importance.c_str())
    : limpid::FindScalars(image, name.c_str(), onCells);
  if (scalars.array && name.empty())
  {
    messages.push_back("No array is chosen for coloring (a volume has no solid color). \"" +
      std::string(scalars.array->GetName()) +
      "\" is shown; choose an array under Coloring, in Python with " + ColorByCall(scalars) + ".");
  }
  else if (!scalars.array && !name.empty())
  {
    messages.push_back("The array \"" + name +
      "\" that the volume is colored by is not among those "
      "of the " +
      (onCells ? "cells" : "points") +
      " (there are no values to draw). Choose another one under Coloring.");
  }
  else if (!scalars.array && image->GetNumberOfPoints() > 0)
  {
    messages.emplace_back("The image has no array with numbers (there are no values to draw). Make "
                          "one, for instance with the filter Calculator.");
  }
  return scalars;
}
}

// Returns the processes that draw together; null: one process.
vtkMultiProcessController* vtkOptimizedVolumeRepresentation::Others() const
{
  return this->State->Mapper->DrawsOnSeveralRanks()
    ? vtkMultiProcessController::GetGlobalController()
    : nullptr;
}

limpid::SharedArray vtkOptimizedVolumeRepresentation::Shared(
  const limpid::ScalarChoice& choice, vtkImageData* image) const
{
  limpid::FieldSource source;
  source.array = choice.array;
  source.onCells = choice.onCells;
  source.component = std::max(this->State->Mapper->GetScalarComponent(), -1); // or undecided
  return { source, image, this->WholeExtent, this->Others() };
}

// Returns the array that is shown; null if nothing is, or if this process has no values.
vtkDataArray* vtkOptimizedVolumeRepresentation::ApplyScalars(
  vtkImageData* image, std::vector<std::string>& messages)
{
  const limpid::ScalarChoice scalars =
    WhatToShow(this->GetInputArrayInformation(0), this->State->ImportanceArray, image, messages);
  const bool isShown = limpid::AnyProcess(this->Others(), scalars.array != nullptr);
  this->Actor->SetVisibility(isShown ? 1 : 0);
  if (!isShown)
  {
    this->State->Mapper->ClearResults(); // they would be those of an earlier time step
    return nullptr;
  }
  this->ApplyComponent(scalars.array);
  this->ApplyFunctions(scalars, image);
  if (scalars.array)
  {
    vtkTransmittanceVolumeMapper* mapper = this->State->Mapper;
    mapper->SelectScalarArray(scalars.array->GetName());
    mapper->SetScalarMode(
      scalars.onCells ? VTK_SCALAR_MODE_USE_CELL_FIELD_DATA : VTK_SCALAR_MODE_USE_POINT_FIELD_DATA);
  }
  this->ApplyImportance(image, scalars);
  limpid::CopyFurtherArrays(this, this->State->Mapper);
  return scalars.array;
}

// The base class sets the vector mode of VTK's own mappers only. Two or four components may be
// meant as colours with an opacity; in this case the mapper reports what it shows of them.
void vtkOptimizedVolumeRepresentation::ApplyComponent(vtkDataArray* scalars)
{
  if (scalars)
  {
    vtkColorTransferFunction* colors = this->Property->GetRGBTransferFunction(0);
    const int components = scalars->GetNumberOfComponents();
    const int unchosen = components == 2 || components == 4
      ? vtkTransmittanceVolumeMapper::UNDECIDED
      : vtkTransmittanceVolumeMapper::MAGNITUDE;
    this->State->Mapper->SetScalarComponent(colors->GetVectorMode() == vtkScalarsToColors::COMPONENT
        ? colors->GetVectorComponent()
        : unchosen);
  }
}

void vtkOptimizedVolumeRepresentation::ApplyFunctions(
  const limpid::ScalarChoice& scalars, vtkImageData* image)
{
  this->State->Contents.Notice(image, { scalars.array });
  const auto of = this->TimeAndComponentOf(scalars.array);
  if (limpid::AnyProcess(this->Others(), this->State->DefaultsOf != of))
  {
    limpid::SpreadOverRange(this->Shared(scalars, image).FiniteRange(), this->State->DefaultColors,
      this->State->DefaultOpacity);
    this->State->DefaultsOf = of;
  }
  if (!this->State->ColorsGiven)
  {
    this->Superclass::SetColor(this->State->DefaultColors);
  }
  if (!this->State->OpacityGiven)
  {
    this->Superclass::SetScalarOpacity(this->State->DefaultOpacity);
  }
}

void vtkOptimizedVolumeRepresentation::AssumeImportance(
  const limpid::ScalarChoice& scalars, vtkImageData* image)
{
  const auto of = this->TimeAndComponentOf(scalars.array);
  limpid::ImportanceRamp& ramp = this->State->ShownRamp;
  vtkPiecewiseFunction* function = this->State->AssumedImportance;
  if (limpid::AnyProcess(this->Others(), this->State->AssumedOf != of))
  {
    this->State->AssumedOf = of;
    ramp = limpid::StartingImportance(this->Shared(scalars, image));
    function->RemoveAllPoints();
    if (ramp.IsKnown())
    {
      function->AddPoint(ramp.begin, 0);
      function->AddPoint(ramp.end, 1);
    }
  }
  this->State->Mapper->SetAssumedImportance(ramp.IsKnown() ? function : nullptr);
}

// This pair differs between arrays, and between components of one array.
std::pair<vtkMTimeType, int> vtkOptimizedVolumeRepresentation::TimeAndComponentOf(
  vtkDataArray* scalars) const
{
  return { scalars ? scalars->GetMTime() : 0, this->State->Mapper->GetScalarComponent() };
}

double* vtkOptimizedVolumeRepresentation::GetSuggestedImportance()
{
  auto* image = vtkImageData::SafeDownCast(this->VolumeMapper->GetDataSetInput());
  const std::string& name = this->State->ImportanceArray;
  const bool onCells = this->State->ImportanceAssociation == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  const limpid::ScalarChoice chosen =
    image ? limpid::FindScalars(image, name.c_str(), onCells) : limpid::ScalarChoice();
  limpid::ImportanceRamp ramp;
  if (chosen.array)
  {
    // The ramp of this process stands for those of all.
    limpid::FieldSource source;
    source.array = chosen.array;
    source.onCells = chosen.onCells;
    const limpid::SharedArray array(source, image, nullptr, nullptr);
    const std::array<double, 2> range = array.FiniteRange();
    const bool isImportance = range[0] >= 0 && range[1] <= 1;
    ramp = isImportance ? limpid::ImportanceRamp() : limpid::StartingImportance(array);
  }
  else if (image && (name == COLOR_ARRAY || name == IMPORTANCE))
  {
    ramp = this->State->ShownRamp;
  }
  this->State->SuggestedImportance = { ramp.range[0], ramp.begin, ramp.end, ramp.range[1] };
  return this->State->SuggestedImportance.data();
}

void vtkOptimizedVolumeRepresentation::ApplyImportance(
  vtkImageData* image, const limpid::ScalarChoice& colors)
{
  vtkTransmittanceVolumeMapper* mapper = this->State->Mapper;
  const std::string& name = this->State->ImportanceArray;
  const bool onCells = this->State->ImportanceAssociation == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  const auto isThere = [&](const std::string& array, bool cells)
  {
    return limpid::AnyProcess(
      this->Others(), limpid::FindScalars(image, array.c_str(), cells).array != nullptr);
  };
  const auto association = [](bool cells)
  {
    return cells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS;
  };

  if (name == COLOR_ARRAY && (isThere(IMPORTANCE, false) || isThere(IMPORTANCE, true)))
  {
    this->AssumeImportance(colors, image);
    if (colors.array)
    {
      mapper->SetImportanceArray(colors.array->GetName());
      mapper->SetImportanceArrayAssociation(association(colors.onCells));
    }
  }
  else if (name == COLOR_ARRAY || (!this->State->ImportanceGiven && !isThere(name, onCells)))
  {
    this->AssumeImportance(colors, image);
    mapper->SetImportanceArray(""); // "Importance", or what the function makes of the scalars
    mapper->SetImportanceArrayAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS);
  }
  else
  {
    mapper->SetAssumedImportance(nullptr);
    mapper->SetImportanceArray(name.c_str()); // the mapper reports that it is missing
    mapper->SetImportanceArrayAssociation(association(onCells));
  }
}

// `components`: number of components of the array that is shown.
void vtkOptimizedVolumeRepresentation::AddUnavailable(
  int components, std::vector<std::string>& messages) const
{
  if (this->State->UseSeparateOpacityArray)
  {
    messages.emplace_back("Use Separate Opacity Array is on (Optimized Volume takes extinctions "
                          "from an array, not opacities). Turn it off; for extinctions, set "
                          "Extinction Source to Array.");
  }
  if (this->State->UseTransfer2D)
  {
    messages.emplace_back("Use 2D Transfer Function is on (Optimized Volume takes color and "
                          "opacity from functions of one variable). Turn it off.");
  }
  if (components > 1 && !this->State->MapsScalars)
  {
    messages.emplace_back(
      "Map Scalars is off (the components would be used directly as color and opacity; Optimized "
      "Volume takes both from functions of one component). Turn it on.");
  }
  if (components > 1 && this->State->MapsComponents)
  {
    messages.emplace_back(
      "Multi Components Mapping is on (the last component would be used as opacity; Optimized "
      "Volume takes color and opacity from one component). Turn it off.");
  }
  if (!this->State->Interpolates)
  {
    messages.emplace_back("The interpolation type is Nearest (Optimized Volume interpolates "
                          "linearly between points). Set it to Linear.");
  }
}

// Repeats a message only after its cause has been absent.
void vtkOptimizedVolumeRepresentation::Say(const std::vector<std::string>& messages)
{
  const std::vector<std::string>& said = this->State->Messages;
  for (const std::string& message : messages)
  {
    if (std::find(said.begin(), said.end(), message) == said.end())
    {
      vtkWarningMacro(<< message);
    }
  }
  this->State->Messages = messages;
}

const char* vtkOptimizedVolumeRepresentation::GetMessages()
{
  std::string& text = this->State->Text;
  text = this->State->Mapper->GetMessages();
  for (const std::string& message : this->State->Messages)
  {
    text += (text.empty() ? "" : "\n") + message;
  }
  return text.c_str();
}

void vtkOptimizedVolumeRepresentation::SetColor(vtkColorTransferFunction* colors)
{
  this->State->ColorsGiven = colors != nullptr;
  this->Superclass::SetColor(colors);
}

void vtkOptimizedVolumeRepresentation::SetScalarOpacity(vtkPiecewiseFunction* opacity)
{
  this->State->OpacityGiven = opacity != nullptr;
  this->Superclass::SetScalarOpacity(opacity);
}

void vtkOptimizedVolumeRepresentation::SetUseSeparateOpacityArray(bool use)
{
  this->State->UseSeparateOpacityArray = use; // the base class would create an array for it
}

void vtkOptimizedVolumeRepresentation::SetUseTransfer2D(bool use)
{
  this->State->UseTransfer2D = use;
}

void vtkOptimizedVolumeRepresentation::SetMapScalars(bool map)
{
  this->State->MapsScalars = map; // the base class would make the mapper refuse to draw
}

void vtkOptimizedVolumeRepresentation::SetMultiComponentsMapping(bool map)
{
  this->State->MapsComponents = map;
}

void vtkOptimizedVolumeRepresentation::SetInterpolationType(int type)
{
  this->State->Interpolates = type != VTK_NEAREST_INTERPOLATION;
}
