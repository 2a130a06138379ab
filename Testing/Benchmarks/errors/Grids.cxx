// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Errors.h"
#include "PeakMemory.h"

#include "PaperScheme/Launch.h"
#include "PaperScheme/PaperScheme.h"
#include "PaperScheme/TransmittanceRay.h"
#include "backend/Backend.h"

namespace limpid::benchmark
{
namespace
{
/// T at voxels by the perspective grid of an eye, of the base extinction and of the optimised one.
SampledTransmittance TransmittanceOf(const Truth& truth, const Vec3& eye, double samplesPerVoxel)
{
  const SceneOfFile& scene = truth.Source();
  const auto map = reference::LookAtBox<float>(scene.grid, eye, samplesPerVoxel);
  std::vector<float> normalized(scene.extinction.size());
  std::vector<float> cells(std::size_t(map.CellCount()));
  const auto radius = static_cast<float>(scene.grid.Radius());
  SampledTransmittance sampled;
  for (int which = 0; which < 2; ++which)
  {
    ParallelFor(scene.grid.NodeCount(), 65536,
      [&](Index node)
      { normalized[std::size_t(node)] = truth.Extinction(which)[std::size_t(node)] * radius; });
    reference::Launch(map.RayCount(),
      reference::TransmittanceRay<float>{
        { normalized.data(), scene.grid.nodes }, map, { cells.data(), map.cells } });
    for (const std::size_t voxel : truth.Voxels())
    {
      const reference::Vec3Of<float> position(NodeAt(scene.grid, voxel));
      const reference::GridView<const float> grid{ cells.data(), map.cells };
      const auto place = reference::LocateInGrid(grid, map.ToCells(map.ToView(position)));
      sampled[std::size_t(which)].push_back(double(reference::Interpolate(cells.data(), place)));
    }
  }
  return sampled;
}

/// S, its derivative by Eq. (27) and T of the paper's scheme.
void AddErrorsOf(const Truth& truth, double samplesPerVoxel, Json& result)
{
  const SceneOfFile& scene = truth.Source();
  {
    reference::PaperSettings settings;
    settings.samplesPerVoxel = samplesPerVoxel;
    settings.weights = { 0, 1, 0 }; // F is -S
    reference::PaperScheme<float> paper(
      scene.Fields(), scene.camera.position, scene.light.position, settings);
    const double base = paper.Score();
    std::vector<float> gradient(scene.extinction.size());
    paper.Gradient(gradient.data());
    for (float& slope : gradient)
    {
      slope = -slope;
    }
    paper.SetExtinction(truth.Extinction(1).data());
    truth.AddErrors(result, base, paper.Score());
    result["error_slope"] = truth.SlopeError(gradient);
  }
  truth.AddErrors(result, TransmittanceOf(truth, scene.camera.position, samplesPerVoxel),
    TransmittanceOf(truth, scene.light.position, samplesPerVoxel));
}

/// Adam iterations; the constructor's update of the grids warms up.
void TimeSteps(const SceneOfFile& scene, double samplesPerVoxel, Json& result)
{
  const PeakMemory memory;
  reference::PaperSettings settings;
  settings.samplesPerVoxel = samplesPerVoxel;
  reference::PaperScheme<float> paper(
    scene.Fields(), scene.camera.position, scene.light.position, settings);
  std::vector<double> times;
  const int timesAtMost = 5;
  const double secondsAtMost = 5; // for more than one
  double spent = 0;
  while (int(times.size()) < timesAtMost && (times.empty() || spent < secondsAtMost))
  {
    Stopwatch watch;
    paper.Step();
    times.push_back(watch.Lap());
    spent += times.back();
  }
  result["seconds"] = Median(times);
  result["timed"] = times.size();
  result["bytes"] = memory.Bytes();
}

double CellsOf(const SceneOfFile& scene, double samplesPerVoxel)
{
  double cells = 0;
  for (const Vec3& eye : { scene.camera.position, scene.light.position })
  {
    cells += double(reference::LookAtBox<float>(scene.grid, eye, samplesPerVoxel).CellCount());
  }
  return cells;
}
}

Json MeasureGrids(const Truth& truth, const Effort& effort, const Options& options)
{
  const SceneOfFile& scene = truth.Source();
  const double bytesPerCell = 8; // transmittance and visible importance
  Json results = Json::array();
  double spent = 0;
  double secondsPerCell = 0;
  for (const double samplesPerVoxel : effort.gridSamples)
  {
    const double cells = CellsOf(scene, samplesPerVoxel);
    const bool fits = cells * bytesPerCell < options.Number("grid-gigabytes") * 1e9;
    if (!fits || spent + secondsPerCell * cells > effort.gridSeconds)
    {
      break;
    }
    Json result{ { "samples_per_voxel", samplesPerVoxel }, { "cells", cells } };
    Stopwatch watch;
    AddErrorsOf(truth, samplesPerVoxel, result);
    TimeSteps(scene, samplesPerVoxel, result);
    const double seconds = watch.Lap();
    secondsPerCell = seconds / cells;
    spent += seconds;
    results.push_back(result);
  }
  return results;
}
}
