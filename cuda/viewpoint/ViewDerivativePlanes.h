// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Where a sweep that follows moves of the eye samples its fields.

#ifndef limpid_viewpoint_ViewDerivativePlanes_h
#define limpid_viewpoint_ViewDerivativePlanes_h

#include "sweep/PlanSweep.h"

#include <array>
#include <vector>

namespace limpid
{
/// A map that owns its numbers.
struct OwnedMap
{
  std::vector<int> index;
  std::vector<float> weight;

  LinearMap View() const { return { this->index.data(), this->weight.data() }; }
};

/**
 * A plane through a Gauss point of a layer, and where rays and the middles between them meet it.
 *
 * Unlike those of Plane, weights go beyond [0, 1] outside the box: what is sampled there goes on as
 * it does at the border, so that lines through samples on both sides of it are right inside.
 */
struct ViewDerivativePlane
{
  int nodes[2] = { 0, 0 }; ///< node indices along the depth axis
  float fraction = 0;      ///< weight of the second slice [0, 1]
  double depth = 0;        ///< from the eye [index]
  float perIndex = 0;      ///< units of the rays' coordinates per index
  OwnedMap columns;        ///< ray column -> voxel column
  OwnedMap between;        ///< likewise of the edges of the columns (ViewDerivativeAxis)
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

/// The rays along a lateral axis and what the derivative across them is made of.
struct ViewDerivativeAxis
{
  explicit ViewDerivativeAxis(const Lateral& lateral);

  Lateral Rays;
  std::vector<double> Middles;               ///< coordinates of the rays
  std::vector<double> Edges;                 ///< two before the first ray, ..., two behind the last
  std::array<std::vector<float>, 4> Weights; ///< per ray, of the values at the edges [ray, ray + 4)
};

/// A voxel row and the weight of the one behind it.
struct RowPlace
{
  int row;
  float weight;
};

/// The samples of all layers, each cut into `parts` of the same thickness, front to back; two
/// planes each.
class ViewDerivativePlanes
{
public:
  ViewDerivativePlanes(const PlannedFrustum& frustum, int parts);

  int Parts() const { return this->PartCount; }

  /// The derivative across the rows of rays at row `row` of a plane.
  RowStencil StencilOf(const ViewDerivativePlane& plane, int row) const;

  /// Where row `row` of the rays is.
  RowPlace RowAt(const ViewDerivativePlane& plane, int row) const;

  const ViewDerivativeAxis& Columns() const { return this->U; }

  /// Plane `half` in part `part` of the layer behind slice `s`.
  const ViewDerivativePlane& At(int s, int part, int half) const
  {
    return this->Planes[(std::size_t(s) * std::size_t(this->PartCount) + std::size_t(part)) * 2 +
      std::size_t(half)];
  }

private:
  int PartCount;
  ViewDerivativeAxis U;
  ViewDerivativeAxis V;
  std::vector<ViewDerivativePlane> Planes;
};
}

#endif
