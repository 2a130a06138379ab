// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Quality.h"

#include "Markdown.h"
#include "Timing.h"

#include <algorithm>

namespace limpid::benchmark
{
namespace
{
RunResult RunToTheEnd(const Scene& scene, SolverKind kind, const Options& options)
{
  Settings settings;
  settings.solver = kind;
  Stopwatch watch;
  Solver solver = scene.MakeSolver(settings);
  solver.Run();

  RunResult result;
  result.seconds = watch.Lap();
  result.score.reported = solver.BestScore().visibility;
  result.score.march = scene.March(solver.Extinction(), options.marchRays);
  result.energy = solver.BestEnergy().Total();
  result.fraction = solver.BestScore().fraction;
  result.iterations = solver.Iterations();
  result.first = solver.History()[std::min<std::size_t>(1, solver.History().size() - 1)];
  return result;
}

void WriteAccuracy(std::ostream& stream, const std::vector<QualityResult>& results)
{
  Table table({ "scene", "base S, reported", "march", "deviation", "policy S, reported", "march",
    "deviation", "Adam S, reported", "march", "deviation" });
  for (const QualityResult& result : results)
  {
    std::vector<std::string> row{ result.scene };
    for (const CheckedScore& score : { result.base, result.policy.score, result.adam.score })
    {
      row.push_back(Significant(score.reported, 6));
      row.push_back(Significant(score.march, 6));
      row.push_back(Deviation(score.reported, score.march));
    }
    table.Add(row);
  }
  stream << "Scores [length²] that the solver reports against those of the march.\n";
  table.Write(stream);
}

void WriteComparison(std::ostream& stream, const std::vector<QualityResult>& results)
{
  Table table({ "scene", "policy, 1 iteration: F", "S", "policy: F", "S (march)",
    "visible, before → after", "iterations", "time [s]", "Adam: F", "S (march)", "iterations",
    "time [s]", "F, policy to Adam" });
  for (const QualityResult& result : results)
  {
    const RunResult& policy = result.policy;
    const RunResult& adam = result.adam;
    table.Add({ result.scene, Fixed(policy.first.energy.Total(), 0),
      Significant(policy.first.visibilityScore, 5), Fixed(policy.energy, 0),
      Significant(policy.score.march, 5),
      Fixed(100 * result.baseFraction, 1) + " → " + Fixed(100 * policy.fraction, 1) + " %",
      std::to_string(policy.iterations), Significant(policy.seconds, 3), Fixed(adam.energy, 0),
      Significant(adam.score.march, 5), std::to_string(adam.iterations),
      Significant(adam.seconds, 3), Deviation(policy.energy, adam.energy) });
  }
  stream << "Policy with default settings against Adam with 32, 32 and 64 iterations on a quarter, "
            "half and full resolution. F is the energy of Eq. (21); the last column is negative "
            "where the policy's is lower, that is, better. S after one iteration is the reported "
            "one. Visible: S over the same integral without transmittance. Times are those of one "
            "run each, with setup.\n";
  table.Write(stream);
}
}

QualityResult MeasureQuality(const Scene& scene, const Options& options)
{
  QualityResult result;
  result.scene = scene.file.name;
  const Score base = scene.MakeSolver(Settings()).BaseScore();
  result.base.reported = base.visibility;
  result.baseFraction = base.fraction;
  result.base.march = scene.March(scene.file.extinction, options.marchRays);
  result.policy = RunToTheEnd(scene, SolverKind::Policy, options);
  result.adam = RunToTheEnd(scene, SolverKind::Adam, options);
  return result;
}

void WriteQuality(
  std::ostream& stream, const std::vector<QualityResult>& results, const Options& options)
{
  stream << "\n## Policy against Adam\n\n"
         << "The march is that of Testing/Reference: double precision, " << options.marchRays
         << " rays per voxel and axis, four Gauss points in every piece of a cell, no code of the "
            "solver.\n\n"
         << "### Are the reported scores true?\n\n";
  WriteAccuracy(stream, results);
  stream << "### Which solver ends lower?\n\n";
  WriteComparison(stream, results);
}
}
