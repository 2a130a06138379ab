// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PhantomScenes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace limpid
{
namespace
{
// Returns the share of a shape at a point with this distance to its surface, negative inside: 1
// inside, 0 outside, a cubic from -edge to edge.
double Inside(double distance, double edge)
{
  const double t = std::min(std::max(0.5 - 0.5 * distance / edge, 0.0), 1.0);
  return t * t * (3.0 - 2.0 * t);
}

void Fill(Material& material, const Material& shape, double share)
{
  material.scalar += share * (shape.scalar - material.scalar);
  material.importance += share * (shape.importance - material.importance);
  material.extinction += share * (shape.extinction - material.extinction);
  material.structure = share > 0.5 ? shape.structure : material.structure;
}

double Length(double x, double y, double z)
{
  return std::sqrt(x * x + y * y + z * z);
}

// Returns the distance to a sphere.
double Sphere(const PhantomPoint& point, const PhantomPoint& centre, double radius)
{
  return Length(point[0] - centre[0], point[1] - centre[1], point[2] - centre[2]) - radius;
}

// Returns the distance to an ellipsoid, to first order near its surface.
double Ellipsoid(const PhantomPoint& point, const PhantomPoint& centre, const PhantomPoint& radii)
{
  double scaled = 0;
  double gradient = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double along = (point[axis] - centre[axis]) / radii[axis];
    scaled += along * along;
    gradient += along * along / (radii[axis] * radii[axis]);
  }
  if (scaled < 1e-12)
  {
    return -*std::min_element(radii.begin(), radii.end());
  }
  return (scaled - std::sqrt(scaled)) / std::sqrt(gradient);
}

// Returns the distance to a vessel that winds upwards around the axis through (x, y) = (side, 0).
double Vessel(const PhantomPoint& point, double side, double radius)
{
  const double turn = 4.0 * point[2] + (side > 0 ? 0.0 : 2.1);
  const double x = side + 0.09 * std::cos(turn);
  const double y = 0.05 + 0.14 * std::sin(turn);
  const double slope = 4.0 * 0.14; // largest slope of the tube
  const double across = std::hypot(point[0] - x, point[1] - y) / std::hypot(1.0, 0.5 * slope);
  const double ends = std::abs(point[2] + 0.05) - 0.42;
  return std::max(across - radius, ends);
}

// Returns the distance to the nearest of several thin vessels, which wind along all three axes.
double ThinVessels(const PhantomPoint& p)
{
  constexpr int vessels = 12;
  double nearest = 2;
  for (int vessel = 0; vessel < vessels; ++vessel)
  {
    const double x = p[std::size_t(vessel % 3)];
    const double y = p[std::size_t((vessel + 1) % 3)];
    const double along = p[std::size_t((vessel + 2) % 3)];
    const double turn = 3.0 * along + 1.7 * vessel;
    const double wide = 0.12 + 0.035 * vessel;
    const double across = std::hypot(x - wide * std::cos(turn), y - wide * std::sin(turn)) /
      std::hypot(1.0, 3.0 * wide); // largest slope of the tube
    nearest = std::min(nearest, std::max(across - 0.012, std::abs(along) - 0.55));
  }
  return nearest;
}

// Returns white noise in [0, 1], constant within cells of size 1/64.
double Noise(const PhantomPoint& p)
{
  std::uint32_t bits = 2166136261u;
  for (const double coordinate : p)
  {
    bits = (bits ^ static_cast<std::uint32_t>(std::lround(64 * (coordinate + 1)))) * 16777619u;
    bits ^= bits >> 15;
  }
  bits *= 2246822519u;
  return double(bits >> 8) / double(1u << 24);
}

double SkullDistance(const PhantomPoint& p, double edge)
{
  const double outer = Ellipsoid(p, { 0, 0.04, 0.1 }, { 0.58, 0.68, 0.66 });
  const double inner = Ellipsoid(p, { 0, 0.04, 0.1 }, { 0.51, 0.61, 0.59 });
  const double bone = std::max(outer, -inner);
  const double eyes =
    std::min(Sphere(p, { -0.22, -0.62, 0.08 }, 0.15), Sphere(p, { 0.22, -0.62, 0.08 }, 0.15));
  const double nose = Sphere(p, { 0, -0.66, -0.14 }, 0.1);
  const double jaw = Ellipsoid(p, { 0, -0.28, -0.62 }, { 0.34, 0.34, 0.1 });
  const double jawInside = Ellipsoid(p, { 0, -0.2, -0.62 }, { 0.25, 0.3, 0.3 });
  const double openings = std::min(eyes, nose) - 0.5 * edge;
  return std::min(std::max(bone, -openings), std::max(jaw, -jawInside));
}
}

double PhantomEdge(double spacing)
{
  return std::max(0.03, 0.75 * spacing);
}

Material HeadScene(const PhantomPoint& p, double edge)
{
  const Material softTissue{ 0.25, 0, 3.0, 2 };
  const Material skin{ 0.4, 0, 9.0, 1 };
  const Material brain{ 0.15, 0, 1.5, 3 };
  const Material bone{ 0.65, 0.35, 14.0, 4 };
  const Material vessel{ 0.85, 0.8, 25.0, 5 };
  const Material tumour{ 1.0, 1.0, 25.0, 6 };

  const double skull = Ellipsoid(p, { 0, 0, 0.08 }, { 0.72, 0.82, 0.8 });
  const double chin = Ellipsoid(p, { 0, -0.25, -0.55 }, { 0.45, 0.48, 0.3 });
  const double neck = std::max(std::hypot(p[0], p[1] - 0.1) - 0.36, p[2] - 0.0);
  const double nose = Ellipsoid(p, { 0, -0.82, -0.08 }, { 0.1, 0.13, 0.16 });
  const double head = std::min({ skull, chin, neck, nose });

  Material material;
  Fill(material, skin, Inside(head, edge));
  Fill(material, softTissue, Inside(head + 0.06, edge));
  Fill(material, brain, Inside(Ellipsoid(p, { 0, 0.04, 0.1 }, { 0.5, 0.6, 0.58 }), edge));
  Fill(material, bone, Inside(SkullDistance(p, edge), edge));
  Fill(material, vessel, Inside(Vessel(p, -0.22, 0.06), edge));
  Fill(material, vessel, Inside(Vessel(p, 0.22, 0.06), edge));
  Fill(material, tumour, Inside(Ellipsoid(p, { 0.08, -0.16, 0.34 }, { 0.15, 0.13, 0.12 }), edge));
  return material;
}

Material FlameScene(const PhantomPoint& p, double edge)
{
  const double height = 0.5 * (p[2] + 1.0);
  const double sway = 0.22 * height * height;
  const double x = p[0] - sway * std::sin(5.0 * p[2]);
  const double y = p[1] - sway * std::cos(4.0 * p[2] + 0.6);
  const double angle = std::atan2(y, x);
  const double flicker =
    1.0 + 0.16 * std::sin(3.0 * angle + 7.0 * p[2]) + 0.09 * std::sin(7.0 * angle - 11.0 * p[2]);
  const double width = 0.1 + 1.15 * height * std::sqrt(std::max(0.0, 1.0 - height));
  const double radius = std::hypot(x, y);
  const double top = p[2] - 0.85;
  const double smoke = std::max(radius - 1.1 * width * flicker, top);
  const double gas = std::max(radius - 0.85 * width * flicker, top + 0.08);
  const double front = std::max(std::abs(radius - 0.5 * width * flicker) - 0.03, top + 0.2);
  const double core = std::max(radius - 0.22 * width, top + 0.35);

  Material material;
  Fill(material, { 0.2, 0, 3.0, 1 }, Inside(smoke, 2 * edge));
  Fill(material, { 0.45, 0, 4.5, 2 }, Inside(gas, 2 * edge));
  Fill(material, { 0.9, 0.8, 14.0, 3 }, Inside(front, edge));
  Fill(material, { 1.0, 1.0, 18.0, 4 }, Inside(core, edge));
  return material;
}

Material ShellsScene(const PhantomPoint& p, double edge)
{
  const double radius = Length(p[0], p[1], p[2]);
  Material material;
  Fill(material, { 0.2, 0, 2.0, 1 }, Inside(std::abs(radius - 0.85) - 0.06, edge));
  Fill(material, { 0.45, 0.3, 6.0, 2 }, Inside(std::abs(radius - 0.62) - 0.05, edge));
  Fill(material, { 0.7, 0.6, 10.0, 3 }, Inside(std::abs(radius - 0.4) - 0.05, edge));
  Fill(material, { 1.0, 1.0, 20.0, 4 }, Inside(radius - 0.2, edge));
  return material;
}

Material VesselsScene(const PhantomPoint& p, double edge)
{
  const double noise = Noise(p);
  const Material tissue{ 0.2 + 0.2 * noise, 0.6 * std::pow(noise, 3), 1.0 + 4.0 * noise, 2 };
  const double body = Ellipsoid(p, { 0, 0, 0 }, { 0.75, 0.8, 0.7 });
  Material material;
  Fill(material, { 0.5, 0, 8.0, 1 }, Inside(body, edge));
  Fill(material, tissue, Inside(body + 0.05, edge));
  Fill(material, { 1.0, 1.0, 40.0, 3 }, Inside(ThinVessels(p), 0.5 * edge));
  return material;
}

Material HomogeneousScene(const PhantomPoint&, double)
{
  return { 0.5, 1.0, 1.0, 1 };
}
}
