// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The paper's Fig. 10 for Limpid: a Markdown page, and with --json FILE numbers and, beside that
// file, the pictures.

#include "../Markdown.h"
#include "../Program.h"
#include "Resolutions.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <iostream>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

constexpr int pictureSize = 320; // pixels along each side

std::string FileNameOf(const std::string& scene, const ResolutionResult& result)
{
  return scene + "-" + std::to_string(result.run.coarsening) + "-" +
    Significant(result.run.settings.rayDensity, 2) + ".ppm";
}

/// Over black, first row at the top.
void WritePicture(const std::string& path, const Picture& picture)
{
  std::ofstream file(path, std::ios::binary);
  LIMPID_REQUIRE(file.good(),
    "The file " << path << " cannot be written (the plot shows it). Choose another --json.");
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

nlohmann::ordered_json Describe(const ResolutionResults& all, const std::string& folder)
{
  nlohmann::ordered_json pictures = nlohmann::ordered_json::array();
  for (const ResolutionResult& result : all.results)
  {
    const std::string file = FileNameOf(all.scene, result);
    WritePicture(folder + file, result.picture);
    pictures.push_back({ { "file", file }, { "coarsening", result.run.coarsening },
      { "ray_density", result.run.settings.rayDensity }, { "seconds", result.run.seconds },
      { "S", result.run.worth.score }, { "F", result.run.worth.energy },
      { "rms_difference", result.difference } });
  }
  return { { "name", all.scene }, { "pictures", pictures } };
}

void WriteTable(std::ostream& page, const ResolutionResults& all)
{
  Table table({ "nodes along each axis", "rays per node", "whole run [ms]", "F (march)",
    "S (march)", "picture, rms difference from the last [of 255]" });
  for (const ResolutionResult& result : all.results)
  {
    const int coarsening = result.run.coarsening;
    table.Add({ coarsening == 1 ? "all" : "1/" + std::to_string(coarsening),
      Significant(result.run.settings.rayDensity, 2), Milliseconds(result.run.seconds),
      Fixed(result.run.worth.energy, 0), Significant(result.run.worth.score, 5),
      Significant(result.difference, 2) });
  }
  page << "\n## " << all.scene << "\n";
  table.Write(page);
}

void Measure(const Options& options, std::ostream& page)
{
  const std::size_t slash = options.json.find_last_of('/');
  const std::string folder = slash == std::string::npos ? "" : options.json.substr(0, slash + 1);
  const ThreadLimit limit(options.threads > 0 ? options.threads : ThreadCount());
  nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
  page << "\nThe policy on fewer nodes and with more or fewer rays, camera and light; medians of "
       << options.repeats << " runs, each with resampling to and from the coarse grid.\n";
  for (const std::string& path : options.scenes)
  {
    const Scene scene(path);
    std::cerr << scene.file.name << std::endl;
    const ResolutionResults all = MeasureResolutions(scene, options.repeats, pictureSize);
    WriteTable(page, all);
    if (!options.json.empty())
    {
      scenes.push_back(Describe(all, folder));
    }
  }
  if (!options.json.empty())
  {
    std::ofstream(options.json) << nlohmann::ordered_json{ { "scenes", scenes } }.dump(1) << "\n";
  }
}
}

int main(int argc, char* argv[])
{
  return RunProgram(argc, argv, "Resolutions", Measure);
}
