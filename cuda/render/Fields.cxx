// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Fields.h"

#include "backend/Backend.h"
#include "math/Require.h"
#include "render/Gradient.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
/// Mean of the finite values among the 26 neighbours of a node; `otherwise` if there is none.
float NeighbourMean(const Int3& nodes, const float* values, const Int3& at, float otherwise)
{
  double sum = 0;
  int count = 0;
  for (int k = std::max(at.z - 1, 0); k <= std::min(at.z + 1, nodes.z - 1); ++k)
  {
    for (int j = std::max(at.y - 1, 0); j <= std::min(at.y + 1, nodes.y - 1); ++j)
    {
      for (int i = std::max(at.x - 1, 0); i <= std::min(at.x + 1, nodes.x - 1); ++i)
      {
        const float value = values[i + nodes.x * (j + Index(nodes.y) * k)];
        if (std::isfinite(value))
        {
          sum += value;
          ++count;
        }
      }
    }
  }
  return count > 0 ? static_cast<float>(sum / count) : otherwise;
}

/// Extinction of a slice of nodes [majorant].
void ClassifySlice(
  const ScalarField& scalars, const OpticalTable<FourFloats>& table, int k, float* slice)
{
  const Index size = Index(scalars.grid.nodes.x) * scalars.grid.nodes.y;
  const float* values = scalars.values + k * size;
  const float* filled = scalars.filled.empty() ? nullptr : scalars.filled.data() + k * size;
  for (Index node = 0; node < size; ++node)
  {
    const float extinction = table.At(table.Position(values[node]))[0];
    slice[node] = filled ? extinction * filled[node] : extinction;
  }
}

/// World gradient at every node of slice `k`; `slices`: the extinctions before, at and behind it.
void DifferentiateSlice(
  const Grid& grid, int k, const float* const slices[3], std::vector<GradientVector>& out)
{
  const Mat3 toWorld = grid.direction;
  const Neighbours along(k, grid.nodes.z);
  const float* before = slices[along.before - k + 1];
  const float* after = slices[along.after - k + 1];
  for (int j = 0; j < grid.nodes.y; ++j)
  {
    const Neighbours rows(j, grid.nodes.y);
    for (int i = 0; i < grid.nodes.x; ++i)
    {
      const Neighbours columns(i, grid.nodes.x);
      const Index row = Index(grid.nodes.x) * j;
      const Vec3 steps(
        (slices[1][row + columns.after] - slices[1][row + columns.before]) * columns.Share(),
        (slices[1][Index(grid.nodes.x) * rows.after + i] -
          slices[1][Index(grid.nodes.x) * rows.before + i]) *
          rows.Share(),
        (after[row + i] - before[row + i]) * along.Share());
      out[std::size_t(row + i)] = GradientOf(steps, toWorld, grid.spacing);
    }
  }
}

/// Calls use(k, gradients) for every slice, in parallel; the gradients are of [majorant/length].
template <class Use>
void ForGradients(const ScalarField& scalars, const OpticalTable<FourFloats>& table, const Use& use)
{
  const Grid& grid = scalars.grid;
  const Index size = Index(grid.nodes.x) * grid.nodes.y;
  constexpr int slicesPerTask = 8; // each task classifies two more slices than it uses
  const Index tasks = (grid.nodes.z + slicesPerTask - 1) / slicesPerTask;
  ParallelFor(tasks,
    [&](Index task)
    {
      std::vector<float> memory(std::size_t(3 * size));
      std::vector<GradientVector> gradients(static_cast<std::size_t>(size));
      const int begin = int(task) * slicesPerTask;
      const int end = std::min(begin + slicesPerTask, grid.nodes.z);
      const auto place = [&](int k) { return memory.data() + (k + 3) % 3 * size; };
      for (int k = std::max(begin - 1, 0); k < std::min(end + 1, grid.nodes.z); ++k)
      {
        ClassifySlice(scalars, table, k, place(k));
        const int ready = k - 1;
        if (ready >= begin)
        {
          const float* slices[3] = { place(ready - 1), place(ready), place(ready + 1) };
          DifferentiateSlice(grid, ready, slices, gradients);
          use(ready, gradients);
        }
      }
      if (end == grid.nodes.z)
      {
        const float* slices[3] = { place(end - 2), place(end - 1), place(end) };
        DifferentiateSlice(grid, end - 1, slices, gradients);
        use(end - 1, gradients);
      }
    });
}
}

ScalarField::ScalarField(const Grid& nodes, const float* scalars)
  : grid(nodes)
  , values(scalars)
{
  const Index count = nodes.NodeCount();
  const double bad = ParallelBlockSum(count,
    [&](Index begin, Index end)
    {
      Index unusable = 0;
      for (Index node = begin; node < end; ++node)
      {
        unusable += std::isfinite(scalars[node]) ? 0 : 1;
      }
      return static_cast<double>(unusable);
    });
  if (!(bad > 0))
  {
    return;
  }
  this->mended.assign(scalars, scalars + count);
  this->filled.assign(std::size_t(count), 1.0f);
  const float* finite =
    std::find_if(scalars, scalars + count, [](float value) { return std::isfinite(value); });
  const float otherwise = finite < scalars + count ? *finite : 0.0f;
  ParallelFor(nodes.nodes.z,
    [&](Index k)
    {
      for (int j = 0; j < nodes.nodes.y; ++j)
      {
        for (int i = 0; i < nodes.nodes.x; ++i)
        {
          const Index node = i + nodes.nodes.x * (j + nodes.nodes.y * k);
          if (!std::isfinite(scalars[node]))
          {
            this->filled[std::size_t(node)] = 0;
            this->mended[std::size_t(node)] =
              NeighbourMean(nodes.nodes, scalars, { i, j, int(k) }, otherwise);
          }
        }
      }
    });
  this->values = this->mended.data();
}

GradientField PackGradient(const ScalarField& scalars, const Classification& classification)
{
  const Index size = Index(scalars.grid.nodes.x) * scalars.grid.nodes.y;
  std::vector<float> largest(std::size_t(scalars.grid.nodes.z), 0.0f);
  ForGradients(scalars, classification.Table(),
    [&](int k, const std::vector<GradientVector>& gradients)
    {
      float most = 0;
      for (const GradientVector& gradient : gradients)
      {
        most = std::max(most, gradient.SquaredLength());
      }
      largest[std::size_t(k)] = most;
    });
  const float unit = GradientUnit(*std::max_element(largest.begin(), largest.end()));

  GradientField field;
  field.packed.resize(std::size_t(4 * scalars.grid.NodeCount()));
  ForGradients(scalars, classification.Table(),
    [&](int k, const std::vector<GradientVector>& gradients)
    {
      std::int16_t* out = field.packed.data() + 4 * size * k;
      for (const GradientVector& gradient : gradients)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          out[axis] = static_cast<std::int16_t>(std::lrint(gradient.values[axis] * unit));
        }
        out[3] = 0;
        out += 4;
      }
    });
  return field;
}
}
