// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How long the steps of the optimisation take on a GPU, at the sizes of Table 1 of [HG24].
//
//   limpid_bench_gpu [--sizes 256,304,472] [--scenes onion,dense,waves] [--quick] [--along-x]
//     [--files A.scene.json,B.scene.json] [--output FILE.json] [--append]
//     [--parts policy,frame,set-up,adam,processor,sphere]
//
// With --files those scenes (pack-scenes.py) instead of formulas. --along-x looks along
// that axis. --parts: what to measure, everything by default.
// Writes FILE.json after every part of a scene, or the numbers to standard output. With --append
// the scenes of an earlier run stay in FILE.json, and the device is measured only if there is none.

#include "Measure.h"
#include "Volume.h"

#include "backend/Choice.h"
#include "math/Require.h"

#include <fstream>
#include <iostream>

namespace limpid::benchmark
{
namespace
{
/// The device and the scenes that a file of results has; null if there are none.
Json Earlier(const std::string& path)
{
  std::ifstream file(path);
  if (file.peek() == std::ifstream::traits_type::eof())
  {
    return nullptr;
  }
  Json results = Json::parse(file, nullptr, false);
  LIMPID_REQUIRE(results.contains("scenes"),
    "The file " << path << " has no scenes (nothing can be added to it). Choose another, or leave "
                << "out --append.");
  results.erase("machine"); // those of this run are written
  results.erase("options");
  return results;
}

/// An empty list of scenes on a device.
Json Nothing(const Effort& effort)
{
  Json results = MeasureDevice(effort);
  results["scenes"] = Json::array();
  return results;
}
}
}

int main(int argc, char* argv[])
{
  using namespace limpid;
  using namespace limpid::benchmark;
  return RunProgram(argc, argv,
    { { "sizes", "256,304,472" }, { "scenes", "onion,dense,waves" }, { "along-x", "no" },
      { "files", "" }, { "append", "no" }, { "parts", "" } },
    [](const Options& options, Json& results, const std::function<void()>& save)
    {
      LIMPID_REQUIRE(FindCuda().usable,
        "There is nothing to measure on: "
          << FindCuda().reason << " (this program times a GPU). Run it where there is one.");
      const Effort effort = options.Flag("quick") ? Effort{ 2, 0.2, 12, 64, 1 << 22 } : Effort();
      if (options.Flag("append"))
      {
        results = Earlier(options.Text("output"));
      }
      if (results.empty())
      {
        results = Nothing(effort);
      }
      const auto measure = [&](SceneForSolver scene)
      {
        if (options.Flag("along-x"))
        {
          scene.camera.position = scene.grid.Centre() + scene.grid.Radius() * Vec3(3, 0.3, 0.2);
          scene.name += " along x";
        }
        std::cerr << scene.name << ' ' << scene.grid.nodes.x << std::endl;
        MeasureScene(scene, effort, options.List("parts"), results["scenes"].emplace_back(), save);
      };
      const std::vector<std::string> files = options.List("files");
      for (const std::string& file : files)
      {
        measure(SceneOfFile(file));
      }
      if (!files.empty())
      {
        return;
      }
      for (const std::string& filling : options.List("scenes"))
      {
        for (const std::string& size : options.List("sizes"))
        {
          measure(MakeVolume(filling, std::stoi(size)));
        }
      }
    });
}
