// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Quadrature.h"

#include "../Timing.h"
#include "QuadratureRay.h"

#include "reference/Launch.h"

namespace limpid::benchmark
{
namespace
{
std::vector<Pyramid> PlanOf(const Scene& scene, double rayDensity)
{
  const Occupancy everything(
    scene.grid, scene.file.extinction.data(), scene.file.importance.data(), false);
  return PlanSweep(
    scene.grid, everything, EyeOfCamera(scene.camera, scene.grid, false), rayDensity);
}

template <class Rule>
double ScoreOf(const Scene& scene, const std::vector<Pyramid>& pyramids,
  const std::vector<float>& extinction, int steps)
{
  double score = 0;
  for (const Pyramid& pyramid : pyramids)
  {
    std::vector<double> visible(std::size_t(pyramid.RayCount()));
    QuadratureRay<Rule> body;
    body.pyramid = &pyramid;
    body.extinction = { extinction.data(), scene.grid.nodes };
    body.importance = { scene.file.importance.data(), scene.grid.nodes };
    body.steps = steps;
    body.visible = visible.data();
    reference::Launch(pyramid.RayCount(), body);
    double sum = 0;
    for (int row = 0; row < pyramid.rows; ++row)
    {
      for (int column = 0; column < pyramid.columns; ++column)
      {
        sum += visible[std::size_t(row) * pyramid.columns + column] *
          pyramid.columnAxis.share[std::size_t(column)] * pyramid.rowAxis.share[std::size_t(row)] /
          double(pyramid.RayLength(column, row));
      }
    }
    score += sum * pyramid.cellMeasure;
  }
  return score;
}

template <class Rule>
QuadratureResult Measure(
  const Truth& truth, const std::vector<Pyramid>& pyramids, const char* name, int steps)
{
  const Scene& scene = truth.Source();
  double scores[2] = { 0, 0 };
  std::vector<double> times;
  for (int which = 0; which < 2; ++which)
  {
    Stopwatch watch;
    scores[which] = ScoreOf<Rule>(scene, pyramids, truth.Extinction(which), steps);
    times.push_back(watch.Lap());
  }
  return { name, steps, truth.ErrorsOf(scores[0], scores[1]), Median(times) };
}
}

std::vector<QuadratureResult> MeasureQuadratures(const Truth& truth, const Effort& effort)
{
  const std::vector<Pyramid> pyramids = PlanOf(truth.Source(), effort.quadratureRays);
  std::vector<QuadratureResult> results;
  for (const int steps : effort.quadratureSteps)
  {
    results.push_back(Measure<LeftRiemann>(truth, pyramids, "left Riemann", steps));
    results.push_back(Measure<Trapezoid>(truth, pyramids, "trapezoid", steps));
    results.push_back(Measure<ConservativeLinear>(truth, pyramids, "conservative linear", steps));
    results.push_back(Measure<TwoGaussPoints>(truth, pyramids, "two Gauss points", steps));
  }
  return results;
}
}
