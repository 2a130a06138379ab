// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "AgainstPaper.h"

#include "Markdown.h"
#include "Timing.h"

#include "PaperScheme/PaperScheme.h"

namespace limpid::benchmark
{
namespace
{
using Paper = reference::PaperScheme<float>;

Paper MakePaper(const Scene& scene, const Options& options)
{
  reference::PaperSettings settings;
  settings.samplesPerVoxel = options.paperSamples;
  return Paper(scene.Fields(), scene.camera.position, scene.light.position, settings);
}

/// The same problem: Adam on the full resolution alone, from the base extinction.
Solver MakeAdam(const Scene& scene, const Options& options)
{
  Settings settings;
  settings.solver = SolverKind::Adam;
  settings.iterationsPerLevel = { { 0, 0, options.paperIterations + 1 } };
  settings.tolerance = 0; // all iterations, please
  return scene.MakeSolver(settings);
}

/// F of any extinction by Limpid's sweeps.
double EnergyOf(const Scene& scene, const std::vector<float>& extinction)
{
  Solver solver = scene.MakeSolver(Settings());
  solver.SetInitialExtinction(extinction.data());
  return solver.History().front().energy.Total();
}

void Iterate(Paper& paper, Solver& limpid, const Options& options, PaperResult& result)
{
  paper.Step(); // warms up
  limpid.Step(1);
  std::vector<double> ofPaper;
  std::vector<double> ofLimpid;
  double spent = 0;
  while (
    result.timed < options.paperIterations && (result.timed < 3 || spent < options.paperSeconds))
  {
    Stopwatch watch;
    paper.Step();
    ofPaper.push_back(watch.Lap());
    limpid.Step(1);
    ofLimpid.push_back(watch.Lap());
    spent += ofPaper.back();
    ++result.timed;
  }
  result.paper.seconds = Median(ofPaper);
  result.limpid.seconds = Median(ofLimpid);
}

void WriteTimes(std::ostream& stream, const std::vector<PaperResult>& results)
{
  Table table({ "scene", "camera grid", "light grid", "timed iterations", "paper's scheme [ms]",
    "Limpid [ms]", "ratio" });
  for (const PaperResult& result : results)
  {
    table.Add({ result.scene, Sizes(result.cameraCells), Sizes(result.lightCells),
      std::to_string(result.timed), Milliseconds(result.paper.seconds),
      Milliseconds(result.limpid.seconds),
      Fixed(result.paper.seconds / result.limpid.seconds, 1) });
  }
  table.Write(stream);
}

void WriteScores(std::ostream& stream, const std::vector<PaperResult>& results)
{
  Table table({ "scene", "base S, march", "paper's scheme", "Limpid", "iterations",
    "paper's scheme: F", "S, march", "S, own", "Limpid: F", "S, march", "S, own" });
  for (const PaperResult& result : results)
  {
    std::vector<std::string> row{ result.scene, Significant(result.baseMarch, 5),
      Deviation(result.paper.baseScore, result.baseMarch),
      Deviation(result.limpid.baseScore, result.baseMarch), std::to_string(result.timed + 1) };
    for (const AdamResult& adam : { result.paper, result.limpid })
    {
      row.push_back(Fixed(adam.energy, 0));
      row.push_back(Significant(adam.march, 5));
      row.push_back(Deviation(adam.score, adam.march));
    }
    table.Add(row);
  }
  stream << "Scores that both report themselves, as deviations from the march, and what the same "
            "number of Adam iterations from the base extinction led to. F is that of Limpid's "
            "sweeps for both fields.\n";
  table.Write(stream);
}
}

PaperResult MeasureAgainstPaper(const Scene& scene, const Options& options)
{
  PaperResult result;
  result.scene = scene.file.name;
  result.baseMarch = scene.March(scene.file.extinction, options.marchRays);
  std::vector<float> ofPaper;
  {
    Paper paper = MakePaper(scene, options);
    Solver limpid = MakeAdam(scene, options);
    result.cameraCells = paper.CameraMap().cells;
    result.lightCells = paper.LightMap().cells;
    result.paper.baseScore = paper.Score();
    result.limpid.baseScore = limpid.BaseScore().visibility;
    Iterate(paper, limpid, options, result);
    ofPaper = paper.Extinction();
    result.paper.score = paper.Score();
    result.limpid.score = limpid.BestScore().visibility;
    result.limpid.energy = limpid.BestEnergy().Total();
    result.limpid.march = scene.March(limpid.Extinction(), options.marchRays);
  }
  result.paper.energy = EnergyOf(scene, ofPaper);
  result.paper.march = scene.March(ofPaper, options.marchRays);
  return result;
}

void WriteAgainstPaper(
  std::ostream& stream, const std::vector<PaperResult>& results, const Options& options)
{
  stream << "\n## The paper's scheme\n\n"
         << "An Adam iteration at full resolution, camera and light, single precision: perspective "
            "grids with "
         << options.paperSamples
         << " samples per voxel and axis (Eqs. 13, 17–20, 26–28) beside Limpid's sweeps with their "
            "defaults, in turns, after one iteration of each as warm-up; medians.\n";
  WriteTimes(stream, results);
  WriteScores(stream, results);
}
}
