// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkScoreAnnotation.h"

#include "Swatches.h"

#include "vtkCamera.h"
#include "vtkCoordinate.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkTable.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkVariant.h"
#include "vtkViewport.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkScoreAnnotation);

namespace
{
// Font size [points], that of ParaView's own annotations.
constexpr int FONT_SIZE = 12;

// Distance to the border of the view [its width or height].
constexpr double MARGIN = 0.01;

constexpr double PLATE_OPACITY = 0.5;

// Most lines of the legend of structures.
constexpr vtkIdType MOST_LINES = 12;

// Returns the names in the first rows, a line each, and how many more there are.
std::string NamesIn(vtkTable* structures, vtkIdType rows)
{
  std::string names;
  for (vtkIdType row = 0; row < rows; ++row)
  {
    names += (row > 0 ? "\n" : "") + structures->GetValueByName(row, "Name").ToString();
  }
  const vtkIdType others = structures->GetNumberOfRows() - rows;
  const std::string last = "and " + std::to_string(others) + " more";
  return others > 0 ? names + (rows > 0 ? "\n" : "") + last : names;
}

// Returns the colours in the first rows.
std::vector<limpid::Color> ColorsIn(vtkTable* structures, vtkIdType rows)
{
  std::vector<limpid::Color> colors;
  for (vtkIdType row = 0; row < rows; ++row)
  {
    const auto channel = [&](const char* name)
    { return structures->GetValueByName(row, name).ToDouble(); };
    colors.push_back({ { channel("Red"), channel("Green"), channel("Blue"), 1 } });
  }
  return colors;
}
}

vtkScoreAnnotation::vtkScoreAnnotation()
{
  this->PickableOff();
  this->UseBoundsOff(); // Reset Camera considers only the data

  for (vtkTextActor* actor : { this->Actor.Get(), this->Legend.Get(), this->Names.Get() })
  {
    vtkTextProperty* text = actor->GetTextProperty();
    text->SetFontFamilyToArial();
    text->SetFontSize(FONT_SIZE);
    text->SetJustificationToLeft();
    text->SetVerticalJustificationToTop();
    text->SetColor(1, 1, 1);
    text->SetBackgroundColor(0, 0, 0);
    text->SetBackgroundOpacity(PLATE_OPACITY);
    actor->SetTextScaleModeToNone();
    actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
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

void vtkScoreAnnotation::SetStructureSource(std::function<vtkTable*()> source)
{
  this->StructureSource = std::move(source);
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

// Returns the structures to list; null: none.
vtkTable* vtkScoreAnnotation::CurrentStructures()
{
  vtkTable* structures =
    this->StructureSource && this->GetVisibility() ? this->StructureSource() : nullptr;
  return structures && structures->GetNumberOfRows() > 0 ? structures : nullptr;
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
      const bool drawn = !annotation->CurrentText().empty() ||
        !annotation->CurrentLegend().empty() || annotation->CurrentStructures();
      bottom = drawn ? annotation->Bottom : bottom;
    }
  }
  return bottom;
}

// Draws a plate below those that were drawn before. Returns its height.
int vtkScoreAnnotation::DrawPlate(
  vtkViewport* viewport, const std::string& text, vtkTextActor* actor, double left)
{
  if (text.empty())
  {
    return 0;
  }
  const double top = this->Bottom - MARGIN;
  actor->SetPosition(left, top);
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

// Draws the names of structures below what was drawn before, with squares in their colours.
int vtkScoreAnnotation::DrawStructures(vtkViewport* viewport, vtkTable* structures)
{
  if (!structures)
  {
    return 0;
  }
  const int* view = viewport->GetSize();
  double size[2];
  this->Names->SetInput("and more");
  this->Names->GetSize(viewport, size);
  const double line = std::max(1., size[1]);
  const auto room = static_cast<vtkIdType>((this->Bottom - 2 * MARGIN) * view[1] / line);
  const vtkIdType lines =
    std::min(structures->GetNumberOfRows(), std::clamp<vtkIdType>(room, 1, MOST_LINES));
  const vtkIdType listed = lines < structures->GetNumberOfRows() ? lines - 1 : lines;

  const int drawn = this->DrawPlate(
    viewport, NamesIn(structures, listed), this->Names, MARGIN + line / std::max(1, view[0]));
  double pixels[4]; // the first and the last column and row
  this->Names->GetBoundingBox(viewport, pixels);
  const double left[4] = { pixels[0] - line, pixels[0], pixels[2], pixels[3] + 1 };
  return drawn +
    limpid::DrawSwatches(viewport, this->Names->GetPosition(), left, { { 0, 0, 0, PLATE_OPACITY } },
      static_cast<int>(lines), ColorsIn(structures, listed));
}

int vtkScoreAnnotation::RenderOverlay(vtkViewport* viewport)
{
  this->Bottom = this->LowestOtherAnnotation(viewport);
  const int text = this->DrawPlate(viewport, this->CurrentText(), this->Actor, MARGIN);
  const int legend = this->DrawPlate(viewport, this->CurrentLegend(), this->Legend, MARGIN);
  return text + legend + this->DrawStructures(viewport, this->CurrentStructures());
}

void vtkScoreAnnotation::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Actor->ReleaseGraphicsResources(window);
  this->Legend->ReleaseGraphicsResources(window);
  this->Names->ReleaseGraphicsResources(window);
}

void vtkScoreAnnotation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Text: " << this->CurrentText() << "\n";
  os << indent << "Legend: " << this->CurrentLegend() << "\n";
  vtkTable* structures = this->CurrentStructures();
  os << indent
     << "Structures: " << (structures ? NamesIn(structures, structures->GetNumberOfRows()) : "")
     << "\n";
}
