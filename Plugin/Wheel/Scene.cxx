// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Arrays.h"
#include "Bindings.h"

#include "scene/ImageGrid.h"
#include "scene/Placement.h"
#include "scene/RaySource.h"
#include "scene/StartingImportance.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

namespace nb = nanobind;
using namespace nb::literals;

namespace limpid::python
{
namespace
{
// `direction`: one world direction per axis of the grid.
void MakeGrid(Grid* grid, const std::array<int, 3>& nodes, const Triple& origin,
  const Triple& spacing, const std::array<Triple, 3>& direction)
{
  const Mat3 axes(ToVec3(direction[0]), ToVec3(direction[1]), ToVec3(direction[2]));
  new (grid)
    Grid(ImageGrid({ nodes[0], nodes[1], nodes[2] }, ToVec3(origin), ToVec3(spacing), axes));
}

// Returns position, focal point and parallel scale of the automatic camera.
nb::tuple PlacedCamera(const Grid& grid)
{
  Camera camera;
  PlaceCamera(grid, camera);
  return nb::make_tuple(
    ToTriple(camera.position), ToTriple(camera.focalPoint), camera.parallelScale);
}

// Returns the position of the automatic light.
Triple PlacedLight(const Camera& camera)
{
  Light light;
  PlaceLight(camera, light);
  return ToTriple(light.position);
}

// A light with a focal point is directional.
void MakeLight(Light* light, const Triple& position, const std::optional<Triple>& focalPoint)
{
  new (light) Light();
  light->position = ToVec3(position);
  if (focalPoint)
  {
    light->type = LightType::Directional;
    light->focalPoint = ToVec3(*focalPoint);
  }
}

using Samples = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

// Returns the values between which importance rises from 0 to 1, for ascending samples; None if no
// values stand out.
std::optional<std::array<double, 2>> StartingImportance(const Samples& sorted)
{
  const std::vector<double> samples(sorted.data(), sorted.data() + sorted.size());
  const ImportanceRamp ramp = RampOf(samples, {});
  if (!ramp.IsKnown())
  {
    return std::nullopt;
  }
  return { { ramp.begin, ramp.end } };
}

// Returns these values, or higher ones if these lie in noise. `values`: samples above the first
// one; `eighths`: for each, the eighth largest of its neighbours.
std::array<double, 2> CleanImportance(const std::array<double, 2>& ramp, const Samples& sorted,
  const Samples& values, const Samples& eighths)
{
  const std::vector<double> samples(sorted.data(), sorted.data() + sorted.size());
  std::vector<ValueWithNeighbours> amongOthers(values.size());
  for (std::size_t i = 0; i < amongOthers.size(); ++i)
  {
    amongOthers[i] = { values.data()[i], eighths.data()[i] };
  }
  const ImportanceRamp clean = CleanRamp({ ramp[0], ramp[1], {} }, samples, amongOthers);
  return { { clean.begin, clean.end } };
}
}

void BindScene(nb::module_& module)
{
  nb::class_<Grid>(module, "Grid")
    .def("__init__", MakeGrid, "nodes"_a, "origin"_a, "spacing"_a, "direction"_a);
  nb::class_<Camera>(module, "Camera")
    .def(
      "__init__",
      [](Camera* camera, const Triple& position, const Triple& focalPoint, const Triple& viewUp,
        double viewAngle, bool parallel, double parallelScale, double aspect)
      {
        new (camera) Camera{ ToVec3(position), ToVec3(focalPoint), ToVec3(viewUp), viewAngle,
          parallel, parallelScale, aspect, {} };
      },
      "position"_a, "focal_point"_a, "view_up"_a, "view_angle"_a, "parallel_projection"_a,
      "parallel_scale"_a, "aspect_ratio"_a);
  nb::class_<Light>(module, "Light")
    .def("__init__", MakeLight, "position"_a, "focal_point"_a.none());
  module.def("placed_camera", PlacedCamera, "grid"_a);
  module.def("placed_light", PlacedLight, "camera"_a);
  module.def("starting_importance", StartingImportance, "sorted"_a);
  module.def("clean_importance", CleanImportance, "ramp"_a, "sorted"_a, "values"_a, "eighths"_a);
  module.attr("most_samples_of_quantiles") = mostSamplesOfQuantiles;
}
}
