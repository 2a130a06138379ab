// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A scene file NAME.scene.json with its volume NAME.vti, as arrays on the nodes.

#ifndef limpid_testing_SceneFile_h
#define limpid_testing_SceneFile_h

#include "RayMarch.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace truth
{
/// Piecewise linear, constant outside: pairs of (value, result), values ascending.
double PiecewiseLinear(const std::vector<std::pair<double, double>>& points, double value);

struct SceneFile
{
  std::string name;
  Lattice lattice;
  std::vector<double> scalars;   ///< [data]
  std::vector<float> extinction; ///< base extinction at the nodes [1/length]
  std::vector<float> importance; ///< at the nodes [0, 1]
  double majorant = 0;           ///< largest of the transfer function [1/length]

  std::vector<std::pair<double, double>> extinctionPoints; ///< of a scalar [1/length]
  std::vector<std::array<double, 4>> colorPoints;          ///< scalar, red, green, blue [0, 1]

  Vector cameraPosition{};
  Vector cameraFocalPoint{};
  Vector cameraViewUp{};
  double cameraViewAngle = 30; ///< vertical [degrees]
  Vector lightPosition{};

  /// Colour of a scalar, piecewise linear as the others.
  std::array<double, 3> Color(double scalar) const;

  Source Eye() const { return Source::Point(cameraPosition); }
  Source Lamp() const { return Source::Point(lightPosition); }

  /// The scene with its own extinction, or with another one on the same nodes.
  Volume<float> Fields() const { return FieldsWith(extinction); }
  Volume<float> FieldsWith(const std::vector<float>& other) const
  {
    return { lattice, other.data(), importance.data() };
  }
};

/// Throws std::runtime_error with the reason when the scene cannot be read.
SceneFile ReadSceneFile(const std::string& path);
}

#endif
