// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Fronts.h"

#include "../Markdown.h"

#include <functional>

namespace limpid::benchmark
{
namespace
{
bool Dominates(const TimedError& one, const TimedError& other)
{
  return one.seconds <= other.seconds && one.error <= other.error &&
    (one.seconds < other.seconds || one.error < other.error);
}

/// One measure of sweeps against the time of policy iterations, first the default's rays.
FrontFacts FrontOfSweeps(const SceneResult& scene, const std::string& measure,
  const std::function<double(const SweepAccuracy&)>& errorOf)
{
  std::vector<TimedError> settings;
  for (const SweepAccuracy& sweep : scene.sweeps)
  {
    const TimedError setting{ "ρ = " + Significant(sweep.rayDensity, 2),
      SecondsOf(scene, SolverKind::Policy, sweep.rayDensity), errorOf(sweep) };
    const bool isDefault = sweep.rayDensity == Settings().rayDensity;
    settings.insert(isDefault ? settings.begin() : settings.end(), setting);
  }
  FrontFacts facts = PlaceOfFirst(settings);
  facts.measure = measure;
  facts.among = "policy iterations by rays";
  return facts;
}

FrontFacts FrontOfRuns(const SceneResult& scene, const std::string& measure,
  const std::function<double(const WholeRun&)>& errorOf)
{
  std::vector<TimedError> settings;
  for (const WholeRun& run : scene.runs)
  {
    if (run.threads == scene.runs.front().threads)
    {
      settings.push_back({ run.name, run.seconds, std::max(bestEnough, errorOf(run)) });
    }
  }
  FrontFacts facts = PlaceOfFirst(settings);
  facts.measure = measure;
  facts.among = "whole runs";
  return facts;
}

/// The cheapest iteration of a solver whose S is at least so exact.
void FindCheapest(
  const SceneResult& scene, SolverKind solver, double error, double& rayDensity, double& seconds)
{
  for (const SweepAccuracy& sweep : scene.sweeps)
  {
    const double time = SecondsOf(scene, solver, sweep.rayDensity);
    const bool cheaper = seconds == 0 || time < seconds;
    if (sweep.score.Largest() <= error && time > 0 && cheaper)
    {
      rayDensity = sweep.rayDensity;
      seconds = time;
    }
  }
}

EqualError AtError(const SceneResult& scene, double samplesPerVoxel, double error, double seconds)
{
  EqualError equal;
  equal.samplesPerVoxel = samplesPerVoxel;
  equal.error = error;
  equal.gridSeconds = seconds;
  FindCheapest(scene, SolverKind::Adam, error, equal.adamDensity, equal.adamSeconds);
  FindCheapest(scene, SolverKind::Policy, error, equal.policyDensity, equal.policySeconds);
  return equal;
}
}

std::vector<std::string> FrontOf(const std::vector<TimedError>& settings)
{
  std::vector<TimedError> front;
  for (const TimedError& setting : settings)
  {
    const bool beaten = std::any_of(settings.begin(), settings.end(),
      [&](const TimedError& other) { return Dominates(other, setting); });
    if (!beaten)
    {
      front.push_back(setting);
    }
  }
  std::sort(front.begin(), front.end(),
    [](const TimedError& one, const TimedError& other) { return one.seconds < other.seconds; });
  std::vector<std::string> names;
  for (const TimedError& setting : front)
  {
    names.push_back(setting.name);
  }
  return names;
}

FrontFacts PlaceOfFirst(const std::vector<TimedError>& settings)
{
  const TimedError& first = settings.front();
  FrontFacts facts;
  facts.seconds = first.seconds;
  facts.error = first.error;
  facts.front = FrontOf(settings);
  for (const TimedError& setting : settings)
  {
    const double factor = std::min(first.seconds / setting.seconds, first.error / setting.error);
    if (factor > facts.factor)
    {
      facts.factor = factor;
      facts.rival = setting.name;
    }
  }
  return facts;
}

double SecondsOf(const SceneResult& scene, SolverKind solver, double rayDensity)
{
  for (const IterationTime& time : scene.iterations)
  {
    if (time.solver == solver && time.rayDensity == rayDensity && time.skip && time.threads != 1)
    {
      return time.seconds;
    }
  }
  return 0;
}

double ShortOfBestEnergy(const SceneResult& scene, const WholeRun& run)
{
  double best = run.worth.energy;
  for (const WholeRun& other : scene.runs)
  {
    best = std::min(best, other.worth.energy);
  }
  return (run.worth.energy - best) / std::abs(best);
}

double ShortOfBestScore(const SceneResult& scene, const WholeRun& run)
{
  double best = run.worth.score;
  for (const WholeRun& other : scene.runs)
  {
    best = std::max(best, other.worth.score);
  }
  return 1 - run.worth.score / best;
}

std::vector<FrontFacts> FrontsOf(const SceneResult& scene)
{
  return {
    FrontOfSweeps(scene, "error of S",
      [&](const SweepAccuracy& sweep)
      { return std::max(scene.reference.uncertainty, sweep.score.Largest()); }),
    FrontOfSweeps(scene, "rms error of T",
      [](const SweepAccuracy& sweep)
      { return std::max(sweep.transmittance.view, sweep.transmittance.light); }),
    FrontOfSweeps(scene, "error of slopes", [](const SweepAccuracy& sweep) { return sweep.slope; }),
    FrontOfRuns(scene, "final F, short of the best",
      [&](const WholeRun& run) { return ShortOfBestEnergy(scene, run); }),
    FrontOfRuns(scene, "final S, short of the best",
      [&](const WholeRun& run) { return ShortOfBestScore(scene, run); }),
  };
}

std::vector<EqualError> EqualErrorsOf(const SceneResult& scene)
{
  std::vector<EqualError> equal;
  for (const GridResult& grid : scene.grids)
  {
    equal.push_back(AtError(scene, grid.samplesPerVoxel, grid.score.Largest(), grid.seconds));
  }
  for (const double error : { 0.2, 0.1, 0.05, 0.02, 0.01 })
  {
    for (std::size_t n = 1; n < scene.grids.size(); ++n)
    {
      const GridResult& coarse = scene.grids[n - 1];
      const GridResult& fine = scene.grids[n];
      if (coarse.score.Largest() >= error && fine.score.Largest() < error)
      {
        const double share = std::log(coarse.score.Largest() / error) /
          std::log(coarse.score.Largest() / fine.score.Largest());
        const double seconds = coarse.seconds * std::pow(fine.seconds / coarse.seconds, share);
        equal.push_back(AtError(scene, 0, error, seconds));
        break;
      }
    }
  }
  return equal;
}
}
