// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How long the steps of the optimisation take on a GPU, at the sizes of Table 1 of [HG24].
//
//   limpid_bench_gpu [--sizes 256,304,472] [--scenes onion,dense,waves] [--quick] [--along-x]
//     [--files A.scene.json,B.scene.json] [--output FILE.json]
//
// With --files those scenes (pack-scenes.py) instead of formulas. --along-x looks along
// that axis.
// Writes FILE.json after every scene, or the numbers to standard output.

#include "Measure.h"
#include "Volume.h"

#include "backend/Choice.h"
#include "math/Require.h"

#include <iostream>

int main(int argc, char* argv[])
{
  using namespace limpid;
  using namespace limpid::benchmark;
  return RunProgram(argc, argv,
    { { "sizes", "256,304,472" }, { "scenes", "onion,dense,waves" }, { "along-x", "no" },
      { "files", "" } },
    [](const Options& options, Json& results, const std::function<void()>& save)
    {
      LIMPID_REQUIRE(FindCuda().usable,
        "There is nothing to measure on: "
          << FindCuda().reason << " (this program times a GPU). Run it where there is one.");
      const Effort effort = options.Flag("quick") ? Effort{ 2, 0.2, 12, 64, 1 << 22 } : Effort();
      results = MeasureDevice(effort);
      results["scenes"] = Json::array();
      const auto measure = [&](SceneForSolver scene)
      {
        if (options.Flag("along-x"))
        {
          scene.camera.position = scene.grid.Centre() + scene.grid.Radius() * Vec3(3, 0.3, 0.2);
          scene.name += " along x";
        }
        std::cerr << scene.name << ' ' << scene.grid.nodes.x << std::endl;
        MeasureScene(scene, effort, results["scenes"].emplace_back(), save);
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
