// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkViewpointSearchInternals.h"

#include "Abort.h"
#include "AllCores.h"
#include "Choices.h"
#include "Log.h"
#include "OptimizedViews.h"
#include "SampledData.h"
#include "SearchReport.h"
#include "SettingsConversion.h"
#include "Vectors.h"
#include "ViewpointData.h"

#include "vtkImageData.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkPolyData.h"

#include <vtksys/SystemInformation.hxx>

#include "backend/Choice.h"
#include "backend/Interruption.h"
#include "math/Require.h"
#include "optimize/PreparedScene.h"
#include "scene/GridCorners.h"
#include "viewpoint/Search.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace
{
constexpr double LongSeconds = 60; // longer searches are announced [s]

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Returns majorant times importance: important structures are as dense as possible, and there is
// nothing else.
std::vector<float> ProxyOf(const limpid::SceneFields& scene, double majorant)
{
  std::vector<float> proxy(std::size_t(scene.ValueCount()));
  const auto factor = static_cast<float>(majorant);
  limpid::ForOnAllCores(static_cast<vtkIdType>(proxy.size()),
    [&proxy, &scene, factor](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        proxy[std::size_t(i)] = factor * scene.importance[i];
      }
    });
  return proxy;
}

std::vector<limpid::ScoredView> Unscored(const std::vector<limpid::Vec3>& directions)
{
  std::vector<limpid::ScoredView> views(directions.size());
  std::transform(directions.begin(), directions.end(), views.begin(),
    [](const limpid::Vec3& direction)
    {
      limpid::ScoredView view;
      view.direction = direction;
      return view;
    });
  return views;
}

// Returns the expected share of the samples in all evaluations; an ascent takes about fifteen.
double ShareOfSamples(std::size_t samples, const limpid::SearchSettings& search)
{
  const double ascents = search.refine ? 15.0 * search.viewpoints : 0.0;
  return double(samples) / (double(samples) + ascents);
}
}

// Returns whether this process has the whole image.
bool vtkViewpointSearch::Internals::HasWholeImage(vtkInformationVector** inputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  const std::array<int, 6> whole = SceneReader::WholeExtentOf(inputVector);
  return input && std::equal(whole.begin(), whole.end(), input->GetExtent());
}

// Returns whether the whole image would take much of this machine's memory.
bool vtkViewpointSearch::Internals::IsLarge(vtkInformationVector** inputVector) const
{
  const std::array<int, 6> whole = SceneReader::WholeExtentOf(inputVector);
  double bytes = BytesPerPoint;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    bytes *= std::max(whole[2 * axis + 1] - whole[2 * axis] + 1, 0);
  }
  vtksys::SystemInformation machine;
  machine.RunMemoryCheck();
  constexpr double megabyte = 1024.0 * 1024.0;
  return this->Self->Field != OPTIMIZE_PER_VIEW &&
    bytes > megabyte * double(machine.GetTotalPhysicalMemory()) / 4;
}

// Returns whether `here` is true; if all ranks do the same steps, whether it is true on any rank.
bool vtkViewpointSearch::Internals::IsTrueOnAnyRank(bool here) const
{
  return this->SharesImage ? this->Ranks->AnyOf(here) : here;
}

limpid::ImageScene vtkViewpointSearch::Internals::Read(vtkInformationVector** inputVector) const
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  const int source =
    this->Self->Field == EXTINCTION_ARRAY ? int(ARRAY) : this->Self->ExtinctionSource;
  if (!this->SharesImage)
  {
    return this->Reader.Read(input, source);
  }
  LIMPID_REQUIRE(this->Self->Field != OPTIMIZE_PER_VIEW,
    "Field is Optimize Per View, and no process has the whole image (each view is optimised by a "
    "single process). Choose another Field, or read from a source that can give the whole image to "
    "each process.");
  return this->Reader.ReadShared(this->Ranks, inputVector, source);
}

// Calls a function that the user may interrupt.
template <class Function>
auto vtkViewpointSearch::Internals::Interruptibly(const Function& function) const
{
  const limpid::Interruptible interruptible(limpid::GoOn(this->Self));
  return function();
}

// Searches round any data. Every process gets an image of all that are none.
void vtkViewpointSearch::Internals::SearchAny(
  vtkInformationVector** inputVector, bool isLaterPiece, vtkPolyData* const outputs[3])
{
  if (!SceneReader::IsMesh(inputVector))
  {
    this->Search(inputVector, isLaterPiece, outputs);
    return;
  }
  if (isLaterPiece && this->Ranks->IsAlone())
  {
    return;
  }
  const limpid::SampledData sampled =
    this->Reader.Sample(vtkDataObject::GetData(inputVector[0]), *this->Ranks, true);
  const vtkSmartPointer<vtkInformationVector> image = limpid::WithImage(inputVector[0], sampled);
  vtkInformationVector* inputs = image;
  this->Search(&inputs, isLaterPiece, outputs);
}

void vtkViewpointSearch::Internals::Search(
  vtkInformationVector** inputVector, bool isLaterPiece, vtkPolyData* const outputs[3])
{
  this->SharesImage = !this->Ranks->IsAlone() && this->Ranks->AnyOf(!HasWholeImage(inputVector));
  if (!this->SharesImage)
  {
    this->Reader.RequireWholeImage(inputVector);
  }
  this->RequirePossibleSettings();
  if (isLaterPiece && this->Ranks->IsAlone())
  {
    return;
  }
  const Clock::time_point start = Clock::now();
  const limpid::ImageScene image = this->Interruptibly([&] { return this->Read(inputVector); });
  LIMPID_REQUIRE(image.grid.HasVolume(),
    "The image has " << image.grid.nodes.x << " x " << image.grid.nodes.y << " x "
                     << image.grid.nodes.z
                     << " points (it has no volume, so nothing is occluded). Give an image with at "
                        "least two points per axis.");
  limpidLogScope("Viewpoint Search: %d x %d x %d points, %d directions", image.grid.nodes.x,
    image.grid.nodes.y, image.grid.nodes.z, this->Self->NumberOfDirections);
  const auto scene = this->Interruptibly(
    [&image] { return std::make_shared<limpid::PreparedScene>(image.Fields()); });
  this->WarnOfSceneWithoutScore(*scene);

  limpid::FoundViews found;
  found.orbit = this->MakeOrbit(image.grid);
  found.corners = limpid::CornersOf(image.grid);
  found.aim = this->Self->UseFocalPoint ? limpid::Aim::Centre : limpid::Aim::Box;
  found.sphere = limpid::MakeDirectionSphere(
    static_cast<limpid::Sampling>(this->Self->Sampling), this->Self->NumberOfDirections);
  found.sphereCentre = image.grid.Centre();
  found.sphereRadius = this->Self->SphereRadius * image.grid.Radius();
  found.unitDistance = image.unitDistance;
  if (this->Self->Field == OPTIMIZE_PER_VIEW)
  {
    this->SearchOptimizedFields(scene, found);
  }
  else
  {
    this->SearchOneField(*scene, found);
  }
  if (isLaterPiece)
  {
    return;
  }
  found.seconds = SecondsSince(start);
  limpidLog("%s; %zu viewpoints after %.2f s", found.backend.c_str(),
    found.search.viewpoints.size(), found.seconds);
  if (found.search.viewpoints.empty() && !limpid::IsAborted(this->Self))
  {
    vtkWarningWithObjectMacro(this->Self,
      "No direction that was scored is within ElevationRange and far enough from all avoided ones "
      "(no viewpoint can be ranked). Widen the range, avoid less, or raise NumberOfDirections.");
  }

  limpid::FillSphere(found, outputs[0]);
  limpid::FillViewpoints(found, outputs[1]);
  limpid::FillPaths(found, outputs[2]);
  for (int port = 0; port < 3; ++port)
  {
    limpid::AddSearchSummary(found, outputs[port]->GetFieldData());
  }
}

void vtkViewpointSearch::Internals::SearchOneField(
  limpid::PreparedScene& scene, limpid::FoundViews& found) const
{
  const limpid::SceneFields& fields = scene.Arrays();
  const limpid::Settings settings = this->MakeSettings();
  found.isAttainable = this->Self->Field == ATTAINABLE;
  std::vector<float> proxy;
  limpid::NodeValues least; // must live as long as the score; ranks may share it
  const auto score = this->Interruptibly(
    [&]
    {
      limpid::ViewedFields viewed{ fields.baseExtinction, fields.importance };
      if (this->Self->Field == IMPORTANCE_PROXY)
      {
        proxy = ProxyOf(fields, scene.Majorant());
        viewed = { proxy.data(), fields.importance, fields.baseExtinction };
      }
      if (found.isAttainable)
      {
        least = scene.LeastExtinction(settings);
        viewed.attainable = true;
        viewed.least = least.Data();
      }
      viewed.piece = fields.piece;
      return limpid::ViewScore(fields.grid, viewed, settings.rayDensity,
        this->SharesImage ? limpid::BackendKind::Cpu : settings.backend);
    });
  found.backend = score.BackendName();
  this->ScoreAndFind(
    [&](const std::vector<limpid::Vec3>& directions, const limpid::SearchProgress& progress)
    { return limpid::ScoreViews(score, found.orbit, directions, progress); },
    [&](const limpid::SearchSettings& search, const limpid::SearchProgress& progress)
    { return limpid::FindViewpoints(score, found.orbit, found.samples, search, progress); },
    found);
}

void vtkViewpointSearch::Internals::SearchOptimizedFields(
  const std::shared_ptr<limpid::PreparedScene>& scene, limpid::FoundViews& found) const
{
  const limpid::OptimizedViews views(scene, found.orbit, this->MakeSettings());
  found.backend = limpid::ChooseBackend(this->MakeSettings().backend, {}).name;
  const Clock::time_point start = Clock::now();
  const std::size_t count = found.sphere.directions.size();
  bool isFirst = true;
  this->ScoreAndFind(
    [&](const std::vector<limpid::Vec3>& directions, const limpid::SearchProgress& progress)
    {
      return views.ScoreAll(directions,
        [&](double share)
        {
          const double expected = share > 0 ? SecondsSince(start) / share : 0;
          if (isFirst && expected > LongSeconds)
          {
            vtkWarningWithObjectMacro(this->Self,
              "Optimising the extinction for each of "
                << count << " views will take about " << std::lround(expected / 60)
                << " minutes. Reduce NumberOfDirections or choose another Field to be faster.");
          }
          isFirst = isFirst && !(share > 0);
          return progress(share);
        });
    },
    [&](const limpid::SearchSettings& search, const limpid::SearchProgress& progress)
    { return views.Find(found.samples, search, progress); },
    found);
}

// Each rank scores every N-th direction, where N is the number of ranks. The scores are gathered on
// all ranks.
template <class Score>
std::vector<limpid::ScoredView> vtkViewpointSearch::Internals::ScoreTogether(
  const std::vector<limpid::Vec3>& directions, const Score& score) const
{
  if (this->SharesImage)
  {
    return score(directions);
  }
  const auto first = static_cast<std::size_t>(this->Ranks->Rank());
  const auto step = static_cast<std::size_t>(this->Ranks->Size());
  std::vector<limpid::Vec3> own;
  for (std::size_t i = first; i < directions.size(); i += step)
  {
    own.push_back(directions[i]);
  }
  const std::vector<limpid::ScoredView> scored = score(own);
  constexpr std::size_t numbersOfView = 5;
  std::vector<double> numbers(numbersOfView * directions.size(), 0.0);
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    const limpid::ScoredView& view = scored[i];
    const double all[numbersOfView] = { view.score.visibility, view.score.fraction,
      view.score.sacrificed, view.worth, view.valid ? 1.0 : 0.0 };
    std::copy_n(all, numbersOfView, &numbers[numbersOfView * (first + i * step)]);
  }
  this->Ranks->Gather(numbers.data(), numbers.size());
  std::vector<limpid::ScoredView> views = Unscored(directions);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    const double* all = &numbers[numbersOfView * i];
    views[i].score = { all[0], all[1], all[2] };
    views[i].worth = all[3];
    views[i].valid = all[4] != 0;
  }
  return views;
}

template <class Score, class Find>
void vtkViewpointSearch::Internals::ScoreAndFind(
  const Score& score, const Find& find, limpid::FoundViews& found) const
{
  vtkViewpointSearch* self = this->Self;
  limpid::SearchReport report(
    [self](double share)
    {
      self->UpdateProgress(share);
      return !limpid::IsAborted(self);
    });
  limpid::SearchSettings search = this->MakeSearchSettings(found.sphere.Spacing());
  const double share = ShareOfSamples(found.sphere.directions.size(), search);

  self->SetProgressText("Scoring views");
  const limpid::SearchProgress progress = report.Part(0, share);
  found.samples = this->ScoreTogether(found.sphere.directions,
    [&](const std::vector<limpid::Vec3>& directions)
    {
      const bool isStopped = this->IsTrueOnAnyRank(!progress(0));
      return isStopped ? Unscored(directions) : score(directions, progress);
    });
  if (this->SharesImage || this->Ranks->Rank() == 0)
  {
    self->SetProgressText("Climbing to better views");
    search.refine = !this->IsTrueOnAnyRank(report.IsStopped()) && search.refine;
    found.search = find(search, report.Part(share, 1));
  }
  self->SetProgressText(nullptr);
}

void vtkViewpointSearch::Internals::RequirePossibleSettings() const
{
  const vtkViewpointSearch* self = this->Self;
  this->Reader.RequireUnitDistance();
  limpid::RequireSettings(this->MakeSettings());
  LIMPID_REQUIRE(self->CameraDistance >= 1 && std::isfinite(self->CameraDistance),
    "CameraDistance is "
      << self->CameraDistance
      << " radii of the sphere round the image (below 1, some cameras would be inside the image "
         "and would not see what is behind them). Set it to 1 or more, for instance 3.");
  LIMPID_REQUIRE(self->CameraViewAngle > 0 && self->CameraViewAngle < 180,
    "CameraViewAngle is " << self->CameraViewAngle
                          << " degrees (the perspective projection is undefined). Set an angle "
                             "between 0 and 180 degrees.");
  LIMPID_REQUIRE(self->CameraAspectRatio > 0 && std::isfinite(self->CameraAspectRatio),
    "CameraAspectRatio is "
      << self->CameraAspectRatio
      << " (the picture would have no width). Set it to the width of the picture over its height.");
  this->RequireAllowedViews();
  limpid::RequireAngle("SeparationAngle", self->SeparationAngle);
  LIMPID_REQUIRE(self->SphereRadius > 0 && std::isfinite(self->SphereRadius),
    "SphereRadius is " << self->SphereRadius
                       << " radii of the sphere round the image (there would be no surface to show "
                          "the scores on). Set it above 0, for instance to 1.1.");
}

void vtkViewpointSearch::Internals::WarnOfSceneWithoutScore(
  const limpid::PreparedScene& scene) const
{
  if (!scene.SomethingToSee())
  {
    vtkWarningWithObjectMacro(this->Self,
      "The largest extinction is "
        << scene.Majorant() << ", and "
        << (scene.Majorant() > 0 ? "no structure is important"
                                 : "without extinction nothing is visible")
        << " (every view has the score 0, so none is better than another). Check the importance "
           "and the extinction.");
  }
}

limpid::Vec3 vtkViewpointSearch::Internals::FocalPoint(const limpid::Grid& grid) const
{
  if (!this->Self->UseFocalPoint)
  {
    return grid.Centre();
  }
  const limpid::Vec3 focalPoint = limpid::ToVec3(this->Self->CameraFocalPoint);
  const double offset = glm::distance(focalPoint, grid.Centre()) / grid.Radius();
  LIMPID_REQUIRE(this->Self->CameraDistance >= 1 + offset,
    "CameraFocalPoint is "
      << focalPoint.x << " " << focalPoint.y << " " << focalPoint.z << ", " << offset
      << " radii of the sphere round the image from its centre, and CameraDistance is "
      << this->Self->CameraDistance
      << " radii (some cameras would be inside the image and would not see what is behind them). "
         "Move the focal point closer to the centre, or set CameraDistance to "
      << (1 + offset) << " or more.");
  return focalPoint;
}

limpid::Vec3 vtkViewpointSearch::Internals::UpAxis() const
{
  const limpid::Vec3 up = limpid::ToVec3(this->Self->CameraViewUp);
  return up == limpid::Vec3(0, 1, 0) ? up : glm::normalize(up);
}

limpid::AllowedViews vtkViewpointSearch::Internals::AllowedViews() const
{
  limpid::AllowedViews allowed;
  allowed.up = this->UpAxis();
  allowed.lowest = vtkMath::RadiansFromDegrees(this->Self->ElevationRange[0]);
  allowed.highest = vtkMath::RadiansFromDegrees(this->Self->ElevationRange[1]);
  allowed.avoidanceAngle = vtkMath::RadiansFromDegrees(this->Self->AvoidanceAngle);
  for (const limpid::Vec3& direction : this->Avoided)
  {
    allowed.avoided.push_back(glm::normalize(direction));
  }
  return allowed;
}

void vtkViewpointSearch::Internals::RequireAllowedViews() const
{
  const vtkViewpointSearch* self = this->Self;
  const auto isDirection = [](const limpid::Vec3& vector)
  { return std::isfinite(glm::length(vector)) && glm::length(vector) > 0; };
  LIMPID_REQUIRE(isDirection(limpid::ToVec3(self->CameraViewUp)),
    "CameraViewUp is "
      << self->CameraViewUp[0] << " " << self->CameraViewUp[1] << " " << self->CameraViewUp[2]
      << " (it does not define a direction). Set it to an axis, for instance 0 0 1.");
  limpid::RequireElevations(self->ElevationRange);
  limpid::RequireAngle("AvoidanceAngle", self->AvoidanceAngle);
  for (const limpid::Vec3& direction : this->Avoided)
  {
    LIMPID_REQUIRE(isDirection(direction),
      "An avoided direction is "
        << direction.x << " " << direction.y << " " << direction.z
        << " (it does not define a direction). Remove it or give a nonzero vector.");
  }
}

limpid::Orbit vtkViewpointSearch::Internals::MakeOrbit(const limpid::Grid& grid) const
{
  limpid::Orbit orbit;
  orbit.centre = this->FocalPoint(grid);
  orbit.distance = this->Self->CameraDistance * grid.Radius();
  orbit.viewAngle = this->Self->CameraViewAngle;
  orbit.parallel = this->Self->CameraParallelProjection != 0;
  orbit.parallelScale = grid.Radius();
  orbit.aspect = this->Self->CameraAspectRatio;
  orbit.up = this->UpAxis();

  const limpid::Camera any = orbit.At({ 0.0, 0.0, 1.0 });
  limpid::Light light;
  light.position = any.position;
  limpid::RequireView(any, light, this->MakeSettings(), grid);
  return orbit;
}

limpid::Settings vtkViewpointSearch::Internals::MakeSettings() const
{
  limpid::Settings settings = limpid::SettingsOf(this->Self->Settings);
  LIMPID_REQUIRE(settings.method == limpid::Method::Optimized,
    "Method is "
      << limpid::InfoOf(settings.method).name
      << " (the search scores the extinction of the method Optimized). Set Method to Optimized.");
  settings.restrictToView = false; // the whole image counts, even if a picture would show only part
                                   // of it
  return settings;
}

limpid::SearchSettings vtkViewpointSearch::Internals::MakeSearchSettings(double spacing) const
{
  limpid::SearchSettings search;
  search.viewpoints = this->Self->NumberOfViewpoints;
  search.separation = vtkMath::RadiansFromDegrees(this->Self->SeparationAngle);
  search.refine = this->Self->Refine != 0;
  search.firstStep = 0.5 * spacing;
  search.allowed = this->AllowedViews();
  return search;
}
