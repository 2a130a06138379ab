// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/NodeTransmittance.h"

#include "math/Require.h"

#include <algorithm>
#include <iterator>

namespace limpid
{
NodeRays::NodeRays(const Grid& grid, const RaySource& source)
  : Parallel(source.parallel)
  , Origin(source.parallel ? source.direction : source.origin)
  , Spacing(grid.spacing)
  , LastCell(grid.nodes - 2)
  , PlaneCount(static_cast<int>(source.viewPlanes.size()))
{
  LIMPID_REQUIRE(source.viewPlanes.size() <= std::size(this->Planes),
    "The picture has " << source.viewPlanes.size() << " sides (it can be bounded by "
                       << std::size(this->Planes) << " planes). Give it four corners.");
  std::copy(source.viewPlanes.begin(), source.viewPlanes.end(), this->Planes);
}
}
