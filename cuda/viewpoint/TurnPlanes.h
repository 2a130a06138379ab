// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Where a sweep that follows moves of the eye samples its fields.

#ifndef limpid_viewpoint_TurnPlanes_h
#define limpid_viewpoint_TurnPlanes_h

#include "sweep/Plan.h"

#include <vector>

namespace limpid
{
/**
 * A plane through a Gauss point of a layer, and where rays and the middles between them meet it.
 *
 * Unlike those of Plane, weights go beyond [0, 1] outside the box: what is sampled there goes on as
 * it does at the border, so that lines through samples on both sides of it are right inside.
 */
struct TurnPlane
{
  int slices[2] = { 0, 0 }; ///< node indices along the depth axis
  float fraction = 0;       ///< weight of the second slice [0, 1]
  LinearMap columns;        ///< ray column -> voxel column
  LinearMap between;        ///< likewise 3/2 and 1/2 before column 0, 1/2 behind it, and so on
  double firstRow = 0;      ///< voxel row of ray row 0 [index]
  double rowStep = 0;       ///< ... of neighbouring ray rows, beyond each other
  float columnStep = 0;     ///< distance of neighbouring ray columns [index]
};

/// Four samples across the rows of rays; their sum times `factor` is a derivative.
struct RowStencil
{
  int row[4];      ///< voxel row before the sample
  float weight[4]; ///< of the voxel row behind it
  float factor[4]; ///< of the sample [1/index]

  /// Of a voxel row.
  float FactorOf(int voxelRow) const
  {
    float sum = 0;
    for (int k = 0; k < 4; ++k)
    {
      const float before = voxelRow == this->row[k] ? 1 - this->weight[k] : 0.0f;
      const float behind = voxelRow == this->row[k] + 1 ? this->weight[k] : 0.0f;
      sum += this->factor[k] * (before + behind);
    }
    return sum;
  }
};

/// Weights of the samples at -3/2, -1/2, 1/2, 3/2 steps in the derivative by the step: its mean
/// over the step, sharpened to fourth order.
constexpr float stencilWeights[4] = { 1.0f / 24, -27.0f / 24, 27.0f / 24, -1.0f / 24 };

/// The node before a position, not the last one: where beyond the nodes to go on from.
int NodeBefore(double position, int nodes);

/// The derivative across the rows of rays at row `row` of a plane.
RowStencil StencilOf(const TurnPlane& plane, int row, int voxelRows);

/// The samples of all layers, each cut into `parts` of the same thickness, front to back; two
/// planes each.
class TurnPlanes
{
public:
  TurnPlanes(const Pyramid& pyramid, const Eye& eye, double rayDensity, int parts);

  int Parts() const { return this->PartCount; }

  /// Plane `half` in part `part` of the layer behind station `s`.
  const TurnPlane& At(int s, int part, int half) const
  {
    return this->Planes[std::size_t((s * this->PartCount + part) * 2 + half)];
  }

private:
  int PartCount;
  std::vector<TurnPlane> Planes;
};
}

#endif
