// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Arrays.h"
#include "Bindings.h"
#include "Computing.h"

#include "render/Renderer.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

#include <optional>

namespace nb = nanobind;
using namespace nb::literals;

namespace limpid::python
{
namespace
{
// `extinction`: values at equal steps of the scalar [1/length]; `color`: as many colours [0, 1].
void MakeFunctions(TransferFunctions* functions, double low, double high, const Field& extinction,
  const Table<float, 3>& color)
{
  new (functions) TransferFunctions();
  functions->low = low;
  functions->high = high;
  functions->extinction.assign(extinction.data(), extinction.data() + extinction.size());
  for (std::size_t row = 0; row < color.shape(0); ++row)
  {
    const float* channels = color.data() + 3 * row;
    functions->color.push_back({ { channels[0], channels[1], channels[2] } });
  }
}

// `clipToWorld`: 16 numbers, column by column.
void MakeView(View* view, int width, int height, const std::array<double, 16>& clipToWorld,
  double sampleDistance)
{
  new (view) View();
  view->width = width;
  view->height = height;
  view->sampleDistance = sampleDistance;
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      view->clipToWorld[column][row] = clipToWorld[4 * std::size_t(column) + std::size_t(row)];
    }
  }
}

// Returns colours premultiplied by alpha, bottom row first. `base`, `extinction` and
// `lightExtinction` as for Renderer::SetExtinction.
nb::object Render(const Grid& grid, const Field& scalars, const TransferFunctions& functions,
  const OptionalField& base, const OptionalField& extinction, const OptionalField& lightExtinction,
  const Lighting& lighting, const View& view, const nb::object& progress)
{
  Picture picture;
  Listener listener;
  if (!progress.is_none())
  {
    listener = [&progress](double share) { progress(share, "Drawing"); };
  }
  ComputeBesidePython(
    [&]
    {
      Renderer renderer;
      renderer.SetScalars(grid, scalars.data());
      renderer.SetTransferFunctions(functions);
      renderer.SetExtinction(grid, DataOf(base), DataOf(extinction), 1, DataOf(lightExtinction));
      renderer.SetLighting(lighting);
      renderer.Render(view, picture);
    },
    listener);
  return ToNumpy(std::move(picture.rgba));
}

void BindLighting(nb::module_& module)
{
  nb::class_<Lighting>(module, "Lighting")
    .def(nb::init<>())
    .def_rw("enabled", &Lighting::enabled)
    .def_rw("light", &Lighting::light)
    .def_rw("light_intensity", &Lighting::intensity)
    .def_rw("ambient", &Lighting::ambient)
    .def_rw("anisotropy", &Lighting::anisotropy)
    .def_rw("specular", &Lighting::surface)
    .def_rw("specular_power", &Lighting::specularPower)
    .def_rw("shadows", &Lighting::shadows)
    .def_rw("shadow_strength", &Lighting::shadowStrength);
}
}

void BindRender(nb::module_& module)
{
  BindLighting(module);
  nb::class_<TransferFunctions>(module, "TransferFunctions")
    .def("__init__", MakeFunctions, "low"_a, "high"_a, "extinction"_a, "color"_a);
  nb::class_<View>(module, "View")
    .def("__init__", MakeView, "width"_a, "height"_a, "clip_to_world"_a, "sample_distance"_a);
  module.def("render", Render, "grid"_a, "scalars"_a.noconvert(), "functions"_a,
    "base"_a.noconvert().none(), "extinction"_a.noconvert().none(),
    "light_extinction"_a.noconvert().none(), "lighting"_a, "view"_a, "progress"_a.none());
}
}
