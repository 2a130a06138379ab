// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/ControlGrid.h"

#include "backend/PhysicalMemory.h"
#include "math/Require.h"
#include "scene/Resampling.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

namespace limpid
{
namespace
{
constexpr double megabyte = 1e6;
constexpr double gigabyte = 1e9;

/// Share of the available memory that is used without a chosen limit; the rest is for what else
/// the application does.
constexpr double shareOfAvailable = 0.7;

/// Factors that are tried, finest first.
constexpr std::array<int, 6> factors{ { 1, 2, 3, 4, 6, 8 } };

std::string NameOf(int factor)
{
  switch (factor)
  {
    case 1:
      return "full";
    case 2:
      return "half";
    case 4:
      return "quarter";
    default:
      return "1/" + std::to_string(factor);
  }
}

std::string InGigabytes(double bytes)
{
  std::ostringstream text;
  text << std::setprecision(2) << bytes / gigabyte;
  return text.str();
}

int FactorOf(ControlResolution resolution)
{
  switch (resolution)
  {
    case ControlResolution::Half:
      return 2;
    case ControlResolution::Quarter:
      return 4;
    default:
      return 1;
  }
}
}

std::string ControlGrid::Text() const
{
  std::string text = NameOf(this->factor) + " resolution";
  if (this->forced)
  {
    text += ": " + InGigabytes(this->bytes) + " of " + InGigabytes(this->limit) + " GB";
  }
  return text;
}

ControlGrid ChooseControlGrid(
  const Settings& settings, const Grid& data, const ScenePiece& shared, const NeedPerNode& need)
{
  const bool limited = settings.memoryLimit > 0;
  const double nodes = double(shared.nodes.Count());
  const double limit =
    limited ? settings.memoryLimit * megabyte : shareOfAvailable * AvailableMemory();
  // The process that needs the largest share of its limit decides.
  const double perNode = double(shared.LargestOf(static_cast<float>(nodes / limit)));
  ControlGrid grid;
  grid.limit = limit;
  const auto fits = [&](int factor)
  {
    const double share =
      double(CoarseGrid(data, factor).NodeCount()) / std::max(double(data.NodeCount()), 1.0);
    const double each = need.ofData + need.ofControl * share;
    const double measured = each + (factor > 1 ? need.measuring : 0);
    grid.factor = factor;
    grid.measuresData = measured * perNode <= 1;
    grid.bytes = nodes * (grid.measuresData ? measured : each);
    return each * perNode <= 1;
  };
  if (settings.controlResolution != ControlResolution::FinestThatFits)
  {
    const bool isWithin = fits(FactorOf(settings.controlResolution));
    LIMPID_REQUIRE(isWithin || !limited,
      "At " << grid.Text() << ", " << data.NodeCount() << " points need " << InGigabytes(grid.bytes)
            << " GB, and the memory limit is " << InGigabytes(limit)
            << " GB (the optimisation would take more than it may). Set ControlResolution to Auto, "
               "which takes the finest that fits, or raise MemoryLimit.");
    return grid;
  }
  for (const int factor : factors)
  {
    grid.forced = factor > 1;
    if (fits(factor))
    {
      break;
    }
  }
  return grid;
}
}
