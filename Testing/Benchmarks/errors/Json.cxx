// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Json.h"

#include "../Machine.h"
#include "Fronts.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstdlib>

namespace limpid::benchmark
{
namespace
{
using Json = nlohmann::ordered_json;

const char* NameOf(SolverKind solver)
{
  return solver == SolverKind::Policy ? "policy" : "Adam";
}

/// Six digits: what is measured has no more.
double Short(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return std::atof(text);
}

template <class Item, class Function>
Json ArrayOf(const std::vector<Item>& items, const Function& function)
{
  Json array = Json::array();
  for (const Item& item : items)
  {
    array.push_back(function(item));
  }
  return array;
}

void AddScore(Json& json, const ScoreErrors& errors)
{
  json["error_S_base"] = Short(errors.base);
  json["error_S_optimized"] = Short(errors.optimized);
  json["error_S"] = Short(errors.Largest());
}

void AddTransmittance(Json& json, const TransmittanceErrors& errors)
{
  json["rms_T_view"] = Short(errors.view);
  json["rms_T_light"] = Short(errors.light);
}

Json OfReference(const ReferenceFacts& facts)
{
  return { { "rays_per_voxel", facts.raysPerVoxel },
    { "rays_per_voxel_of_worth", facts.worthRaysPerVoxel }, { "S_base", Short(facts.base) },
    { "S_optimized", Short(facts.optimized) }, { "uncertainty", Short(facts.uncertainty) },
    { "voxels", facts.voxels }, { "seconds", Short(facts.seconds) } };
}

Json OfSweep(const SweepAccuracy& sweep)
{
  Json json{ { "ray_density", sweep.rayDensity } };
  AddScore(json, sweep.score);
  AddTransmittance(json, sweep.transmittance);
  json["error_slope"] = Short(sweep.slope);
  json["error_slope_ray"] = Short(sweep.raySlope);
  return json;
}

Json OfShadow(const ShadowAccuracy& shadow)
{
  Json json{ { "ray_density", shadow.rayDensity }, { "seconds", Short(shadow.seconds) } };
  AddTransmittance(json, shadow.transmittance);
  return json;
}

Json OfIteration(const IterationTime& time)
{
  return { { "solver", NameOf(time.solver) }, { "ray_density", time.rayDensity },
    { "skip", time.skip }, { "threads", time.threads }, { "seconds", Short(time.seconds) },
    { "timed", time.timed } };
}

Json OfGrid(const GridResult& grid)
{
  Json json{ { "samples_per_voxel", grid.samplesPerVoxel }, { "cells", grid.cells },
    { "seconds", Short(grid.seconds) }, { "timed", grid.timed }, { "bytes", grid.bytes } };
  AddScore(json, grid.score);
  AddTransmittance(json, grid.transmittance);
  json["error_slope"] = Short(grid.slope);
  return json;
}

Json OfQuadrature(const QuadratureResult& result)
{
  Json json{ { "rule", result.rule }, { "steps", result.steps },
    { "seconds", Short(result.seconds) } };
  AddScore(json, result.score);
  return json;
}

Json OfRun(const SceneResult& scene, const WholeRun& run)
{
  Json history = Json::array(); // of the runs that are plotted
  for (const HistoryPoint& point : run.history)
  {
    if (run.group == "default" || run.group == "solver")
    {
      history.push_back({ point.iteration, point.level, Short(point.seconds), Short(point.score),
        Short(point.energy) });
    }
  }
  const Settings& settings = run.settings;
  return { { "name", run.name }, { "group", run.group }, { "solver", NameOf(settings.solver) },
    { "ray_density", settings.rayDensity }, { "maximum_iterations", settings.maximumIterations },
    { "iterations_per_level", settings.iterationsPerLevel },
    { "derivative", settings.derivative == Derivative::Volume ? "Volume" : "Ray" },
    { "skip", settings.skipUnneeded }, { "threads", run.threads }, { "coarsening", run.coarsening },
    { "iterations", run.iterations }, { "seconds", Short(run.seconds) },
    { "spread", Short(run.spread) }, { "repeats", run.repeats }, { "bytes", run.bytes },
    { "S", Short(run.worth.score) }, { "S_light", Short(run.worth.lightScore) },
    { "F", Short(run.worth.energy) }, { "short_of_best_F", Short(ShortOfBestEnergy(scene, run)) },
    { "short_of_best_S", Short(ShortOfBestScore(scene, run)) },
    { "history_iteration_level_seconds_S_F", history } };
}

Json OfFront(const FrontFacts& facts)
{
  return { { "measure", facts.measure }, { "among", facts.among },
    { "default_seconds", Short(facts.seconds) }, { "default_error", Short(facts.error) },
    { "rival", facts.rival }, { "factor", Short(facts.factor) }, { "front", facts.front } };
}

Json OfEqual(const EqualError& equal)
{
  Json json{ { "interpolated", equal.samplesPerVoxel == 0 },
    { "samples_per_voxel", equal.samplesPerVoxel }, { "error_S", Short(equal.error) },
    { "grid_seconds", Short(equal.gridSeconds) } };
  if (equal.adamSeconds > 0)
  {
    json["adam_ray_density"] = equal.adamDensity;
    json["adam_seconds"] = Short(equal.adamSeconds);
    json["adam_ratio"] = Short(equal.gridSeconds / equal.adamSeconds);
  }
  if (equal.policySeconds > 0)
  {
    json["policy_ray_density"] = equal.policyDensity;
    json["policy_seconds"] = Short(equal.policySeconds);
    json["policy_ratio"] = Short(equal.gridSeconds / equal.policySeconds);
  }
  return json;
}

Json OfScene(const SceneResult& scene)
{
  return { { "name", scene.name }, { "nodes", scene.nodes }, { "voxels", scene.voxels },
    { "seconds", Short(scene.seconds) }, { "reference", OfReference(scene.reference) },
    { "sweeps", ArrayOf(scene.sweeps, OfSweep) }, { "shadows", ArrayOf(scene.shadows, OfShadow) },
    { "iterations", ArrayOf(scene.iterations, OfIteration) },
    { "paper_grids", ArrayOf(scene.grids, OfGrid) },
    { "quadratures", ArrayOf(scene.quadratures, OfQuadrature) },
    { "runs", ArrayOf(scene.runs, [&](const WholeRun& run) { return OfRun(scene, run); }) },
    { "fronts", ArrayOf(scene.fronts, OfFront) },
    { "equal_error", ArrayOf(scene.equal, OfEqual) } };
}
}

void WriteJson(std::ostream& stream, const std::vector<SceneResult>& scenes, double loadBefore,
  const std::string& cuda)
{
  const MachineFacts machine = FactsOfMachine();
  const Json facts{ { "processor", machine.processor }, { "cores", machine.cores },
    { "threads", machine.threads }, { "compiler", machine.compiler },
    { "build_type", machine.buildType }, { "date", machine.date }, { "load_before", loadBefore },
    { "cuda", cuda } };
  stream << "{ \"machine\": " << facts.dump() << ",\n  \"scenes\": [";
  for (const SceneResult& scene : scenes)
  {
    stream << (&scene == &scenes.front() ? "\n" : ",\n") << OfScene(scene).dump();
  }
  stream << " ] }\n";
}
}
