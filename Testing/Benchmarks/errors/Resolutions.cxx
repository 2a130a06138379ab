// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Resolutions.h"

#include "../Timing.h"
#include "Effort.h"
#include "Runs.h"
#include "SceneFunctions.h"
#include "Truth.h"
#include "Viewing.h"

#include "backend/Backend.h"

#include <cmath>

namespace limpid::benchmark
{
namespace
{
View ViewOf(const Camera& camera, int pixels)
{
  const double distance = glm::length(camera.position - camera.focalPoint);
  View view;
  view.width = view.height = pixels;
  view.sampleDistance = 0.5;
  view.clipToWorld = Perspective(LookAt(camera.position, camera.focalPoint, camera.viewUp),
    camera.viewAngle, 1, 0.1 * distance, 3 * distance);
  return view;
}

/// Draws extinctions of a scene as seen from its camera, lit and shadowed.
class Drawer
{
public:
  Drawer(const Scene& scene, int pixels)
    : Source(scene)
    , Scalars(scene.file.scalars.begin(), scene.file.scalars.end())
    , Pixels(pixels)
  {
    this->Paint.SetScalars(scene.grid, this->Scalars.data());
    this->Paint.SetTransferFunctions(FunctionsOf(scene.file));
    Lighting lighting;
    lighting.enabled = true;
    lighting.light = scene.light;
    this->Paint.SetLighting(lighting);
  }

  Picture Draw(const std::vector<float>& extinction)
  {
    Picture picture;
    this->Paint.SetExtinction(
      this->Source.grid, this->Source.file.extinction.data(), extinction.data());
    this->Paint.Render(ViewOf(this->Source.camera, this->Pixels), picture);
    return picture;
  }

private:
  const Scene& Source;
  std::vector<float> Scalars;
  int Pixels;
  Renderer Paint;
};

double RmsOf(const Picture& one, const Picture& other)
{
  double sum = 0;
  for (std::size_t n = 0; n < one.rgba.size(); ++n)
  {
    const double difference = double(one.rgba[n]) - double(other.rgba[n]);
    sum += difference * difference;
  }
  return std::sqrt(sum / double(one.rgba.size()));
}

WholeRun PlannedAt(int coarsening, double rayDensity)
{
  WholeRun run;
  run.settings.backend = BackendKind::Cpu;
  run.settings.rayDensity = rayDensity;
  run.coarsening = coarsening;
  run.threads = ThreadCount();
  return run;
}
}

ResolutionResults MeasureResolutions(const Scene& scene, int repeats, int pixels)
{
  const Effort effort(Options(), double(scene.grid.NodeCount()));
  Drawer drawer(scene, pixels);
  ResolutionResults all;
  all.scene = scene.file.name;
  for (const int coarsening : { 4, 2, 1 })
  {
    for (const double rayDensity : { 0.25, 0.5, 1.0, 2.0 })
    {
      ResolutionResult result;
      result.run = PlannedAt(coarsening, rayDensity);
      std::vector<double> times;
      std::vector<float> extinction;
      for (int repeat = -1; repeat < repeats; ++repeat) // the first run warms up
      {
        extinction = Execute(scene, result.run);
        if (repeat >= 0)
        {
          times.push_back(result.run.seconds);
        }
      }
      result.run.seconds = Median(times);
      result.run.spread = Spread(times);
      result.run.repeats = repeats;
      result.run.worth = WorthOf(scene, extinction, result.run.settings.weights, effort.worthRays);
      result.picture = drawer.Draw(extinction);
      all.results.push_back(std::move(result));
    }
  }
  for (ResolutionResult& result : all.results)
  {
    result.difference = RmsOf(result.picture, all.results.back().picture);
  }
  return all;
}
}
