// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Page.h"

#include "../Markdown.h"
#include "Fronts.h"

namespace limpid::benchmark
{
namespace
{
std::string Percent(double share)
{
  const double percent = 100 * share;
  return percent == 0 ? "0 %" : Significant(percent, 2) + " %";
}

std::string Signed(double share)
{
  return (share < 0 ? "−" : "+") + Percent(std::abs(share));
}

std::string Small(double value)
{
  return Significant(value, 2);
}

std::string Rays(double rayDensity)
{
  return Significant(rayDensity, 2);
}

std::string OrNothing(double value, const std::string& text)
{
  return value > 0 ? text : "–";
}

void WriteFronts(std::ostream& stream, const std::vector<SceneResult>& scenes)
{
  Table table({ "scene", "error", "among", "default: time [ms]", "error", "rival", "factor",
    "on the front or within 10 %" });
  for (const SceneResult& scene : scenes)
  {
    for (const FrontFacts& facts : scene.fronts)
    {
      table.Add({ scene.name, facts.measure, facts.among, Milliseconds(facts.seconds),
        facts.measure == "rms error of T" ? Small(facts.error) : Percent(facts.error),
        facts.rival.empty() ? "–" : facts.rival, Fixed(facts.factor, 2),
        facts.factor <= 1.1 ? "yes" : "**no**" });
    }
  }
  stream << "\n## Is the default worth its time?\n\n"
         << "A setting is on the Pareto front if no other is both faster and better. *Rival*: the "
            "setting that is most better in time and error at once, and *factor* by how much, in "
            "the one of the two in which it is less so: with time and error divided by it the "
            "default would be on the front. Errors of an iteration are compared with the time of a "
            "policy iteration by rays, what is reached with that of a whole run of either solver. "
            "Errors below the reference's own, and shortfalls below 0.001 %, count as these. F is "
            "what the solvers minimise; S is a part of it, and a single pass, which does not know "
            "the light, gets more of S and less out of F.\n";
  table.Write(stream);
}

void WriteEqualErrors(std::ostream& stream, const std::vector<SceneResult>& scenes)
{
  Table table({ "scene", "samples per voxel", "error of S", "paper's grids [ms]",
    "Limpid, Adam [ms]", "rays", "ratio", "Limpid, policy [ms]", "rays", "ratio" });
  for (const SceneResult& scene : scenes)
  {
    for (const EqualError& equal : scene.equal)
    {
      table.Add({ scene.name,
        equal.samplesPerVoxel > 0 ? Significant(equal.samplesPerVoxel, 2) : "interpolated",
        Percent(equal.error), Milliseconds(equal.gridSeconds),
        OrNothing(equal.adamSeconds, Milliseconds(equal.adamSeconds)),
        OrNothing(equal.adamSeconds, Rays(equal.adamDensity)),
        OrNothing(equal.adamSeconds, Fixed(equal.gridSeconds / equal.adamSeconds, 0)),
        OrNothing(equal.policySeconds, Milliseconds(equal.policySeconds)),
        OrNothing(equal.policySeconds, Rays(equal.policyDensity)),
        OrNothing(equal.policySeconds, Fixed(equal.gridSeconds / equal.policySeconds, 0)) });
    }
  }
  stream << "\n## The paper's grids at equal error\n\n"
         << "An Adam iteration, camera and light, on the paper's perspective grids "
            "(`Testing/PaperScheme`) of several resolutions, and Limpid's cheapest iterations at "
            "full resolution whose S is at least as exact: same process, threads, compiler flags, "
            "float32. The finest grids are those that fit into the limits of memory and time. "
            "*Interpolated*: between the two neighbouring resolutions, straight in the logarithms "
            "of error and time. Error of S: the larger of that of the base extinction and of the "
            "default result.\n";
  table.Write(stream);
}

void WriteSweeps(std::ostream& stream, const SceneResult& scene)
{
  Table table({ "", "rays or samples per voxel", "policy iteration [ms]", "Adam iteration [ms]",
    "S, base", "S, optimised", "T_V, rms", "T_L, rms", "slopes, Volume", "slopes, Ray" });
  for (const SweepAccuracy& sweep : scene.sweeps)
  {
    table.Add({ "Limpid", Rays(sweep.rayDensity),
      Milliseconds(SecondsOf(scene, SolverKind::Policy, sweep.rayDensity)),
      Milliseconds(SecondsOf(scene, SolverKind::Adam, sweep.rayDensity)), Signed(sweep.score.base),
      Signed(sweep.score.optimized), Small(sweep.transmittance.view),
      Small(sweep.transmittance.light), Percent(sweep.slope), Percent(sweep.raySlope) });
  }
  for (const GridResult& grid : scene.grids)
  {
    table.Add({ "paper's grids", Rays(grid.samplesPerVoxel), "–", Milliseconds(grid.seconds),
      Signed(grid.score.base), Signed(grid.score.optimized), Small(grid.transmittance.view),
      Small(grid.transmittance.light), "–", Percent(grid.slope) });
  }
  stream << "### Iterations\n";
  table.Write(stream);
}

void WriteTimes(std::ostream& stream, const SceneResult& scene)
{
  Table table({ "solver", "rays", "skips", "threads", "iteration [ms]", "timed" });
  for (const IterationTime& time : scene.iterations)
  {
    if (!time.skip || time.threads == 1 || time.rayDensity == 1)
    {
      table.Add({ time.solver == SolverKind::Policy ? "policy" : "Adam", Rays(time.rayDensity),
        time.skip ? "on" : "off", std::to_string(time.threads), Milliseconds(time.seconds),
        std::to_string(time.timed) });
    }
  }
  stream << "### Skips and threads\n";
  table.Write(stream);
}

void WriteShadows(std::ostream& stream, const SceneResult& scene)
{
  Table table({ "", "rays", "T_V, rms", "T_L, rms", "one sweep [ms]" });
  for (const ShadowAccuracy& shadow : scene.shadows)
  {
    table.Add({ "nodes", Rays(shadow.rayDensity), Small(shadow.transmittance.view),
      Small(shadow.transmittance.light), Milliseconds(shadow.seconds) });
  }
  stream << "### Transmittance for shadows\n";
  table.Write(stream);
}

void WriteQuadratures(std::ostream& stream, const SceneResult& scene)
{
  Table table({ "rule", "steps per layer", "S, base", "S, optimised", "time [ms]" });
  for (const QuadratureResult& result : scene.quadratures)
  {
    table.Add({ result.rule, std::to_string(result.steps), Signed(result.score.base),
      Signed(result.score.optimized), Milliseconds(result.seconds) });
  }
  stream << "### Quadrature\n";
  table.Write(stream);
}

void WriteRuns(std::ostream& stream, const SceneResult& scene, const std::string& cuda)
{
  Table table({ "setting", "whole run [s]", "repeats", "spread", "iterations", "F (march)",
    "short of the best", "S (march)", "short of the best", "peak memory [MiB]" });
  for (const WholeRun& run : scene.runs)
  {
    table.Add({ run.name, Significant(run.seconds, 3), std::to_string(run.repeats),
      Fixed(100 * run.spread, 0) + " %", std::to_string(run.iterations), Fixed(run.worth.energy, 0),
      Percent(ShortOfBestEnergy(scene, run)), Significant(run.worth.score, 6),
      Percent(ShortOfBestScore(scene, run)), Fixed(run.bytes / 1048576, 1) });
  }
  if (!cuda.empty())
  {
    table.Add({ "CUDA", "not measured", "–", "–", "–", "–", "–", "–", "–", "–" });
  }
  stream << "### Whole runs\n";
  table.Write(stream);
}

void WriteScene(std::ostream& stream, const SceneResult& scene, const std::string& cuda)
{
  const ReferenceFacts& reference = scene.reference;
  stream << "\n## " << scene.name << "\n\n"
         << Sizes({ scene.nodes[0], scene.nodes[1], scene.nodes[2] })
         << " nodes. Reference: " << Rays(reference.raysPerVoxel) << " rays per voxel and axis, S "
         << Significant(reference.base, 6) << " (base) and " << Significant(reference.optimized, 6)
         << " (default result); with two thirds of the rays it moves by at most "
         << Percent(reference.uncertainty) << ". T at " << reference.voxels
         << " voxels. Measured in " << Fixed(scene.seconds, 0) << " s.\n\n";
  WriteSweeps(stream, scene);
  WriteTimes(stream, scene);
  WriteShadows(stream, scene);
  WriteQuadratures(stream, scene);
  WriteRuns(stream, scene, cuda);
}
}

void WritePage(
  std::ostream& stream, const std::vector<SceneResult>& scenes, const std::string& cuda)
{
  stream << "\nReference: the march of Testing/Reference, double precision, no code of the sweeps. "
            "Rays and samples are per voxel and axis. Quadrature: a simple scorer with two rays "
            "per voxel and axis (one in scenes above 4 million voxels), no skips. CUDA: "
         << (cuda.empty() ? "measured" : "not measured (" + cuda + ")") << ".\n";
  WriteFronts(stream, scenes);
  WriteEqualErrors(stream, scenes);
  for (const SceneResult& scene : scenes)
  {
    WriteScene(stream, scene, cuda);
  }
}
}
