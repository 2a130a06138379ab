// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Bindings.h"

#include "optimize/Presets.h"
#include "optimize/Settings.h"
#include "optimize/SettingsTable.h"
#include "scene/ViewSet.h"
#include "viewpoint/Concurrent.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <string>

namespace nb = nanobind;
using namespace nb::literals;

namespace limpid::python
{
namespace
{
// Names are those of the filters' properties in Python's spelling.
void BindChoices(nb::module_& module)
{
  nb::enum_<Method>(module, "Method")
    .value("optimized", Method::Optimized)
    .value("ordinary", Method::Ordinary)
    .value("viola_2004", Method::Viola2004)
    .value("marchesin_2010", Method::Marchesin2010)
    .value("ament_2017", Method::Ament2017);
  nb::enum_<Mode>(module, "Mode").value("joint", Mode::Joint).value("separate", Mode::Separate);
  nb::enum_<SolverKind>(module, "Solver")
    .value("policy", SolverKind::Policy)
    .value("adam", SolverKind::Adam);
  nb::enum_<Derivative>(module, "Derivative")
    .value("volume", Derivative::Volume)
    .value("ray", Derivative::Ray);
  nb::enum_<ImportanceSmoothing>(module, "ImportanceSmoothing")
    .value("off", ImportanceSmoothing::Off)
    .value("median", ImportanceSmoothing::Median);
  nb::enum_<ControlResolution>(module, "ControlResolution")
    .value("auto", ControlResolution::FinestThatFits)
    .value("full", ControlResolution::Full)
    .value("half", ControlResolution::Half)
    .value("quarter", ControlResolution::Quarter);
  nb::enum_<BackendKind>(module, "Backend")
    .value("auto", BackendKind::Auto)
    .value("cpu", BackendKind::Cpu)
    .value("cuda", BackendKind::Cuda);
  nb::enum_<Guide>(module, "ViewpointGuide")
    .value("proxy", Guide::Proxy)
    .value("coupled", Guide::Extinction)
    .value("attainable", Guide::Attainable);
  nb::enum_<ViewKind>(module, "Views")
    .value("single_view", ViewKind::Single)
    .value("stereo_pair", ViewKind::StereoPair)
    .value("orbit", ViewKind::Orbit);
}

// Binds a member of the settings, or of one of its members, as a property.
#define LIMPID_BIND(property, name, member)                                                        \
  settings.def_prop_rw(                                                                            \
    #name, [](const Settings& self) { return self.member; },                                       \
    [](Settings& self, decltype(Settings().member) value) { self.member = value; });
}

void BindSettings(nb::module_& module)
{
  BindChoices(module);
  nb::class_<Settings> settings(module, "Settings");
  settings.def(nb::init<>());
  LIMPID_EVERY_CORE_SETTING(LIMPID_BIND);
  nb::class_<ViewSet>(module, "ViewSet")
    .def(
      "__init__",
      [](ViewSet* views, ViewKind kind, int count, double eyeAngle)
      {
        new (views) ViewSet{ kind, count, eyeAngle };
        views->Require();
      },
      "kind"_a, "count"_a, "eye_angle"_a);
  module.def("settings_of_preset",
    [](const std::string& name)
    {
      Settings ofPreset;
      Take(PresetNamed(name), ofPreset);
      return ofPreset;
    });
}
}
