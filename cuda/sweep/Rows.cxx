// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Rows.h"

#include "backend/Gather.h"
#include "sweep/Cubic.h"
#include "sweep/RayLayer.h"

namespace limpid
{
namespace
{
LIMPID_INLINE HalfLayer<float> Whole(const RayRow& rays, int half, int i)
{
  return WholeHalf<float>(rays.layer, RangeOfHalf(half), rays.length[i], rays.extinction[half][i],
    rays.importance[half][i]);
}

template <Cut cut>
LIMPID_INLINE HalfLayer<float> Clipped(const RayRow& rays, int half, int i)
{
  return CutHalf<cut>(rays.layer, half, rays.length[i], rays.extinction[half][i],
    rays.importance[half][i], { rays.columnEntry[i], rays.columnExit[i] }, rays.row);
}

/// The columns of a row in three parts: clipped, whole, clipped.
struct Parts
{
  Range<int> before;
  Range<int> whole;
  Range<int> after;
};

LIMPID_INLINE Parts PartsOf(const RayRow& rays)
{
  const float back = rays.layer.front + rays.layer.thickness;
  const bool rowInside = rays.row.begin <= rays.layer.front && rays.row.end >= back;
  const Range<int> whole = Intersection(rays.work, rays.inside);
  if (!rowInside || whole.Empty())
  {
    return { rays.work, {}, {} };
  }
  return { { rays.work.begin, whole.begin }, whole, { whole.end, rays.work.end } };
}

/// Visits the columns of a row with `whole` where the layer is inside the box from front to back,
/// with `clipped` elsewhere.
template <class WholeColumn, class ClippedColumn>
LIMPID_INLINE void Visit(const RayRow& rays, const WholeColumn& whole, const ClippedColumn& clipped)
{
  const Parts parts = PartsOf(rays);
  for (const Range<int>& part : { parts.before, parts.after })
  {
    for (int i = part.begin; i < part.end; ++i)
    {
      clipped(i);
    }
  }
#pragma GCC ivdep
  for (int i = parts.whole.begin; i < parts.whole.end; ++i)
  {
    whole(i);
  }
}

struct ForwardColumn
{
  RayRow rays;
  double* opticalDepth;
  float* visible;
  float* unattenuated;

  LIMPID_INLINE void Gain(int i, const HalfLayer<float>& front, const HalfLayer<float>& rear) const
  {
    const float transmittance = Attenuate(static_cast<float>(this->opticalDepth[i]));
    this->visible[i] += transmittance * (front.visible + front.Passed() * rear.visible);
    this->unattenuated[i] += front.unattenuated + rear.unattenuated;
  }

  LIMPID_INLINE void Deepen(
    int i, const HalfLayer<float>& front, const HalfLayer<float>& rear) const
  {
    this->opticalDepth[i] += DepthOf(front, rear);
  }
};

struct ForwardWhole : ForwardColumn
{
  LIMPID_INLINE void operator()(int i) const
  {
    const HalfLayer<float> front = Whole(this->rays, 0, i);
    const HalfLayer<float> rear = Whole(this->rays, 1, i);
    this->Gain(i, front, rear);
    this->Deepen(i, front, rear);
  }
};

struct ForwardClipped : ForwardColumn
{
  LIMPID_INLINE void operator()(int i) const
  {
    this->Gain(i, Clipped<Cut::Both>(this->rays, 0, i), Clipped<Cut::Both>(this->rays, 1, i));
    this->Deepen(i, Clipped<Cut::Entry>(this->rays, 0, i), Clipped<Cut::Entry>(this->rays, 1, i));
  }
};

struct DeepenWhole
{
  RayRow rays;
  double* opticalDepth;

  LIMPID_INLINE void operator()(int i) const
  {
    this->opticalDepth[i] += DepthOf(Whole(this->rays, 0, i), Whole(this->rays, 1, i));
  }
};

struct DeepenClipped
{
  RayRow rays;
  double* opticalDepth;

  LIMPID_INLINE void operator()(int i) const
  {
    this->opticalDepth[i] +=
      DepthOf(Clipped<Cut::Entry>(this->rays, 0, i), Clipped<Cut::Entry>(this->rays, 1, i));
  }
};

struct Unwind
{
  RayRow rays;
  double* opticalDepth;

  LIMPID_INLINE void operator()(int i) const
  {
    this->opticalDepth[i] -= DepthOf(Whole(this->rays, 0, i), Whole(this->rays, 1, i));
  }
};

/// Whether a backward sweep takes the layer off the optical depths or adds it.
enum class Depth
{
  Unwound,
  Collected
};

template <Depth depth>
struct BackwardWhole
{
  RayRow rays;
  RaysBehind state;

  LIMPID_INLINE void operator()(int i) const
  {
    const HalfLayer<float> front = Whole(this->rays, 0, i);
    const HalfLayer<float> rear = Whole(this->rays, 1, i);
    this->state.behind[i] = Carried(front, rear, this->state.behind[i]);
    this->state.unattenuated[i] += front.unattenuated + rear.unattenuated;
    const float layer = DepthOf(front, rear);
    this->state.opticalDepth[i] += depth == Depth::Collected ? layer : -layer;
  }
};

template <Depth depth>
struct BackwardClipped
{
  RayRow rays;
  RaysBehind state;

  LIMPID_INLINE void operator()(int i) const
  {
    const float behind = this->state.behind[i];
    const HalfLayer<float> front = Clipped<Cut::Both>(this->rays, 0, i);
    const HalfLayer<float> rear = Clipped<Cut::Both>(this->rays, 1, i);
    this->state.unattenuated[i] += front.unattenuated + rear.unattenuated;
    const float columnEntry = this->rays.columnEntry[i];
    const float entry = this->rays.row.begin > columnEntry ? this->rays.row.begin : columnEntry;
    this->state.visible[i] =
      FromEntry(this->state.visible[i], entry, this->rays.layer, Carried(front, rear, behind));
    this->state.behind[i] =
      Carried(Clipped<Cut::Exit>(this->rays, 0, i), Clipped<Cut::Exit>(this->rays, 1, i), behind);
    this->state.opticalDepth[i] += depth == Depth::Collected
      ? DepthOf(Clipped<Cut::Entry>(this->rays, 0, i), Clipped<Cut::Entry>(this->rays, 1, i))
      : -DepthOf(Whole(this->rays, 0, i), Whole(this->rays, 1, i));
  }
};

struct RearHalfWhole
{
  RayRow rays;
  const float* behind;
  float* ahead;

  LIMPID_INLINE void operator()(int i) const
  {
    this->ahead[i] = Carried(Whole(this->rays, 1, i), this->behind[i]);
  }
};

struct RearHalfClipped
{
  RayRow rays;
  const float* behind;
  float* ahead;

  LIMPID_INLINE void operator()(int i) const
  {
    this->ahead[i] = Carried(Clipped<Cut::Exit>(this->rays, 1, i), this->behind[i]);
  }
};
}

LIMPID_MULTIVERSION
void BlendRows(const float* __restrict first, const float* __restrict second, float weight,
  int begin, int end, float* __restrict out)
{
  for (int u = begin; u < end; ++u)
  {
    out[u] = first[u] + weight * (second[u] - first[u]);
  }
}

LIMPID_MULTIVERSION
void BlendFourRows(const float* const rows[2][2], float across, float along, int begin, int end,
  float* __restrict out)
{
  const float* __restrict front0 = rows[0][0];
  const float* __restrict front1 = rows[0][1];
  const float* __restrict back0 = rows[1][0];
  const float* __restrict back1 = rows[1][1];
  for (int u = begin; u < end; ++u)
  {
    const float first = front0[u] + along * (back0[u] - front0[u]);
    const float second = front1[u] + along * (back1[u] - front1[u]);
    out[u] = first + across * (second - first);
  }
}

LIMPID_MULTIVERSION
void BlendFourRowsTwice(const float* const rows[2][2], const float across[2], const float along[2],
  int begin, int end, float* __restrict first, float* __restrict second)
{
  const float* __restrict front0 = rows[0][0];
  const float* __restrict front1 = rows[0][1];
  const float* __restrict back0 = rows[1][0];
  const float* __restrict back1 = rows[1][1];
  const float across0 = across[0];
  const float across1 = across[1];
  const float along0 = along[0];
  const float along1 = along[1];
  for (int u = begin; u < end; ++u)
  {
    const float step0 = back0[u] - front0[u];
    const float step1 = back1[u] - front1[u];
    const float low0 = front0[u] + along0 * step0;
    const float low1 = front0[u] + along1 * step0;
    first[u] = low0 + across0 * ((front1[u] + along0 * step1) - low0);
    second[u] = low1 + across1 * ((front1[u] + along1 * step1) - low1);
  }
}

LIMPID_MULTIVERSION
void BlendCubic(const float* const rows[4], float across, int begin, int end, float* __restrict out)
{
  const float* __restrict before = rows[0];
  const float* __restrict first = rows[1];
  const float* __restrict second = rows[2];
  const float* __restrict after = rows[3];
  for (int i = begin; i < end; ++i)
  {
    out[i] = CubicBetween(before[i], first[i], second[i], after[i], across);
  }
}

LIMPID_MULTIVERSION
void Curve(const float* __restrict row, int begin, int end, float* __restrict out)
{
  for (int i = begin; i < end; ++i)
  {
    out[i] = Curvature(row[i - 1], row[i], row[i + 1]);
  }
}

LIMPID_MULTIVERSION
void BendRow(const LinearMap& map, const float* __restrict curvature, const Range<int>& columns,
  float* __restrict values)
{
  const float* __restrict fractions = map.weight.data();
  for (int i = columns.begin; i < columns.end; ++i)
  {
    values[i] = Bent(values[i], curvature[i], fractions[i]);
  }
}

LIMPID_MULTIVERSION
void ClampRow(const Range<int>& columns, float* __restrict values)
{
  for (int i = columns.begin; i < columns.end; ++i)
  {
    const float atLeast = values[i] > 0.0f ? values[i] : 0.0f;
    values[i] = atLeast < 1.0f ? atLeast : 1.0f;
  }
}

void InterpolateRow(
  const float* source, const LinearMap& map, const Range<int>& columns, float* out)
{
  if (!columns.Empty())
  {
    InterpolateGathered(source, map.index.data() + columns.begin, map.weight.data() + columns.begin,
      columns.end - columns.begin, out + columns.begin);
  }
}

LIMPID_MULTIVERSION
void ForwardRow(const RayRow& rays, double* opticalDepth, float* visible, float* unattenuated)
{
  const ForwardColumn column{ rays, opticalDepth, visible, unattenuated };
  Visit(rays, ForwardWhole{ column }, ForwardClipped{ column });
}

LIMPID_MULTIVERSION
void DeepenRow(const RayRow& rays, double* opticalDepth)
{
  Visit(rays, DeepenWhole{ rays, opticalDepth }, DeepenClipped{ rays, opticalDepth });
}

LIMPID_MULTIVERSION
void UnwindRow(const RayRow& rays, double* opticalDepth)
{
  const Unwind column{ rays, opticalDepth };
#pragma GCC ivdep
  for (int i = rays.work.begin; i < rays.work.end; ++i)
  {
    column(i);
  }
}

LIMPID_MULTIVERSION
void BackwardRow(const RayRow& rays, const RaysBehind& state)
{
  constexpr Depth depth = Depth::Unwound;
  Visit(rays, BackwardWhole<depth>{ rays, state }, BackwardClipped<depth>{ rays, state });
}

LIMPID_MULTIVERSION
void CollectRow(const RayRow& rays, const RaysBehind& state)
{
  constexpr Depth depth = Depth::Collected;
  Visit(rays, BackwardWhole<depth>{ rays, state }, BackwardClipped<depth>{ rays, state });
}

LIMPID_MULTIVERSION
void RearHalfRow(const RayRow& rays, const float* behind, float* ahead)
{
  Visit(rays, RearHalfWhole{ rays, behind, ahead }, RearHalfClipped{ rays, behind, ahead });
}

LIMPID_MULTIVERSION
void TransmitRow(
  const double* __restrict opticalDepth, const Range<int>& columns, float* __restrict transmittance)
{
  for (int i = columns.begin; i < columns.end; ++i)
  {
    transmittance[i] = Transmitted(static_cast<float>(opticalDepth[i]));
  }
}

LIMPID_MULTIVERSION
void DensifyRow(const DensityRow& row, const Range<int>& columns, float* __restrict density)
{
  const DensityRow rays = row;
  for (int i = columns.begin; i < columns.end; ++i)
  {
    const float entry = rays.entry > rays.columnEntry[i] ? rays.entry : rays.columnEntry[i];
    const float here = rays.extinction ? rays.extinction[i] * rays.length[i] : 0.0f;
    density[i] = Densified(
      static_cast<float>(rays.opticalDepth[i]), rays.depth - entry, here, rays.unwound, rays.limit);
  }
}

LIMPID_MULTIVERSION
void TransmitVoxelRow(float depth, float rowEntry, const float* __restrict columnEntry,
  const Range<int>& columns, float* __restrict densityToTransmittance)
{
  for (int u = columns.begin; u < columns.end; ++u)
  {
    const float entry = rowEntry > columnEntry[u] ? rowEntry : columnEntry[u];
    densityToTransmittance[u] = Transmitted(densityToTransmittance[u] * (depth - entry));
  }
}

LIMPID_MULTIVERSION
void MultiplyRow(
  float* __restrict values, const float* __restrict factors, const Range<int>& columns)
{
  for (int i = columns.begin; i < columns.end; ++i)
  {
    values[i] *= factors[i];
  }
}
}
