// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Occupancy.h"

#include "backend/Backend.h"

#include <algorithm>

namespace limpid
{
Occupancy::Occupancy(
  const Grid& grid, const float* baseExtinction, const float* importance, bool skip)
  : Nodes(grid.nodes)
  , Skip(skip)
{
  const int nx = grid.nodes.x;
  const int ny = grid.nodes.y;
  const int nz = grid.nodes.z;
  this->AlongX.resize(std::size_t(ny) * nz);
  this->AlongY.resize(std::size_t(nx) * nz);
  std::vector<Index> filled(std::size_t(nz), 0);
  ParallelFor(nz,
    [&](Index z)
    {
      Spans* columns = this->AlongY.data() + z * nx;
      for (int y = 0; y < ny; ++y)
      {
        Spans& row = this->AlongX[std::size_t(z) * ny + y];
        const Index first = (z * ny + y) * nx;
        for (int x = 0; x < nx; ++x)
        {
          const bool important = importance[first + x] > 0;
          if (important || baseExtinction[first + x] > 0)
          {
            row.filled = Hull(row.filled, { x, x + 1 });
            columns[x].filled = Hull(columns[x].filled, { y, y + 1 });
            ++filled[std::size_t(z)];
          }
          if (important)
          {
            row.important = Hull(row.important, { x, x + 1 });
            columns[x].important = Hull(columns[x].important, { y, y + 1 });
          }
        }
      }
    });
  if (!skip)
  {
    std::fill(this->AlongX.begin(), this->AlongX.end(), Spans{ { 0, nx }, { 0, nx } });
    std::fill(this->AlongY.begin(), this->AlongY.end(), Spans{ { 0, ny }, { 0, ny } });
  }
  for (const Index count : filled)
  {
    this->Filled += count;
  }
}
}
