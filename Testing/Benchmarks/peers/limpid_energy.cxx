// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The energy of Eq. (21) and its derivative on demand: Limpid's side of energy.py. Reads
// commands from standard input, one a line, and answers each with a line of JSON; README.md has
// them.
//   limpid_energy [--onion NODES] [--threads N] [--skips-off] [--derivative-ray] [--camera-only]

#include "BoxScene.h"
#include "Program.h"

#include "backend/Backend.h"
#include "math/Require.h"
#include "optimize/PreparedScene.h"
#include "optimize/Terms.h"

#include <optional>

#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

/// Wall clock, and the clock of all cores that this process uses, since its construction.
struct Watch
{
  Stopwatch wall;
  std::clock_t start = std::clock();

  Json Seconds() const
  {
    return { { "seconds", this->wall.Elapsed() },
      { "cpu", double(std::clock() - this->start) / CLOCKS_PER_SEC } };
  }
};

/// The terms of Eq. (21) with their weights [length^2], and the time since the watch was started.
Json Answer(const Energy& energy, const Watch& watch)
{
  Json answer = watch.Seconds();
  answer.update({ { "regularization", energy.regularization }, { "view", energy.view },
    { "light", energy.light } });
  return answer;
}

/// The energy and its derivative at one extinction of the onion scene (BoxScene::FillOnion): 0.8
/// times the base extinction, so that no term is zero.
class OnionEnergy
{
public:
  OnionEnergy(int nodes, const Settings& settings)
    : Scene(BoxScene::Cube(nodes))
  {
    this->Scene.FillOnion();
    this->Scene.settings = settings;
    for (const float value : this->Scene.extinction)
    {
      this->Extinction.push_back(0.8f * value);
    }
    this->Gradient.resize(this->Extinction.size());
  }

  /// Makes what does not depend on the extinction: rays, spans, importance of nodes.
  Json Plan()
  {
    const Watch watch;
    this->Prepared = std::make_unique<PreparedScene>(this->Scene.Fields());
    this->Task =
      this->Prepared->ProblemFor(this->Scene.camera, this->Scene.light, this->Scene.settings);
    this->Both.emplace(HostDevice::Shared(), this->Task);
    return watch.Seconds();
  }

  Json Value()
  {
    const Watch watch;
    return Answer(this->Both->Measure(this->Extinction.data()).energy, watch);
  }

  Json ValueAndGradient()
  {
    const auto weight = static_cast<float>(this->Task.RegularizationWeight());
    float* gradient = this->Gradient.data();
    const Watch watch;
    this->Both->Differentiate(this->Extinction.data(), gradient);
    ParallelFor(this->Scene.grid.NodeCount(), 65536,
      [&](Index node)
      { gradient[node] += weight * (this->Extinction[node] - this->Task.baseExtinction[node]); });
    this->Both->TakeMoved(this->Extinction.data(), nullptr);
    return Answer(this->Both->Record().energy, watch);
  }

  /// Derivatives of F, by the gradient, along all directions [length^2].
  Json Slopes() const
  {
    Json slopes;
    for (const auto& [name, direction] : this->Directions())
    {
      // All of a cell belongs to every node: the scene is empty on the sides of the box.
      double sum = 0;
      for (std::size_t node = 0; node < direction.size(); ++node)
      {
        sum += double(this->Gradient[node]) * direction[node];
      }
      slopes[name] = sum * this->Scene.grid.CellVolume();
    }
    return slopes;
  }

  /// By the reference: double precision, no code of the core.
  Json March(double raysPerVoxel) const
  {
    const Watch watch;
    return Answer(
      this->Truth({ this->Extinction.begin(), this->Extinction.end() }, raysPerVoxel), watch);
  }

  /// Central differences of the reference's energy along all directions [length^2].
  Json Differences(double raysPerVoxel) const
  {
    // A share of the base extinction: the optical depths change by about 1e-3, and truncation is a
    // share of a sixth of the square of that.
    const double step = 1e-4;
    Json differences;
    for (const auto& [name, direction] : this->Directions())
    {
      double totals[2];
      for (const int side : { 0, 1 })
      {
        std::vector<double> extinction(this->Extinction.begin(), this->Extinction.end());
        for (std::size_t node = 0; node < direction.size(); ++node)
        {
          extinction[node] += (2 * side - 1) * step * direction[node];
        }
        totals[side] = this->Truth(extinction, raysPerVoxel).Total();
      }
      differences[name] = (totals[1] - totals[0]) / (2 * step);
    }
    return differences;
  }

  /// Base extinction, importance and gradient: float32, first axis fastest.
  Json Save(const std::string& path) const
  {
    std::ofstream file(path, std::ios::binary);
    for (const std::vector<float>* field :
      { &this->Scene.extinction, &this->Scene.importance, &this->Gradient })
    {
      file.write(reinterpret_cast<const char*>(field->data()),
        static_cast<std::streamsize>(field->size() * sizeof(float)));
    }
    LIMPID_REQUIRE(file.good(),
      "The file " << path << " cannot be written (the fields would be lost). Choose another.");
    return Json::object();
  }

private:
  Energy Truth(const std::vector<double>& extinction, double raysPerVoxel) const
  {
    const BoxScene& scene = this->Scene;
    const std::vector<double> importance(scene.importance.begin(), scene.importance.end());
    const truth::Volume<double> volume{ scene.Lattice(), extinction.data(), importance.data() };
    truth::Sampling sampling;
    sampling.raysPerVoxel = raysPerVoxel;
    double squares = 0;
    for (std::size_t node = 0; node < extinction.size(); ++node)
    {
      squares += std::pow(extinction[node] - scene.extinction[node], 2);
    }
    const Weights& weights = scene.settings.weights;
    Energy energy;
    energy.regularization =
      0.5 * weights.regularization * scene.grid.Radius() * scene.grid.CellVolume() * squares;
    energy.view = -weights.view * truth::VisibilityScore(volume, scene.Eye(), sampling);
    energy.light = -weights.light * truth::VisibilityScore(volume, scene.Lamp(), sampling);
    return energy;
  }

  /// Shares of the base extinction: of what is important, of what is not, and a wave through it.
  std::map<std::string, std::vector<double>> Directions() const
  {
    std::map<std::string, std::vector<double>> directions;
    this->Scene.ForEachNode(
      [&](std::size_t node, int i, int j, int k)
      {
        const double base = this->Scene.extinction[node];
        const double importance = this->Scene.importance[node];
        const Vec3 x = this->Scene.grid.PointToWorld(Vec3(i, j, k));
        directions["important"].push_back(base * importance);
        directions["unimportant"].push_back(base * (1 - importance));
        directions["wave"].push_back(base * std::sin(3 * (x.x + 2 * x.y - x.z)));
      });
    return directions;
  }

  BoxScene Scene;
  std::vector<float> Extinction; ///< where the energy is asked for [1/length]
  std::vector<float> Gradient;   ///< of F at the nodes, per volume [1]
  std::unique_ptr<PreparedScene> Prepared;
  Problem Task;
  std::optional<Terms<HostDevice>> Both;
};

Json Obey(const std::string& line, OnionEnergy& energy)
{
  const std::string command = line.substr(0, line.find(' '));
  const std::string value = line.substr(std::min(line.size(), command.size() + 1));
  const std::map<std::string, std::function<Json()>> known{
    { "build",
      []
      {
        return Json{ { "name", "Limpid, " LIMPID_COMPILER ", build type " LIMPID_BUILD_TYPE },
          { "threads", ThreadCount() } };
      } },
    { "plan", [&] { return energy.Plan(); } },
    { "value", [&] { return energy.Value(); } },
    { "gradient", [&] { return energy.ValueAndGradient(); } },
    { "slopes", [&] { return energy.Slopes(); } },
    { "march", [&] { return energy.March(std::stod(value)); } },
    { "difference", [&] { return energy.Differences(std::stod(value)); } },
    { "save", [&] { return energy.Save(value); } },
  };
  const auto found = known.find(command);
  LIMPID_REQUIRE(found != known.end(),
    "The command \"" << command << "\" is unknown (nothing would be answered). See README.md.");
  return found->second();
}
}

int main(int argc, char* argv[])
{
  try
  {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const Options::Table known{ { "onion", "64" }, { "threads", std::to_string(ThreadCount()) },
      { "skips-off", "no" }, { "derivative-ray", "no" }, { "camera-only", "no" } };
    if (Options::TellUsage(arguments, known))
    {
      return 0;
    }
    const Options options(arguments, known);
    Settings settings;
    settings.backend = BackendKind::Cpu;
    settings.skipUnneeded = !options.Flag("skips-off");
    settings.derivative = options.Flag("derivative-ray") ? Derivative::Ray : Derivative::Volume;
    if (options.Flag("camera-only"))
    {
      settings.weights.regularization = settings.weights.light = 0;
    }
    const ThreadLimit limit(options.Count("threads"));
    OnionEnergy small(8, settings); // starts threads and pages of libraries, which do not count
    small.Plan();
    small.ValueAndGradient();
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
