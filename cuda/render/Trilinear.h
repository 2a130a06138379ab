// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Trilinear interpolation number by number, for devices. RaySamples.h has the same blends in the
// same order for the registers of the processor.

#ifndef limpid_render_Trilinear_h
#define limpid_render_Trilinear_h

#include "render/CellGrid.h"
#include "render/FourFloats.h"

namespace limpid
{
/// Four packed numbers of a node, see OverlayField and GradientField.
struct alignas(8) FourPacked
{
  std::int16_t values[4];
};

LIMPID_HD LIMPID_INLINE float Unpacked(float value)
{
  return value;
}

LIMPID_HD LIMPID_INLINE FourFloats Unpacked(const FourPacked& packed)
{
  const std::int16_t* values = packed.values;
  return { { float(values[0]), float(values[1]), float(values[2]), float(values[3]) } };
}

/// A position in a grid.
struct CellPlace
{
  Index cell = 0; ///< first node of the cell
  float fraction[3] = { 0, 0, 0 };

  LIMPID_HD LIMPID_INLINE CellPlace(const CellGrid& grid, float x, float y, float z)
  {
    this->cell = grid.Split(0, x, this->fraction[0]) * grid.stride[0] +
      grid.Split(1, y, this->fraction[1]) * grid.stride[1] +
      grid.Split(2, z, this->fraction[2]) * grid.stride[2];
  }

  /// `field`: numbers, or four packed ones per node.
  template <class Node>
  LIMPID_HD LIMPID_INLINE auto Sample(const CellGrid& grid, const Node* field) const
  {
    const Node* front = field + this->cell;
    const Node* back = front + grid.stride[2];
    const auto near = Blend(this->BlendAlong(front, back),
      this->BlendAlong(front + grid.stride[1], back + grid.stride[1]), this->fraction[1]);
    const auto far = Blend(this->BlendAlong(front + 1, back + 1),
      this->BlendAlong(front + 1 + grid.stride[1], back + 1 + grid.stride[1]), this->fraction[1]);
    return Blend(near, far, this->fraction[0]);
  }

private:
  template <class Node>
  LIMPID_HD LIMPID_INLINE auto BlendAlong(const Node* front, const Node* back) const
  {
    return Blend(Unpacked(*front), Unpacked(*back), this->fraction[2]);
  }
};
}

#endif
