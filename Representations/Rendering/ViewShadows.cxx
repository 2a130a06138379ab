// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ViewShadows.h"

#include "distributed/FieldResampling.h"

#include <algorithm>
#include <array>
#include <vector>

namespace limpid
{
namespace
{
// Largest share of shadows in the time of a frame during interaction.
constexpr double LargestShare = 0.25;

// Rays of the shadow volume per voxel and axis.
constexpr double StillDensity = 3;
constexpr double MovingDensity = 1;

// Possible coarseness of shadows during interaction, see Renderer::SetShadowCoarseness.
constexpr std::array<int, 7> Coarsenesses{ { 1, 2, 3, 4, 6, 8, 12 } };
}

void ViewShadows::MakeFine(bool still)
{
  this->Pictures.SetShadowRayDensity(still ? StillDensity : MovingDensity);
  this->Pictures.SetShadowCoarseness(1);
  this->Pictures.UpdateShadows();
}

void ViewShadows::MakeInTime(const FrameSettings& frame, const Grid& grid, const Grid& whole)
{
  std::vector<int> factors;
  std::vector<Index> nodes;
  for (const int factor : Coarsenesses)
  {
    const Grid coarse = CoarseGrid(grid, factor);
    const bool suits = IsForAll(*frame.ranks, coarse, whole);
    if (suits || factor == Coarsenesses.back())
    {
      factors.push_back(factor);
      nodes.push_back(coarse.NodeCount());
    }
  }
  const std::size_t current = std::min(this->Level, nodes.size() - 1);
  const std::size_t level =
    this->Time.Choose(nodes, frame.Largest(LargestShare * frame.frameTime), current);
  this->Level = level;
  this->Pictures.SetShadowRayDensity(MovingDensity);
  this->Pictures.SetShadowCoarseness(factors[level]);
  bool made = false;
  const double taken =
    frame.Largest(SecondsPerNodeOf(nodes[level], [&] { made = this->Pictures.UpdateShadows(); }));
  // The first time on a grid includes a preparation that is not repeated, so it is not recorded.
  if (made && this->Nodes == nodes[level])
  {
    this->Time.Learn(taken);
  }
  this->Nodes = nodes[level];
}
}
