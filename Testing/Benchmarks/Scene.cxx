// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Scene.h"

namespace limpid::benchmark
{
namespace
{
Vec3 FromTruth(const truth::Vector& v)
{
  return { v[0], v[1], v[2] };
}

Grid GridOf(const truth::Lattice& lattice)
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
}

Scene::Scene(const std::string& path)
  : file(truth::ReadSceneFile(path))
  , grid(GridOf(this->file.lattice))
{
  this->camera.position = FromTruth(this->file.cameraPosition);
  this->camera.focalPoint = FromTruth(this->file.cameraFocalPoint);
  this->camera.viewUp = FromTruth(this->file.cameraViewUp);
  this->camera.viewAngle = this->file.cameraViewAngle;
  this->light.position = FromTruth(this->file.lightPosition);
  this->light.focalPoint = this->camera.focalPoint;
}

SceneFields Scene::Fields() const
{
  return { this->grid, this->file.extinction.data(), this->file.importance.data() };
}

Solver Scene::MakeSolver(const Settings& settings) const
{
  return Solver(this->Fields(), this->camera, this->light, settings);
}

double Scene::March(const std::vector<float>& extinction, double raysPerVoxel) const
{
  truth::Sampling sampling;
  sampling.raysPerVoxel = raysPerVoxel;
  return truth::VisibilityScore(this->file.FieldsWith(extinction), this->file.Eye(), sampling);
}
}
