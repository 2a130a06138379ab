// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The shapes and materials of vtkOcclusionPhantom, as functions of position.

#ifndef limpid_PhantomScenes_h
#define limpid_PhantomScenes_h

#include <array>

namespace limpid
{
using PhantomPoint = std::array<double, 3>;

/// The material of a phantom at a point.
struct Material
{
  double scalar = 0;     ///< [0, 1]
  double importance = 0; ///< [0, 1]
  double extinction = 0; ///< [1/length]
  int structure = 0;     ///< label of the shape that has most of the point; 0: none
};

/// Returns half the width of the edges of shapes for a node spacing [length].
double PhantomEdge(double spacing);

/// Returns the material of a scene at a point of [-1, 1]^3. `edge`: see PhantomEdge [length].
using PhantomScene = Material (*)(const PhantomPoint& point, double edge);

Material HeadScene(const PhantomPoint& point, double edge);
Material FlameScene(const PhantomPoint& point, double edge);
Material ShellsScene(const PhantomPoint& point, double edge);
Material HomogeneousScene(const PhantomPoint& point, double edge);
Material VesselsScene(const PhantomPoint& point, double edge);
}

#endif
