// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Arrays.h"
#include "Bindings.h"
#include "Computing.h"

#include "optimize/PreparedScene.h"
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
// Throws limpid::Error unless the cameras of an orbit can be worked with.
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

// Direction, position and view up of the camera, score and fraction.
nb::tuple RowOf(const ScoredView& view, const Orbit& orbit)
{
  const Camera camera = orbit.At(view.direction);
  return nb::make_tuple(ToTriple(view.direction), ToTriple(camera.position),
    ToTriple(camera.viewUp), view.score.visibility, view.score.fraction);
}

nb::list RowsOf(const std::vector<ScoredView>& views, const Orbit& orbit)
{
  nb::list rows;
  for (const ScoredView& view : views)
  {
    rows.append(RowOf(view, orbit));
  }
  return rows;
}

// `viewed`: the extinction that is looked at; with `base` it is not the base extinction.
// `attainable`: every ray has its own, from `least` on.
nb::dict SearchViewpoints(const Grid& grid, const Field& viewed, const Field& importance,
  const OptionalField& base, bool attainable, const OptionalField& least, const Orbit& orbit,
  const Table<double, 3>& directions, const SearchSettings& search, const Settings& settings)
{
  RequireOrbit(orbit, settings, grid);
  std::vector<ScoredView> samples;
  SearchResult found;
  std::string backend;
  ComputeBesidePython(
    [&]
    {
      const ViewedFields fields{ viewed.data(), importance.data(), DataOf(base), nullptr,
        attainable, DataOf(least) };
      const ViewScore score(grid, fields, settings.rayDensity, settings.backend);
      backend = score.BackendName();
      samples = ScoreViews(score, orbit, DirectionsOf(directions), {});
      found = FindViewpoints(score, orbit, samples, search, {});
    });

  nb::dict results;
  results["samples"] = RowsOf(samples, orbit);
  results["viewpoints"] = RowsOf(found.viewpoints, orbit);
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
        double parallelScale) {
        new (orbit) Orbit{ ToVec3(centre), distance, viewAngle, parallel, parallelScale };
      },
      "centre"_a, "distance"_a, "view_angle"_a, "parallel_projection"_a, "parallel_scale"_a);
  nb::class_<SearchSettings>(module, "SearchSettings")
    .def(nb::init<>())
    .def_rw("viewpoints", &SearchSettings::viewpoints)
    .def_rw("separation", &SearchSettings::separation)
    .def_rw("refine", &SearchSettings::refine)
    .def_rw("first_step", &SearchSettings::firstStep);
  module.def("search_viewpoints", SearchViewpoints, "grid"_a, "viewed"_a.noconvert(),
    "importance"_a.noconvert(), "base"_a.noconvert().none(), "attainable"_a,
    "least"_a.noconvert().none(), "orbit"_a, "directions"_a, "search"_a, "settings"_a);
}
}
