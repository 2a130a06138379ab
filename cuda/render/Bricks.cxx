// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Bricks.h"

#include "backend/Backend.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
constexpr int farthest = 255; // what fits in a byte

/// Calls use(i, j, k) for the box of nodes from `first` to `last`.
template <class Use>
void ForNodes(const Int3& nodes, const Int3& first, const Int3& last, const Use& use)
{
  for (int k = first.z; k <= last.z; ++k)
  {
    for (int j = first.y; j <= last.y; ++j)
    {
      const Index row = nodes.x * (j + Index(nodes.y) * k);
      for (int i = first.x; i <= last.x; ++i)
      {
        use(row + i);
      }
    }
  }
}

/// Nodes of a coarse grid over the same box whose interpolation a range of
/// cells reads.
void CoarseRange(int nodes, int coarseNodes, int& first, int& last)
{
  const double scale = double(coarseNodes - 1) / std::max(nodes - 1, 1);
  first = std::clamp(int(std::floor(first * scale - 1e-6)), 0, coarseNodes - 1);
  last = std::clamp(int(std::ceil(last * scale + 1e-6)), 0, coarseNodes - 1);
}

std::uint8_t Next(int distance)
{
  return static_cast<std::uint8_t>(std::min(distance + 1, farthest));
}

/// Chebyshev distances to the nearest zero among what a pass has met: the last slice, the last row,
/// the last brick.
class DistancePass
{
public:
  DistancePass(const Int3& count, std::vector<std::uint8_t>& distance)
    : Count(count)
    , Distance(distance)
    , Least(std::size_t(count.x) + 2)
  {
  }

  void Forth()
  {
    for (int k = 0; k < this->Count.z; ++k)
    {
      for (int j = 0; j < this->Count.y; ++j)
      {
        std::uint8_t* row = this->TakeRows(j, k, -1);
        for (int i = 1; i < this->Count.x; ++i)
        {
          row[i] = std::min(row[i], Next(row[i - 1]));
        }
      }
    }
  }

  void Back()
  {
    for (int k = this->Count.z - 1; k >= 0; --k)
    {
      for (int j = this->Count.y - 1; j >= 0; --j)
      {
        std::uint8_t* row = this->TakeRows(j, k, 1);
        for (int i = this->Count.x - 2; i >= 0; --i)
        {
          row[i] = std::min(row[i], Next(row[i + 1]));
        }
      }
    }
  }

private:
  std::uint8_t* Row(int j, int k)
  {
    return this->Distance.data() + this->Count.x * (j + Index(this->Count.y) * k);
  }

  /// One more than the least of the neighbours in the rows on the `side` from which the pass comes.
  std::uint8_t* TakeRows(int j, int k, int side)
  {
    std::uint8_t* least = this->Least.data() + 1; // with a brick beyond each end
    std::fill(this->Least.begin(), this->Least.end(), std::uint8_t(farthest));
    this->TakeRow(j + side, k, least);
    for (int other = j - 1; other <= j + 1; ++other)
    {
      this->TakeRow(other, k + side, least);
    }
    std::uint8_t* row = this->Row(j, k);
    for (int i = 0; i < this->Count.x; ++i)
    {
      row[i] = std::min(row[i], Next(std::min({ least[i - 1], least[i], least[i + 1] })));
    }
    return row;
  }

  void TakeRow(int j, int k, std::uint8_t* least)
  {
    if (j < 0 || j >= this->Count.y || k < 0 || k >= this->Count.z)
    {
      return;
    }
    const std::uint8_t* row = this->Row(j, k);
    for (int i = 0; i < this->Count.x; ++i)
    {
      least[i] = std::min(least[i], row[i]);
    }
  }

  Int3 Count;
  std::vector<std::uint8_t>& Distance;
  std::vector<std::uint8_t> Least;
};

/// Chebyshev distances to the nearest zero, by one pass forth and one back.
void SpreadDistances(const Int3& count, std::vector<std::uint8_t>& distance)
{
  DistancePass pass(count, distance);
  pass.Forth();
  pass.Back();
}
} // namespace

Bricks::Bricks(const ScalarField& scalars)
  : Nodes(scalars.grid.nodes)
  , Count((scalars.grid.nodes + (size - 2)) / size)
  , Ranges(std::size_t(Index(Count.x) * Count.y * Count.z))
{
  ParallelFor(Index(this->Count.y) * this->Count.z,
    [&](Index row)
    {
      for (int i = 0; i < this->Count.x; ++i)
      {
        const Int3 first = size * Int3(i, int(row % this->Count.y), int(row / this->Count.y));
        const Int3 last = glm::min(first + size, this->Nodes - 1);
        Range range{ 3.4e38f, -3.4e38f };
        ForNodes(this->Nodes, first, last,
          [&](Index node)
          {
            range.least = std::min(range.least, scalars.values[node]);
            range.most = std::max(range.most, scalars.values[node]);
          });
        this->Ranges[std::size_t(row * this->Count.x + i)] = range;
      }
    });
}

void Bricks::Classify(const Classification& classification, const MediumField& medium)
{
  this->Distance.resize(this->Ranges.size());
  ParallelFor(Index(this->Count.y) * this->Count.z,
    [&](Index row)
    {
      for (int i = 0; i < this->Count.x; ++i)
      {
        const Index brick = row * this->Count.x + i;
        const Range& range = this->Ranges[std::size_t(brick)];
        float largest = classification.LargestBetween(
          classification.Position(range.least), classification.Position(range.most));
        if (medium.changed)
        {
          Int3 first = size * Int3(i, int(row % this->Count.y), int(row / this->Count.y));
          Int3 last = glm::min(first + size, this->Nodes - 1);
          for (int axis = 0; axis < 3; ++axis)
          {
            CoarseRange(this->Nodes[axis], medium.nodes[axis], first[axis], last[axis]);
          }
          int kept = 0;
          int added = 0;
          ForNodes(medium.nodes, first, last,
            [&](Index node)
            {
              kept = std::max<int>(kept, medium.packed[std::size_t(4 * node)]);
              added = std::max<int>(added, medium.packed[std::size_t(4 * node + 1)]);
            });
          largest = largest * static_cast<float>(kept) + static_cast<float>(added);
        }
        this->Distance[std::size_t(brick)] = largest > 0 ? 0 : farthest;
      }
    });
  SpreadDistances(this->Count, this->Distance);
}

double Bricks::EmptyShare() const
{
  const auto empty = std::count_if(
    this->Distance.begin(), this->Distance.end(), [](std::uint8_t value) { return value > 0; });
  return this->Distance.empty() ? 0.0 : double(empty) / double(this->Distance.size());
}
} // namespace limpid
