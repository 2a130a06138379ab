// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Swatches.h"

#include "vtkActor2D.h"
#include "vtkCellArray.h"
#include "vtkCoordinate.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkUnsignedCharArray.h"
#include "vtkViewport.h"

#include <cmath>

namespace limpid
{
namespace
{
// Side of a square [height of its line].
constexpr double SHARE = 0.6;

// Rectangles in colours.
class Rectangles
{
public:
  Rectangles()
  {
    this->Colors->SetNumberOfComponents(4);
    this->Data->SetPoints(this->Points);
    this->Data->SetPolys(this->Polygons);
    this->Data->GetPointData()->SetScalars(this->Colors);
  }

  void Add(double left, double right, double bottom, double top, const Color& color)
  {
    const vtkIdType first = this->Points->InsertNextPoint(left, bottom, 0);
    this->Points->InsertNextPoint(right, bottom, 0);
    this->Points->InsertNextPoint(right, top, 0);
    this->Points->InsertNextPoint(left, top, 0);
    const vtkIdType corners[4] = { first, first + 1, first + 2, first + 3 };
    this->Polygons->InsertNextCell(4, corners);
    for (int corner = 0; corner < 4; ++corner)
    {
      this->Colors->InsertNextTuple4(
        255 * color[0] + 0.5, 255 * color[1] + 0.5, 255 * color[2] + 0.5, 255 * color[3] + 0.5);
    }
  }

  vtkPolyData* Get() { return this->Data; }

private:
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Polygons;
  vtkNew<vtkUnsignedCharArray> Colors;
  vtkNew<vtkPolyData> Data;
};
}

int DrawSwatches(vtkViewport* viewport, const double place[2], const double box[4],
  const Color& plate, int lines, const std::vector<Color>& colors)
{
  Rectangles rectangles;
  rectangles.Add(box[0], box[1], box[2], box[3], plate);
  const double line = (box[3] - box[2]) / lines;
  const double side = std::round(SHARE * line);
  const double left = std::round((box[0] + box[1] - side) / 2);
  double middle = box[3] + line / 2;
  for (const Color& color : colors)
  {
    middle -= line;
    const double lower = std::round(middle - side / 2);
    rectangles.Add(left, left + side, lower, lower + side, color);
  }
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(rectangles.Get());
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(place[0], place[1]);
  const int drawn = actor->RenderOverlay(viewport);
  actor->ReleaseGraphicsResources(viewport->GetVTKWindow());
  return drawn;
}
}
