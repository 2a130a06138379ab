// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkScoreAnnotation.h"

#include "vtkCamera.h"
#include "vtkCoordinate.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkViewport.h"

#include <algorithm>
#include <cmath>
#include <utility>

vtkStandardNewMacro(vtkScoreAnnotation);

namespace
{
// Font size [points], that of ParaView's own annotations.
constexpr int FONT_SIZE = 12;

// Distance to the border of the view [its width or height].
constexpr double MARGIN = 0.01;
}

vtkScoreAnnotation::vtkScoreAnnotation()
{
  this->PickableOff();
  this->UseBoundsOff(); // Reset Camera considers only the data

  for (vtkTextActor* actor : { this->Actor.Get(), this->Legend.Get() })
  {
    vtkTextProperty* text = actor->GetTextProperty();
    text->SetFontFamilyToArial();
    text->SetFontSize(FONT_SIZE);
    text->SetJustificationToLeft();
    text->SetVerticalJustificationToTop();
    text->SetColor(1, 1, 1);
    text->SetBackgroundColor(0, 0, 0);
    text->SetBackgroundOpacity(0.5);
    actor->SetTextScaleModeToNone();
    actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    actor->SetPosition(MARGIN, 1 - MARGIN);
  }
}

vtkScoreAnnotation::~vtkScoreAnnotation() = default;

void vtkScoreAnnotation::SetTextSource(std::function<std::string()> source)
{
  this->TextSource = std::move(source);
  this->Modified();
}

void vtkScoreAnnotation::SetLegendSource(std::function<std::string()> source)
{
  this->LegendSource = std::move(source);
  this->Modified();
}

void vtkScoreAnnotation::SetLegendColor(const double color[3])
{
  this->Legend->GetTextProperty()->SetColor(color[0], color[1], color[2]);
}

void vtkScoreAnnotation::ClaimView(vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const double halfHeight = camera->GetParallelProjection()
    ? camera->GetParallelScale()
    : camera->GetDistance() * std::tan(vtkMath::RadiansFromDegrees(camera->GetViewAngle() / 2));
  const double radius = halfHeight * std::hypot(1, renderer->GetTiledAspectRatio());
  const double* middle = camera->GetFocalPoint();
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Bounds[2 * axis] = middle[axis] - radius;
    this->Bounds[2 * axis + 1] = middle[axis] + radius;
  }
  this->UseBoundsOn();
}

std::string vtkScoreAnnotation::CurrentText()
{
  return this->TextSource && this->GetVisibility() ? this->TextSource() : std::string();
}

std::string vtkScoreAnnotation::CurrentLegend()
{
  return this->LegendSource && this->GetVisibility() ? this->LegendSource() : std::string();
}

// Returns the lower end of the annotations that were drawn before this one in this frame.
double vtkScoreAnnotation::LowestOtherAnnotation(vtkViewport* viewport)
{
  double bottom = 1;
  vtkPropCollection* props = viewport->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  for (vtkProp* prop = props->GetNextProp(position); prop && prop != this;
       prop = props->GetNextProp(position))
  {
    if (auto* annotation = vtkScoreAnnotation::SafeDownCast(prop))
    {
      const bool drawn = !annotation->CurrentText().empty() || !annotation->CurrentLegend().empty();
      bottom = drawn ? annotation->Bottom : bottom;
    }
  }
  return bottom;
}

// Draws a plate below those that were drawn before. Returns its height.
int vtkScoreAnnotation::DrawPlate(
  vtkViewport* viewport, const std::string& text, vtkTextActor* actor)
{
  if (text.empty())
  {
    return 0;
  }
  const double top = this->Bottom - MARGIN;
  actor->SetPosition(MARGIN, top);
  actor->SetInput(text.c_str());
  double size[2];
  actor->GetSize(viewport, size);
  this->Bottom = top - size[1] / std::max(1, viewport->GetSize()[1]);
  // The image of the text is made in earlier passes, which are over.
  actor->RenderOpaqueGeometry(viewport);
  const int drawn = actor->RenderOverlay(viewport);
  // Windows of a server share their shaders: if one is closed, those that the text has kept are
  // invalid in the others. So it keeps none.
  actor->ReleaseGraphicsResources(viewport->GetVTKWindow());
  return drawn;
}

int vtkScoreAnnotation::RenderOverlay(vtkViewport* viewport)
{
  this->Bottom = this->LowestOtherAnnotation(viewport);
  const int text = this->DrawPlate(viewport, this->CurrentText(), this->Actor);
  const int legend = this->DrawPlate(viewport, this->CurrentLegend(), this->Legend);
  return text + legend;
}

void vtkScoreAnnotation::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Actor->ReleaseGraphicsResources(window);
  this->Legend->ReleaseGraphicsResources(window);
}

void vtkScoreAnnotation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Text: " << this->CurrentText() << "\n";
  os << indent << "Legend: " << this->CurrentLegend() << "\n";
}
