// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Errors.h"
#include "QuadratureRay.h"

#include "reference/Launch.h"

namespace limpid::benchmark
{
namespace
{
std::vector<FaceFrustum> PlanOf(const SceneOfFile& scene, double rayDensity)
{
  const Occupancy everything(scene.grid, scene.extinction.data(), scene.importance.data(), false);
  return PlanSweep(
    scene.grid, everything, SourceOfCamera(scene.camera, scene.grid, false), rayDensity);
}

template <class Rule>
double ScoreOf(const SceneOfFile& scene, const std::vector<FaceFrustum>& frusta,
  const std::vector<float>& extinction, int steps)
{
  double score = 0;
  for (const FaceFrustum& frustum : frusta)
  {
    std::vector<double> visible(std::size_t(frustum.RayCount()));
    QuadratureRay<Rule> body;
    body.frustum = &frustum;
    body.extinction = { extinction.data(), scene.grid.nodes };
    body.importance = { scene.importance.data(), scene.grid.nodes };
    body.steps = steps;
    body.visible = visible.data();
    reference::Launch(frustum.RayCount(), body);
    double sum = 0;
    for (int row = 0; row < frustum.rows; ++row)
    {
      for (int column = 0; column < frustum.columns; ++column)
      {
        sum += visible[std::size_t(row) * frustum.columns + column] *
          frustum.columnAxis.share[std::size_t(column)] * frustum.rowAxis.share[std::size_t(row)] /
          double(frustum.RayLength(column, row));
      }
    }
    score += sum * frustum.cellMeasure;
  }
  return score;
}

template <class Rule>
Json Measure(
  const Truth& truth, const std::vector<FaceFrustum>& frusta, const char* name, int steps)
{
  double scores[2] = { 0, 0 };
  std::vector<double> times;
  for (int which = 0; which < 2; ++which)
  {
    Stopwatch watch;
    scores[which] = ScoreOf<Rule>(truth.Source(), frusta, truth.Extinction(which), steps);
    times.push_back(watch.Lap());
  }
  Json result{ { "rule", name }, { "steps", steps }, { "seconds", Median(times) } };
  truth.AddErrors(result, scores[0], scores[1]);
  return result;
}
}

Json MeasureQuadratures(const Truth& truth, const Effort& effort)
{
  const std::vector<FaceFrustum> frusta = PlanOf(truth.Source(), effort.quadratureRays);
  Json results;
  for (const int steps : effort.quadratureSteps)
  {
    results.push_back(Measure<LeftRiemann>(truth, frusta, "left Riemann", steps));
    results.push_back(Measure<Trapezoid>(truth, frusta, "trapezoid", steps));
    results.push_back(Measure<ConservativeLinear>(truth, frusta, "conservative linear", steps));
    results.push_back(Measure<TwoGaussPoints>(truth, frusta, "two Gauss points", steps));
  }
  return results;
}
}
