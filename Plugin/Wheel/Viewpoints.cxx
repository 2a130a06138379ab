// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Arrays.h"
#include "Bindings.h"
#include "Computing.h"

#include "optimize/PreparedScene.h"
#include "scene/GridCorners.h"
#include "viewpoint/FittedCamera.h"
#include "viewpoint/Search.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <optional>

namespace nb = nanobind;
using namespace nb::literals;

namespace limpid::python
{
namespace
{
// Throws limpid::Error if the cameras of an orbit are invalid.
void RequireOrbit(const Orbit& orbit, const Settings& settings, const Grid& grid)
{
  RequireSettings(settings);
  const Camera any = orbit.At({ 0.0, 0.0, 1.0 });
  Light light;
  light.position = any.position;
  RequireView(any, light, settings, grid);
}

std::vector<Vec3> DirectionsOf(const Table<double, 3>& table)
{
  std::vector<Vec3> directions;
  for (std::size_t row = 0; row < table.shape(0); ++row)
  {
    const double* numbers = table.data() + 3 * row;
    directions.emplace_back(numbers[0], numbers[1], numbers[2]);
  }
  return directions;
}

// Reports both parts of a search to a caller, which may stop it.
class Report
{
public:
  explicit Report(const nb::object& callable)
    : Tell(ToProgress(callable))
  {
  }

  /// Returns a progress function for the part of the work from `begin` to `end`, in [0, 1].
  SearchProgress Part(double begin, double end, const char* text)
  {
    return [this, begin, end, text](double share)
    {
      this->Stopped =
        this->Stopped || (this->Tell && !this->Tell(begin + (end - begin) * share, text));
      return !this->Stopped;
    };
  }

  bool IsStopped() const { return this->Stopped; }

private:
  Progress Tell;
  bool Stopped = false;
};

// Returns the expected share of the samples in all evaluations; an ascent takes about fifteen.
double ShareOfSamples(double samples, const SearchSettings& search)
{
  return samples / (samples + (search.refine ? 15.0 * search.viewpoints : 0.0));
}

// Returns score, fraction and validity of the samples.
nb::list SamplesOf(const std::vector<ScoredView>& views)
{
  nb::list rows;
  for (const ScoredView& view : views)
  {
    rows.append(nb::make_tuple(view.score.visibility, view.score.fraction, view.valid));
  }
  return rows;
}

// Returns direction, camera, score and fraction of the viewpoints.
nb::list ViewpointsOf(
  const std::vector<ScoredView>& views, const Orbit& orbit, const Grid& grid, Aim aim)
{
  const std::vector<Vec3> corners = CornersOf(grid);
  nb::list rows;
  for (const ScoredView& view : views)
  {
    const Camera camera = FittedCamera(orbit, corners, view.direction, aim);
    rows.append(nb::make_tuple(ToTriple(view.direction), ToTriple(camera.position),
      ToTriple(camera.focalPoint), ToTriple(camera.viewUp), camera.parallelScale,
      view.score.visibility, view.score.fraction));
  }
  return rows;
}

// `proxy`: the extinction to score; null: the base extinction. `attainable`: score the best
// extinction for every ray within the bounds of the settings. `aimsAtCentre`: cameras of viewpoints
// look at the orbit's centre instead of the middle of the box.
nb::dict SearchViewpoints(const Grid& grid, const Field& base, const Field& importance,
  float majorant, const OptionalField& proxy, bool attainable, const Orbit& orbit,
  bool aimsAtCentre, const Table<double, 3>& directions, const SearchSettings& settingsOfSearch,
  const Settings& settings, const nb::object& progress)
{
  RequireOrbit(orbit, settings, grid);
  Report report(progress);
  SearchSettings search = settingsOfSearch;
  std::vector<ScoredView> samples;
  SearchResult found;
  std::string backend;
  ComputeBesidePython(
    [&]
    {
      const SceneFields scene{ grid, base.data(), importance.data(), majorant };
      const NodeValues least =
        attainable ? PreparedScene(scene).LeastExtinction(settings) : NodeValues();
      ViewedFields fields{ proxy ? proxy->data() : base.data(), importance.data() };
      fields.base = proxy ? base.data() : nullptr;
      fields.attainable = attainable;
      fields.least = attainable ? least.Data() : nullptr;
      const ViewScore score(grid, fields, settings.rayDensity, settings.backend);
      backend = score.BackendName();
      const std::vector<Vec3> ways = DirectionsOf(directions);
      const double share = ShareOfSamples(double(ways.size()), search);
      samples = ScoreViews(score, orbit, ways, report.Part(0, share, "Scoring views"));
      search.refine = search.refine && !report.IsStopped();
      found = FindViewpoints(
        score, orbit, samples, search, report.Part(share, 1, "Climbing to better views"));
    });

  nb::dict results;
  results["samples"] = SamplesOf(samples);
  results["viewpoints"] =
    ViewpointsOf(found.viewpoints, orbit, grid, aimsAtCentre ? Aim::Centre : Aim::Box);
  results["evaluations"] = found.evaluations;
  results["backend"] = backend;
  return results;
}
}

void BindViewpoints(nb::module_& module)
{
  nb::class_<Orbit>(module, "Orbit")
    .def(
      "__init__",
      [](Orbit* orbit, const Triple& centre, double distance, double viewAngle, bool parallel,
        double parallelScale, double aspect, const Triple& up)
      {
        new (orbit)
          Orbit{ ToVec3(centre), distance, viewAngle, parallel, parallelScale, aspect, ToVec3(up) };
      },
      "centre"_a, "distance"_a, "view_angle"_a, "parallel_projection"_a, "parallel_scale"_a,
      "aspect_ratio"_a, "up"_a);
  nb::class_<AllowedViews>(module, "AllowedViews")
    .def(
      "__init__",
      [](AllowedViews* allowed, const Triple& up, double lowest, double highest,
        const Table<double, 3>& avoided, double avoidanceAngle)
      {
        new (allowed)
          AllowedViews{ ToVec3(up), lowest, highest, DirectionsOf(avoided), avoidanceAngle };
      },
      "up"_a, "lowest"_a, "highest"_a, "avoided"_a, "avoidance_angle"_a);
  nb::class_<SearchSettings>(module, "SearchSettings")
    .def(nb::init<>())
    .def_rw("viewpoints", &SearchSettings::viewpoints)
    .def_rw("separation", &SearchSettings::separation)
    .def_rw("refine", &SearchSettings::refine)
    .def_rw("first_step", &SearchSettings::firstStep)
    .def_rw("allowed", &SearchSettings::allowed);
  module.def("search_viewpoints", SearchViewpoints, "grid"_a, "base"_a.noconvert(),
    "importance"_a.noconvert(), "majorant"_a, "proxy"_a.noconvert().none(), "attainable"_a,
    "orbit"_a, "aims_at_centre"_a, "directions"_a, "search"_a, "settings"_a, "progress"_a.none());
}
}
