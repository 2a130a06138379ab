// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Bindings.h"

#include "optimize/Presets.h"
#include "optimize/Settings.h"
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

// Binds a member of a member of the settings as a property.
template <class Part, class Value>
void BindPart(
  nb::class_<Settings>& settings, const char* name, Part Settings::*part, Value Part::*member)
{
  settings.def_prop_rw(
    name, [part, member](const Settings& self) { return self.*part.*member; },
    [part, member](Settings& self, Value value) { self.*part.*member = value; });
}
}

void BindSettings(nb::module_& module)
{
  BindChoices(module);
  nb::class_<Settings> settings(module, "Settings");
  settings.def(nb::init<>())
    .def_rw("method", &Settings::method)
    .def_rw("clearing_threshold", &Settings::clearingThreshold)
    .def_rw("mode", &Settings::mode)
    .def_rw("solver", &Settings::solver)
    .def_rw("maximum_iterations", &Settings::maximumIterations)
    .def_rw("iterations_per_level", &Settings::iterationsPerLevel)
    .def_rw("learning_rate", &Settings::learningRate)
    .def_rw("tolerance", &Settings::tolerance)
    .def_rw("maximum_seconds", &Settings::maximumSeconds)
    .def_rw("derivative", &Settings::derivative)
    .def_rw("ray_density", &Settings::rayDensity)
    .def_rw("skip_unneeded", &Settings::skipUnneeded)
    .def_rw("restrict_to_view", &Settings::restrictToView)
    .def_rw("protect_importance", &Settings::protectImportance)
    .def_rw("emphasis", &Settings::emphasis)
    .def_rw("importance_smoothing", &Settings::importanceSmoothing)
    .def_rw("smoothness", &Settings::smoothness)
    .def_rw("temporal_coherence", &Settings::temporalCoherence)
    .def_rw("backend", &Settings::backend);
  BindPart(settings, "regularization_weight", &Settings::weights, &Weights::regularization);
  BindPart(settings, "view_weight", &Settings::weights, &Weights::view);
  BindPart(settings, "light_weight", &Settings::weights, &Weights::light);
  BindPart(settings, "ament_exponent", &Settings::ament, &AmentWeights::exponent);
  BindPart(settings, "ament_regularization", &Settings::ament, &AmentWeights::regularization);
  BindPart(settings, "ament_occluders", &Settings::ament, &AmentWeights::occluders);
  BindPart(settings, "ament_background", &Settings::ament, &AmentWeights::background);
  BindPart(settings, "ament_light_occluders", &Settings::ament, &AmentWeights::lightOccluders);
  BindPart(settings, "ament_light_background", &Settings::ament, &AmentWeights::lightBackground);
  BindPart(settings, "ament_smoothing", &Settings::ament, &AmentWeights::smoothingPasses);
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
