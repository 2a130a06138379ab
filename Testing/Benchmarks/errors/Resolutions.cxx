// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Drawing.h"
#include "Errors.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <cmath>
#include <fstream>

namespace limpid::benchmark
{
namespace
{
constexpr int pictureSize = 320; // pixels along each side

double RmsDifference(const Picture& one, const Picture& other)
{
  double sum = 0;
  for (std::size_t n = 0; n < one.rgba.size(); ++n)
  {
    sum += std::pow(double(one.rgba[n]) - double(other.rgba[n]), 2);
  }
  return std::sqrt(sum / double(one.rgba.size()));
}

/// Over black, first row at the top.
void Save(const std::string& path, const Picture& picture)
{
  std::ofstream file(path, std::ios::binary);
  LIMPID_REQUIRE(file.good(),
    "The file " << path << " cannot be written (the plot shows it). Choose another --output.");
  file << "P6\n" << picture.width << " " << picture.height << "\n255\n";
  for (int row = picture.height; row-- > 0;)
  {
    for (int column = 0; column < picture.width; ++column)
    {
      const std::size_t pixel = std::size_t(row) * picture.width + column;
      file.write(reinterpret_cast<const char*>(picture.rgba.data() + 4 * pixel), 3);
    }
  }
}
}

Json MeasureResolutions(const SceneOfFile& scene, const Options& options)
{
  const std::string& output = options.Text("output");
  const Effort effort(options, double(scene.grid.NodeCount()));
  const Drawable drawable(scene);
  Renderer renderer;
  drawable.Prepare(renderer);
  drawable.Light(renderer);
  View view = ViewOf(scene.camera, pictureSize);
  view.sampleDistance = 0.5;
  std::vector<Picture> pictures;
  Json results;
  for (const int coarsening : { 4, 2, 1 })
  {
    for (const int percent : { 25, 50, 100, 200 })
    {
      WholeRun run;
      run.settings.backend = BackendKind::Cpu;
      run.settings.rayDensity = percent / 100.0;
      run.coarsening = coarsening;
      run.threads = ThreadCount();
      std::vector<double> times;
      std::vector<float> extinction = Execute(scene, run); // warms up
      for (int repeat = 0; repeat < options.Count("repeats"); ++repeat)
      {
        extinction = Execute(scene, run);
        times.push_back(run.seconds);
      }
      drawable.Show(renderer, extinction);
      pictures.emplace_back();
      renderer.Render(view, pictures.back());
      const std::string file =
        scene.name + "-" + std::to_string(coarsening) + "-" + std::to_string(percent) + ".ppm";
      if (!output.empty())
      {
        Save(output.substr(0, output.rfind('/') + 1) + file, pictures.back());
      }
      results.push_back({ { "file", file }, { "coarsening", coarsening },
        { "ray_density", run.settings.rayDensity } });
      results.back().update(FigureOf(times));
      results.back().update(WorthOf(scene, extinction, run.settings.weights, effort.worthRays));
    }
  }
  for (std::size_t n = 0; n < pictures.size(); ++n)
  {
    results[n]["rms_difference"] = RmsDifference(pictures[n], pictures.back());
  }
  return { { "name", scene.name }, { "pictures", results } };
}
}
