// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OnionEnergy.h"

#include "Timing.h"

#include "backend/Backend.h"
#include "energy/NodeImportance.h"
#include "math/Require.h"

#include <cmath>
#include <fstream>
#include <memory>

namespace limpid::benchmark
{
OnionEnergy::OnionEnergy(int nodes, const Settings& settings)
  : Scene(BoxScene::Cube(nodes))
{
  this->Scene.FillOnion();
  this->Scene.settings = settings;
  this->Extinction = this->Scene.extinction;
  for (float& value : this->Extinction)
  {
    value *= 0.8f;
  }
}

double OnionEnergy::Plan()
{
  Stopwatch watch;
  const BoxScene& scene = this->Scene;
  this->NodeImportance =
    NodeImportanceOfFilled(scene.grid, scene.extinction.data(), scene.importance.data());
  this->Task.grid = scene.grid;
  this->Task.baseExtinction = scene.extinction.data();
  this->Task.importance = scene.importance.data();
  this->Task.nodeImportance = this->NodeImportance.data();
  this->Task.occupancy = std::make_shared<const Occupancy>(
    scene.grid, scene.extinction.data(), this->NodeImportance.data(), scene.settings.skipUnneeded);
  this->Task.camera = SourceOfCamera(scene.camera, scene.grid, false);
  this->Task.light = SourceOfLight(scene.light, scene.grid);
  this->Task.settings = scene.settings;
  this->Both = Terms(this->Task);
  this->Gradient.assign(this->Extinction.size(), 0.0f);
  return watch.Lap();
}

void OnionEnergy::RequirePlan() const
{
  LIMPID_REQUIRE(this->Both.camera && this->Both.light,
    "There are no rays yet (they are planned once). Send the command plan first.");
}

Evaluation OnionEnergy::Value()
{
  this->RequirePlan();
  Stopwatch watch;
  const Energy energy = this->Both.Measure(this->Task, this->Extinction.data()).energy;
  return { energy, watch.Lap() };
}

Evaluation OnionEnergy::ValueAndGradient()
{
  this->RequirePlan();
  const auto weight = static_cast<float>(this->Task.RegularizationWeight());
  float* gradient = this->Gradient.data();

  Stopwatch watch;
  ParallelFor(this->Scene.grid.NodeCount(), 65536,
    [&](Index node)
    { gradient[node] = weight * (this->Extinction[node] - this->Task.baseExtinction[node]); });
  const Energy energy = this->Both.AddGradient(this->Task, this->Extinction, this->Gradient).energy;
  return { energy, watch.Lap() };
}

std::map<std::string, double> OnionEnergy::Slopes() const
{
  this->RequirePlan();
  std::map<std::string, double> slopes;
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

Evaluation OnionEnergy::March(double raysPerVoxel) const
{
  Stopwatch watch;
  const Energy energy = this->Truth(
    std::vector<double>(this->Extinction.begin(), this->Extinction.end()), raysPerVoxel);
  return { energy, watch.Lap() };
}

std::map<std::string, double> OnionEnergy::Differences(double raysPerVoxel) const
{
  // A share of the base extinction: the optical depths change by about 1e-3, and truncation is a
  // share of a sixth of the square of that.
  const double step = 1e-4;
  std::map<std::string, double> differences;
  for (const auto& [name, direction] : this->Directions())
  {
    for (const double side : { -1.0, 1.0 })
    {
      std::vector<double> extinction(this->Extinction.begin(), this->Extinction.end());
      for (std::size_t node = 0; node < direction.size(); ++node)
      {
        extinction[node] += side * step * direction[node];
      }
      differences[name] += side * this->Truth(extinction, raysPerVoxel).Total() / (2 * step);
    }
  }
  return differences;
}

void OnionEnergy::Save(const std::string& path) const
{
  this->RequirePlan();
  std::ofstream file(path, std::ios::binary);
  for (const std::vector<float>* field :
    { &this->Scene.extinction, &this->Scene.importance, &this->Gradient })
  {
    file.write(reinterpret_cast<const char*>(field->data()),
      static_cast<std::streamsize>(field->size() * sizeof(float)));
  }
  LIMPID_REQUIRE(file.good(),
    "The file " << path << " cannot be written (the fields would be lost). Choose another.");
}

Energy OnionEnergy::Truth(const std::vector<double>& extinction, double raysPerVoxel) const
{
  const BoxScene& scene = this->Scene;
  const std::vector<double> importance(scene.importance.begin(), scene.importance.end());
  const truth::Volume<double> volume{ scene.Lattice(), extinction.data(), importance.data() };
  truth::Sampling sampling;
  sampling.raysPerVoxel = raysPerVoxel;
  const Weights& weights = scene.settings.weights;
  double squares = 0;
  for (std::size_t node = 0; node < extinction.size(); ++node)
  {
    const double change = extinction[node] - scene.extinction[node];
    squares += change * change;
  }
  Energy energy;
  energy.regularization =
    0.5 * weights.regularization * scene.grid.Radius() * scene.grid.CellVolume() * squares;
  energy.view = -weights.view * truth::VisibilityScore(volume, scene.Eye(), sampling);
  energy.light = -weights.light * truth::VisibilityScore(volume, scene.Lamp(), sampling);
  return energy;
}

std::map<std::string, std::vector<double>> OnionEnergy::Directions() const
{
  const BoxScene& scene = this->Scene;
  std::map<std::string, std::vector<double>> directions;
  std::vector<double>& important = directions["important"];
  std::vector<double>& unimportant = directions["unimportant"];
  std::vector<double>& wave = directions["wave"];
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      const double base = scene.extinction[node];
      const double importance = scene.importance[node];
      const Vec3 x = scene.grid.PointToWorld(Vec3(i, j, k));
      important.push_back(base * importance);
      unimportant.push_back(base * (1 - importance));
      wave.push_back(base * std::sin(3 * (x.x + 2 * x.y - x.z)));
    });
  return directions;
}
}
