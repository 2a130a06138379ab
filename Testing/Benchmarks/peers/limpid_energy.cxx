// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The energy of Eq. (21) and its derivative on demand: Limpid's side of energy_torch.py. Reads
// commands from standard input, one a line, and answers each with a line of JSON; README.md has
// them.

#include "OnionEnergy.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

const char* const usage =
  "limpid_energy [--onion NODES] [--threads N] [--skips on|off] [--derivative volume|ray]\n"
  "NODES: along each axis. Commands come from standard input: build, plan, value, gradient, "
  "slopes, march RAYS, difference RAYS, save FILE, quit.\n";

struct Options
{
  int nodes = 64;
  int threads = ThreadCount();
  Settings settings;
};

int Count(const std::string& option, const std::string& text, int least)
{
  const int value = std::atoi(text.c_str());
  LIMPID_REQUIRE(value >= least,
    "The option " << option << " is \"" << text << "\" (it counts, from " << least << "). Usage:\n"
                  << usage);
  return value;
}

bool Choice(const std::string& option, const std::string& text, const std::string& first,
  const std::string& second)
{
  LIMPID_REQUIRE(text == first || text == second,
    "The option " << option << " is \"" << text << "\" (it is " << first << " or " << second
                  << "). Usage:\n"
                  << usage);
  return text == first;
}

Options Parse(const std::vector<std::string>& arguments)
{
  using Text = const std::string&;
  Options options;
  Settings& settings = options.settings;
  const std::map<std::string, std::function<void(Text, Text)>> known{
    { "--onion", [&](Text name, Text text) { options.nodes = Count(name, text, 4); } },
    { "--threads", [&](Text name, Text text) { options.threads = Count(name, text, 1); } },
    { "--skips",
      [&](Text name, Text text) { settings.skipUnneeded = Choice(name, text, "on", "off"); } },
    { "--derivative",
      [&](Text name, Text text)
      {
        settings.derivative =
          Choice(name, text, "volume", "ray") ? Derivative::Volume : Derivative::Ray;
      } },
  };
  for (std::size_t at = 0; at < arguments.size(); at += 2)
  {
    const auto option = known.find(arguments[at]);
    LIMPID_REQUIRE(option != known.end() && at + 1 < arguments.size(),
      "The option " << arguments[at] << " is unknown or has no value (nothing would come of it). "
                    << "Usage:\n"
                    << usage);
    option->second(arguments[at], arguments[at + 1]);
  }
  return options;
}

/// A JSON object, numbers with all their digits.
std::string Object(const std::map<std::string, double>& members)
{
  std::ostringstream text;
  text.precision(17);
  const char* separator = "{";
  for (const auto& [name, value] : members)
  {
    text << separator << '"' << name << "\": " << value;
    separator = ", ";
  }
  return members.empty() ? "{}" : text.str() + "}";
}

std::string Object(const Evaluation& evaluation)
{
  const Energy& energy = evaluation.energy;
  return Object({ { "regularization", energy.regularization }, { "view", energy.view },
    { "light", energy.light }, { "seconds", evaluation.seconds } });
}

std::string Build()
{
  return "{\"name\": \"Limpid, " LIMPID_COMPILER ", build type " LIMPID_BUILD_TYPE
         "\", \"threads\": " +
    std::to_string(ThreadCount()) + "}";
}

double Rays(const std::string& text)
{
  const double rays = std::atof(text.c_str());
  LIMPID_REQUIRE(rays > 0,
    "The rays per voxel are \"" << text << "\" (a march needs some). Send a number above zero.");
  return rays;
}

std::string Obey(const std::string& line, OnionEnergy& energy)
{
  const std::size_t space = line.find(' ');
  const std::string command = line.substr(0, space);
  const std::string value = space == std::string::npos ? "" : line.substr(space + 1);
  const std::map<std::string, std::function<std::string()>> known{
    { "build", Build },
    { "plan",
      [&] {
        return Object({ { "seconds", energy.Plan() } });
      } },
    { "value", [&] { return Object(energy.Value()); } },
    { "gradient", [&] { return Object(energy.ValueAndGradient()); } },
    { "slopes", [&] { return Object(energy.Slopes()); } },
    { "march", [&] { return Object(energy.March(Rays(value))); } },
    { "difference", [&] { return Object(energy.Differences(Rays(value))); } },
    { "save",
      [&]
      {
        energy.Save(value);
        return std::string("{}");
      } },
  };
  const auto found = known.find(command);
  LIMPID_REQUIRE(found != known.end(),
    "The command \"" << command << "\" is unknown (nothing would be answered). Usage:\n"
                     << usage);
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
    const Options options = Parse(std::vector<std::string>(argv + 1, argv + argc));
    const ThreadLimit limit(options.threads);
    WarmUp(options.settings);
    OnionEnergy energy(options.nodes, options.settings);
    std::cout << "{}" << std::endl; // the scene is there
    for (std::string line; std::getline(std::cin, line) && line != "quit";)
    {
      std::cout << Obey(line, energy) << std::endl;
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
