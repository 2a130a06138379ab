// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "NodeImportanceOfAll.h"
#include "Tolerance.h"

#include "energy/NodeImportance.h"
#include "energy/SceneSurvey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace limpid;

namespace
{
struct Fields
{
  Grid grid;
  std::vector<float> extinction;
  std::vector<float> importance;

  std::size_t At(int i, int j, int k) const
  {
    return static_cast<std::size_t>((Index(k) * this->grid.nodes.y + j) * this->grid.nodes.x + i);
  }
};

/// Blobs of importance with much that is empty round them, some of it with extinction.
Fields Blobs(const Int3& nodes)
{
  Fields fields;
  fields.grid.nodes = nodes;
  fields.extinction.assign(std::size_t(fields.grid.NodeCount()), 0.0f);
  fields.importance.assign(std::size_t(fields.grid.NodeCount()), 0.0f);
  for (int k = 0; k < nodes.z; ++k)
  {
    for (int j = 0; j < nodes.y; ++j)
    {
      for (int i = 0; i < nodes.x; ++i)
      {
        const double wave = std::sin(0.31 * i) + std::sin(0.23 * j + 1) + std::sin(0.37 * k + 2);
        const std::size_t node = fields.At(i, j, k);
        fields.importance[node] = static_cast<float>(std::min(std::max(wave - 1.2, 0.0), 1.0));
        fields.extinction[node] = wave > 0.8 && (i + j + k) % 3 ? 2.0f : 0.0f;
      }
    }
  }
  return fields;
}

/// Integral of the hat of node `k` times that of its neighbour at `offset`, over that of its own.
double Weight(int k, int offset, int nodes)
{
  if (k + offset < 0 || k + offset >= nodes)
  {
    return 0;
  }
  const bool border = nodes > 1 && (k == 0 || k == nodes - 1);
  const double own = nodes > 1 ? 2.0 / 3 : 1.0;
  return offset == 0 ? own : (border ? 1.0 / 3 : 1.0 / 6);
}

double MeanAt(const Fields& fields, int i, int j, int k)
{
  const Int3& nodes = fields.grid.nodes;
  double sum = 0;
  for (int c = -1; c <= 1; ++c)
  {
    for (int b = -1; b <= 1; ++b)
    {
      for (int a = -1; a <= 1; ++a)
      {
        const double weight = Weight(i, a, nodes.x) * Weight(j, b, nodes.y) * Weight(k, c, nodes.z);
        sum += weight > 0 ? weight * fields.importance[fields.At(i + a, j + b, k + c)] : 0.0;
      }
    }
  }
  return sum;
}

class NodeImportanceOf : public ::testing::TestWithParam<Int3>
{
};
}

// Sizes below, at and above those of the tiles that it is computed in, and of a single node.
TEST_P(NodeImportanceOf, IsTheMeanOverTheHatOfEveryNode)
{
  const Fields fields = Blobs(GetParam());

  const std::vector<float> mean = NodeImportanceOfAll(fields.grid, fields.importance.data());

  for (int k = 0; k < fields.grid.nodes.z; ++k)
  {
    for (int j = 0; j < fields.grid.nodes.y; ++j)
    {
      for (int i = 0; i < fields.grid.nodes.x; ++i)
      {
        // Three weighted sums of three values not above one, with rounded weights.
        ASSERT_WITHIN(
          mean[fields.At(i, j, k)], MeanAt(fields, i, j, k), Roundoff<float>(3 * 8, 1.0))
          << "at node " << i << ", " << j << ", " << k;
      }
    }
  }
}

TEST_P(NodeImportanceOf, IsZeroWhereThereIsNothingAndElseTheSame)
{
  const Fields fields = Blobs(GetParam());
  const std::vector<float> mean = NodeImportanceOfAll(fields.grid, fields.importance.data());

  const std::vector<float> ofFilled =
    NodeImportanceOfFilled(fields.grid, fields.extinction.data(), fields.importance.data());
  NodeValues filled(fields.grid.NodeCount());
  std::vector<int> rowsDone(std::size_t(fields.grid.nodes.z), 0);
  FillNodeImportanceOfFilled(fields.grid, fields.extinction.data(), fields.importance.data(),
    filled.Data(),
    [&](int slice, const Range<int>& rows)
    {
      EXPECT_EQ(rows.begin, rowsDone[std::size_t(slice)]);
      rowsDone[std::size_t(slice)] = rows.end;
    });

  for (std::size_t node = 0; node < mean.size(); ++node)
  {
    const bool empty = fields.extinction[node] <= 0 && fields.importance[node] <= 0;
    ASSERT_EQ(ofFilled[node], empty ? 0.0f : mean[node]) << "at node " << node;
    ASSERT_EQ(filled.Data()[node], ofFilled[node]) << "at node " << node;
  }
  EXPECT_EQ(rowsDone, std::vector<int>(rowsDone.size(), fields.grid.nodes.y));
}

TEST_P(NodeImportanceOf, IsSurveyedTogetherWithSpansAndRanges)
{
  const Fields fields = Blobs(GetParam());
  const std::vector<float> mean =
    NodeImportanceOfFilled(fields.grid, fields.extinction.data(), fields.importance.data());
  const Occupancy occupancy(fields.grid, fields.extinction.data(), mean.data(), true);

  const SceneSurvey survey =
    SurveyScene(fields.grid, fields.extinction.data(), 2.0f, fields.importance.data(), 1.0f);

  EXPECT_TRUE(std::equal(mean.begin(), mean.end(), survey.nodeImportance.Data()));
  EXPECT_EQ(survey.occupancy->FilledVoxels(), occupancy.FilledVoxels());
  EXPECT_TRUE(survey.occupancy->Skips());
  for (int z = 0; z < fields.grid.nodes.z; ++z)
  {
    for (int y = 0; y < fields.grid.nodes.y; ++y)
    {
      EXPECT_EQ(survey.occupancy->Row(0, y, z).filled.begin, occupancy.Row(0, y, z).filled.begin);
      EXPECT_EQ(survey.occupancy->Row(0, y, z).filled.end, occupancy.Row(0, y, z).filled.end);
    }
    for (int x = 0; x < fields.grid.nodes.x; ++x)
    {
      const Range<int>& important = survey.occupancy->Row(1, x, z).important;
      EXPECT_EQ(important.begin, occupancy.Row(1, x, z).important.begin);
      EXPECT_EQ(important.end, occupancy.Row(1, x, z).important.end);
    }
  }
  EXPECT_TRUE(survey.extinction.valid && survey.importance.valid);
  EXPECT_EQ(survey.extinction.largest,
    *std::max_element(fields.extinction.begin(), fields.extinction.end()));
  EXPECT_EQ(survey.importance.largest,
    *std::max_element(fields.importance.begin(), fields.importance.end()));
}

TEST(SceneSurvey, FindsAWrongValueWhereverItIs)
{
  const Fields fields = Blobs(Int3(37, 33, 17));
  for (std::size_t node = 0; node < fields.importance.size(); node += 997)
  {
    for (const float wrong : { -1e-30f, 2.5f, std::nanf("") })
    {
      Fields other = fields;
      other.extinction[node] = wrong;
      const SceneSurvey survey =
        SurveyScene(other.grid, other.extinction.data(), 2.0f, other.importance.data(), 1.0f);
      EXPECT_FALSE(survey.extinction.valid) << wrong << " at " << node;
      EXPECT_TRUE(survey.importance.valid) << wrong << " at " << node;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, NodeImportanceOf,
  ::testing::Values(Int3(1, 1, 1), Int3(2, 2, 2), Int3(3, 1, 40), Int3(1, 50, 2), Int3(16, 32, 16),
    Int3(37, 33, 17), Int3(19, 70, 35)));
