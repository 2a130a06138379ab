// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Eqs. (15) to (20) and (26) to (28) along single rays: the bodies of the paper's own scheme.

#include "Tolerance.h"

#include "PaperScheme/AdamVoxel.h"
#include "PaperScheme/GradientVoxel.h"
#include "PaperScheme/TransmittanceRay.h"
#include "PaperScheme/VisibleImportanceRay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{
using namespace limpid;
using namespace limpid::reference;

/// A homogeneous unit cube, three normalised lengths wide, that 2 x 2 diverging rays cross from
/// front to back without touching its sides.
template <class Real>
PerspectiveMap<Real> FourRays(int depthCells)
{
  PerspectiveMap<Real> map;
  map.origin = { Real(0.5), Real(0.5), Real(-1) };
  map.SetFrame({ Real(0.25), 0, 0 }, { 0, Real(0.25), 0 }, { 0, 0, 1 });
  map.unit = Vec3Of<Real>(3);
  map.nearDepth = 1;
  map.farDepth = 2;
  map.cells = { 2, 2, depthCells };
  return map;
}

/// Path of one of the four rays through the cube: the picture's half width is a quarter, and the
/// middle of a cell is half of that off the axis.
double PathOfFourRays()
{
  return 3 * std::sqrt(1 + 2 * 0.125 * 0.125);
}
}

// In a homogeneous medium Eq. (17) has no discretisation error: every ray is Beer's law, and only
// rounding is allowed.
TEST(PaperSchemeRays, FollowBeersLawInAHomogeneousMedium)
{
  const int cells = 64;
  const float extinction = 0.8f;
  const std::vector<float> nodes(8, extinction);
  const PerspectiveMap<float> map = FourRays<float>(cells);
  std::vector<float> values(4 * cells);
  const GridView<float> transmittance{ values.data(), map.cells };

  const TransmittanceRay<float> body{ { nodes.data(), { 2, 2, 2 } }, map, transmittance };
  for (Index ray = 0; ray < map.RayCount(); ++ray)
  {
    body(ray);
  }

  for (int k = 0; k < cells; ++k)
  {
    const double opticalDepth = double(extinction) * PathOfFourRays() * k / cells;
    // k additions and some ten operations for the length of a cell round the optical depth, and
    // |dT| <= |d tau|; exp adds at most two units in the last place of a number not above one.
    const Tolerance tolerance = Roundoff<float>(k + 10, opticalDepth) + Roundoff<float>(4, 1.0);
    EXPECT_WITHIN(transmittance(0, 0, k), std::exp(-opticalDepth), tolerance);
    EXPECT_WITHIN(transmittance(1, 0, k), std::exp(-opticalDepth), tolerance);
    EXPECT_WITHIN(transmittance(0, 1, k), std::exp(-opticalDepth), tolerance);
    EXPECT_WITHIN(transmittance(1, 1, k), std::exp(-opticalDepth), tolerance);
  }
}

// With g = 1 the sum that discretises Eq. (19) is a geometric series.
TEST(PaperSchemeRays, GatherAGeometricSeriesInAHomogeneousMedium)
{
  const int cells = 32;
  const double extinction = 0.8;
  const std::vector<double> nodes(8, extinction);
  const std::vector<double> important(8, 1.0);
  const PerspectiveMap<double> map = FourRays<double>(cells);
  std::vector<double> transmittance(4 * cells);
  std::vector<double> visible(4 * cells);
  const GridView<double> visibleBehind{ visible.data(), map.cells };

  TransmittanceRay<double>{ { nodes.data(), { 2, 2, 2 } }, map,
    { transmittance.data(), map.cells } }(3);
  VisibleImportanceRay<double>{ { nodes.data(), { 2, 2, 2 } }, { important.data(), { 2, 2, 2 } },
    map, { transmittance.data(), map.cells }, visibleBehind }(3);

  const double step = extinction * PathOfFourRays() / cells;
  const double dimming = std::exp(-step);
  for (int k = 0; k < cells; ++k)
  {
    const double series =
      step * (std::pow(dimming, k + 1) - std::pow(dimming, cells)) / (1 - dimming);
    EXPECT_WITHIN(visibleBehind(1, 1, k), series, Roundoff<double>(4 * cells, 1.0));
  }
}

namespace
{
/// One ray along the nodes of a wavy column, one sample per node, half a length apart.
class OneRay
{
public:
  static constexpr int count = 16;
  static constexpr double stepLength = 0.5; // h
  static constexpr double weight = 10;      // q

  OneRay()
    : Extinction(4 * count)
    , Importance(4 * count)
    , Transmittance(count)
    , VisibleBehind(count)
  {
    for (int node = 0; node < 4 * count; ++node)
    {
      const int k = node / 4;
      this->Extinction[node] = 0.6 + 0.5 * std::sin(0.9 * k);
      this->Importance[node] = 0.5 + 0.5 * std::cos(0.7 * k);
    }
    this->Map.origin = { 0.5, 0.5, -4 };
    this->Map.SetFrame({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 });
    this->Map.unit = Vec3(stepLength);
    this->Map.nearDepth = 4;
    this->Map.farDepth = 4 + count;
    this->Map.cells = { 1, 1, count };
  }

  /// -q sum g mu T h: Eq. (23) along the ray, with the extinction of layer `changed` changed.
  double EnergyWith(int changed, double change)
  {
    const std::vector<double> kept = this->Extinction;
    for (int node = 4 * changed; node < 4 * changed + 4; ++node)
    {
      this->Extinction[node] += change;
    }
    this->Update();
    double energy = 0;
    for (int k = 0; k < count; ++k)
    {
      energy -= weight * this->Importance[4 * k] * this->Extinction[4 * k] *
        this->Transmittance[k] * stepLength;
    }
    this->Extinction = kept;
    return energy;
  }

  /// Eq. (27) at the layers.
  std::vector<double> Gradient()
  {
    this->Update();
    std::vector<double> gradient(4 * count);
    GradientVoxel<double> body;
    body.nodes = { 2, 2, count };
    body.extinction = this->Extinction.data();
    body.baseExtinction = this->Extinction.data();
    body.importance = this->Importance.data();
    body.view = { weight, this->Map, { this->Transmittance.data(), this->Map.cells },
      { this->VisibleBehind.data(), this->Map.cells } };
    body.gradient = gradient.data();
    std::vector<double> ofLayers(count);
    for (int k = 0; k < count; ++k)
    {
      body(4 * k);
      ofLayers[k] = gradient[4 * k];
    }
    return ofLayers;
  }

  double VisibleBehindLayer(int k) const { return this->VisibleBehind[k]; }

private:
  void Update()
  {
    const FieldView<double> extinction{ this->Extinction.data(), { 2, 2, count } };
    const FieldView<double> importance{ this->Importance.data(), { 2, 2, count } };
    TransmittanceRay<double>{ extinction, this->Map,
      { this->Transmittance.data(), this->Map.cells } }(0);
    VisibleImportanceRay<double>{ extinction, importance, this->Map,
      { this->Transmittance.data(), this->Map.cells },
      { this->VisibleBehind.data(), this->Map.cells } }(0);
  }

  std::vector<double> Extinction;
  std::vector<double> Importance;
  std::vector<double> Transmittance;
  std::vector<double> VisibleBehind;
  PerspectiveMap<double> Map;
};
}

// Eq. (27) is the exact derivative of the discrete energy along a ray, so a central difference may
// differ by its own two errors only: truncation d^2/6 |F'''| and cancellation u |F| / d. The
// energy is that of a sample, Eq. (27) is per length: hence the division by h.
TEST(PaperSchemeRays, HaveTheDerivativeOfTheDiscreteEnergy)
{
  OneRay ray;
  const std::vector<double> gradient = ray.Gradient();
  const double d = 1e-3;

  for (int k = 0; k < OneRay::count; ++k)
  {
    const double h = OneRay::stepLength;
    const double visibleBehind = ray.VisibleBehindLayer(k);
    const double up = ray.EnergyWith(k, +d);
    const double down = ray.EnergyWith(k, -d);
    ray.EnergyWith(k, 0); // back to the unchanged ray

    // In the extinction of layer k the energy behind it is proportional to exp(-mu_k h), the energy
    // of the layer itself is linear: |F'''| / h = q h^2 G_k, at most exp(h d) larger nearby.
    const double third = OneRay::weight * h * h * visibleBehind * std::exp(h * d);
    const Tolerance truncation{ d * d / 6 * third, "central difference" };
    const Tolerance cancellation = Roundoff<double>(4 * OneRay::count, std::abs(up) / (d * h));
    EXPECT_WITHIN((up - down) / (2 * d * h), gradient[k], truncation + cancellation);
  }
}

// After one step the corrected moments are the gradient and its square, so a voxel moves by the
// step length against the sign of the gradient, and the bounds of Eq. (25) hold it.
TEST(PaperSchemeRays, MoveByOneStepLengthAtFirstAndStayWithinTheBounds)
{
  const std::vector<double> gradient{ 3, -0.02, 3, -3, 0 };
  std::vector<double> extinction{ 0.5, 0.5, 0.01, 0.99, 0.5 };
  std::vector<double> first(5, 0.0);
  std::vector<double> second(5, 0.0);
  AdamVoxel<double> body;
  body.gradient = gradient.data();
  body.firstMoment = first.data();
  body.secondMoment = second.data();
  body.extinction = extinction.data();
  body.majorant = 1;
  body.stepLength = 0.05;
  body.epsilon = 1e-18; // shortens a step by epsilon / 0.02, below a rounding
  body.firstCorrection = 1 / (1 - 0.9);
  body.secondCorrection = 1 / (1 - 0.999);

  for (Index voxel = 0; voxel < 5; ++voxel)
  {
    body(voxel);
  }

  // (1 - 0.999) cancels: its relative error is a rounding times 1000, half of it in the root.
  const Tolerance rounding = Roundoff<double>(1000, 0.05) + Roundoff<double>(2, 0.55);
  EXPECT_WITHIN(extinction[0], 0.45, rounding);
  EXPECT_WITHIN(extinction[1], 0.55, rounding);
  EXPECT_EQ(extinction[2], 0);
  EXPECT_EQ(extinction[3], 1);
  EXPECT_EQ(extinction[4], 0.5);
}
