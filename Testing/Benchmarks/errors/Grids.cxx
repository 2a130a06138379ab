// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Grids.h"

#include "../Timing.h"
#include "PeakMemory.h"

#include "PaperScheme/GradientVoxel.h"
#include "PaperScheme/Launch.h"
#include "PaperScheme/PaperScheme.h"
#include "PaperScheme/ScoreRay.h"
#include "PaperScheme/TransmittanceRay.h"
#include "PaperScheme/VisibleImportanceRay.h"
#include "backend/Backend.h"

#include <array>
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
  EyeGrids(const Scene& scene, const Vec3& eye, double samplesPerVoxel)
    : Scenery(scene)
    , Map(reference::LookAtBox<float>(scene.grid, eye, samplesPerVoxel))
    , Normalized(scene.file.extinction.size())
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
    body.importance = this->Scenery.file.importance.data();
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
    return { this->Scenery.file.importance.data(), this->Scenery.grid.nodes };
  }
  GridView<const float> Seen() const { return { this->Transmittance.data(), this->Map.cells }; }

  const Scene& Scenery;
  PerspectiveMap<float> Map;
  std::vector<float> Normalized;
  std::vector<float> Transmittance;
};

void MeasureErrors(const Truth& truth, GridResult& result)
{
  const Scene& scene = truth.Source();
  SampledTransmittance view;
  SampledTransmittance light;
  {
    EyeGrids camera(scene, scene.camera.position, result.samplesPerVoxel);
    double scores[2] = { 0, 0 };
    for (const int which : { 1, 0 })
    {
      camera.Transmit(truth.Extinction(which));
      scores[which] = camera.Score();
      view[std::size_t(which)] = camera.TransmittanceAt(truth.Voxels());
    }
    result.score = truth.ErrorsOf(scores[0], scores[1]);
    const std::vector<float> gradient = camera.Gradient();
    std::array<double, directionCount> slopes{};
    for (int which = 0; which < directionCount; ++which)
    {
      slopes[std::size_t(which)] = AlongDirection(scene, gradient, Direction(scene, which));
    }
    result.slope = truth.ErrorOf(slopes);
  }
  EyeGrids lamp(scene, scene.light.position, result.samplesPerVoxel);
  for (int which = 0; which < 2; ++which)
  {
    lamp.Transmit(truth.Extinction(which));
    light[std::size_t(which)] = lamp.TransmittanceAt(truth.Voxels());
  }
  result.transmittance = truth.ErrorsOf(view, light);
}

/// Adam iterations; the constructor's update of the grids warms up.
void TimeSteps(const Scene& scene, GridResult& result)
{
  const PeakMemory memory;
  reference::PaperSettings settings;
  settings.samplesPerVoxel = result.samplesPerVoxel;
  reference::PaperScheme<float> paper(
    scene.Fields(), scene.camera.position, scene.light.position, settings);
  std::vector<double> times;
  const int timesAtMost = 5;
  const double secondsAtMost = 5; // for more than one
  double spent = 0;
  while (result.timed < timesAtMost && (result.timed == 0 || spent < secondsAtMost))
  {
    Stopwatch watch;
    paper.Step();
    times.push_back(watch.Lap());
    spent += times.back();
    ++result.timed;
  }
  result.seconds = Median(times);
  result.bytes = memory.Bytes();
}

double CellsOf(const Scene& scene, double samplesPerVoxel)
{
  double cells = 0;
  for (const Vec3& eye : { scene.camera.position, scene.light.position })
  {
    cells += double(reference::LookAtBox<float>(scene.grid, eye, samplesPerVoxel).CellCount());
  }
  return cells;
}
}

std::vector<GridResult> MeasureGrids(
  const Truth& truth, const Effort& effort, const Options& options)
{
  const Scene& scene = truth.Source();
  const double bytesPerCell = 8; // transmittance and visible importance
  std::vector<GridResult> results;
  double spent = 0;
  double secondsPerCell = 0;
  for (const double samplesPerVoxel : effort.gridSamples)
  {
    GridResult result;
    result.samplesPerVoxel = samplesPerVoxel;
    result.cells = CellsOf(scene, samplesPerVoxel);
    const bool fits = result.cells * bytesPerCell < options.gridGigabytes * 1e9;
    if (!fits || spent + secondsPerCell * result.cells > effort.gridSeconds)
    {
      break;
    }
    Stopwatch watch;
    MeasureErrors(truth, result);
    TimeSteps(scene, result);
    const double seconds = watch.Lap();
    secondsPerCell = seconds / result.cells;
    spent += seconds;
    results.push_back(result);
  }
  return results;
}
}
