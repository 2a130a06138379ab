// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Errors.h"
#include "PeakMemory.h"

#include "backend/Backend.h"
#include "reference/GradientVoxel.h"
#include "reference/Launch.h"
#include "reference/PaperScheme.h"
#include "reference/ScoreRay.h"
#include "reference/TransmittanceRay.h"
#include "reference/VisibleImportanceRay.h"

#include <cmath>

namespace limpid::benchmark
{
namespace
{
using reference::FieldView;
using reference::GridView;
using reference::PerspectiveMap;

/// One eye's grids, with the bodies that PaperScheme runs, in normalised coordinates.
class EyeGrids
{
public:
  EyeGrids(const SceneForSolver& scene, const Vec3& eye, double samplesPerVoxel)
    : Scenery(scene)
    , Map(reference::LookAtBox<float>(scene.grid, eye, samplesPerVoxel))
    , Normalized(scene.extinction.size())
    , Transmittance(std::size_t(this->Map.CellCount()))
  {
  }

  void Transmit(const std::vector<float>& extinction)
  {
    const auto radius = static_cast<float>(this->Scenery.grid.Radius());
    ParallelFor(this->Scenery.grid.NodeCount(), 65536,
      [&](Index node)
      { this->Normalized[std::size_t(node)] = extinction[std::size_t(node)] * radius; });
    reference::Launch(this->Map.RayCount(),
      reference::TransmittanceRay<float>{
        this->Extinction(), this->Map, { this->Transmittance.data(), this->Map.cells } });
  }

  /// Of what was transmitted last [length^2].
  double Score() const
  {
    std::vector<double> scores(std::size_t(this->Map.RayCount()));
    reference::Launch(this->Map.RayCount(),
      reference::ScoreRay<float>{
        this->Extinction(), this->Importance(), this->Map, this->Seen(), scores.data() });
    double sum = 0;
    for (const double score : scores)
    {
      sum += score;
    }
    return sum * this->Scenery.grid.Radius() * this->Scenery.grid.Radius();
  }

  std::vector<double> TransmittanceAt(const std::vector<std::size_t>& voxels) const
  {
    std::vector<double> values;
    const Int3 nodes = this->Scenery.grid.nodes;
    for (const std::size_t voxel : voxels)
    {
      const std::size_t row = voxel / std::size_t(nodes.x);
      const reference::Vec3Of<float> position(float(voxel % std::size_t(nodes.x)),
        float(row % std::size_t(nodes.y)), float(row / std::size_t(nodes.y)));
      const auto place =
        reference::LocateInGrid(this->Seen(), this->Map.ToCells(this->Map.ToView(position)));
      values.push_back(double(reference::Interpolate(this->Transmittance.data(), place)));
    }
    return values;
  }

  /// Eq. (27) at the voxels, for the base extinction, with the sign of dS/dmu.
  std::vector<float> Gradient()
  {
    std::vector<float> behind(this->Transmittance.size());
    reference::Launch(this->Map.RayCount(),
      reference::VisibleImportanceRay<float>{ this->Extinction(), this->Importance(), this->Map,
        this->Seen(), { behind.data(), this->Map.cells } });
    std::vector<float> gradient(this->Normalized.size());
    reference::GradientVoxel<float> body;
    body.nodes = this->Scenery.grid.nodes;
    body.extinction = body.baseExtinction = this->Normalized.data();
    body.importance = this->Scenery.importance.data();
    body.view = { 1.0f, this->Map, this->Seen(), { behind.data(), this->Map.cells } };
    body.gradient = gradient.data();
    reference::Launch(this->Scenery.grid.NodeCount(), body);
    for (float& slope : gradient)
    {
      slope = -slope;
    }
    return gradient;
  }

private:
  FieldView<float> Extinction() const
  {
    return { this->Normalized.data(), this->Scenery.grid.nodes };
  }
  FieldView<float> Importance() const
  {
    return { this->Scenery.importance.data(), this->Scenery.grid.nodes };
  }
  GridView<const float> Seen() const { return { this->Transmittance.data(), this->Map.cells }; }

  const SceneForSolver& Scenery;
  PerspectiveMap<float> Map;
  std::vector<float> Normalized;
  std::vector<float> Transmittance;
};

void AddErrorsOf(const Truth& truth, double samplesPerVoxel, Json& result)
{
  const SceneOfFile& scene = truth.Source();
  SampledTransmittance view;
  SampledTransmittance light;
  {
    EyeGrids camera(scene, scene.camera.position, samplesPerVoxel);
    double scores[2] = { 0, 0 };
    for (const int which : { 1, 0 })
    {
      camera.Transmit(truth.Extinction(which));
      scores[which] = camera.Score();
      view[std::size_t(which)] = camera.TransmittanceAt(truth.Voxels());
    }
    truth.AddErrors(result, scores[0], scores[1]);
    result["error_slope"] = truth.SlopeError(camera.Gradient());
  }
  EyeGrids lamp(scene, scene.light.position, samplesPerVoxel);
  for (int which = 0; which < 2; ++which)
  {
    lamp.Transmit(truth.Extinction(which));
    light[std::size_t(which)] = lamp.TransmittanceAt(truth.Voxels());
  }
  truth.AddErrors(result, view, light);
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
