// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How the score of a row of rays changes when the eye moves.

#ifndef limpid_viewpoint_TurnRow_h
#define limpid_viewpoint_TurnRow_h

#include "sweep/Rows.h"

namespace limpid
{
/**
 * What a move of the eye by e does to the rays of a row in one layer.
 *
 * A point x at depth D stays where it is; its optical depth changes by
 *
 *   d tau = (D P - M - c tau) / R,   P = int e . grad mu ds,   M = int D' e . grad mu ds
 *
 * over the medium in front of it, at depths D'. R is D for a point eye; for a parallel one, which
 * turns about a point, it is the distance to that over the length of a ray per unit of depth. c
 * belongs to the ray that becomes longer. Where rays enter the box, grad mu is that of a step.
 */
struct EyeMove
{
  const float* slope[2]; ///< e . grad mu at the Gauss points [1/length]
  const float* along;    ///< c, per column
  const float* side;     ///< P of a step of 1 through the sides that face u, per column
  float row;             ///< ... through those that face v, over the length per depth
  float front;           ///< ... through the front, over the length per depth; 0 at the eye
  float* push;           ///< P so far
  float* moment;         ///< M so far
  float* gain;           ///< minus the derivative of the visible importance so far
};

/// Where the rays of all layers come from.
struct EyeDistance
{
  bool parallel;
  float front;   ///< relative depth where rays begin that do not enter through a side
  float depth;   ///< point eye: depth of relative depth 0 [index]
  float inverse; ///< parallel eye: 1 / distance to the point about which it turns [1/length]
};

/// What a move does to the samples of a plane: along its rows and in depth, for the columns [begin,
/// end) of four rows [slice][row] with the weights of BlendFourRows.
struct RowMove
{
  float across; ///< e along the second index of the rows [index]
  float along;  ///< e in depth [index]
};
void DifferFourRows(const float* const rows[2][2], float across, float along, const RowMove& move,
  int begin, int end, float* out);

/// out[i] = row[i + 1] - row[i], and 0 at end - 1.
void DifferRow(const float* row, int begin, int end, float* out);

/// values[i] += factor steps[index[i]].
void AddSteps(
  const LinearMap& map, const float* steps, float factor, const Interval& columns, float* values);

/// Like ForwardRow, and what two moves of the eye do to the visible importance.
void ForwardTurnRow(const RayRow& rays, const EyeDistance& eye, const EyeMove moves[2],
  double* opticalDepth, float* visible, float* plain);
}

#endif
