// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A scene file in the terms of the core.

#ifndef limpid_testing_SceneForSolver_h
#define limpid_testing_SceneForSolver_h

#include "SceneFile.h"

#include "optimize/Solver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace limpid
{
inline Vec3 FromTruth(const truth::Vector& v)
{
  return Vec3(v[0], v[1], v[2]);
}

inline Grid FromTruth(const truth::Lattice& lattice)
{
  Grid grid;
  grid.origin = FromTruth(lattice.origin);
  grid.spacing = FromTruth(lattice.spacing);
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.nodes[axis] = lattice.nodes[axis];
    for (int row = 0; row < 3; ++row)
    {
      grid.direction[axis][row] = lattice.direction[3 * row + axis];
    }
  }
  return grid;
}

/// What a solver needs, with arrays of its own.
struct SceneForSolver
{
  std::string name;
  Grid grid;
  Camera camera;
  Light light;
  std::vector<float> extinction; ///< of the transfer function, at the nodes [1/length]
  std::vector<float> importance; ///< at the nodes [0, 1]

  SceneForSolver() = default;

  explicit SceneForSolver(const truth::SceneFile& file)
    : name(file.name)
    , grid(FromTruth(file.lattice))
    , extinction(file.extinction)
    , importance(file.importance)
  {
    this->camera.position = FromTruth(file.cameraPosition);
    this->camera.focalPoint = FromTruth(file.cameraFocalPoint);
    this->camera.viewUp = FromTruth(file.cameraViewUp);
    this->camera.viewAngle = file.cameraViewAngle;
    this->light.position = FromTruth(file.lightPosition);
    this->light.focalPoint = this->camera.focalPoint;
  }

  SceneFields Fields() const
  {
    return { this->grid, this->extinction.data(), this->importance.data() };
  }

  Solver MakeSolver(const Settings& settings) const
  {
    return Solver(this->Fields(), this->camera, this->light, settings);
  }

  /// The extinction of Field "Importance Proxy": the majorant times importance.
  std::vector<float> Proxy() const
  {
    const float majorant = *std::max_element(this->extinction.begin(), this->extinction.end());
    std::vector<float> proxy = this->importance;
    std::for_each(proxy.begin(), proxy.end(), [=](float& value) { value *= majorant; });
    return proxy;
  }
};

/// A scene file, and what a solver needs of it.
struct SceneOfFile : SceneForSolver
{
  truth::SceneFile file;

  explicit SceneOfFile(truth::SceneFile read)
    : SceneForSolver(read)
    , file(std::move(read))
  {
  }

  /// Throws std::runtime_error with the reason when the scene cannot be read.
  explicit SceneOfFile(const std::string& path)
    : SceneOfFile(truth::ReadSceneFile(path))
  {
  }

  /// What people have: opacity from 0 to 1 over the range of the scalars, ParaView's default, or 1
  /// for the topmost 3 % of them and 0 for others, over a distance of `cells` cells; important is
  /// what is above the 97th percentile. For the march, too.
  void Classify(bool ramp, double cells)
  {
    const std::vector<double>& scalars = this->file.scalars;
    const auto [low, high] = std::minmax_element(scalars.begin(), scalars.end());
    const double top = this->Top();
    const double distance = cells * std::cbrt(this->grid.CellVolume());
    for (std::size_t node = 0; node < scalars.size(); ++node)
    {
      const double opacity =
        ramp ? (scalars[node] - *low) / (*high - *low) : double(scalars[node] > top);
      this->extinction[node] =
        static_cast<float>(-std::log(std::max(1 - opacity, 1e-6)) / distance);
      this->importance[node] =
        static_cast<float>(std::clamp((scalars[node] / top - 0.95) / 0.05, 0.0, 1.0));
    }
    this->file.extinction = this->extinction;
    this->file.importance = this->importance;
  }

  /// The 97th percentile of the scalars [data].
  double Top() const
  {
    std::vector<double> ordered = this->file.scalars;
    const auto top = ordered.begin() + static_cast<std::ptrdiff_t>(0.97 * double(ordered.size()));
    std::nth_element(ordered.begin(), top, ordered.end());
    return *top;
  }

  /// S by the independent ray march of an extinction [length^2].
  double March(const std::vector<float>& extinctionThere, double raysPerVoxel = 3) const
  {
    truth::Sampling sampling;
    sampling.raysPerVoxel = raysPerVoxel;
    return truth::VisibilityScore(
      this->file.FieldsWith(extinctionThere), this->file.Eye(), sampling);
  }

  /// What the march says of an extinction (energy/Score.h).
  Score MarchScore(const std::vector<float>& extinctionThere, double raysPerVoxel = 3) const
  {
    truth::Sampling sampling;
    sampling.raysPerVoxel = raysPerVoxel;
    const truth::Shares shares = truth::SharesOf(this->file.FieldsWith(extinctionThere),
      this->file.extinction.data(), this->file.Eye(), sampling);
    return { this->March(extinctionThere, raysPerVoxel), shares.visible, shares.removed };
  }
};
}

#endif
