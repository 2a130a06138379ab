// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Measures one subject and writes its numbers as JSON:
//   limpid_bench SUBJECT [--output FILE.json] [OPTION ...] [NAME.scene.json ...]
// Subjects and options are in the tables below. Without scenes, those of LIMPID_TEST_DATA are
// taken. The scene "head" is the phantom of the page of peers.

#include "Head.h"
#include "Measure.h"

#include "math/Require.h"

#include <fstream>
#include <iostream>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

const Options::Table known{
  { "repeats", "5" },    // of a timed run
  { "march-rays", "3" }, // per voxel and axis of the independent march
  { "parts",
    "memory,quality,time,paper,sizes,threads,skips,rays,stages" }, // of solvers, scaling, rendering
  { "paper-samples", "2" },     // solvers: per voxel and axis of the paper's grids
  { "paper-iterations", "12" }, // timed Adam iterations on these grids, at most
  { "paper-seconds", "20" },    // no further iteration after, but at least three [s]
  { "grid-seconds", "100" },    // errors: limit of the paper's grids, per scene [s]
  { "grid-gigabytes", "8" },    // limit of the memory of these grids
  { "largest", "512" },         // nodes along each axis of the largest procedural volume
};

constexpr const char* headScene = "head";
constexpr int headNodes = 256;

/// Measures scenes one after the other.
template <Json (*measure)(const SceneOfFile&, const Options&)>
void EachScene(const Options& options, Json& results, const std::function<void()>& save)
{
  for (const std::string& path : options.words)
  {
    const SceneOfFile scene = path == headScene ? MakeHead(headNodes) : SceneOfFile(path);
    Say(scene.name);
    results["scenes"].push_back(measure(scene, options));
    save();
  }
}

const std::map<std::string, Measurement> subjects{
  { "solvers", MeasureSolvers },
  { "scaling", MeasureScaling },
#ifdef LIMPID_GOOGLE_BENCHMARK
  { "kernels", MeasureKernels },
#endif
  { "errors", EachScene<MeasureErrors> },
  { "resolutions", EachScene<MeasureResolutions> },
  { "rendering", EachScene<MeasureRendering> },
  { "viewpoints", EachScene<MeasureViewpoints> },
};

std::vector<std::string> TestScenes()
{
  std::vector<std::string> scenes;
  for (const char* name : { "carotid_mra", "isabel_wind", "vortex_rings", "skull_phantom",
         "visible_male", "engine", "thorax_ct" })
  {
    const std::string path = std::string(LIMPID_TEST_DATA) + "/" + name + ".scene.json";
    if (std::ifstream(path).good())
    {
      scenes.push_back(path);
    }
  }
  LIMPID_REQUIRE(!scenes.empty(),
    "There are no scene files in \"" << LIMPID_TEST_DATA
                                     << "\" (nothing can be measured). Name some, or set "
                                        "LIMPID_TEST_DATA in CMake.");
  return scenes;
}
}

void limpid::benchmark::Say(const std::string& text)
{
  std::cerr << text << std::endl;
}

int main(int argc, char* argv[])
{
  return RunProgram(argc, argv, known,
    [](const Options& given, Json& results, const std::function<void()>& save)
    {
      Options options = given;
      const auto subject = subjects.find(options.words.empty() ? "" : options.words.front());
      std::string names;
      for (const auto& [name, measure] : subjects)
      {
        names += " " + name;
      }
      LIMPID_REQUIRE(subject != subjects.end(),
        "The first word is no subject (nothing can be measured). Choose one of" << names << ".");
      options.words.erase(options.words.begin());
      if (options.words.empty())
      {
        options.words = TestScenes();
        if (subject->first == "rendering")
        {
          options.words.push_back(headScene);
        }
      }
      subject->second(options, results, save);
    });
}
