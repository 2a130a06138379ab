// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Options.h"

#include "math/Require.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

namespace limpid::benchmark
{
namespace
{
const char* const usage =
  "PROGRAM [--output FILE] [--repeats N] [--threads N] [NAME.scene.json ...]\n"
  "limpid_bench_solvers also [--parts quality,time,paper,memory] [--march-rays PER_VOXEL]\n"
  "                     [--paper-samples PER_VOXEL] [--paper-iterations N] [--paper-seconds S]\n"
  "limpid_bench_viewpoints also [--march-rays PER_VOXEL]\n"
  "limpid_bench_scaling also [--json FILE] [--parts memory,sizes,threads,skips] [--largest NODES]\n"
  "limpid_bench_kernels also [--json FILE] [--quick] [--largest NODES]\n"
  "limpid_bench_error also [--json FILE] [--quick] [--grid-seconds S] [--grid-gigabytes GB]\n";

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
                                        "LIMPID_TEST_DATA in CMake. Usage:\n"
                                     << usage);
  return scenes;
}

double PositiveNumber(const std::string& option, const std::string& text)
{
  const double value = std::atof(text.c_str());
  LIMPID_REQUIRE(value > 0,
    "The option " << option << " is \"" << text << "\" (it sets a number above zero). Usage:\n"
                  << usage);
  return value;
}

int PositiveCount(const std::string& option, const std::string& text)
{
  return std::max(1, static_cast<int>(PositiveNumber(option, text)));
}

std::vector<std::string> Parts(const std::string& list)
{
  const std::vector<std::string> known = Options().parts;
  std::vector<std::string> parts;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, ',');)
  {
    LIMPID_REQUIRE(std::find(known.begin(), known.end(), part) != known.end(),
      "The part \"" << part << "\" is unknown (nothing would be measured). Usage:\n"
                    << usage);
    parts.push_back(part);
  }
  return parts;
}
}

bool Options::Wants(const std::string& part) const
{
  return std::find(this->parts.begin(), this->parts.end(), part) != this->parts.end();
}

Options ParseOptions(const std::vector<std::string>& arguments)
{
  using Text = const std::string&;
  Options options;
  const std::map<std::string, std::function<void(Text, Text)>> known{
    { "--output", [&](Text, Text text) { options.output = text; } },
    { "--parts", [&](Text, Text text) { options.parts = Parts(text); } },
    { "--repeats", [&](Text name, Text text) { options.repeats = PositiveCount(name, text); } },
    { "--threads", [&](Text name, Text text) { options.threads = PositiveCount(name, text); } },
    { "--march-rays",
      [&](Text name, Text text) { options.marchRays = PositiveNumber(name, text); } },
    { "--paper-samples",
      [&](Text name, Text text) { options.paperSamples = PositiveNumber(name, text); } },
    { "--paper-iterations",
      [&](Text name, Text text) { options.paperIterations = PositiveCount(name, text); } },
    { "--paper-seconds",
      [&](Text name, Text text) { options.paperSeconds = PositiveNumber(name, text); } },
    { "--largest", [&](Text name, Text text) { options.largest = PositiveCount(name, text); } },
    { "--json", [&](Text, Text text) { options.json = text; } },
    { "--grid-seconds",
      [&](Text name, Text text) { options.gridSeconds = PositiveNumber(name, text); } },
    { "--grid-gigabytes",
      [&](Text name, Text text) { options.gridGigabytes = PositiveNumber(name, text); } },
  };
  for (std::size_t at = 0; at < arguments.size(); ++at)
  {
    const std::string& argument = arguments[at];
    if (argument.rfind("--", 0) != 0)
    {
      options.scenes.push_back(argument);
      continue;
    }
    if (argument == "--quick")
    {
      options.quick = true;
      continue;
    }
    const auto option = known.find(argument);
    LIMPID_REQUIRE(option != known.end() && at + 1 < arguments.size(),
      "The option " << argument << " is unknown or has no value (nothing would come of it). "
                    << "Usage:\n"
                    << usage);
    option->second(argument, arguments[++at]);
  }
  if (options.scenes.empty())
  {
    options.scenes = TestScenes();
  }
  return options;
}
}
