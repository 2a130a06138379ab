// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Bricks.h"

#include "backend/Backend.h"

#include <algorithm>

namespace limpid
{
namespace
{
std::uint8_t Next(int distance)
{
  return static_cast<std::uint8_t>(std::min(distance + 1, farthestBrick));
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
    std::fill(this->Least.begin(), this->Least.end(), std::uint8_t(farthestBrick));
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
        const BrickNodes box = BrickNodes::Of(i, int(row % this->Count.y), int(row / this->Count.y),
          this->Nodes.x, this->Nodes.y, this->Nodes.z);
        ScalarRange range;
        box.ForEach(this->Nodes.x, this->Nodes.y,
          [&range, values = scalars.values](Index node) { range.Include(values[node]); });
        this->Ranges[std::size_t(row * this->Count.x + i)] = range;
      }
    });
}

void Bricks::Classify(const Classification& classification, const OverlayField& overlay)
{
  this->Distance.resize(this->Ranges.size());
  const OpticalTable<FourFloats> table = classification.Table();
  ParallelFor(Index(this->Count.y) * this->Count.z,
    [&](Index row)
    {
      for (int i = 0; i < this->Count.x; ++i)
      {
        const Index brick = row * this->Count.x + i;
        const ScalarRange& range = this->Ranges[std::size_t(brick)];
        float largest =
          table.LargestBetween(table.Position(range.least), table.Position(range.most));
        if (overlay.changed)
        {
          const BrickNodes box = BrickNodes::Of(i, int(row % this->Count.y),
            int(row / this->Count.y), this->Nodes.x, this->Nodes.y, this->Nodes.z)
                                   .On(this->Nodes.x, overlay.nodes.x, 0)
                                   .On(this->Nodes.y, overlay.nodes.y, 1)
                                   .On(this->Nodes.z, overlay.nodes.z, 2);
          LargestChange most;
          box.ForEach(overlay.nodes.x, overlay.nodes.y,
            [&](Index node) { most.Include(overlay.packed.data() + 4 * node); });
          largest = most.Of(largest);
        }
        this->Distance[std::size_t(brick)] = largest > 0 ? 0 : farthestBrick;
      }
    });
  SpreadDistances(this->Count, this->Distance);
}

BrickDistances Bricks::Distances() const
{
  return BrickDistances::Of(this->Nodes, this->Distance.data());
}

double Bricks::EmptyShare() const
{
  const auto empty = std::count_if(
    this->Distance.begin(), this->Distance.end(), [](std::uint8_t value) { return value > 0; });
  return this->Distance.empty() ? 0.0 : double(empty) / double(this->Distance.size());
}
} // namespace limpid
