// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The solver's transmittance and score against closed forms, before any iteration.

#include "BoxScene.h"
#include "Tolerance.h"

#include "energy/TransmittanceSweep.h"
#include "energy/VisibilityTerm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// A camera with a name for messages; it looks at the box [-1, 1]^3.
struct View
{
  const char* name;
  bool parallel;
  Vec3 position;
};

std::ostream& operator<<(std::ostream& stream, const View& view)
{
  return stream << view.name;
}

BoxScene HomogeneousCube(int nodes, double extinction, const View& view)
{
  BoxScene scene = BoxScene::Cube(nodes);
  scene.Fill(Everywhere(extinction), Everywhere(1));
  scene.camera.parallel = view.parallel;
  scene.camera.position = view.position;
  scene.camera.focalPoint = view.parallel ? Vec3(0) : view.position + Vec3(0.2, 0.1, 1);
  return scene;
}

/// Where the ray to x enters [-1, 1]^3: the length of its way inside up to x.
double PathInCube(const View& view, const Vec3& x)
{
  const double distance = view.parallel ? 1 : glm::length(view.position - x);
  if (distance == 0)
  {
    return 0;
  }
  const Vec3 back = view.parallel ? glm::normalize(view.position) : (view.position - x) / distance;
  double path = view.parallel ? 1e300 : distance;
  for (int c = 0; c < 3; ++c)
  {
    if (back[c] != 0)
    {
      path = std::min(path, std::max((back[c] > 0 ? 1 - x[c] : -1 - x[c]) / back[c], 0.0));
    }
  }
  return path;
}

std::vector<float> TransmittanceOf(const BoxScene& scene, double rayDensity)
{
  std::vector<float> transmittance(scene.extinction.size(), -1.0f);
  FillTransmittance(scene.grid, scene.extinction.data(),
    SourceOfCamera(scene.camera, scene.grid, false), rayDensity, transmittance.data());
  return transmittance;
}

struct Errors
{
  double largest = 0;
  double rms = 0;
};

Errors TransmittanceErrors(
  const BoxScene& scene, double extinction, const View& view, double rayDensity)
{
  const std::vector<float> transmittance = TransmittanceOf(scene, rayDensity);
  Errors errors;
  double squares = 0;
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      const double path = PathInCube(view, scene.grid.PointToWorld(Vec3(i, j, k)));
      const double error = std::abs(transmittance[node] - std::exp(-extinction * path));
      errors.largest = std::max(errors.largest, error);
      squares += error * error;
    });
  errors.rms = std::sqrt(squares / double(transmittance.size()));
  return errors;
}

/// By no more rays than that.
double BaseScore(const BoxScene& scene, double rayDensity)
{
  const Occupancy everything(scene.grid, scene.extinction.data(), scene.importance.data(), false);
  VisibilityTerm<HostDevice> term(HostDevice::Shared(), scene.grid, everything,
    SourceOfCamera(scene.camera, scene.grid, false), rayDensity);
  Seen seen;
  term.Forward({ scene.extinction.data(), scene.importance.data() }, &seen);
  return seen.all.visible;
}

const std::vector<View> straightViews{
  { "from -z", true, { 0, 0, -1 } },
  { "from +z", true, { 0, 0, 1 } },
  { "from -y", true, { 0, -5, 0 } },
  { "from +y", true, { 0, 5, 0 } },
  { "from -x", true, { -2, 0, 0 } },
  { "from +x", true, { 2, 0, 0 } },
};

const std::vector<View> obliqueViews{
  { "oblique parallel", true, { -0.9, -0.6, -3 } },
  { "diagonal parallel", true, { 1, 1, 1 } },
  { "straight", false, { 0, 0, -4 } },
  { "oblique", false, { 1.5, 2.2, -4 } },
  { "near", false, { 0.3, 0.2, -1.1 } },
  { "grazing", false, { -4, 0.3, 0.98 } },
  { "inside", false, { 0.11, 0.23, -0.31 } },
  { "in the centre", false, { 0, 0, 0 } },
  { "on a face", false, { -1, 0.2, 0.3 } },
  { "on an edge", false, { -1, 1, 0.3 } },
  { "on a corner", false, { -1, -1, -1 } },
  { "along the cube's diagonal", false, { 3, 3, 3 } },
  { "far", false, { 1e5, 2e5, -3e5 } },
};

class StraightView : public ::testing::TestWithParam<View>
{
};
class ObliqueView : public ::testing::TestWithParam<View>
{
};

std::string NameOf(const ::testing::TestParamInfo<View>& view)
{
  std::string name;
  for (const char* c = view.param.name; *c; ++c)
  {
    name += *c == '+' ? 'p' : *c == '-' ? 'm' : std::isalnum(*c) ? *c : '_';
  }
  return name;
}
}

TEST_P(StraightView, FollowsBeersLawToRounding)
{
  const double extinction = 1.3;
  const BoxScene scene = HomogeneousCube(33, extinction, GetParam());

  const Errors errors = TransmittanceErrors(scene, extinction, GetParam(), 1);

  // 32 additions of an optical depth up to 2.6, an exponential and a bilinear look-up.
  const Tolerance tolerance = Roundoff<float>(32, 2.6) + Roundoff<float>(8, 1.0);
  EXPECT_WITHIN(errors.largest, 0, tolerance);
}

TEST_P(StraightView, ScoresAHomogeneousCubeExactly)
{
  const double extinction = 1.3;
  const BoxScene scene = HomogeneousCube(33, extinction, GetParam());

  const double score = BaseScore(scene, 1);

  const double truth = 4 * (1 - std::exp(-2 * extinction));
  EXPECT_WITHIN(score, truth, Relative(1e-5, truth, "the quadrature is exact: rounding in float"));
}

TEST_P(StraightView, SeesTwoSlabsAsTheirClosedForm)
{
  // Two slabs of full extinction, two cells thick with linear ramps of one cell; the one behind is
  // important. Piecewise linear fields: the optical depth is exact.
  const int depthAxis = std::abs(GetParam().position.x) > 0 ? 0
    : std::abs(GetParam().position.y) > 0                   ? 1
                                                            : 2;
  const double side = GetParam().position[depthAxis] > 0 ? -1 : 1; // direction of the view
  BoxScene scene = HomogeneousCube(33, 0, GetParam());
  const double h = scene.grid.spacing.x;
  const auto slab = [=](double from)
  {
    return [=](const Vec3& x)
    {
      const double cell = (1 + side * x[depthAxis]) / h - from;
      return std::min(1.0, std::max(0.0, 2 - std::abs(cell - 2)));
    };
  };
  const auto front = slab(4);
  const auto back = slab(20);
  const double extinction = 4;
  scene.Fill([=](const Vec3& x) { return extinction * (front(x) + back(x)); },
    [=](const Vec3& x) { return back(x) > 0 ? 1 : 0; });

  const double score = BaseScore(scene, 1);

  const double opticalDepth = extinction * 3 * h - extinction * h; // a trapezoid, area 2 h
  const double truth = 4 * std::exp(-opticalDepth) * (1 - std::exp(-opticalDepth));
  // Where importance steps from 0 to 1 extinction is 0 at the node: g mu is of second order there,
  // and what the quadrature puts into the empty half of the step is mu h^2 / 6 each.
  const double step = 2 * extinction * h / 6 * 4 * std::exp(-opticalDepth);
  EXPECT_WITHIN(score, truth, (Tolerance{ step, "importance ramps up within one cell" }));
}

INSTANTIATE_TEST_SUITE_P(ClosedForm, StraightView, ::testing::ValuesIn(straightViews), NameOf);

// Beside the sides of the box the optical depth is interpolated linearly between rays, along two
// axes; in a homogeneous box tau = mu D sqrt(1 + a^2 + b^2), whose second derivatives by the slopes
// are below mu D.
TEST_P(ObliqueView, FollowsBeersLawToSecondOrder)
{
  const double extinction = 1.0;
  const BoxScene scene = HomogeneousCube(33, extinction, GetParam());

  const Errors coarse = TransmittanceErrors(scene, extinction, GetParam(), 1);
  const Errors fine = TransmittanceErrors(scene, extinction, GetParam(), 2);

  const double voxel = scene.grid.spacing.x;
  // Half-spacings squared, two axes, nearest depth a voxel: h^2 / 4 mu D / D_far^2 with D = D_far
  // at its worst, seen under 45 degrees.
  const double bound = extinction * voxel * voxel / 2;
  EXPECT_WITHIN(coarse.rms, 0, (Tolerance{ bound, "bilinear interpolation between rays" }));
  EXPECT_WITHIN(fine.rms, 0,
    Relative(0.5, coarse.rms, "second order, with room for the sides") + Roundoff<float>(16, 1.0));
  EXPECT_WITHIN(
    coarse.largest, 0, (Tolerance{ extinction * voxel / 2, "nowhere worse than half a voxel" }));
}

TEST_P(ObliqueView, ScoresAHomogeneousCubeToSecondOrder)
{
  const BoxScene scene = HomogeneousCube(45, 1.0, GetParam());
  // On few voxels, which change nothing in a homogeneous cube, 528 rays across are marched soonest.
  const BoxScene few = HomogeneousCube(5, 1.0, GetParam());
  const double truth = few.TrueScore(few.extinction, 132);

  const double coarse = std::abs(BaseScore(scene, 1) - truth);
  const double fine = std::abs(BaseScore(scene, 4) - truth);

  // The midpoint rule between rays: kinks at the outline of the box make the error a little
  // irregular, so a factor 8 is asked for where 16 is due.
  EXPECT_WITHIN(coarse, 0, Relative(0.004, truth, "one ray per voxel, 44 voxels across"));
  EXPECT_WITHIN(fine, 0,
    (Tolerance{ coarse / 8, "second order in the ray spacing" }) +
      Relative(3e-5, truth, "outline of the box at four rays per voxel, reference"));
}

TEST_P(ObliqueView, SeesAThinMediumWhole)
{
  const double extinction = 1e-6;
  const BoxScene scene = HomogeneousCube(33, extinction, GetParam());

  const Score score = scene.MakeSolver().BaseScore();

  const double truth = 8 * extinction;
  EXPECT_WITHIN(
    score.visibility, truth, Relative(0.004, truth, "one ray per voxel, 32 voxels across"));
  EXPECT_WITHIN(score.fraction, 1,
    (Tolerance{ 4 * extinction, "optical depth of the box" }) + Roundoff<float>(16, 1.0));
}

INSTANTIATE_TEST_SUITE_P(ClosedForm, ObliqueView, ::testing::ValuesIn(obliqueViews), NameOf);

TEST(SolverClosedForm, SeesADenseMediumFromInsideAsDeepAsItsMeanFreePath)
{
  const double extinction = 20;
  BoxScene scene = HomogeneousCube(65, extinction, { "inside", false, { 0, 0, 0 } });

  const double score = BaseScore(scene, 1);

  // Integral of mu exp(-mu t) t^2 over all directions; the mean free path is 1.6 cells.
  const double truth = 8 * std::acos(-1.0) / (extinction * extinction);
  EXPECT_WITHIN(
    score, truth, Relative(0.02, truth, "(cell / mean free path)^2 / 12, the widening of rays"));
}

TEST(SolverClosedForm, FollowsAGaussianToSecondOrder)
{
  // mu = A exp(-r^2 / w^2), parallel rays along z: tau is a product of two Gaussians and an error
  // function. Nodes interpolate linearly: h^2 / 8 mu'', integrated.
  const double height = 3;
  const double width = 0.4;
  const auto extinctionAt = [=](const Vec3& x)
  { return height * std::exp(-glm::dot(x, x) / (width * width)); };
  const auto largestError = [&](int nodes)
  {
    BoxScene scene = BoxScene::Cube(nodes);
    scene.Fill(extinctionAt, Everywhere(1));
    scene.camera.parallel = true;
    scene.camera.position = Vec3(0, 0, -3);
    const std::vector<float> transmittance = TransmittanceOf(scene, 1);
    double largest = 0;
    scene.ForEachNode(
      [&](std::size_t node, int i, int j, int k)
      {
        const Vec3 x = scene.grid.PointToWorld(Vec3(i, j, k));
        const double across = std::exp(-(x.x * x.x + x.y * x.y) / (width * width));
        const double depth = height * across * width * std::sqrt(std::acos(-1.0)) / 2 *
          (std::erf(x.z / width) - std::erf(-1 / width));
        largest = std::max(largest, std::abs(transmittance[node] - std::exp(-depth)));
      });
    return largest;
  };

  const double coarse = largestError(17);
  const double fine = largestError(33);

  // Along the rays the trapezoid rule errs by h^2 / 12 (mu'(end) - mu'(begin)). Across, depths are
  // interpolated linearly from voxels to rays and back: h^2 / 8 of tau'' each, along two axes, with
  // tau'' up to 2 tau / w^2; T tau'' is largest where tau = 1. And |dT| = T |dtau|.
  const double h = 2.0 / 16;
  const double steepest = height / width * std::sqrt(2 / std::exp(1.0));
  const double along = h * h / 12 * steepest;
  const double across = h * h / 2 * 2 / (std::exp(1.0) * width * width);
  EXPECT_WITHIN(coarse, 0, (Tolerance{ along + across, "linear interpolation" }));
  EXPECT_WITHIN(fine, coarse / 4,
    Relative(0.1, coarse / 4, "second order, next order") + Roundoff<float>(40, 1.0));
}
