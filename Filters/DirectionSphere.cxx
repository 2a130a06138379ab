// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "DirectionSphere.h"

#include "SphereTriangles.h"

#include "vtkIdList.h"
#include "vtkLinearSubdivisionFilter.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPlatonicSolidSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace limpid
{
namespace
{
Vec3 PointOf(vtkPoints* points, vtkIdType id)
{
  Vec3 point;
  points->GetPoint(id, &point.x);
  return point;
}

// Adds a triangle, oriented so that its front faces outward.
void AddOutward(
  const std::vector<Vec3>& directions, std::array<vtkIdType, 3> corners, vtkCellArray* triangles)
{
  const Vec3& a = directions[std::size_t(corners[0])];
  const Vec3& b = directions[std::size_t(corners[1])];
  const Vec3& c = directions[std::size_t(corners[2])];
  if (glm::dot(glm::cross(a, b), c) < 0)
  {
    std::swap(corners[1], corners[2]);
  }
  triangles->InsertNextCell(3, corners.data());
}

// Returns a triangulated sphere of VTK with its points moved to the unit sphere by `place`.
template <class Place>
DirectionSphere FromSurface(vtkPolyData* surface, const Place& place)
{
  DirectionSphere sphere;
  for (vtkIdType id = 0; id < surface->GetNumberOfPoints(); ++id)
  {
    sphere.directions.push_back(glm::normalize(place(PointOf(surface->GetPoints(), id))));
  }
  sphere.triangles = vtkSmartPointer<vtkCellArray>::New();
  vtkNew<vtkIdList> cell;
  for (vtkIdType id = 0; id < surface->GetNumberOfCells(); ++id)
  {
    surface->GetCellPoints(id, cell);
    AddOutward(
      sphere.directions, { { cell->GetId(0), cell->GetId(1), cell->GetId(2) } }, sphere.triangles);
  }
  return sphere;
}

DirectionSphere MakeIcosphere(int count)
{
  vtkNew<vtkPlatonicSolidSource> source;
  source->SetSolidTypeToIcosahedron();
  source->Update();
  vtkSmartPointer<vtkPolyData> surface = source->GetOutput();
  const auto finer = [](vtkIdType points) { return 4 * points - 6; };
  for (vtkIdType points = surface->GetNumberOfPoints();
       std::abs(finer(points) - count) < std::abs(points - count); points = finer(points))
  {
    vtkNew<vtkLinearSubdivisionFilter> subdivide;
    subdivide->SetInputData(surface);
    subdivide->Update();
    surface = subdivide->GetOutput();
    // Normalising after every division makes the sizes of triangles more even.
    for (vtkIdType id = 0; id < surface->GetNumberOfPoints(); ++id)
    {
      const Vec3 direction = glm::normalize(PointOf(surface->GetPoints(), id));
      surface->GetPoints()->SetPoint(id, &direction.x);
    }
  }
  return FromSurface(surface, [](const Vec3& point) { return point; });
}

DirectionSphere MakeFibonacciSphere(int count)
{
  DirectionSphere sphere;
  const double goldenAngle = vtkMath::Pi() * (3 - std::sqrt(5.0));
  const int number = std::max(count, 4); // at least a tetrahedron
  for (int i = 0; i < number; ++i)
  {
    const double height = 1 - (2 * i + 1.0) / number;
    const double radius = std::sqrt((1 - height) * (1 + height));
    const double azimuth = i * goldenAngle;
    sphere.directions.push_back(
      glm::normalize(Vec3(radius * std::sin(azimuth), height, radius * std::cos(azimuth))));
  }
  sphere.triangles = vtkSmartPointer<vtkCellArray>::New();
  for (const std::array<vtkIdType, 3>& corners : TriangulateSphere(sphere.directions))
  {
    sphere.triangles->InsertNextCell(3, corners.data());
  }
  return sphere;
}

DirectionSphere MakeLatitudeLongitudeSphere(int count)
{
  // For equal spacing, there are twice as many directions around the equator as steps from pole to
  // pole: 2 + rings (2 (rings + 1)) directions in all.
  const int rings = std::max(
    1, static_cast<int>(std::lround(0.5 * (std::sqrt(std::max(2.0 * count - 3, 1.0)) - 1))));
  const int columns = std::max(3, static_cast<int>(std::lround((count - 2.0) / rings)));
  vtkNew<vtkSphereSource> source;
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->SetThetaResolution(columns);
  source->SetPhiResolution(rings + 2);
  source->Update();
  // The source has its poles on the z axis, and its longitudes begin at the x axis. Those of Eq.
  // (10) have the poles on the y axis and begin at the z axis.
  return FromSurface(
    source->GetOutput(), [](const Vec3& point) { return Vec3(point.y, point.z, point.x); });
}
}

double DirectionSphere::Spacing() const
{
  return std::sqrt(4 * vtkMath::Pi() / static_cast<double>(this->directions.size()));
}

DirectionSphere MakeDirectionSphere(Sampling sampling, int count)
{
  switch (sampling)
  {
    case Sampling::Fibonacci:
      return MakeFibonacciSphere(count);
    case Sampling::LatitudeLongitude:
      return MakeLatitudeLongitudeSphere(count);
    case Sampling::Icosphere:
      break;
  }
  return MakeIcosphere(count);
}
}
