// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SceneFile.h"
#include "SceneVolume.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace truth
{
namespace
{
using Points = std::vector<std::pair<double, double>>;

Vector ReadVector(const nlohmann::json& json)
{
  return { { json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>() } };
}

std::vector<float> Classify(const std::vector<double>& scalars, const Points& points)
{
  std::vector<float> result(scalars.size());
  std::transform(scalars.begin(), scalars.end(), result.begin(),
    [&](double value) { return static_cast<float>(PiecewiseLinear(points, value)); });
  return result;
}
}

double PiecewiseLinear(const std::vector<std::pair<double, double>>& points, double value)
{
  if (value <= points.front().first)
  {
    return points.front().second;
  }
  for (std::size_t point = 1; point < points.size(); ++point)
  {
    const auto& [left, low] = points[point - 1];
    const auto& [right, high] = points[point];
    if (value <= right)
    {
      return low + (high - low) * (value - left) / (right - left);
    }
  }
  return points.back().second;
}

std::array<double, 3> SceneFile::Color(double scalar) const
{
  std::array<double, 3> color{};
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    Points points;
    for (const std::array<double, 4>& point : this->colorPoints)
    {
      points.emplace_back(point[0], point[channel + 1]);
    }
    color[channel] = PiecewiseLinear(points, scalar);
  }
  return color;
}

SceneFile ReadSceneFile(const std::string& path)
{
  std::ifstream file(path);
  if (!file)
  {
    throw std::runtime_error(path + " cannot be opened.");
  }
  const nlohmann::json json = nlohmann::json::parse(file);
  const std::size_t slash = path.find_last_of('/');
  const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);

  SceneFile scene;
  scene.name = json.at("name").get<std::string>();
  const nlohmann::json& data = json.at("data");
  ReadVolume(
    folder + data.at("file").get<std::string>(), data.at("array").get<std::string>(), scene);
  scene.extinctionPoints = json.at("extinction_tf").get<Points>();
  scene.colorPoints = json.at("color_tf").get<std::vector<std::array<double, 4>>>();
  scene.extinction = Classify(scene.scalars, scene.extinctionPoints);
  scene.importance = Classify(scene.scalars, json.at("importance_tf").get<Points>());
  scene.majorant = json.at("max_extinction").get<double>();
  const nlohmann::json& camera = json.at("camera");
  scene.cameraPosition = ReadVector(camera.at("position"));
  scene.cameraFocalPoint = ReadVector(camera.at("focal_point"));
  scene.cameraViewUp = ReadVector(camera.at("view_up"));
  scene.cameraViewAngle = camera.at("view_angle").get<double>();
  scene.lightPosition = ReadVector(json.at("light").at("position"));
  return scene;
}
}
