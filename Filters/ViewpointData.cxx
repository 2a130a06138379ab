// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ViewpointData.h"

#include "FieldValues.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <numeric>

namespace limpid
{
namespace
{
bool IsWorse(const ScoredView& a, const ScoredView& b)
{
  return IsBetter(b, a);
}

// Returns the views that were evaluated.
std::vector<ScoredView> ValidOf(const std::vector<ScoredView>& views)
{
  std::vector<ScoredView> valid;
  std::copy_if(views.begin(), views.end(), std::back_inserter(valid),
    [](const ScoredView& view) { return view.valid; });
  return valid;
}

// Returns an array with one number per item, which is a view or a camera.
template <class Item, class Value>
void AddNumbers(
  const char* name, const std::vector<Item>& items, const Value& value, vtkPolyData* output)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const Item& item : items)
  {
    array->InsertNextValue(value(item));
  }
  output->GetPointData()->AddArray(array);
}

template <class Item, class Value>
void AddVectors(
  const char* name, const std::vector<Item>& items, const Value& value, vtkPolyData* output)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  for (const Item& item : items)
  {
    const Vec3 vector = value(item);
    array->InsertNextTuple3(vector.x, vector.y, vector.z);
  }
  output->GetPointData()->AddArray(array);
}

void AddScores(const FoundViews& found, const std::vector<ScoredView>& views, vtkPolyData* output)
{
  AddNumbers(
    "VisibilityScore", views, [](const ScoredView& view) { return view.score.visibility; }, output);
  AddNumbers(
    "VisibleFraction", views, [](const ScoredView& view) { return view.score.fraction; }, output);
  if (found.isAttainable)
  {
    AddNumbers(
      "AttainableFraction", views, [](const ScoredView& view) { return view.score.fraction; },
      output);
  }
  output->GetPointData()->SetActiveScalars("VisibilityScore");
}

double AzimuthOf(const ScoredView& view)
{
  return vtkMath::DegreesFromRadians(AnglesOf(view.direction).azimuth);
}

double PolarOf(const ScoredView& view)
{
  return vtkMath::DegreesFromRadians(AnglesOf(view.direction).polar);
}

// Adds the angles of Eq. (10) and the camera of each view.
void AddCameras(
  const std::vector<ScoredView>& views, const std::vector<Camera>& cameras, vtkPolyData* output)
{
  AddNumbers("Azimuth", views, AzimuthOf, output);
  AddNumbers("Polar", views, PolarOf, output);
  AddVectors(
    "ViewDirection", views, [](const ScoredView& view) { return view.direction; }, output);
  AddVectors(
    "CameraPosition", cameras, [](const Camera& camera) { return camera.position; }, output);
  AddVectors(
    "CameraFocalPoint", cameras, [](const Camera& camera) { return camera.focalPoint; }, output);
  AddVectors(
    "CameraViewUp", cameras, [](const Camera& camera) { return camera.viewUp; }, output);
  AddNumbers(
    "CameraParallelScale", cameras, [](const Camera& camera) { return camera.parallelScale; },
    output);
}

// Returns the cameras that views were scored with.
std::vector<Camera> ScoringCameras(const Orbit& orbit, const std::vector<ScoredView>& views)
{
  std::vector<Camera> cameras(views.size());
  std::transform(views.begin(), views.end(), cameras.begin(),
    [&orbit](const ScoredView& view) { return orbit.At(view.direction); });
  return cameras;
}

// Adds ranks: 1 for the best of the evaluated views and so on, 0 for views that were not evaluated.
void AddRanks(const std::vector<ScoredView>& views, vtkPolyData* output)
{
  std::vector<std::size_t> order(views.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&views](std::size_t a, std::size_t b)
    { return views[a].valid != views[b].valid ? views[a].valid : IsWorse(views[b], views[a]); });
  vtkNew<vtkIntArray> ranks;
  ranks->SetName("Rank");
  ranks->SetNumberOfTuples(static_cast<vtkIdType>(views.size()));
  vtkNew<vtkIntArray> valid;
  valid->SetName("Valid");
  valid->SetNumberOfTuples(static_cast<vtkIdType>(views.size()));
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    const bool isValid = views[order[place]].valid;
    const auto id = static_cast<vtkIdType>(order[place]);
    ranks->SetValue(id, isValid ? static_cast<int>(place) + 1 : 0);
    valid->SetValue(id, isValid ? 1 : 0);
  }
  output->GetPointData()->AddArray(ranks);
  output->GetPointData()->AddArray(valid);
}

// Adds scores scaled from 0 for the worst to 1 for the best. If all are equal, they are 1 if
// anything can be seen, else 0.
void AddNormalizedScores(const std::vector<ScoredView>& views, vtkPolyData* output)
{
  const std::vector<ScoredView> valid = ValidOf(views);
  const auto range = std::minmax_element(valid.begin(), valid.end(), IsWorse);
  const double least = valid.empty() ? 0 : range.first->worth;
  const double span = valid.empty() ? 0 : range.second->worth - least;
  AddNumbers(
    "NormalizedScore", views,
    [least, span](const ScoredView& view)
    {
      const double same = view.worth > 0 ? 1 : 0;
      const double normalized = span > 0 ? (view.worth - least) / span : same;
      return view.valid ? normalized : 0;
    },
    output);
}

void AddView(
  const std::string& prefix, const ScoredView& view, const Camera& camera, vtkFieldData* output)
{
  AddValue<vtkDoubleArray>((prefix + "VisibilityScore").c_str(), view.score.visibility, output);
  AddValue<vtkDoubleArray>((prefix + "VisibleFraction").c_str(), view.score.fraction, output);
  AddVector((prefix + "CameraPosition").c_str(), camera.position, output);
  AddVector((prefix + "CameraFocalPoint").c_str(), camera.focalPoint, output);
  AddVector((prefix + "CameraViewUp").c_str(), camera.viewUp, output);
  AddValue<vtkDoubleArray>((prefix + "Azimuth").c_str(), AzimuthOf(view), output);
  AddValue<vtkDoubleArray>((prefix + "Polar").c_str(), PolarOf(view), output);
}
}

void FillSphere(const FoundViews& found, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& direction : found.sphere.directions)
  {
    const Vec3 point = found.sphereCentre + found.sphereRadius * direction;
    points->InsertNextPoint(&point.x);
  }
  output->SetPoints(points);
  output->SetPolys(found.sphere.triangles);
  AddScores(found, found.samples, output);
  AddNormalizedScores(found.samples, output);
  AddCameras(found.samples, ScoringCameras(found.orbit, found.samples), output);
  AddRanks(found.samples, output);
  output->GetPointData()->SetActiveNormals("ViewDirection");
}

void FillViewpoints(const FoundViews& found, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> vertices;
  std::vector<Camera> cameras;
  for (const ScoredView& view : found.search.viewpoints)
  {
    cameras.push_back(found.CameraOf(view));
    const vtkIdType id = points->InsertNextPoint(&cameras.back().position.x);
    vertices->InsertNextCell(1, &id);
  }
  output->SetPoints(points);
  output->SetVerts(vertices);
  AddScores(found, found.search.viewpoints, output);
  AddCameras(found.search.viewpoints, cameras, output);
  AddRanks(found.search.viewpoints, output);
}

void FillPaths(const FoundViews& found, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  std::vector<ScoredView> views;
  for (const std::vector<ScoredView>& path : found.search.paths)
  {
    if (path.size() < 2)
    {
      continue; // the sample itself was the best view
    }
    lines->InsertNextCell(static_cast<int>(path.size()));
    for (const ScoredView& view : path)
    {
      const Vec3 position = found.orbit.At(view.direction).position;
      lines->InsertCellPoint(points->InsertNextPoint(&position.x));
      views.push_back(view);
    }
  }
  output->SetPoints(points);
  output->SetLines(lines);
  AddScores(found, views, output);
  AddCameras(views, ScoringCameras(found.orbit, views), output);
}

void AddSearchSummary(const FoundViews& found, vtkFieldData* output)
{
  const std::vector<ScoredView> valid = ValidOf(found.samples);
  if (!found.search.viewpoints.empty() && !valid.empty())
  {
    const ScoredView& best = found.search.viewpoints.front();
    AddView("Best", best, found.CameraOf(best), output);
    const ScoredView& worst = *std::min_element(valid.begin(), valid.end(), IsWorse);
    AddView("Worst", worst, found.orbit.At(worst.direction), output);
  }
  AddVector("CameraFocalPoint", found.orbit.centre, output);
  AddVector("CameraUpAxis", found.orbit.up, output);
  AddValue<vtkDoubleArray>("CameraViewAngle", found.orbit.viewAngle, output);
  AddValue<vtkIntArray>("CameraParallelProjection", found.orbit.parallel ? 1 : 0, output);
  AddValue<vtkDoubleArray>("CameraParallelScale", found.orbit.parallelScale, output);
  AddValue<vtkDoubleArray>("CameraAspectRatio", found.orbit.aspect, output);
  AddTuple("ImageCorners", found.corners, output);
  AddValue<vtkIntArray>("Evaluations", static_cast<int>(found.search.evaluations), output);
  AddValue<vtkDoubleArray>("Seconds", found.seconds, output);
  AddValue<vtkDoubleArray>("ScalarOpacityUnitDistance", found.unitDistance, output);
  AddValue<vtkStringArray>("Backend", found.backend, output);
}
}
