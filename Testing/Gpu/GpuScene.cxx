// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "GpuScene.h"

#include "backend/Backend.h"

#include <algorithm>
#include <cmath>

namespace limpid::benchmark
{
namespace
{
constexpr double majorant = 12; // [1/length]

double Bell(double x, double width)
{
  return std::exp(-x * x / (width * width));
}

double FromCore(const Vec3& x)
{
  return glm::length(x - Vec3(0.1, -0.1, 0.15));
}

float ExtinctionAt(const Vec3& x, Filling filling)
{
  const double value = 0.5 * Bell(glm::length(x) - 0.75, 0.12) + Bell(FromCore(x), 0.35);
  const double least = filling == Filling::Dense ? 0.02 : 0.0;
  return static_cast<float>(majorant * (value < 0.02 ? least : std::min(1.0, value)));
}

float ImportanceAt(const Vec3& x)
{
  return static_cast<float>(std::clamp(1.6 - 4 * FromCore(x), 0.0, 1.0));
}
}

std::string NameOf(Filling filling)
{
  return filling == Filling::Onion ? "onion" : "dense";
}

GpuScene::GpuScene(Filling filling, int nodes)
  : name(NameOf(filling))
{
  this->grid.nodes = Int3(nodes);
  this->grid.origin = Vec3(-1);
  this->grid.spacing = Vec3(2.0 / (nodes - 1));
  const auto count = static_cast<std::size_t>(this->grid.NodeCount());
  this->extinction.resize(count);
  this->importance.resize(count);
  ParallelFor(Index(nodes) * nodes,
    [&](Index row)
    {
      const auto j = static_cast<int>(row % nodes);
      const auto k = static_cast<int>(row / nodes);
      std::size_t node = static_cast<std::size_t>(row) * static_cast<std::size_t>(nodes);
      for (int i = 0; i < nodes; ++i, ++node)
      {
        const Vec3 x = this->grid.PointToWorld(Vec3(i, j, k));
        this->extinction[node] = ExtinctionAt(x, filling);
        this->importance[node] = ImportanceAt(x);
      }
    });
  this->largest = *std::max_element(this->extinction.begin(), this->extinction.end());
  const double radius = this->grid.Radius();
  this->camera.focalPoint = this->grid.Centre();
  this->camera.position = this->grid.Centre() + radius * Vec3(0.9, 1.3, -3);
  this->light.focalPoint = this->grid.Centre();
  this->light.position = this->grid.Centre() + radius * Vec3(-1, 3, -0.7);
}
}
