// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Truth.h"

#include "../Timing.h"

#include "Parallel.h"

#include "backend/Backend.h"

#include <cmath>
#include <random>

namespace limpid::benchmark
{
namespace
{
constexpr int pointsPerPiece = 2; // of Gauss' rule: a change of 5e-6 against four

/// Indices of a node.
Int3 NodeAt(const Grid& grid, std::size_t node)
{
  const std::size_t row = node / std::size_t(grid.nodes.x);
  return { static_cast<int>(node % std::size_t(grid.nodes.x)),
    static_cast<int>(row % std::size_t(grid.nodes.y)),
    static_cast<int>(row / std::size_t(grid.nodes.y)) };
}

double MarchOf(const Scene& scene, const std::vector<float>& extinction, const truth::Source& eye,
  double raysPerVoxel)
{
  truth::Sampling sampling;
  sampling.raysPerVoxel = raysPerVoxel;
  sampling.samplesPerVoxel = pointsPerPiece;
  return truth::VisibilityScore(scene.file.FieldsWith(extinction), eye, sampling);
}

std::vector<double> MarchTo(const Scene& scene, const std::vector<float>& extinction,
  const truth::Source& eye, const std::vector<std::size_t>& voxels)
{
  const truth::Volume<float> volume = scene.file.FieldsWith(extinction);
  std::vector<double> transmittance(voxels.size());
  truth::ForEachRow(voxels.size(), 0,
    [&](std::size_t n)
    {
      const Int3 node = NodeAt(scene.grid, voxels[n]);
      transmittance[n] =
        truth::Transmittance(volume, eye, volume.lattice.Position(node.x, node.y, node.z));
    });
  return transmittance;
}
}

std::vector<float> Direction(const Scene& scene, int which)
{
  const std::vector<float>& base = scene.file.extinction;
  const std::vector<float>& importance = scene.file.importance;
  std::vector<float> direction(base.size());
  ParallelFor(scene.grid.NodeCount(), 4096,
    [&](Index index)
    {
      const auto node = std::size_t(index);
      double share = which == 0 ? importance[node] : 1 - importance[node];
      if (which == 2)
      {
        // One and a half, two and two and a half periods, beginning anywhere.
        const Vec3 place = Vec3(NodeAt(scene.grid, node)) / Vec3(scene.grid.nodes);
        share = std::sin(9.4 * place.x + 0.7) * std::sin(12.6 * place.y + 1.3) *
          std::sin(15.7 * place.z + 0.4);
      }
      direction[node] = static_cast<float>(base[node] * share);
    });
  return direction;
}

double AlongDirection(
  const Scene& scene, const std::vector<float>& gradient, const std::vector<float>& direction)
{
  const auto term = [&](std::size_t node)
  {
    double share = 1; // of a cell: half of it on each side of the box
    const Int3 at = NodeAt(scene.grid, node);
    for (int axis = 0; axis < 3; ++axis)
    {
      share *= at[axis] == 0 || at[axis] + 1 == scene.grid.nodes[axis] ? 0.5 : 1.0;
    }
    return share * double(gradient[node]) * direction[node];
  };
  const double sum = ParallelBlockSum(scene.grid.NodeCount(),
    [&](Index begin, Index end)
    {
      double part = 0;
      for (Index node = begin; node < end; ++node)
      {
        part += direction[std::size_t(node)] == 0 ? 0.0 : term(std::size_t(node));
      }
      return part;
    });
  return sum * scene.grid.CellVolume();
}

Worth WorthOf(const Scene& scene, const std::vector<float>& extinction, const Weights& weights,
  double raysPerVoxel)
{
  const std::vector<float>& base = scene.file.extinction;
  Worth worth;
  worth.score = MarchOf(scene, extinction, scene.file.Eye(), raysPerVoxel);
  worth.lightScore = MarchOf(scene, extinction, scene.file.Lamp(), raysPerVoxel);
  double squares = 0;
  for (std::size_t node = 0; node < base.size(); ++node)
  {
    const double change = double(extinction[node]) - base[node];
    squares += change * change;
  }
  const double regularization =
    0.5 * weights.regularization * scene.grid.Radius() * squares * scene.grid.CellVolume();
  worth.energy = regularization - weights.view * worth.score - weights.light * worth.lightScore;
  return worth;
}

double RmsDifference(const SampledTransmittance& one, const SampledTransmittance& other)
{
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t field = 0; field < one.size(); ++field)
  {
    for (std::size_t n = 0; n < one[field].size(); ++n)
    {
      const double difference = one[field][n] - other[field][n];
      sum += difference * difference;
    }
    count += one[field].size();
  }
  return count > 0 ? std::sqrt(sum / double(count)) : 0.0;
}

Truth::Truth(const Scene& scene, const std::vector<float>& optimized, const Effort& effort)
  : Origin(scene)
  , Optimized(optimized)
{
  Stopwatch watch;
  this->SampleVoxels();
  for (int which = 0; which < 2; ++which)
  {
    const std::vector<float>& field = this->Extinction(which);
    this->View[std::size_t(which)] = MarchTo(scene, field, scene.file.Eye(), this->Sampled);
    this->Light[std::size_t(which)] = MarchTo(scene, field, scene.file.Lamp(), this->Sampled);
  }
  this->Reference.worthRaysPerVoxel = effort.worthRays;
  this->MarchScores(effort);
  this->MarchSlopes();
  this->Reference.seconds = watch.Lap();
}

void Truth::SampleVoxels()
{
  std::vector<std::size_t> filled;
  const truth::SceneFile& file = this->Origin.file;
  for (std::size_t node = 0; node < file.extinction.size(); ++node)
  {
    if (file.extinction[node] > 0 || file.importance[node] > 0)
    {
      filled.push_back(node);
    }
  }
  std::mt19937 random(20240608); // the same voxels every time
  for (int n = 0; n < 4000 && !filled.empty(); ++n)
  {
    this->Sampled.push_back(filled[random() % filled.size()]);
  }
  this->Reference.voxels = this->Sampled.size();
}

void Truth::MarchScores(const Effort& effort)
{
  this->Reference.raysPerVoxel = effort.marchRays;
  for (int which = 0; which < 2; ++which)
  {
    const std::vector<float>& field = this->Extinction(which);
    const truth::Source eye = this->Origin.file.Eye();
    const double fine = MarchOf(this->Origin, field, eye, effort.marchRays);
    const double coarse = MarchOf(this->Origin, field, eye, effort.marchRays * 2 / 3);
    (which == 0 ? this->Reference.base : this->Reference.optimized) = fine;
    this->Reference.uncertainty =
      std::max(this->Reference.uncertainty, std::abs(coarse / fine - 1));
  }
}

void Truth::MarchSlopes()
{
  // Optical depths of what is seen change by about 1e-2; truncation is a sixth of its square, and
  // rounding of the fields averages out.
  const float step = 2e-3f;
  for (int which = 0; which < directionCount; ++which)
  {
    const std::vector<float> direction = Direction(this->Origin, which);
    double difference = 0;
    for (const float side : { -1.0f, 1.0f })
    {
      std::vector<float> moved = this->Origin.file.extinction;
      for (std::size_t node = 0; node < moved.size(); ++node)
      {
        moved[node] += side * step * direction[node];
      }
      const double score =
        MarchOf(this->Origin, moved, this->Origin.file.Eye(), this->Reference.worthRaysPerVoxel);
      difference += double(side) * score;
    }
    this->Slopes[std::size_t(which)] = difference / (2.0 * double(step));
  }
}

double Truth::ErrorOf(const std::array<double, directionCount>& slopes) const
{
  double difference = 0;
  double length = 0;
  for (std::size_t which = 0; which < slopes.size(); ++which)
  {
    difference += std::pow(slopes[which] - this->Slopes[which], 2);
    length += std::pow(this->Slopes[which], 2);
  }
  return std::sqrt(difference / length);
}
}
