// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PictureMarch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace truth
{
/// The part of a pixel's line of sight that is inside the box.
struct PictureMarch::Line
{
  Vector origin{};
  Vector direction{}; ///< unit length
  Interval inside;    ///< [length]
  double middlePhase = 1;
};

namespace
{
using Clip = std::array<double, 4>;

Clip Times(const std::array<double, 16>& matrix, const Clip& x)
{
  Clip result{};
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      result[row] += matrix[4 * column + row] * x[column];
    }
  }
  return result;
}

Vector Dehomogenised(const Clip& x)
{
  return { { x[0] / x[3], x[1] / x[3], x[2] / x[3] } };
}

double Length(const Vector& a)
{
  return std::sqrt(Dot(a, a));
}

/// Gradient at the nodes over its largest length.
Field<Vector> RelativeGradient(const Field<double>& field)
{
  Field<Vector> gradient = Gradient(field);
  double steepest = 0;
  for (const Vector& slope : gradient.values)
  {
    steepest = std::max(steepest, Length(slope));
  }
  for (Vector& slope : gradient.values)
  {
    slope = steepest > 0 ? Along({}, 1 / steepest, slope) : Vector{};
  }
  return gradient;
}

Volume<double> AsVolume(const Field<double>& extinction)
{
  return { extinction.lattice, extinction.values.data(), nullptr };
}

/// The light that arrives at a place.
double MarchedLight(
  const Field<double>& extinction, const Illumination& light, const Vector& position)
{
  const auto transmittance = [&](const Vector& to)
  { return Transmittance(AsVolume(extinction), light.lamp, to); };
  const Vector before = Along(position, -ownCells * light.cell, light.TravelAt(position));
  return ArrivingLight(transmittance(position), transmittance(before));
}

/// The light that arrives at every node.
Field<double> MarchToNodes(const Field<double>& extinction, const Illumination& lit)
{
  Field<double> light{ extinction.lattice, {} };
  ForEachNode(extinction.lattice,
    [&](int i, int j, int k) {
      light.values.push_back(MarchedLight(extinction, lit, extinction.lattice.Position(i, j, k)));
    });
  return light;
}

/// Share of the base extinction that is kept, at the nodes.
Field<double> KeptShare(const Field<double>& base, const Field<double>& changed)
{
  Field<double> kept{ base.lattice, {} };
  const auto share = [&](int i, int j, int k)
  { return std::min(1.0, changed.Node(i, j, k) / base.Node(i, j, k)); };
  ForEachNode(base.lattice,
    [&](int i, int j, int k)
    {
      if (base.Node(i, j, k) > 0)
      {
        kept.values.push_back(share(i, j, k));
        return;
      }
      double sum = 0;
      int count = 0;
      for (int side = 0; side < 6; ++side)
      {
        std::array<int, 3> next{ { i, j, k } };
        next[side / 2] += side % 2 ? 1 : -1;
        const bool inside =
          next[side / 2] >= 0 && next[side / 2] < base.lattice.nodes[std::size_t(side / 2)];
        if (inside && base.Node(next[0], next[1], next[2]) > 0)
        {
          sum += share(next[0], next[1], next[2]);
          ++count;
        }
      }
      kept.values.push_back(count > 0 ? sum / count : 1.0);
    });
  return kept;
}

/// By how much the changed extinction exceeds the base, at the nodes.
Field<double> Excess(const Field<double>& base, const Field<double>& changed)
{
  Field<double> excess{ base.lattice, {} };
  for (std::size_t node = 0; node < base.values.size(); ++node)
  {
    excess.values.push_back(std::max(0.0, changed.values[node] - base.values[node]));
  }
  return excess;
}

/// Direction from the middle of the box to the viewer, unit length.
Vector ToViewerFromMiddle(const Frame& frame, const Lattice& lattice)
{
  const Clip eye = Times(frame.clipToWorld, { { 0, 0, 1, 0 } });
  if (std::abs(eye[3]) < 1e-12 * std::abs(frame.clipToWorld[15]))
  {
    const Vector away = Unit({ { eye[0], eye[1], eye[2] } });
    return { { -away[0], -away[1], -away[2] } };
  }
  const Vector middle = lattice.Position(
    0.5 * (lattice.nodes[0] - 1), 0.5 * (lattice.nodes[1] - 1), 0.5 * (lattice.nodes[2] - 1));
  return Unit(Minus(Dehomogenised(eye), middle));
}
}

PictureMarch::PictureMarch(const Medium& medium, Shadow shadow, int stepsPerVoxel)
  : Scene(medium)
  , Kind(shadow)
  , StepsPerVoxel(stepsPerVoxel)
{
  this->BaseAtNodes.lattice = medium.scalars.lattice;
  for (const double scalar : medium.scalars.values)
  {
    this->BaseAtNodes.values.push_back(medium.extinction(scalar));
  }
  for (const double value : medium.extinction.values)
  {
    this->Majorant = std::max(this->Majorant, value);
  }
  if (!medium.changed.values.empty())
  {
    this->Kept = KeptShare(medium.base, medium.changed);
    this->Added = Excess(medium.base, medium.changed);
  }
  this->Slopes = RelativeGradient(this->BaseAtNodes);
  this->LightAtNodes = medium.arrivingLight;
  if (medium.light.enabled && shadow == Shadow::Interpolated && this->LightAtNodes.values.empty())
  {
    this->LightAtNodes = MarchToNodes(this->ShadowCaster(), medium.light);
  }
}

const Field<double>& PictureMarch::ShadowCaster() const
{
  return this->Scene.changed.values.empty() ? this->BaseAtNodes : this->Scene.changed;
}

double PictureMarch::Unit() const
{
  const Vector& spacing = this->Scene.scalars.lattice.spacing;
  return std::min({ spacing[0], spacing[1], spacing[2] });
}

double PictureMarch::ExtinctionAt(const Vector& position) const
{
  const double base = this->Scene.extinction(this->Scene.scalars(position));
  if (this->Scene.changed.values.empty())
  {
    return base;
  }
  return std::min(this->Kept(position) * base + this->Added(position), this->Majorant);
}

double PictureMarch::ArrivingLightAt(const Vector& position) const
{
  return this->Kind == Shadow::Interpolated
    ? this->LightAtNodes(position)
    : MarchedLight(this->ShadowCaster(), this->Scene.light, position);
}

PictureMarch::Line PictureMarch::LineOf(const Frame& frame, int column, int row) const
{
  const double x = 2 * (column + 0.5) / frame.width - 1;
  const double y = 2 * (row + 0.5) / frame.height - 1;
  const double z = frame.depth ? frame.depth[std::size_t(row) * frame.width + column] : 1.0;
  Line line;
  line.origin = Dehomogenised(Times(frame.clipToWorld, { { x, y, -1, 1 } }));
  const Vector way =
    Minus(Dehomogenised(Times(frame.clipToWorld, { { x, y, 1, 1 } })), line.origin);
  const Vector toEnd =
    Minus(Dehomogenised(Times(frame.clipToWorld, { { x, y, z, 1 } })), line.origin);
  line.direction = truth::Unit(way);

  const Lattice& lattice = this->Scene.scalars.lattice;
  const Ray ray{ lattice.Index(line.origin), lattice.IndexDirection(line.direction) };
  line.inside = truth::Clip(ray, lattice.nodes, 0);
  line.inside.end = std::min(line.inside.end, Dot(toEnd, line.direction));

  const Illumination& light = this->Scene.light;
  if (light.enabled)
  {
    const Vector middle = lattice.Position(
      0.5 * (lattice.nodes[0] - 1), 0.5 * (lattice.nodes[1] - 1), 0.5 * (lattice.nodes[2] - 1));
    line.middlePhase = HenyeyGreenstein(
      light.anisotropy, Dot(light.TravelAt(middle), ToViewerFromMiddle(frame, lattice)));
  }
  return line;
}

double PictureMarch::SlopeAt(double scalar) const
{
  const Table<double>& table = this->Scene.extinction;
  const double entry = (table.high - table.low) / double(table.values.size() - 1);
  return std::abs(table(scalar + entry / 2) - table(scalar - entry / 2)) / entry;
}

Sample PictureMarch::SampleAt(const Vector& position, const Line& line) const
{
  Sample sample;
  sample.scalar = this->Scene.scalars(position);
  sample.slope = this->SlopeAt(sample.scalar);
  sample.extinction = this->ExtinctionAt(position);
  sample.color = this->Scene.color(sample.scalar);
  const Illumination& light = this->Scene.light;
  if (light.enabled && sample.extinction > 0)
  {
    const Vector toViewer = Along({}, -1, line.direction);
    const double arriving = light.shadowStrength > 0 ? this->ArrivingLightAt(position) : 1.0;
    const double brightness =
      Brightness(light, { position, toViewer, this->Slopes(position), arriving }, line.middlePhase);
    for (int channel = 0; channel < 3; ++channel)
    {
      sample.color[channel] *= brightness;
    }
  }
  return sample;
}

/// At the middles of equal steps.
std::vector<Sample> PictureMarch::SamplesAlong(const Line& line) const
{
  std::vector<Sample> samples;
  if (line.inside.Empty())
  {
    return samples;
  }
  const double length = line.inside.end - line.inside.begin;
  const int count =
    std::max(8, static_cast<int>(std::ceil(length / this->Unit() * this->StepsPerVoxel)));
  for (int step = 0; step < count; ++step)
  {
    const double t = line.inside.begin + (step + 0.5) * length / count;
    samples.push_back(this->SampleAt(Along(line.origin, t, line.direction), line));
  }
  return samples;
}

Color PictureMarch::Pixel(const Frame& frame, int column, int row) const
{
  const Line line = this->LineOf(frame, column, row);
  const std::vector<Sample> samples = this->SamplesAlong(line);
  if (samples.empty())
  {
    return {};
  }
  const double step = (line.inside.end - line.inside.begin) / double(samples.size());
  return { Compose(samples, step), SecondOrderBound(samples, step) };
}

std::vector<Color> PictureMarch::Picture(const Frame& frame) const
{
  std::vector<Color> picture;
  for (int row = 0; row < frame.height; ++row)
  {
    for (int column = 0; column < frame.width; ++column)
    {
      picture.push_back(this->Pixel(frame, column, row));
    }
  }
  return picture;
}
}
