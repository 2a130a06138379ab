// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the processor alone.

#ifndef limpid_render_BlockSampler_h
#define limpid_render_BlockSampler_h

#include "render/Trilinear.h"

#include <cstring>

namespace limpid
{
/// Reads samples of a ray block by block with the registers of the processor. The blends and their
/// order are those of SingleSampler.
struct BlockSampler
{
  using Optical = float __attribute__((vector_size(16)));
  static constexpr int segments = 16; ///< of a ray at a time

  static LIMPID_INLINE float Interpolate(
    const CellGrid& grid, const float* first, float x, float y, float z)
  {
    const Float4 front = LoadRows(first, grid.stride[1]);
    const Float4 back = LoadRows(first + grid.stride[2], grid.stride[1]);
    const Float4 between = front + z * (back - front);
    const float near = between[0] + y * (between[2] - between[0]);
    const float far = between[1] + y * (between[3] - between[1]);
    return near + x * (far - near);
  }

  /// Interpolates a field at samples from Begin to End - 1, eight by eight.
  template <int Begin, int End>
  static LIMPID_INLINE void InterpolateAll(const CellGrid& grid, const float* field,
    const Index* cells, const float* x, const float* y, const float* z, float* out)
  {
    int i = Begin;
    for (; i + 8 <= End; i += 8)
    {
      const NodePairs low(field, cells + i);
      const NodePairs high(field + grid.stride[1], cells + i);
      const NodePairs lowBehind(field + grid.stride[2], cells + i);
      const NodePairs highBehind(field + grid.stride[1] + grid.stride[2], cells + i);
      Float8 share[3];
      std::memcpy(&share[0], x + i, sizeof(Float8));
      std::memcpy(&share[1], y + i, sizeof(Float8));
      std::memcpy(&share[2], z + i, sizeof(Float8));
      const Float8 nearLow = low.first + share[2] * (lowBehind.first - low.first);
      const Float8 farLow = low.second + share[2] * (lowBehind.second - low.second);
      const Float8 nearHigh = high.first + share[2] * (highBehind.first - high.first);
      const Float8 farHigh = high.second + share[2] * (highBehind.second - high.second);
      const Float8 near = nearLow + share[1] * (nearHigh - nearLow);
      const Float8 far = farLow + share[1] * (farHigh - farLow);
      const Float8 value = near + share[0] * (far - near);
      std::memcpy(out + i, &value, sizeof(value));
    }
    for (; i < End; ++i)
    {
      out[i] = Interpolate(grid, field + cells[i], x[i], y[i], z[i]);
    }
  }

  static LIMPID_INLINE Optical Interpolate(
    const CellGrid& grid, const FourPacked* first, float x, float y, float z)
  {
    const TwoNodes lowFront(first);
    const TwoNodes highFront(first + grid.stride[1]);
    const TwoNodes lowBehind(first + grid.stride[2]);
    const TwoNodes highBehind(first + grid.stride[1] + grid.stride[2]);
    const Float8 low = lowFront.values + z * (lowBehind.values - lowFront.values);
    const Float8 high = highFront.values + z * (highBehind.values - highFront.values);
    const Float8 between = low + y * (high - low);
    const Float4 near = __builtin_shufflevector(between, between, 0, 1, 2, 3);
    const Float4 far = __builtin_shufflevector(between, between, 4, 5, 6, 7);
    return (1.0f / 65536.0f) * (near + x * (far - near));
  }

  /// Interpolates four packed numbers per node at samples from Begin to End - 1.
  template <int Begin, int End>
  static LIMPID_INLINE void InterpolateAll(const CellGrid& grid, const FourPacked* field,
    const Index* cells, const float* x, const float* y, const float* z, Optical* out)
  {
    for (int i = Begin; i < End; ++i)
    {
      out[i] = Interpolate(grid, field + cells[i], x[i], y[i], z[i]);
    }
  }

private:
  using Packed8 = std::int16_t __attribute__((vector_size(16)));
  using Int8 = std::int32_t __attribute__((vector_size(32)));
  using Float8 = float __attribute__((vector_size(32)));
  using Float4 = Optical;

  /// Two nodes that follow each other along x, of eight cells.
  struct NodePairs
  {
    Float8 first;
    Float8 second;

    LIMPID_INLINE NodePairs(const float* field, const Index* cells)
    {
      using Pairs = std::int64_t __attribute__((vector_size(32)));
      const auto pair = [&](int i)
      {
        std::int64_t both;
        std::memcpy(&both, field + cells[i], sizeof(both));
        return both;
      };
      const auto some = reinterpret_cast<Float8>(Pairs{ pair(0), pair(1), pair(4), pair(5) });
      const auto others = reinterpret_cast<Float8>(Pairs{ pair(2), pair(3), pair(6), pair(7) });
      this->first = __builtin_shufflevector(some, others, 0, 2, 8, 10, 4, 6, 12, 14);
      this->second = __builtin_shufflevector(some, others, 1, 3, 9, 11, 5, 7, 13, 15);
    }
  };

  /// What two nodes that follow each other along x have packed, times 2^16: numbers of 16 bits
  /// become the upper halves of such of 32 bits.
  struct TwoNodes
  {
    Float8 values;

    LIMPID_INLINE explicit TwoNodes(const FourPacked* first)
    {
      Packed8 packed;
      std::memcpy(&packed, first, sizeof(packed));
      const Packed8 zero{};
      const auto shifted =
        __builtin_shufflevector(zero, packed, 0, 8, 0, 9, 0, 10, 0, 11, 0, 12, 0, 13, 0, 14, 0, 15);
      this->values = __builtin_convertvector(reinterpret_cast<Int8>(shifted), Float8);
    }
  };

  /// Two rows of two nodes that follow each other along y, eight bytes each, in one register.
  static LIMPID_INLINE Float4 LoadRows(const float* first, Index stride)
  {
    using Halves = std::int64_t __attribute__((vector_size(16)));
    std::int64_t near;
    std::int64_t far;
    std::memcpy(&near, first, sizeof(near));
    std::memcpy(&far, first + stride, sizeof(far));
    return reinterpret_cast<Float4>(Halves{ near, far });
  }
};
}

#endif
