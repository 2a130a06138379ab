// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Views of a scene that ranks share: the scores, slopes and viewpoints of one process, bit by bit.

#include "RandomScene.h"
#include "SceneOnRanks.h"
#include "ViewScene.h"

#include <gtest/gtest.h>

#include <mutex>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
const std::vector<Vec3> someDirections{ Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, -1, 0),
  glm::normalize(Vec3(1, 1, 1)), glm::normalize(Vec3(-2, 1, 0.3)),
  glm::normalize(Vec3(0.1, -1, 3)) };

/// What is found of views.
struct Views
{
  std::vector<ScoredView> scored;
  std::vector<ViewSlope> slopes;
  SearchResult found;
};

Views Seen(const Grid& grid, const ViewedFields& viewed, bool parallel)
{
  const ViewScore score(grid, viewed, 1);
  EXPECT_EQ(score.BackendName().find("on each of") != std::string::npos, viewed.piece != nullptr);
  const Orbit orbit = OrbitOf(grid, parallel);
  Views views;
  views.scored = ScoreViews(score, orbit, someDirections, nullptr);
  for (const Vec3& direction : someDirections)
  {
    views.slopes.push_back(score.SlopeAt(orbit.At(direction)));
  }
  SearchSettings settings;
  settings.viewpoints = 2;
  settings.largestNumberOfSteps = 5;
  views.found = FindViewpoints(score, orbit, views.scored, settings, nullptr);
  return views;
}

void ExpectSame(const std::vector<ScoredView>& one, const std::vector<ScoredView>& other)
{
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    SCOPED_TRACE(i);
    EXPECT_EQ(one[i].direction, other[i].direction);
    EXPECT_EQ(one[i].worth, other[i].worth);
    limpid::ExpectSame(one[i].score, other[i].score);
  }
}

void ExpectSame(const Views& one, const Views& other)
{
  ExpectSame(one.scored, other.scored);
  for (std::size_t i = 0; i < one.slopes.size(); ++i)
  {
    EXPECT_EQ(one.slopes[i].score, other.slopes[i].score) << i;
    EXPECT_EQ(one.slopes[i].slope, other.slopes[i].slope) << i;
  }
  ExpectSame(one.found.viewpoints, other.found.viewpoints);
  ASSERT_EQ(one.found.paths.size(), other.found.paths.size());
  for (std::size_t i = 0; i < one.found.paths.size(); ++i)
  {
    ExpectSame(one.found.paths[i], other.found.paths[i]);
  }
}

/// What is seen.
enum class Field
{
  Base,
  Other,
  Attainable ///< every ray's own
};

void ExpectSameOnRanks(const Whole& scene, bool parallel, Field field)
{
  std::vector<float> dense(scene.importance);
  for (std::size_t node = 0; node < dense.size(); ++node)
  {
    dense[node] *= field == Field::Attainable ? 0.5f * scene.extinction[node] : 3.0f;
  }
  const auto viewed = [field](const float* extinction, const float* other, const float* importance)
  {
    if (field == Field::Other)
    {
      return ViewedFields{ other, importance, extinction };
    }
    ViewedFields fields{ extinction, importance };
    fields.attainable = field == Field::Attainable;
    fields.least = fields.attainable ? other : nullptr;
    return fields;
  };
  const Views alone = Seen(
    scene.grid, viewed(scene.extinction.data(), dense.data(), scene.importance.data()), parallel);
  for (const int ranks : { 2, 3, 5 })
  {
    SCOPED_TRACE(ranks);
    std::mutex access;
    OnRanks(ranks, scene, Slabs(scene.grid.nodes, ranks % 3, ranks, ranks % 2, ranks / 3),
      [&](const SceneFields& fields, const NodeBox& box)
      {
        const std::vector<float> proxy = Cut(dense, scene.grid.nodes, box);
        ViewedFields here = viewed(fields.baseExtinction, proxy.data(), fields.importance);
        here.piece = fields.piece;
        const Views views = Seen(scene.grid, here, parallel);
        const std::lock_guard<std::mutex> lock(access);
        ExpectSame(alone, views);
      });
  }
}

class ViewsOnRanks : public ::testing::TestWithParam<unsigned>
{
protected:
  Whole Make() const { return Whole(MakeRandomScene(GetParam())); }
};
}

TEST_P(ViewsOnRanks, HaveTheSameBits)
{
  ExpectSameOnRanks(this->Make(), GetParam() % 2 == 1, static_cast<Field>(GetParam() % 3));
}

INSTANTIATE_TEST_SUITE_P(Ranks, ViewsOnRanks, ::testing::Range(0U, 12U));

class ViewsOfALargerSceneOnRanks : public ::testing::TestWithParam<Field>
{
};

TEST_P(ViewsOfALargerSceneOnRanks, HaveTheSameBits)
{
  BoxScene scene(Int3(48, 40, 56), Vec3(1, 2, 3), Vec3(0.1, 0.12, 0.09));
  scene.FillOnion();
  ExpectSameOnRanks(Whole(scene), GetParam() == Field::Other, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Ranks, ViewsOfALargerSceneOnRanks,
  ::testing::Values(Field::Base, Field::Other, Field::Attainable));
