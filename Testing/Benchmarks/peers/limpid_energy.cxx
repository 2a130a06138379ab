// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The energy of Eq. (21) and its derivative on demand: Limpid's side of energy_torch.py. Reads
// commands from standard input, one a line, and answers each with a line of JSON; README.md has
// them.
//   limpid_energy [--onion NODES] [--threads N] [--skips-off] [--derivative-ray]

#include "OnionEnergy.h"

#include "Program.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <exception>
#include <iostream>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

Json Of(const Evaluation& evaluation)
{
  const Energy& energy = evaluation.energy;
  return { { "regularization", energy.regularization }, { "view", energy.view },
    { "light", energy.light }, { "seconds", evaluation.seconds } };
}

double Rays(const std::string& text)
{
  const double rays = std::atof(text.c_str());
  LIMPID_REQUIRE(rays > 0,
    "The rays per voxel are \"" << text << "\" (a march needs some). Send a number above zero.");
  return rays;
}

Json Obey(const std::string& line, OnionEnergy& energy)
{
  const std::size_t space = line.find(' ');
  const std::string command = line.substr(0, space);
  const std::string value = space == std::string::npos ? "" : line.substr(space + 1);
  const std::map<std::string, std::function<Json()>> known{
    { "build",
      []
      {
        return Json{ { "name", "Limpid, " LIMPID_COMPILER ", build type " LIMPID_BUILD_TYPE },
          { "threads", ThreadCount() } };
      } },
    { "plan",
      [&] {
        return Json{ { "seconds", energy.Plan() } };
      } },
    { "value", [&] { return Of(energy.Value()); } },
    { "gradient", [&] { return Of(energy.ValueAndGradient()); } },
    { "slopes", [&] { return Json(energy.Slopes()); } },
    { "march", [&] { return Of(energy.March(Rays(value))); } },
    { "difference", [&] { return Json(energy.Differences(Rays(value))); } },
    { "save",
      [&]
      {
        energy.Save(value);
        return Json::object();
      } },
  };
  const auto found = known.find(command);
  LIMPID_REQUIRE(found != known.end(),
    "The command \"" << command
                     << "\" is unknown (nothing would be answered). README.md has them.");
  return found->second();
}

/// Threads are started and pages of libraries used, so that they are no part of what is measured.
void WarmUp(const Settings& settings)
{
  OnionEnergy small(8, settings);
  small.Plan();
  small.ValueAndGradient();
}
}

int main(int argc, char* argv[])
{
  try
  {
    const Options options(std::vector<std::string>(argv + 1, argv + argc),
      { { "onion", "64" }, { "threads", std::to_string(ThreadCount()) }, { "skips-off", "no" },
        { "derivative-ray", "no" } });
    Settings settings;
    settings.skipUnneeded = !options.Flag("skips-off");
    settings.derivative = options.Flag("derivative-ray") ? Derivative::Ray : Derivative::Volume;
    const ThreadLimit limit(options.Count("threads"));
    WarmUp(settings);
    OnionEnergy energy(options.Count("onion"), settings);
    std::cout << "{}" << std::endl; // the scene is there
    for (std::string line; std::getline(std::cin, line) && line != "quit";)
    {
      std::cout << Obey(line, energy).dump() << std::endl;
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
