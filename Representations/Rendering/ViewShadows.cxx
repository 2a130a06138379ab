// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ViewShadows.h"

#include "optimize/Levels.h"

#include <array>
#include <vector>

namespace limpid
{
namespace
{
// Share of a moving frame's time that shadows get at most.
constexpr double LargestShare = 0.25;

// Rays of the shadow volume per voxel and axis.
constexpr double StillDensity = 3;
constexpr double MovingDensity = 1;

// How coarse the shadows of moving frames may be, see Renderer::SetShadowCoarseness.
constexpr std::array<int, 7> Coarsenesses{ { 1, 2, 3, 4, 6, 8, 12 } };
}

void ViewShadows::Make(const FrameSettings& frame, const Grid& grid, bool fine)
{
  if (fine)
  {
    this->Pictures.SetShadowRayDensity(StillDensity);
    this->Pictures.SetShadowCoarseness(1);
    this->Pictures.UpdateShadows();
    return;
  }
  std::vector<Index> nodes;
  nodes.reserve(Coarsenesses.size());
  for (const int factor : Coarsenesses)
  {
    nodes.push_back(CoarseGrid(grid, factor).NodeCount());
  }
  const std::size_t level = this->Time.Choose(nodes, LargestShare * frame.frameTime, this->Level);
  this->Level = level;
  this->Pictures.SetShadowRayDensity(MovingDensity);
  this->Pictures.SetShadowCoarseness(Coarsenesses[level]);
  const auto start = FrameClock::SteadyClock::now();
  const bool made = this->Pictures.UpdateShadows();
  // The first time on a grid, something has to be prepared that will not be again.
  if (made && this->Nodes == nodes[level])
  {
    this->Time.Learn(nodes[level], FrameClock::SecondsSince(start));
  }
  this->Nodes = nodes[level];
}
}
