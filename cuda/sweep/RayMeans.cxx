// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/RayMeans.h"

#include "sweep/HatMean.h"
#include "sweep/Registers.h"
#include "sweep/Sweep.h"

#include <algorithm>
#include <array>

namespace limpid
{
namespace
{
/// A row of voxels between two rows of rays.
struct BetweenRows
{
  Index first;      ///< ray of the row in front
  float weights[2]; ///< of the row in front and of the next one
};

/// `share`: by which the weights are multiplied.
BetweenRows RowsOf(const FaceFrustum& frustum, const Slice& slice, int v, float share)
{
  const float weight = slice.voxelRows.weight[std::size_t(v)];
  return { Index(slice.voxelRows.index[std::size_t(v)]) * frustum.columns,
    { share * (1.0f - weight), share * weight } };
}

/// The images that voxels see, in rows of `stride` rays.
struct SeenImages
{
  const float* transmittance;
  const float* behind;
  Index stride;
};

/// One row of voxels as a column of rays sees it.
struct SeenRows
{
  const float* transmittance[2];
  const float* behind[2];
  float weights[2];

  LIMPID_INLINE SeenRows(const SeenImages& images, const BetweenRows& row)
    : transmittance{ images.transmittance + row.first,
      images.transmittance + row.first + images.stride }
    , behind{ images.behind + row.first, images.behind + row.first + images.stride }
    , weights{ row.weights[0], row.weights[1] }
  {
  }

  LIMPID_INLINE void Add(int i, float& passed, float& seen) const
  {
    const float first = this->weights[0] * this->transmittance[0][i];
    const float second = this->weights[1] * this->transmittance[1][i];
    passed += first + second;
    seen += first * this->behind[0][i] + second * this->behind[1][i];
  }
};

/// Of a row of voxels between rows of rays.
LIMPID_MULTIVERSION
void SeeRow(
  const SeenImages& images, const BetweenRows& row, const Range<int>& columns, const SeenRow& out)
{
  const SeenRows own(images, row);
  float* __restrict transmittance = out.transmittance;
  float* __restrict behind = out.behind;
#pragma GCC ivdep
  for (int i = columns.begin; i < columns.end; ++i)
  {
    float passed = 0;
    float seen = 0;
    own.Add(i, passed, seen);
    transmittance[i] = passed;
    behind[i] = seen;
  }
}

/// Of three rows of voxels.
LIMPID_MULTIVERSION
void SeeRows(const SeenImages& images, const std::array<BetweenRows, 3>& rows,
  const Range<int>& columns, const SeenRow& out)
{
  const SeenRows before(images, rows[0]);
  const SeenRows own(images, rows[1]);
  const SeenRows after(images, rows[2]);
  float* __restrict transmittance = out.transmittance;
  float* __restrict behind = out.behind;
#pragma GCC ivdep
  for (int i = columns.begin; i < columns.end; ++i)
  {
    float passed = 0;
    float seen = 0;
    before.Add(i, passed, seen);
    own.Add(i, passed, seen);
    after.Add(i, passed, seen);
    transmittance[i] = passed;
    behind[i] = seen;
  }
}

LIMPID_MULTIVERSION
void AverageAlongRow(const float* __restrict values, const float* __restrict sides,
  const Range<int>& columns, float* __restrict out)
{
  for (int u = columns.begin; u < columns.end; ++u)
  {
    out[u] = HatMean(values[u - 1], values[u], values[u + 1], sides[u]);
  }
}

/// Takes another transmittance for the mean, and so much more or less of what is behind.
LIMPID_MULTIVERSION
void ExchangeTransmittance(
  const float* __restrict other, const Range<int>& columns, const SeenRow& seen)
{
  float* __restrict transmittance = seen.transmittance;
  float* __restrict behind = seen.behind;
  for (int u = columns.begin; u < columns.end; ++u)
  {
    behind[u] = Exchanged(behind[u], transmittance[u], other[u]);
    transmittance[u] = other[u];
  }
}

/// What rays in `read` show to a row of voxels and, through it, to those beside it.
void SeeAcrossRows(const FaceFrustum& frustum, const Slice& slice, int v, const SeenImages& images,
  const Range<int>& read, const SeenRow& out)
{
  const float side = slice.rowSides[std::size_t(v)];
  if (side == 0)
  {
    SeeRow(images, RowsOf(frustum, slice, v, 1.0f), read, out);
    return;
  }
  SeeRows(images,
    { { RowsOf(frustum, slice, std::max(v - 1, 0), side),
      RowsOf(frustum, slice, v, 1.0f - 2.0f * side),
      RowsOf(frustum, slice, std::min(v + 1, frustum.nodesV - 1), side) } },
    read, out);
}

/// Interpolates a row of rays to voxels, and averages these. `voxels`: memory for them all, with
/// one more on either side.
void AverageVoxels(const FaceFrustum& frustum, const Slice& slice, const Range<int>& columns,
  const float* rays, float* voxels, float* out)
{
  const Range<int> wide{ std::max(columns.begin - 1, 0),
    std::min(columns.end + 1, frustum.nodesU) };
  InterpolateRow(rays, slice.voxelColumns, wide, voxels);
  voxels[-1] = voxels[0];
  voxels[frustum.nodesU] = voxels[frustum.nodesU - 1];
  AverageAlongRow(voxels, slice.columnSides.data(), columns, out);
}

/// The rays that columns of voxels and those beside them are interpolated from.
Range<int> RaysRead(const FaceFrustum& frustum, const Slice& slice, const Range<int>& columns)
{
  const std::vector<int>& index = slice.voxelColumns.index;
  const int first = std::max(columns.begin - 1, 0);
  const int last = std::min(columns.end, frustum.nodesU - 1);
  return WholeRegisters(
    { index[std::size_t(first)], index[std::size_t(last)] + 2 }, { 0, frustum.columns });
}
}

std::vector<float> SideWeights(const Lateral& lateral, const LinearMap& voxels, double depth)
{
  const double nodesApart = lateral.parallel ? 1.0 : depth;
  std::vector<float> sides(voxels.index.size());
  for (std::size_t k = 0; k < sides.size(); ++k)
  {
    const int ray = voxels.index[k];
    const double gap = nodesApart * (lateral.Coordinate(ray + 1) - lateral.Coordinate(ray));
    sides[k] = SideWeight(voxels.weight[k], static_cast<float>(gap));
  }
  sides.front() = sides.back() = sides.size() > 1 ? sideWeightOnBorder : 0.0f;
  return sides;
}

std::size_t MeanScratch(const FaceFrustum& frustum)
{
  return 2 * ScratchSize(frustum) + std::size_t(frustum.nodesU) + 2;
}

void AverageSeen(const FaceFrustum& frustum, const Slice& slice, int v, const Range<int>& columns,
  const RayImages& images, const std::vector<float>& behind, float* scratch, const SeenRow& out)
{
  if (columns.Empty())
  {
    return;
  }
  const SeenRow rays{ scratch, scratch + ScratchSize(frustum) };
  float* voxels = scratch + 2 * ScratchSize(frustum) + 1;
  SeeAcrossRows(frustum, slice, v, { images.transmittance.data(), behind.data(), frustum.columns },
    RaysRead(frustum, slice, columns), rays);
  AverageVoxels(frustum, slice, columns, rays.transmittance, voxels, out.transmittance);
  AverageVoxels(frustum, slice, columns, rays.behind, voxels, out.behind);
  const Range<int> front = ColumnsBetweenFrontRays(frustum, slice, v, columns);
  for (const Range<int>& side :
    { Range<int>{ columns.begin, front.begin }, Range<int>{ front.end, columns.end } })
  {
    TransmitFromSide(frustum, slice, v, side, images, scratch, voxels);
    ExchangeTransmittance(voxels, side, out);
  }
}
}
