// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What a picture misses of what is important, painted over it.

#include "PictureErrors.h"
#include "RenderScene.h"
#include "Tolerance.h"

#include "math/Require.h"
#include "render/MissedImportance.h"
#include "render/Ray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace limpid;

namespace
{
/// A segment of a ray in double precision.
struct Stretch
{
  double importance;
  double base;  ///< optical depth with mu-bar
  double depth; ///< optical depth with mu
};

std::vector<Stretch> RandomRay(unsigned seed)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Stretch> ray(10);
  for (Stretch& stretch : ray)
  {
    stretch.importance = share(generator) < 0.4 ? 0.0 : share(generator);
    stretch.base = share(generator) < 0.2 ? 0.0 : 2 * share(generator);
    stretch.depth = share(generator) < 0.4 ? stretch.base : 2.5 * share(generator);
  }
  return ray;
}

RayImportance Gathered(const std::vector<Stretch>& ray)
{
  RayImportance gathered;
  for (auto stretch = ray.rbegin(); stretch != ray.rend(); ++stretch)
  {
    gathered.AddInFront(float(stretch->importance), float(stretch->base), float(stretch->depth));
  }
  return gathered;
}

/// The integral of g mu T from the front with some of the stretches only, at mu-bar.
double ShownOf(const std::vector<Stretch>& ray, unsigned kept)
{
  double transmittance = 1;
  double shown = 0;
  for (std::size_t i = 0; i < ray.size(); ++i)
  {
    if ((kept >> i & 1u) != 0)
    {
      shown += transmittance * ray[i].importance * -std::expm1(-ray[i].base);
      transmittance *= std::exp(-ray[i].base);
    }
  }
  return shown;
}

/// The rounding of sums of ten terms not above one, with exponentials in single precision.
Tolerance RoundingOfARay()
{
  return Roundoff<float>(10 * 8, 2);
}

/// Cells of unit size along z in parallel view: each is a segment of the rays, and its importance
/// and its kept share are the means of its two nodes.
struct Column
{
  static constexpr int cells = 12;
  static constexpr double perCell = 0.3; ///< optical depth

  Column()
  {
    scene = RenderScene::Homogeneous(
      MakeGrid({ 5, 5, cells + 1 }, Vec3(0.0), Vec3(1.0)), perCell, { { 0.2f, 0.8f, 0.4f } });
    const Vec3 centre = scene.grid.Centre();
    scene.view.width = 3;
    scene.view.height = 3;
    scene.view.opaqueBelow = 0;
    scene.view.clipToWorld =
      Parallel(LookAt(centre - Vec3(0, 0, 20), centre, Vec3(0, 1, 0)), 1.5, 1, 10, 30);
  }

  /// Returns a field with one value per slice, at all its nodes.
  template <class OfSlice>
  std::vector<float> Field(const OfSlice& ofSlice) const
  {
    std::vector<float> values;
    for (int k = 0; k <= cells; ++k)
    {
      values.insert(values.end(), 25, float(ofSlice(k)));
    }
    return values;
  }

  void Keep(const std::vector<float>& shares)
  {
    scene.changeGrid = scene.grid;
    scene.base.assign(shares.size(), float(perCell));
    scene.extinction = shares;
    for (float& value : scene.extinction)
    {
      value *= float(perCell);
    }
  }

  /// Every pixel is `opaque` covered and misses `missed`, in the scene's colour.
  void ExpectMissed(double missed, double optical) const
  {
    const Picture found = scene.Render();
    const double opacity = 0.7 * missed * missed * (3 - 2 * missed);
    const double alpha = -std::expm1(-optical);
    const std::array<float, 3> under = scene.functions.color[0];
    for (std::size_t pixel = 0; pixel < 9; ++pixel)
    {
      for (std::size_t channel = 0; channel < 4; ++channel)
      {
        const double drawn = channel < 3 ? alpha * double(under[channel]) : alpha;
        const double paint = channel < 3 ? double(scene.missedColor[channel]) : 1.0;
        EXPECT_WITHIN(found.rgba[4 * pixel + channel] / 255.0,
          (1 - opacity) * drawn + opacity * paint,
          (Tolerance{ 1.0 / 255, "two roundings to 8 bits, of the picture and of the paint" } +
            Tolerance{ 2e-4, "shares in 15 bits" }));
      }
    }
  }

  RenderScene scene;
};

/// Two important balls in a medium that is empty otherwise: the smaller one is thinned, and the
/// larger one, of more cells than are read at a time, is cleared.
RenderScene Balls()
{
  const Grid grid = MakeGrid({ 49, 39, 35 }, Vec3(5, -3, 2), Vec3(0.9, 1.3, 0.7));
  RenderScene scene = RenderScene::Random(3, grid, 30);
  scene.importance.resize(scene.scalars.size());
  scene.changeGrid = grid;
  scene.base.assign(scene.scalars.size(), 1.0f);
  scene.extinction.resize(scene.scalars.size());
  std::size_t node = 0;
  for (int k = 0; k < grid.nodes.z; ++k)
  {
    for (int j = 0; j < grid.nodes.y; ++j)
    {
      for (int i = 0; i < grid.nodes.x; ++i, ++node)
      {
        const bool small = glm::length(Vec3(i, j, k) - Vec3(8, 8, 8)) < 6;
        const bool large = glm::length(Vec3(i, j, k) - Vec3(30, 20, 17)) < 15;
        scene.scalars[node] = small || large ? scene.scalars[node] : 0.02f;
        scene.importance[node] = small || large ? 1.0f : 0.0f;
        scene.extinction[node] = large ? 0.0f : 0.8f * scene.base[node];
      }
    }
  }
  scene.LookAtBox(RenderScene::Direction(0.9, 1.3, -3));
  return scene;
}

/// What of the hidden a segment of importance `g` that is there leaves to the paint over it, where
/// `possible` could be seen.
double LeftBy(double g, double possible)
{
  return std::pow(std::max(0.0, 1 - g / possible), 2);
}

/// Where sample `k` of a ray is [index].
Vec3 PlaceOf(const Ray& ray, int k)
{
  Vec3 place(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    place[axis] = double(ray.entry[axis]) + double(ray.At(k)) * double(ray.step[axis]);
  }
  return place;
}
}

TEST(ReversedRay, HasTheSameSamplesInTheOppositeOrder)
{
  for (const float shift : { 0.0f, 0.3f, 0.9f })
  {
    for (const float length : { 0.05f, 1.0f, 7.4f, 30.0f })
    {
      Ray ray;
      for (int axis = 0; axis < 3; ++axis)
      {
        ray.entry[axis] = 3.0f * float(axis);
        ray.step[axis] = 0.5f - 0.4f * float(axis);
      }
      ray.shift = shift;
      ray.length = length;
      ray.segments = static_cast<int>(std::ceil(length + shift));

      const Ray back = ray.Reversed();

      EXPECT_EQ(back.segments, ray.segments);
      for (int k = 0; k <= ray.segments; ++k)
      {
        // Places of up to 30, in a few operations.
        EXPECT_WITHIN(glm::length(PlaceOf(back, ray.segments - k) - PlaceOf(ray, k)), 0,
          Roundoff<float>(8, 30));
      }
    }
  }
}

TEST(RayImportance, ShowsAndRemovesWhatAMarchFromTheFrontDoes)
{
  for (unsigned seed = 0; seed < 50; ++seed)
  {
    const std::vector<Stretch> ray = RandomRay(seed);
    double transmittance = 1;
    double shown = 0;
    double removed = 0;
    for (const Stretch& stretch : ray)
    {
      const double mean =
        stretch.depth > 0 ? -std::expm1(-stretch.depth) / stretch.depth : 1.0; // of T along it
      shown += transmittance * stretch.importance * std::min(stretch.base, stretch.depth) * mean;
      removed +=
        transmittance * stretch.importance * std::max(stretch.base - stretch.depth, 0.0) * mean;
      transmittance *= std::exp(-stretch.depth);
    }

    const RayImportance gathered = Gathered(ray);

    EXPECT_WITHIN(gathered.shown, shown, RoundingOfARay());
    EXPECT_WITHIN(gathered.removed, removed, RoundingOfARay() + Roundoff<float>(80, 10));
  }
}

// What is possible is linear in whether a segment is kept, so the best keeps each wholly or not at
// all: one of all the choices.
TEST(RayImportance, CouldShowWhatTheBestChoiceOfSegmentsShows)
{
  for (unsigned seed = 0; seed < 50; ++seed)
  {
    const std::vector<Stretch> ray = RandomRay(seed);
    double best = 0;
    for (unsigned kept = 0; kept < 1u << ray.size(); ++kept)
    {
      best = std::max(best, ShownOf(ray, kept));
    }

    const RayImportance gathered = Gathered(ray);

    EXPECT_WITHIN(gathered.possible, best, RoundingOfARay());
    EXPECT_LE(double(gathered.shown), best + RoundingOfARay().value);
    EXPECT_GE(gathered.Missed(), 0);
    EXPECT_LE(gathered.Missed(), 1);
  }
}

// Important matter that is seen is not painted for what lies behind it; what is less important is.
TEST(RayImportance, IsPaintedOverWhatHidesAndNotOverWhatIsSeen)
{
  const double opaque = 12;
  const Stretch hidden{ 1, opaque, opaque };
  const auto missedBehind = [&](double importance) {
    return double(Gathered({ { importance, opaque, opaque }, hidden }).Missed());
  };

  EXPECT_WITHIN(
    missedBehind(0), 1, (RoundingOfARay() + Tolerance{ 2 * std::exp(-opaque), "opaque" }));
  EXPECT_LT(missedBehind(0.5), 0.15); // one half is hidden
  EXPECT_LT(missedBehind(0.8), 0.02);
  EXPECT_WITHIN(missedBehind(1), 0, RoundingOfARay());

  // Context hides something; whatever is important and seen in front of both stays as it is.
  const Stretch context{ 0, opaque, opaque };
  const Stretch seen{ 0.7, opaque, opaque };
  EXPECT_LT(double(Gathered({ seen, context, hidden }).Missed()), 0.1);
  EXPECT_GT(double(Gathered({ context, seen, context, hidden }).Missed()), 0.6);
}

// What was removed is missed where it was, whatever it was next to.
TEST(RayImportance, IsPaintedWhereItWasRemoved)
{
  const RayImportance gathered = Gathered({ { 0.5, 3, 0 }, { 1, 3, 3 } });
  const RayImportance behind = Gathered({ { 1, 12, 12 }, { 0.5, 3, 0 } });

  EXPECT_WITHIN(gathered.Missed(), -std::expm1(-1.5), RoundingOfARay());
  EXPECT_WITHIN(behind.Missed(), 0, (RoundingOfARay() + Tolerance{ 2 * std::exp(-12), "opaque" }));
}

TEST(RayImportance, MissesNothingOfASolidThingThatIsSeen)
{
  std::vector<Stretch> ray(10, { 0.4, 1.5, 1.5 });

  EXPECT_WITHIN(Gathered(ray).Missed(), 0, RoundingOfARay());
}

// With N cells in front, one in which the importance rises, and M that are important, all of depth
// a: V = 1 - exp(-M a) behind, if that is more than the half of the one between, could be seen, and
// exp(-N a) (1/2 (1 - exp(-a)) + exp(-a) V) is. The one between hides V - S of it, and is covered
// with its share of that.
TEST(RendererMissed, PaintsAnImportantSlabBehindAnother)
{
  Column column;
  const int inFront = 4;
  column.scene.importance = column.Field([&](int k) { return k > inFront ? 1 : 0; });
  const double a = Column::perCell;
  const double possible = -std::expm1(-a * (Column::cells - inFront - 1));
  const double shown = std::exp(-a * inFront) * (-0.5 * std::expm1(-a) + std::exp(-a) * possible);

  const double between = -0.5 * std::expm1(-a) + std::exp(-a) * possible;
  const double hiddenThere = possible - between;

  column.ExpectMissed(between - shown + LeftBy(0.5, possible) * hiddenThere, a * Column::cells);
}

TEST(RendererMissed, PaintsNothingWhereTheImportantSlabIsInFront)
{
  Column column;
  column.scene.importance = column.Field([](int k) { return k < 7 ? 1 : 0; });

  column.ExpectMissed(0, Column::perCell * Column::cells);
}

// All is important, N cells are cleared, one is half: of these the light passes all and the mean of
// a half segment. What is left, of depth (M + 1/2) a, shows 1 - exp of it, and all could 1 -
// exp(-(N
// + 1 + M) a).
TEST(RendererMissed, PaintsWhatWasRemoved)
{
  Column column;
  const int cleared = 3;
  const double a = Column::perCell;
  column.scene.importance = column.Field([](int) { return 1; });
  column.Keep(column.Field([&](int k) { return k > cleared ? 1 : 0; }));
  column.scene.missedColor = { { 0.9f, 0.1f, 0.3f } };
  const double left = a * (Column::cells - cleared - 0.5);
  // The half cell is there by half, and covers as much of what is hidden with it.
  const double inHalf = std::exp(-left) - std::exp(-a * (Column::cells - cleared));
  const double inCleared = std::exp(-a * (Column::cells - cleared)) - std::exp(-a * Column::cells);
  const double removed = a * cleared - std::expm1(-0.5 * a);

  column.ExpectMissed(1 - (1 - 0.5 * inHalf - inCleared) * std::exp(-removed), left);
}

TEST(RendererMissed, EndsWithTheRays)
{
  Column column;
  const int inFront = 4;
  column.scene.importance = column.Field([&](int k) { return k > inFront ? 1 : 0; });
  // The eye is at z = -14, the view from 10 to 30 in front of it.
  column.scene.depth.assign(9, float(2 * (inFront + 14 - 10) / 20.0 - 1));
  column.ExpectMissed(0, Column::perCell * inFront);

  column.scene.depth.clear();
  column.scene.view.planes = { glm::dvec4(0, 0, -1, inFront) };
  column.ExpectMissed(0, Column::perCell * inFront);
}

TEST(RendererMissed, LeavesNoTraceWhenItIsOffAgain)
{
  RenderScene scene = Balls();
  RenderScene without = scene;
  without.importance.clear();
  const Picture expected = without.Render();
  Renderer renderer;
  scene.SetUp(renderer);
  Picture painted;
  renderer.Render(scene.WholeView(), painted);
  Picture after;

  renderer.ShowMissed({});
  renderer.Render(scene.WholeView(), after);

  EXPECT_NE(painted.rgba, expected.rgba);
  EXPECT_EQ(after.rgba, expected.rgba);
}

TEST(RendererMissed, IsThatOfAFreshRendererAfterAnyChange)
{
  RenderScene scene = Balls();
  Renderer renderer;
  scene.SetUp(renderer);
  Picture found;
  renderer.Render(scene.WholeView(), found);

  scene.LookAtBox(RenderScene::Direction(-1, 0.4, 2));
  renderer.Render(scene.WholeView(), found);
  EXPECT_EQ(found.rgba, scene.Render().rgba) << "another camera";

  std::reverse(scene.extinction.begin(), scene.extinction.end());
  renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.extinction.data());
  renderer.Render(scene.WholeView(), found);
  EXPECT_EQ(found.rgba, scene.Render().rgba) << "another extinction";

  std::reverse(scene.functions.extinction.begin(), scene.functions.extinction.end());
  renderer.SetTransferFunctions(scene.functions);
  renderer.SetExtinction(scene.changeGrid, nullptr, nullptr);
  scene.extinction.clear();
  renderer.Render(scene.WholeView(), found);
  EXPECT_EQ(found.rgba, scene.Render().rgba) << "another transfer function, nothing optimised";

  std::reverse(scene.scalars.begin(), scene.scalars.end());
  renderer.SetScalars(scene.grid, scene.scalars.data());
  renderer.SetImportance(scene.importance.data());
  renderer.Render(scene.WholeView(), found);
  EXPECT_EQ(found.rgba, scene.Render().rgba) << "other scalars";
}

TEST(RendererMissed, IsTheSameWithAndWithoutSkips)
{
  for (const Vec3& direction : { Vec3(0.9, 1.3, -3), Vec3(1, 0, 1e-9), Vec3(-2, -1, 1) })
  {
    for (const bool jitter : { false, true })
    {
      RenderScene scene = Balls();
      scene.LookAtBox(glm::normalize(direction), 61);
      scene.view.jitter = jitter;
      const Picture with = scene.Render();
      scene.view.skipEmpty = false;

      EXPECT_EQ(with.rgba, scene.Render().rgba);
    }
  }
}

TEST(RendererMissed, NeedsScalarsAndAColour)
{
  const RenderScene scene = Balls();
  Renderer renderer;
  EXPECT_THROW(renderer.SetImportance(scene.importance.data()), Error);
  scene.SetUp(renderer);
  EXPECT_THROW(renderer.ShowMissed(std::array<float, 3>{ { 1, 0, 1.5f } }), Error);
  EXPECT_THROW(renderer.ShowMissed(std::array<float, 3>{ { NAN, 0, 1 } }), Error);
}
