// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How the score of a row of rays changes when the eye moves.

#ifndef limpid_viewpoint_ViewDerivativeRow_h
#define limpid_viewpoint_ViewDerivativeRow_h

#include "sweep/RowSampler.h"
#include "viewpoint/ViewDerivativePlanes.h"

namespace limpid
{
/**
 * What a move of the eye by e does to the rays of a row in one layer. Summed over all rays and
 * layers, the gain is the integral of Eq. (29); Eq. (14) is worked into d tau (deviation D13).
 *
 * Moving the eye along a ray changes nothing on it. So e is moved along every ray into the plane of
 * the eye across the depth axis, e' = e - e_w (a, b, 1) with the ray's slopes a and b. A point x at
 * depth D stays where it is; its optical depth changes by
 *
 *   d tau = (D P - M - c tau) / R,   P = int e' . grad mu ds,   M = int D' e' . grad mu ds
 *
 * over the medium in front of it, at depths D'. R is D for a point eye; for a parallel one, which
 * turns about a point, it is the distance to that over the length of a ray per unit of depth. c
 * belongs to the ray that becomes longer. Where rays enter the box, grad mu is that of a step.
 */
struct EyeMove
{
  float across;       ///< e along the columns [index]
  float down;         ///< e' along the rows [index]
  float depth;        ///< e along the depth axis [index]
  const float* along; ///< c, per column
  const float* side;  ///< P of a step of 1 through the sides that face u, per column
  float row;          ///< ... through those that face v, over the length per depth
  float front;        ///< ... through the front, over the length per depth: 0 but at the eye
  float* integral;    ///< P so far
  float* moment;      ///< M so far
  float* gain;        ///< minus the derivative of the visible importance so far
};

/// The derivatives of extinction across a row of rays at the Gauss points [1/length/index].
struct RowSlopes
{
  const float* across[2]; ///< along the columns, per column
  const float* down[2];   ///< along the rows, per column
};

/// Where the rays of all layers come from.
struct EyeDistance
{
  bool parallel;
  const float* slope; ///< a, per column
  float front;        ///< relative depth where rays begin that do not enter through a side
  float depth;        ///< point eye: depth of relative depth 0 [index]
  float inverse;      ///< parallel eye: 1 / distance to the point about which it turns [1/length]
};

/// out = (0 or out) + factor (front + along (back - front)), columns [begin, end).
void AddRow(const float* front, const float* back, float along, float factor, bool first, int begin,
  int end, float* out);

/// out[i] = factor times the sum of samples[i], ..., samples[i + 3], each with its weight of column
/// i.
void DifferRow(const float* samples, const float* const weights[4], float factor,
  const Range<int>& columns, float* out);

/// The visible importance of a layer added to `visible` and `unattenuated`, and what two moves of
/// the eye do to it.
void ForwardViewDerivativeRow(const RayRow& rays, const RowSlopes& slopes, const EyeDistance& eye,
  const EyeMove moves[2], double* opticalDepth, float* visible, float* unattenuated);
}

#endif
