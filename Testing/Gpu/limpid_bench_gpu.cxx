// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How long the steps of the optimisation take on a GPU, at the sizes of Table 1 of [HG24].
//
//   limpid_bench_gpu [--sizes 256,304,472] [--scenes onion,dense] [--quick] [--out FOLDER]
//
// Writes Gpu.md and gpu.json into FOLDER after every scene, or the page to standard output.

#include "Json.h"
#include "Machine.h"
#include "Measure.h"
#include "Page.h"

#include "backend/Choice.h"
#include "math/Require.h"

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

struct Options
{
  std::vector<int> sizes{ 256, 304, 472 };
  std::vector<Filling> scenes{ Filling::Onion, Filling::Dense };
  std::string folder; ///< empty: standard output
  Effort effort;
};

std::vector<std::string> Split(const std::string& list)
{
  std::vector<std::string> items;
  std::istringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');)
  {
    items.push_back(item);
  }
  return items;
}

int SizeOf(const std::string& text)
{
  const long size = std::strtol(text.c_str(), nullptr, 10);
  LIMPID_REQUIRE(size >= 2 && size <= 2048,
    "The size " << text
                << " is not between 2 and 2048 (volumes have so many nodes along each "
                   "axis). Give numbers with commas between them.");
  return static_cast<int>(size);
}

Filling FillingOf(const std::string& name)
{
  for (const Filling filling : { Filling::Onion, Filling::Dense })
  {
    if (name == NameOf(filling))
    {
      return filling;
    }
  }
  LIMPID_REQUIRE(
    false, "There is no scene " << name << " (it is a formula). Choose onion or dense.");
  return Filling::Onion;
}

Effort QuickEffort()
{
  Effort effort;
  effort.quick = true;
  effort.repetitions = 2;
  effort.mostSeconds = 0.2;
  effort.directions = 12;
  effort.pictureSide = 64;
  effort.copySize = 1 << 22;
  return effort;
}

Options ParseOptions(const std::vector<std::string>& arguments)
{
  Options options;
  for (std::size_t n = 0; n < arguments.size(); ++n)
  {
    const std::string& name = arguments[n];
    if (name == "--quick")
    {
      options.effort = QuickEffort();
      continue;
    }
    LIMPID_REQUIRE(
      (name == "--sizes" || name == "--scenes" || name == "--out") && n + 1 < arguments.size(),
      "The argument " << name
                      << " is not understood (nothing was measured). Give --sizes LIST, "
                         "--scenes LIST, --out FOLDER or --quick.");
    const std::string& value = arguments[++n];
    if (name == "--out")
    {
      options.folder = value;
      continue;
    }
    (name == "--sizes") ? options.sizes.clear() : options.scenes.clear();
    for (const std::string& item : Split(value))
    {
      if (name == "--sizes")
      {
        options.sizes.push_back(SizeOf(item));
      }
      else
      {
        options.scenes.push_back(FillingOf(item));
      }
    }
  }
  return options;
}

void Save(const std::string& path, const std::string& text)
{
  std::ofstream file(path);
  file << text;
  LIMPID_REQUIRE(file.flush().good(),
    "The file " << path
                << " cannot be written (the figures would be lost). Choose another folder.");
}

void Publish(const Options& options, const std::vector<std::string>& command, double load,
  const DeviceResult& result)
{
  std::ostringstream page;
  page << "# GPU\n\nWhat the tables mean is in [README.md](README.md).\n\n";
  WriteMachine(page, command, load);
  if (options.effort.quick)
  {
    page << "\n**A quick run: small pictures, few directions, figures without meaning.**\n";
  }
  WritePage(page, result);
  if (options.folder.empty())
  {
    std::cout << page.str() << std::flush;
    return;
  }
  std::ostringstream json;
  WriteJson(json, result);
  Save(options.folder + "/Gpu.md", page.str());
  Save(options.folder + "/gpu.json", json.str());
}
}

int main(int argc, char* argv[])
{
  try
  {
    const double load = LoadAverage();
    const Options options = ParseOptions(std::vector<std::string>(argv + 1, argv + argc));
    LIMPID_REQUIRE(FindCuda().usable,
      "There is nothing to measure on: "
        << FindCuda().reason << " (this program times a GPU). Run it where there is one.");
    DeviceResult result = MeasureDevice(options.effort);
    for (const Filling filling : options.scenes)
    {
      for (const int size : options.sizes)
      {
        std::cerr << NameOf(filling) << ' ' << size << std::endl;
        result.scenes.push_back(MeasureScene(GpuScene(filling, size), options.effort));
        if (!options.folder.empty())
        {
          Publish(options, std::vector<std::string>(argv, argv + argc), load, result);
        }
      }
    }
    if (options.folder.empty())
    {
      Publish(options, std::vector<std::string>(argv, argv + argc), load, result);
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
