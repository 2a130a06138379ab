// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the processor alone.

#ifndef limpid_render_BlockSampler_h
#define limpid_render_BlockSampler_h

#include "backend/Simd.h"
#include "math/FloatLanes.h"
#include "render/ScalarNodes.h"
#include "render/SingleSampler.h"

#include <cstring>

namespace limpid
{
/// Indices of the first nodes of cells.
struct BlockCells
{
  alignas(64) Index first[FloatLanes::count];
};

/// The entries of the transfer functions at both ends of successive segments.
class BlockOptics
{
public:
  using Optical = float __attribute__((vector_size(16)));

  /// See SingleOptics.
  LIMPID_INLINE void Read(const OpticalTable& table, const FloatLanes& positions)
  {
    const FloatLanes inside = table.axis.Inside(positions);
    FloatLanes shareLanes;
    alignas(32) std::int32_t entries[count];
    alignas(32) float shares[count];
    table.axis.Split(inside, shareLanes).Store(entries);
    shareLanes.Store(shares);
    this->Samples[0] = this->Samples[count];
    LIMPID_UNROLL(16)
    for (int i = 0; i < count; ++i)
    {
      const OpticalEntry* entry = table.entries + entries[i];
      EightFloats low;
      EightFloats high;
      std::memcpy(&low, entry, sizeof(low));
      std::memcpy(&high, entry + 1, sizeof(high));
      this->Samples[i + 1] = low + shares[i] * (high - low);
    }
    if (AnyOf(positions != inside))
    {
      alignas(32) float beyond[count];
      (positions - inside).Store(beyond);
      for (int i = 0; i < count; ++i)
      {
        OpticalEntry there;
        std::memcpy(&there, &this->Samples[i + 1], sizeof(there));
        OpticalTable::Extend(there, beyond[i]);
        std::memcpy(&this->Samples[i + 1], &there, sizeof(there));
      }
    }
  }

  /// Returns the extinction at the rear of the segments [majorant], and its integral up to there.
  LIMPID_INLINE void Extinction(FloatLanes& value, FloatLanes& integral) const
  {
    this->Firsts<1>(value.low, integral.low);
    this->Firsts<9>(value.high, integral.high);
  }

  LIMPID_INLINE Optical Color(int i, float ofValues, float ofIntegrals) const
  {
    // The first four numbers become the sum of the values, the others the difference of the
    // integrals.
    const EightFloats signs = { 0.0f, 0.0f, 0.0f, 0.0f, -0.0f, -0.0f, -0.0f, -0.0f };
    const auto front = reinterpret_cast<EightFloats>(
      reinterpret_cast<EightInts>(this->Samples[i]) ^ reinterpret_cast<EightInts>(signs));
    const EightFloats weights = { ofValues, ofValues, ofValues, ofValues, ofIntegrals, ofIntegrals,
      ofIntegrals, ofIntegrals };
    const EightFloats both = weights * (this->Samples[i + 1] + front);
    return __builtin_shufflevector(both, both, 0, 1, 2, 3) +
      __builtin_shufflevector(both, both, 4, 5, 6, 7);
  }

private:
  static constexpr int count = FloatLanes::count;

  /// Returns the first numbers of value and integral of eight samples.
  template <int Sample>
  LIMPID_INLINE void Firsts(EightFloats& values, EightFloats& integrals) const
  {
    const EightFloats* from = this->Samples + Sample;
    const EightFloats a = __builtin_shufflevector(from[0], from[1], 0, 8, 2, 10, 4, 12, 6, 14);
    const EightFloats b = __builtin_shufflevector(from[2], from[3], 0, 8, 2, 10, 4, 12, 6, 14);
    const EightFloats c = __builtin_shufflevector(from[4], from[5], 0, 8, 2, 10, 4, 12, 6, 14);
    const EightFloats d = __builtin_shufflevector(from[6], from[7], 0, 8, 2, 10, 4, 12, 6, 14);
    const EightFloats some = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
    const EightFloats others = __builtin_shufflevector(c, d, 0, 1, 8, 9, 4, 5, 12, 13);
    values = __builtin_shufflevector(some, others, 0, 1, 2, 3, 8, 9, 10, 11);
    integrals = __builtin_shufflevector(some, others, 4, 5, 6, 7, 12, 13, 14, 15);
  }

  EightFloats Samples[count + 1] = {}; ///< each an OpticalEntry; the first is the sample before the
                                       ///< block
};

/// Takes sixteen samples of a ray at a time, in vector registers. It performs the operations of
/// SingleSampler in the same order.
struct BlockSampler
{
  using Lanes = FloatLanes;
  using Integers = IntLanes;
  using Cells = BlockCells;
  using Optics = BlockOptics;
  using Optical = BlockOptics::Optical;
  static constexpr int count = FloatLanes::count;

  static LIMPID_INLINE FloatLanes Numbers()
  {
    return FloatLanes(
      EightFloats{ 0, 1, 2, 3, 4, 5, 6, 7 }, EightFloats{ 8, 9, 10, 11, 12, 13, 14, 15 });
  }

  static LIMPID_INLINE float First(const FloatLanes& samples) { return samples.low[0]; }
  static LIMPID_INLINE int Last(const IntLanes& samples) { return samples.high[7]; }

  static LIMPID_INLINE FloatLanes Shifted(const FloatLanes& before, const FloatLanes& samples)
  {
    return FloatLanes(
      __builtin_shufflevector(before.high, samples.low, 7, 8, 9, 10, 11, 12, 13, 14),
      __builtin_shufflevector(samples.low, samples.high, 7, 8, 9, 10, 11, 12, 13, 14));
  }

  static LIMPID_INLINE Index CellOf(const BlockCells& cells, int i) { return cells.first[i]; }

  static LIMPID_INLINE Optical Loaded(const FourFloats& numbers)
  {
    Optical loaded;
    std::memcpy(&loaded, &numbers, sizeof(loaded));
    return loaded;
  }

  static LIMPID_INLINE void FindFirst(
    const CellGrid& grid, const IntLanes* before, BlockCells& cells)
  {
    alignas(32) std::int32_t columns[count];
    alignas(32) std::int32_t rows[count];
    before[0].Store(columns);
    (before[1] + before[2] * grid.rows).Store(rows);
    const auto nodes = static_cast<std::uint32_t>(grid.stride[1]);
    for (int i = 0; i < count; ++i)
    {
      const auto row = static_cast<std::uint32_t>(rows[i]);
      cells.first[i] = columns[i] + static_cast<Index>(std::uint64_t(row) * nodes);
    }
  }

  /// `field`: floats, or ScalarNodes.
  template <class Field>
  static LIMPID_INLINE FloatLanes InterpolateAll(
    const CellGrid& grid, const Field& field, const CellPlaces<BlockSampler>& place)
  {
    const NodePairs low(field, 0, place.cell);
    const NodePairs high(field, grid.stride[1], place.cell);
    const NodePairs lowBehind(field, grid.stride[2], place.cell);
    const NodePairs highBehind(field, grid.stride[1] + grid.stride[2], place.cell);
    const FloatLanes nearLow = Blend(low.first, lowBehind.first, place.fraction[2]);
    const FloatLanes farLow = Blend(low.second, lowBehind.second, place.fraction[2]);
    const FloatLanes nearHigh = Blend(high.first, highBehind.first, place.fraction[2]);
    const FloatLanes farHigh = Blend(high.second, highBehind.second, place.fraction[2]);
    const FloatLanes near = Blend(nearLow, nearHigh, place.fraction[1]);
    const FloatLanes far = Blend(farLow, farHigh, place.fraction[1]);
    return Blend(near, far, place.fraction[0]);
  }

  template <int Count>
  static LIMPID_INLINE void InterpolateAll(const CellGrid& grid, const Packed<Count>* field,
    const CellPlaces<BlockSampler>& place, FloatLanes (&numbers)[Count])
  {
    const FloatLanes* at = place.fraction;
    EightFloats low[Count];
    EightFloats high[Count];
    Interpolate(grid, field, place.cell.first, at[0].low, at[1].low, at[2].low, low);
    Interpolate(grid, field, place.cell.first + 8, at[0].high, at[1].high, at[2].high, high);
    for (int number = 0; number < Count; ++number)
    {
      numbers[number] = FloatLanes(perUnit * low[number], perUnit * high[number]);
    }
  }

  /// Multiplied segment by segment, so that the result does not depend on where blocks begin.
  static LIMPID_INLINE FloatLanes InFront(
    const FloatLanes& passed, float opaqueBelow, float& transmittance)
  {
    alignas(32) float share[count];
    passed.Store(share);
    float t[count + 1];
    t[0] = transmittance;
    LIMPID_UNROLL(16)
    for (int i = 0; i < count; ++i)
    {
      t[i + 1] = t[i] * share[i];
    }
    int seen = count;
    if (!(t[count - 1] > opaqueBelow))
    {
      for (seen = 0; t[seen] > opaqueBelow; ++seen)
      {
      }
    }
    transmittance = t[seen];
    return FloatLanes(EightFloats{ t[0], t[1], t[2], t[3], t[4], t[5], t[6], t[7] },
      EightFloats{ t[8], t[9], t[10], t[11], t[12], t[13], t[14], t[15] });
  }

private:
  /// Pairs of nodes that are neighbours along x, in several cells.
  struct NodePairs
  {
    FloatLanes first;
    FloatLanes second;

    /// `shift`: from the first nodes of the cells to the first nodes of the pairs.
    LIMPID_INLINE NodePairs(const float* field, Index shift, const BlockCells& cells)
    {
      Load(field + shift, cells.first, this->first.low, this->second.low);
      Load(field + shift, cells.first + 8, this->first.high, this->second.high);
    }

    LIMPID_INLINE NodePairs(const ScalarNodes& field, Index shift, const BlockCells& cells)
    {
      if (field.Bits() == 32)
      {
        *this = NodePairs(field.Floats(), shift, cells);
        return;
      }
      LoadIntegers(field, shift, cells.first, this->first.low, this->second.low);
      LoadIntegers(field, shift, cells.first + 8, this->first.high, this->second.high);
    }

  private:
    static LIMPID_INLINE void LoadIntegers(const ScalarNodes& field, Index shift,
      const Index* cells, EightFloats& first, EightFloats& second)
    {
      alignas(32) std::uint32_t pairs[8];
      if (field.Bits() == 16)
      {
        const auto* nodes = static_cast<const std::uint16_t*>(field.Memory()) + shift;
        for (int i = 0; i < 8; ++i)
        {
          std::memcpy(&pairs[i], nodes + cells[i], sizeof(pairs[i]));
        }
      }
      else
      {
        const auto* nodes = static_cast<const std::uint8_t*>(field.Memory()) + shift;
        for (int i = 0; i < 8; ++i)
        {
          std::uint16_t pair = 0;
          std::memcpy(&pair, nodes + cells[i], sizeof(pair));
          pairs[i] = pair;
        }
      }
      EightInts both;
      std::memcpy(&both, pairs, sizeof(both));
      // Without the highest bit, and as much higher, unsigned integers are signed ones.
      const int bits = field.Bits();
      const int highest = field.IsSigned() ? 0 : 1 << (bits - 1);
      both ^= highest | (highest << bits);
      first =
        __builtin_convertvector(both << (32 - bits) >> (32 - bits), EightFloats) + float(highest);
      second = __builtin_convertvector(both << (32 - 2 * bits) >> (32 - bits), EightFloats) +
        float(highest);
    }

    static LIMPID_INLINE void Load(
      const float* field, const Index* cells, EightFloats& first, EightFloats& second)
    {
      using Pairs = std::int64_t __attribute__((vector_size(32)));
      std::int64_t pairs[8];
      for (int i = 0; i < 8; ++i)
      {
        std::memcpy(&pairs[i], field + cells[i], sizeof(pairs[i]));
      }
      const auto some =
        reinterpret_cast<EightFloats>(Pairs{ pairs[0], pairs[1], pairs[4], pairs[5] });
      const auto others =
        reinterpret_cast<EightFloats>(Pairs{ pairs[2], pairs[3], pairs[6], pairs[7] });
      first = __builtin_shufflevector(some, others, 0, 2, 8, 10, 4, 6, 12, 14);
      second = __builtin_shufflevector(some, others, 1, 3, 9, 11, 5, 7, 13, 15);
    }
  };

  static constexpr float perUnit = 1.0f / 65536.0f;

  /// Unpacks eight numbers, times 2^16: those of 16 bits become the upper halves of 32 bits.
  template <class Bytes>
  static LIMPID_INLINE void Unpack(const Bytes& bytes, EightFloats& numbers)
  {
    using Halves = std::int16_t __attribute__((vector_size(16)));
    static_assert(sizeof(bytes) == sizeof(Halves), "eight numbers of 16 bits");
    Halves packed;
    std::memcpy(&packed, &bytes, sizeof(packed));
    const Halves zero{};
    const auto shifted =
      __builtin_shufflevector(zero, packed, 0, 8, 0, 9, 0, 10, 0, 11, 0, 12, 0, 13, 0, 14, 0, 15);
    numbers = __builtin_convertvector(reinterpret_cast<EightInts>(shifted), EightFloats);
  }

  /// Reads the numbers of two nodes that are neighbours along x, times 2^16.
  struct NodesOfOne
  {
    const FourPacked* first;

    LIMPID_INLINE void Read(Index nodes, EightFloats& numbers) const
    {
      FourPacked there[2];
      std::memcpy(there, this->first + nodes, sizeof(there));
      Unpack(there, numbers);
    }
  };

  /// Reads two samples at once.
  struct NodesOfTwo
  {
    const TwoPacked* first;
    const TwoPacked* other;

    LIMPID_INLINE void Read(Index nodes, EightFloats& numbers) const
    {
      using Pair = std::int64_t __attribute__((vector_size(16)));
      std::int64_t here;
      std::int64_t there;
      std::memcpy(&here, this->first + nodes, sizeof(here));
      std::memcpy(&there, this->other + nodes, sizeof(there));
      Unpack(Pair{ here, there }, numbers);
    }
  };

  /// Interpolates the numbers of such nodes along z and y, times 2^16.
  template <class Nodes, class Share>
  static LIMPID_INLINE void InFace(
    const CellGrid& grid, const Nodes& nodes, const Share& y, const Share& z, EightFloats& between)
  {
    EightFloats lowFront;
    EightFloats highFront;
    EightFloats lowBehind;
    EightFloats highBehind;
    nodes.Read(0, lowFront);
    nodes.Read(grid.stride[1], highFront);
    nodes.Read(grid.stride[2], lowBehind);
    nodes.Read(grid.stride[1] + grid.stride[2], highBehind);
    const EightFloats low = lowFront + z * (lowBehind - lowFront);
    const EightFloats high = highFront + z * (highBehind - highFront);
    between = low + y * (high - low);
  }

  /// Repeats numbers i and i + 4 of eight, four times each.
  struct FourTimes
  {
    EightFloats both[4];

    LIMPID_INLINE explicit FourTimes(const EightFloats& x)
      : both{ __builtin_shufflevector(x, x, 0, 0, 0, 0, 4, 4, 4, 4),
        __builtin_shufflevector(x, x, 1, 1, 1, 1, 5, 5, 5, 5),
        __builtin_shufflevector(x, x, 2, 2, 2, 2, 6, 6, 6, 6),
        __builtin_shufflevector(x, x, 3, 3, 3, 3, 7, 7, 7, 7) }
    {
    }
  };

  /// Interpolates two packed numbers at eight samples, times 2^16.
  static LIMPID_INLINE void Interpolate(const CellGrid& grid, const TwoPacked* field,
    const Index* cells, const EightFloats& x, const EightFloats& y, const EightFloats& z,
    EightFloats* numbers)
  {
    // First, both numbers of both nodes of samples i and i + 4 share a register.
    const FourTimes shareY(y);
    const FourTimes shareZ(z);
    EightFloats pairs[4];
    LIMPID_UNROLL(4)
    for (int i = 0; i < 4; ++i)
    {
      const NodesOfTwo nodes{ field + cells[i], field + cells[i + 4] };
      InFace(grid, nodes, shareY.both[i], shareZ.both[i], pairs[i]);
    }
    // Next, those of samples i, i + 1, i + 4 and i + 5 at either node.
    EightFloats blended[2];
    const EightFloats shareX[2] = { __builtin_shufflevector(x, x, 0, 0, 1, 1, 4, 4, 5, 5),
      __builtin_shufflevector(x, x, 2, 2, 3, 3, 6, 6, 7, 7) };
    LIMPID_UNROLL(2)
    for (int i = 0; i < 2; ++i)
    {
      const EightFloats& one = pairs[2 * i];
      const EightFloats& other = pairs[2 * i + 1];
      const EightFloats near = __builtin_shufflevector(one, other, 0, 1, 8, 9, 4, 5, 12, 13);
      const EightFloats far = __builtin_shufflevector(one, other, 2, 3, 10, 11, 6, 7, 14, 15);
      blended[i] = near + shareX[i] * (far - near);
    }
    // Last, all values of one number side by side.
    numbers[0] = __builtin_shufflevector(blended[0], blended[1], 0, 2, 8, 10, 4, 6, 12, 14);
    numbers[1] = __builtin_shufflevector(blended[0], blended[1], 1, 3, 9, 11, 5, 7, 13, 15);
  }

  /// Interpolates four packed numbers at eight samples, times 2^16.
  static LIMPID_INLINE void Interpolate(const CellGrid& grid, const FourPacked* field,
    const Index* cells, const EightFloats& x, const EightFloats& y, const EightFloats& z,
    EightFloats* numbers)
  {
    alignas(32) float shareY[8];
    alignas(32) float shareZ[8];
    std::memcpy(shareY, &y, sizeof(y));
    std::memcpy(shareZ, &z, sizeof(z));
    // First, all four numbers of samples i and i + 4 share a register.
    EightFloats pairs[4];
    const FourTimes share(x);
    LIMPID_UNROLL(4)
    for (int i = 0; i < 4; ++i)
    {
      EightFloats one;
      EightFloats other;
      InFace(grid, NodesOfOne{ field + cells[i] }, shareY[i], shareZ[i], one);
      InFace(grid, NodesOfOne{ field + cells[i + 4] }, shareY[i + 4], shareZ[i + 4], other);
      const EightFloats near = __builtin_shufflevector(one, other, 0, 1, 2, 3, 8, 9, 10, 11);
      const EightFloats far = __builtin_shufflevector(one, other, 4, 5, 6, 7, 12, 13, 14, 15);
      pairs[i] = near + share.both[i] * (far - near);
    }
    // Last, all values of one number side by side.
    const EightFloats a = __builtin_shufflevector(pairs[0], pairs[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const EightFloats b = __builtin_shufflevector(pairs[2], pairs[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const EightFloats c = __builtin_shufflevector(pairs[0], pairs[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const EightFloats d = __builtin_shufflevector(pairs[2], pairs[3], 2, 10, 3, 11, 6, 14, 7, 15);
    numbers[0] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
    numbers[1] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
    numbers[2] = __builtin_shufflevector(c, d, 0, 1, 8, 9, 4, 5, 12, 13);
    numbers[3] = __builtin_shufflevector(c, d, 2, 3, 10, 11, 6, 7, 14, 15);
  }
};
}

#endif
