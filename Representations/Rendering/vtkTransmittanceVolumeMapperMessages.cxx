// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Messages of vtkTransmittanceVolumeMapper about properties and props that it cannot draw as
// requested.

#include "vtkTransmittanceVolumeMapperInternals.h"

#include "vtkActor.h"
#include "vtkCollection.h"
#include "vtkColorTransferFunction.h"
#include "vtkCuller.h"
#include "vtkCullerCollection.h"
#include "vtkFrustumCoverageCuller.h"
#include "vtkMath.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>

namespace
{
bool IsSortingBackToFront(vtkRenderer* renderer)
{
  vtkCullerCollection* cullers = renderer->GetCullers();
  vtkCollectionSimpleIterator position;
  cullers->InitTraversal(position);
  while (vtkCuller* culler = cullers->GetNextCuller(position))
  {
    auto* sorting = vtkFrustumCoverageCuller::SafeDownCast(culler);
    if (sorting && sorting->GetSortingStyle() == VTK_CULLER_SORT_BACK_TO_FRONT)
    {
      return true;
    }
  }
  return false;
}

bool HasBounds(vtkProp* prop)
{
  const double* bounds = prop->GetBounds();
  return bounds && vtkMath::AreBoundsInitialized(bounds);
}

// Returns whether VTK draws a prop too early: before volumes that it is not wholly behind.
bool IsTranslucentInFront(vtkProp* prop, const limpid::Box& box, vtkRenderer* renderer)
{
  vtkActor* actor = vtkActor::SafeDownCast(prop);
  if (!actor || !actor->GetVisibility() || !HasBounds(actor) ||
    !actor->HasTranslucentPolygonalGeometry())
  {
    return false;
  }
  const limpid::Order order =
    limpid::OrderOf(box, limpid::BoxOfBounds(actor->GetBounds()), renderer);
  return order == limpid::Order::Overlapping || order == limpid::Order::FirstFirst;
}
}

// If processes draw together, only rank 0 reports warnings.
bool vtkTransmittanceVolumeMapper::Internals::ReportsMessages() const
{
  return this->Ranks->Rank() == 0;
}

void vtkTransmittanceVolumeMapper::Internals::Warn(const std::string& text)
{
  this->Messages += text + "\n";
  if (this->Log.IsNew(text) && this->ReportsMessages())
  {
    vtkWarningWithObjectMacro(this->Self, << text);
  }
}

// Errors of the core may contain coordinates that change in every frame, although the error is the
// same. After a change of a property, it counts as a new one.
void vtkTransmittanceVolumeMapper::Internals::Error(const std::string& text)
{
  this->Messages += text + "\n";
  if (this->Log.IsNew(limpid::WithoutNumbers(text) + std::to_string(this->Self->GetMTime())) &&
    this->ReportsMessages())
  {
    vtkErrorWithObjectMacro(this->Self, << text);
  }
}

void vtkTransmittanceVolumeMapper::Internals::ReportIgnored(vtkVolume* volume)
{
  vtkVolumeProperty* property = volume->GetProperty();
  if (this->Self->GetBlendMode() != vtkVolumeMapper::COMPOSITE_BLEND)
  {
    this->Warn("The blend mode is " + std::to_string(this->Self->GetBlendMode()) +
      " (transmittance is defined for composite blending only): the volume is drawn with composite "
      "blending. Set the blend mode to composite, 0.");
  }
  if (property->GetTransferFunctionMode() == vtkVolumeProperty::TF_2D)
  {
    this->Warn(
      "The transfer function is two-dimensional (extinction must be a function of the scalar "
      "alone): the one-dimensional functions are used. Set the transfer function mode to 1D.");
  }
  vtkPiecewiseFunction* gradient =
    property->GetDisableGradientOpacity(0) ? nullptr : property->GetStoredGradientOpacity(0);
  if (gradient && gradient->GetSize() > 0 && gradient->GetType() &&
    !(std::string(gradient->GetType()) == "Constant" && gradient->GetValue(0) == 1))
  {
    this->Warn("The volume property has a gradient opacity function (extinction must be a function "
               "of the scalar alone): it is not used. Disable the gradient opacity.");
  }
  if (property->GetInterpolationType() == VTK_NEAREST_INTERPOLATION)
  {
    this->Warn(
      "The interpolation type of the volume property is nearest (shading needs a gradient, which "
      "steps do not have): scalars are interpolated linearly. Call SetInterpolationTypeToLinear.");
  }
  if (volume->GetShaderProperty()->GetNumberOfShaderReplacements() > 0)
  {
    this->Warn("The volume has shader replacements (this mapper does not use VTK's shaders): they "
               "are not used. Call ClearAllShaderReplacements of its shader property.");
  }
  this->ReportNumbers(property);
  const bool opacityCounts = this->Self->ExtinctionSource == OPACITY_FUNCTION;
  if (opacityCounts && property->GetScalarOpacity(0)->GetSize() == 0)
  {
    this->Warn("The scalar opacity function has no points (the volume is invisible). Add points.");
  }
}

// Values of functions that are not numbers would invalidate the whole function.
void vtkTransmittanceVolumeMapper::Internals::ReportNumbers(vtkVolumeProperty* property)
{
  const auto report = [this](const char* name, auto* function, int values)
  {
    double node[6];
    for (int i = 0; i < function->GetSize(); ++i)
    {
      function->GetNodeValue(i, node);
      if (!std::all_of(node, node + values, [](double value) { return std::isfinite(value); }))
      {
        this->Warn(std::string("The scalar ") + name +
          " function has a value that is nan or "
          "infinite at its point " +
          std::to_string(i) + " (it cannot be interpolated): 0 is used. Set finite values.");
        return;
      }
    }
  };
  if (this->Self->ExtinctionSource == OPACITY_FUNCTION)
  {
    report("opacity", property->GetScalarOpacity(0), 4);
  }
  property->GetColorChannels(0) == 1 ? report("colour", property->GetGrayTransferFunction(0), 4)
                                     : report("colour", property->GetRGBTransferFunction(0), 6);
}

// `later`: whether the renderer visits the other volume after this one. Returns whether another
// class draws the other volume, out of order.
bool vtkTransmittanceVolumeMapper::Internals::ReportVolume(
  vtkRenderer* renderer, vtkVolume* other, const limpid::Box& box, bool later)
{
  const bool ours = vtkTransmittanceVolumeMapper::SafeDownCast(other->GetMapper()) != nullptr;
  const limpid::Box otherBox =
    ours ? limpid::BoxOf(other) : limpid::BoxOfBounds(other->GetBounds());
  const limpid::Order order = limpid::OrderOf(box, otherBox, renderer);
  if (order == limpid::Order::Overlapping)
  {
    this->Warn("The bounds of this volume and another one overlap (each volume is drawn as one "
               "picture, and pictures cannot be interleaved): where both are visible, one is drawn "
               "entirely in front of the other, and neither shades nor clears the other. Move them "
               "apart, or put both into one image.");
  }
  const bool wrong =
    later ? order == limpid::Order::SecondFirst : order == limpid::Order::FirstFirst;
  return wrong && !ours;
}

void vtkTransmittanceVolumeMapper::Internals::ReportNeighbours(
  vtkRenderer* renderer, vtkVolume* volume, bool inParts)
{
  const limpid::Box box = limpid::BoxOf(volume);
  bool later = false;
  bool outOfOrder = false;
  bool foreign = false;
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  while (vtkProp* prop = props->GetNextProp(position))
  {
    vtkVolume* other = vtkVolume::SafeDownCast(prop);
    later |= prop == volume;
    if (other && other != volume && other->GetVisibility() && HasBounds(other))
    {
      outOfOrder |= this->ReportVolume(renderer, other, box, later);
      foreign |= !vtkTransmittanceVolumeMapper::SafeDownCast(other->GetMapper());
    }
  }
  if (inParts && foreign)
  {
    this->Warn("A volume of another mapper is in a view that peels volumes (VTK does not blend two "
               "peeled volumes): where both are visible, each channel is that of the brighter one. "
               "Call UseDepthPeelingForVolumesOff of the renderer.");
  }
  if (!inParts && outOfOrder && !IsSortingBackToFront(renderer))
  {
    this->Warn("A volume of another mapper is on the wrong side of this one (the renderer draws "
               "volumes in the order in which they were added): the farther one is drawn over the "
               "nearer one. Call vtkTransmittanceVolumeMapper::SortBackToFront for the renderer.");
  }
  if (!inParts && vtkTransmittanceVolumeMapper::NeedsDepthPeeling(renderer, volume))
  {
    this->Warn(
      "Translucent geometry is in front of this volume or reaches into it (the renderer "
      "draws it before any volume): it is drawn behind the volume. Call UseDepthPeelingOn and "
      "UseDepthPeelingForVolumesOn of the renderer; in ParaView, tick Depth Peeling and Depth "
      "Peeling for Volumes.");
  }
}

bool vtkTransmittanceVolumeMapper::NeedsDepthPeeling(vtkRenderer* renderer, vtkVolume* volume)
{
  const limpid::Box box = limpid::BoxOf(volume);
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  while (vtkProp* prop = props->GetNextProp(position))
  {
    if (IsTranslucentInFront(prop, box, renderer))
    {
      return true;
    }
  }
  return false;
}

bool vtkTransmittanceVolumeMapper::NeedsDepthPeeling(vtkRenderer* renderer)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  while (vtkProp* prop = props->GetNextProp(position))
  {
    vtkVolume* volume = vtkVolume::SafeDownCast(prop);
    if (volume && volume->GetVisibility() && HasBounds(volume) &&
      NeedsDepthPeeling(renderer, volume))
    {
      return true;
    }
  }
  return false;
}
