// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/TurnRow.h"

#include "backend/Simd.h"

namespace limpid
{
namespace
{
/// A half of a layer between the clips of its ray; the ends are relative depths.
struct ClippedPart
{
  HalfLayer<float> visible; ///< between entry and exit
  float begin;
  float end;
};

LIMPID_INLINE ClippedPart Part(const RayRow& rays, int half, int i)
{
  const Clip column{ rays.columnEntry[i], rays.columnExit[i] };
  const float entry = column.entry > rays.row.entry ? column.entry : rays.row.entry;
  const float exit = column.exit < rays.row.exit ? column.exit : rays.row.exit;
  const float first = rays.layer.front + halfRanges[half].begin * rays.layer.thickness;
  const float last = rays.layer.front + halfRanges[half].end * rays.layer.thickness;
  const float begin = entry > first ? (entry < last ? entry : last) : first;
  const float limit = exit < last ? exit : last;
  return { ClippedHalf<float>(rays.layer, halfRanges[half], rays.length[i],
             rays.extinction[half][i], rays.importance[half][i], column, rays.row),
    begin, limit > begin ? limit : begin };
}

/// Where a ray comes into the box.
struct Entry
{
  float depth;      ///< relative
  float extinction; ///< there [1/length]
  bool here;        ///< in this layer
};

LIMPID_INLINE Entry EntryOf(const RayRow& rays, float front, int i)
{
  const float side = rays.columnEntry[i] > rays.row.entry ? rays.columnEntry[i] : rays.row.entry;
  const float depth = side > front ? side : front;
  const float back = rays.layer.front + rays.layer.thickness;
  const float way = (depth - rays.layer.front) / rays.layer.thickness;
  const float line = rays.extinction[0][i] +
    (way - float(gaussPoints[0])) * float(1 / (gaussPoints[1] - gaussPoints[0])) *
      (rays.extinction[1][i] - rays.extinction[0][i]);
  return { depth, line > 0.0f ? line : 0.0f, depth >= rays.layer.front && depth < back };
}

struct TurnColumn
{
  RayRow rays;
  EyeDistance eye;
  EyeMove moves[2];
  double* opticalDepth;
  float* visible;
  float* plain;

  LIMPID_INLINE void operator()(int i) const
  {
    const ClippedPart parts[2] = { Part(this->rays, 0, i), Part(this->rays, 1, i) };
    const float length = this->rays.length[i];
    const float tau = static_cast<float>(this->opticalDepth[i]);
    const float front = Attenuate(tau);
    const float transmittance[2] = { front, front * parts[0].visible.Passed() };
    const float gained[2] = { transmittance[0] * parts[0].visible.visible,
      transmittance[1] * parts[1].visible.visible };
    this->visible[i] += gained[0] + gained[1];
    this->plain[i] += parts[0].visible.plain + parts[1].visible.plain;

    const Entry entry = EntryOf(this->rays, this->eye.front, i);
    const bool side = this->rays.columnEntry[i] > this->rays.row.entry;
    for (int m = 0; m < 2; ++m)
    {
      const EyeMove& move = this->moves[m];
      const float through = entry.depth > this->eye.front
        ? (side ? move.side[i] : move.row * length)
        : move.front * length;
      const float step = entry.here ? entry.extinction * through : 0.0f;
      float push = move.push[i] + step;
      float moment = move.moment[i] + step * entry.depth;
      float before = tau;
      float gain = 0;
      for (int half = 0; half < 2; ++half)
      {
        const float begin = parts[half].begin;
        const float depth = parts[half].end - begin;
        const float x = parts[half].visible.opticalDepth;
        // Where light is stopped, as a share of the half's depth (HalfLayer.h).
        const float centre = 1.0f / (2.0f + x * (1.0f / 3 + x * (1.0f / 18)));
        const float slope = move.slope[half][i] * length * depth;
        const float at = begin + centre * depth;
        const float change = at * (push + centre * slope) -
          (moment + centre * slope * (begin + 0.5f * centre * depth)) -
          move.along[i] * (before + centre * x);
        const float distance = at + this->eye.depth; // 0 for a half that is clipped at the eye
        const float inverse = this->eye.parallel ? length * this->eye.inverse
                                                 : 1.0f / (distance > 1e-6f ? distance : 1e-6f);
        gain += gained[half] * change * inverse;
        push += slope;
        moment += slope * (begin + 0.5f * depth);
        before += x;
      }
      move.gain[i] += gain;
      move.push[i] = push;
      move.moment[i] = moment;
    }
    // Behind the exit nothing is visible, so what is deepened there does not matter.
    this->opticalDepth[i] += parts[0].visible.LimitedDepth() + parts[1].visible.LimitedDepth();
  }
};
}

LIMPID_MULTIVERSION
void DifferFourRows(const float* const rows[2][2], float across, float along, const RowMove& move,
  int begin, int end, float* __restrict out)
{
  const float* __restrict front0 = rows[0][0];
  const float* __restrict front1 = rows[0][1];
  const float* __restrict back0 = rows[1][0];
  const float* __restrict back1 = rows[1][1];
  const RowMove by = move;
  for (int u = begin; u < end; ++u)
  {
    const float front = front1[u] - front0[u];
    const float back = back1[u] - back0[u];
    const float first = back0[u] - front0[u];
    out[u] =
      by.across * (front + along * (back - front)) + by.along * (first + across * (back - front));
  }
}

LIMPID_MULTIVERSION
void DifferRow(const float* __restrict row, int begin, int end, float* __restrict out)
{
  for (int u = begin; u + 1 < end; ++u)
  {
    out[u] = row[u + 1] - row[u];
  }
  out[end - 1] = 0;
}

LIMPID_MULTIVERSION
void AddSteps(const LinearMap& map, const float* __restrict steps, float factor,
  const Interval& columns, float* __restrict values)
{
  const int* __restrict index = map.index.data();
  for (int i = columns.begin; i < columns.end; ++i)
  {
    values[i] += factor * steps[index[i]];
  }
}

LIMPID_MULTIVERSION
void ForwardTurnRow(const RayRow& rays, const EyeDistance& eye, const EyeMove moves[2],
  double* opticalDepth, float* visible, float* plain)
{
  const TurnColumn column{ rays, eye, { moves[0], moves[1] }, opticalDepth, visible, plain };
#pragma GCC ivdep
  for (int i = rays.work.begin; i < rays.work.end; ++i)
  {
    column(i);
  }
}
}
