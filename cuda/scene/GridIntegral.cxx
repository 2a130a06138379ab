// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/GridIntegral.h"

#include "backend/Backend.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace limpid
{
namespace
{
/// The integral along one axis of the product of the hat functions of two nodes, `offset` apart
/// [spacing].
double Overlap(int node, int offset, int nodes)
{
  const int other = node + offset;
  if (other < 0 || other >= nodes)
  {
    return 0;
  }
  const int cells = int(node > 0) + int(node + 1 < nodes); // that a node's hat covers
  return offset == 0 ? cells / 3.0 : 1.0 / 6;
}

/// The integral over the hats of one row of `a`, along x.
class RowIntegral
{
public:
  RowIntegral(const Grid& grid, const float* a, const float* b)
    : Nodes(grid.nodes)
    , A(a)
    , B(b)
  {
  }

  double Of(int j, int k) const
  {
    const float* row = this->A + this->First(j, k);
    const float* end = row + this->Nodes.x;
    if (std::all_of(row, end, [](float value) { return value == 0.0f; }))
    {
      return 0;
    }
    std::vector<double> across(std::size_t(this->Nodes.x));
    for (int dk = -1; dk <= 1; ++dk)
    {
      for (int dj = -1; dj <= 1; ++dj)
      {
        this->AddRow(j, dj, k, dk, across);
      }
    }
    double sum = 0;
    for (int i = 0; i < this->Nodes.x; ++i)
    {
      double along = 0;
      for (int di = -1; di <= 1; ++di)
      {
        const double weight = Overlap(i, di, this->Nodes.x);
        along += weight > 0 ? weight * across[std::size_t(Index(i) + di)] : 0.0;
      }
      sum += double(row[i]) * along;
    }
    return sum;
  }

private:
  Index First(int j, int k) const { return (Index(k) * this->Nodes.y + j) * this->Nodes.x; }

  void AddRow(int j, int dj, int k, int dk, std::vector<double>& across) const
  {
    const double weight = Overlap(j, dj, this->Nodes.y) * Overlap(k, dk, this->Nodes.z);
    if (weight > 0)
    {
      const float* row = this->B + this->First(j + dj, k + dk);
      for (std::size_t i = 0; i < across.size(); ++i)
      {
        across[i] += weight * double(row[i]);
      }
    }
  }

  Int3 Nodes;
  const float* A;
  const float* B;
};
}

double IntegralOfProduct(const Grid& grid, const float* a, const float* b)
{
  const RowIntegral integral(grid, a, b);
  std::vector<double> rows(std::size_t(grid.nodes.y) * std::size_t(grid.nodes.z));
  ParallelFor(static_cast<Index>(rows.size()), 16,
    [&](Index row)
    {
      rows[std::size_t(row)] =
        integral.Of(static_cast<int>(row % grid.nodes.y), static_cast<int>(row / grid.nodes.y));
    });
  return grid.CellVolume() * std::accumulate(rows.begin(), rows.end(), 0.0);
}
}
