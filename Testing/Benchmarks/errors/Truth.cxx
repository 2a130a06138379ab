// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Errors.h"

#include "Parallel.h"

#include "backend/Backend.h"

#include <cmath>
#include <random>

namespace limpid::benchmark
{
namespace
{
constexpr int pointsPerPiece = 2; // of Gauss' rule: a change of 5e-6 against four

double MarchOf(const SceneOfFile& scene, const std::vector<float>& extinction,
  const truth::Source& eye, double raysPerVoxel)
{
  truth::Sampling sampling;
  sampling.raysPerVoxel = raysPerVoxel;
  sampling.samplesPerVoxel = pointsPerPiece;
  return truth::VisibilityScore(scene.file.FieldsWith(extinction), eye, sampling);
}

std::vector<double> MarchTo(const SceneOfFile& scene, const std::vector<float>& extinction,
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

/// A direction in which S is differentiated: the extinction of what is important, of what is not,
/// or all of it with a wave through the box; the change of the base extinction per unit [1/length].
std::vector<float> Direction(const SceneOfFile& scene, std::size_t which)
{
  const std::vector<float>& base = scene.extinction;
  const std::vector<float>& importance = scene.importance;
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

/// The sum over nodes of gradient times direction times the node's share of the volume.
double AlongDirection(
  const SceneOfFile& scene, const std::vector<float>& gradient, const std::vector<float>& direction)
{
  const double sum = ParallelBlockSum(scene.grid.NodeCount(),
    [&](Index begin, Index end)
    {
      double part = 0;
      for (auto node = std::size_t(begin); node < std::size_t(end); ++node)
      {
        const Int3 at = NodeAt(scene.grid, node);
        double share = 1; // of a cell: half of it on each side of the box
        for (int axis = 0; axis < 3; ++axis)
        {
          share *= at[axis] == 0 || at[axis] + 1 == scene.grid.nodes[axis] ? 0.5 : 1.0;
        }
        part += share * double(gradient[node]) * direction[node];
      }
      return part;
    });
  return sum * scene.grid.CellVolume();
}

double RmsDifference(const SampledTransmittance& one, const SampledTransmittance& other)
{
  double sum = 0;
  double count = 0;
  for (std::size_t field = 0; field < one.size(); ++field)
  {
    for (std::size_t n = 0; n < one[field].size(); ++n, ++count)
    {
      sum += std::pow(one[field][n] - other[field][n], 2);
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}
}

Effort::Effort(const Options& options, double voxels)
{
  const bool quick = options.Flag("quick");
  const bool small = voxels < 1e6;
  const bool large = voxels > 4e6;
  this->repeats = quick ? 2 : options.Count("repeats");
  this->marchRays = small ? (quick ? 5 : 6) : quick ? (large ? 2 : 2.5) : 3;
  this->worthRays = small ? (quick ? 2.4 : 3.4) : quick || large ? 1.4 : 1.8;
  this->quadratureRays = large ? 1 : 2;
  this->gridSeconds = options.Number("grid-seconds") * (small ? 0.2 : 1.0) * (quick ? 0.3 : 1.0);
  if (large)
  {
    this->gridSamples = { 0.5, 1, 2, 2.8, 4 };
  }
  if (quick)
  {
    this->secondsPerSetting = 2;
    this->quadratureSteps = { 1, 2 };
  }
}

Json WorthOf(const SceneOfFile& scene, const std::vector<float>& extinction, const Weights& weights,
  double raysPerVoxel)
{
  const double score = MarchOf(scene, extinction, scene.file.Eye(), raysPerVoxel);
  const double lightScore = MarchOf(scene, extinction, scene.file.Lamp(), raysPerVoxel);
  double squares = 0;
  for (std::size_t node = 0; node < extinction.size(); ++node)
  {
    const double change = double(extinction[node]) - scene.extinction[node];
    squares += change * change;
  }
  const double regularization =
    0.5 * weights.regularization * scene.grid.Radius() * squares * scene.grid.CellVolume();
  return { { "S", score }, { "S_light", lightScore },
    { "F", regularization - weights.view * score - weights.light * lightScore } };
}

Truth::Truth(const SceneOfFile& scene, const std::vector<float>& optimized, const Effort& effort)
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
  this->MarchScores(effort);
  this->MarchSlopes();
  this->Reference["voxels"] = this->Sampled.size();
  this->Reference["seconds"] = watch.Lap();
}

std::vector<double> Truth::AtVoxels(const std::vector<float>& field) const
{
  std::vector<double> values;
  for (const std::size_t voxel : this->Sampled)
  {
    values.push_back(field[voxel]);
  }
  return values;
}

void Truth::AddErrors(Json& json, double base, double optimized) const
{
  json["error_S_base"] = base / this->Reference["S_base"].get<double>() - 1;
  json["error_S_optimized"] = optimized / this->Reference["S_optimized"].get<double>() - 1;
}

void Truth::AddErrors(
  Json& json, const SampledTransmittance& view, const SampledTransmittance& light) const
{
  json["rms_T_view"] = RmsDifference(view, this->View);
  json["rms_T_light"] = RmsDifference(light, this->Light);
}

void Truth::SampleVoxels()
{
  std::vector<std::size_t> filled;
  for (std::size_t node = 0; node < this->Origin.extinction.size(); ++node)
  {
    if (this->Origin.extinction[node] > 0 || this->Origin.importance[node] > 0)
    {
      filled.push_back(node);
    }
  }
  std::mt19937 random(20240608); // the same voxels every time
  for (int n = 0; n < 4000 && !filled.empty(); ++n)
  {
    this->Sampled.push_back(filled[random() % filled.size()]);
  }
}

void Truth::MarchScores(const Effort& effort)
{
  double uncertainty = 0; // S with two thirds of the rays is so far off
  for (int which = 0; which < 2; ++which)
  {
    const std::vector<float>& field = this->Extinction(which);
    const truth::Source eye = this->Origin.file.Eye();
    const double fine = MarchOf(this->Origin, field, eye, effort.marchRays);
    const double coarse = MarchOf(this->Origin, field, eye, effort.marchRays * 2 / 3);
    this->Reference[which == 0 ? "S_base" : "S_optimized"] = fine;
    uncertainty = std::max(uncertainty, std::abs(coarse / fine - 1));
  }
  this->Reference["uncertainty"] = uncertainty;
  this->Reference["rays_per_voxel"] = effort.marchRays;
  this->Reference["rays_per_voxel_of_worth"] = effort.worthRays;
}

void Truth::MarchSlopes()
{
  // Optical depths of what is seen change by about 1e-2; truncation is a sixth of its square, and
  // rounding of the fields averages out.
  const float step = 2e-3f;
  for (std::size_t which = 0; which < this->Slopes.size(); ++which)
  {
    const std::vector<float> direction = Direction(this->Origin, which);
    double difference = 0;
    for (const float side : { -1.0f, 1.0f })
    {
      std::vector<float> moved = this->Origin.extinction;
      for (std::size_t node = 0; node < moved.size(); ++node)
      {
        moved[node] += side * step * direction[node];
      }
      difference += double(side) *
        MarchOf(this->Origin, moved, this->Origin.file.Eye(),
          this->Reference["rays_per_voxel_of_worth"].get<double>());
    }
    this->Slopes[which] = difference / (2.0 * double(step));
  }
}

double Truth::SlopeError(const std::vector<float>& gradient) const
{
  double difference = 0;
  double length = 0;
  for (std::size_t which = 0; which < this->Slopes.size(); ++which)
  {
    const double slope = AlongDirection(this->Origin, gradient, Direction(this->Origin, which));
    difference += std::pow(slope - this->Slopes[which], 2);
    length += std::pow(this->Slopes[which], 2);
  }
  return std::sqrt(difference / length);
}
}
