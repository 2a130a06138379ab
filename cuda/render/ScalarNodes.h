// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_ScalarNodes_h
#define limpid_render_ScalarNodes_h

#include "backend/Simd.h"
#include "math/Vec.h"

#include <cstdint>
#include <type_traits>
#include <vector>

namespace limpid
{
/// Scalars at nodes in the caller's memory: floats, or integers of 8 or 16 bits, which floats
/// represent exactly.
class ScalarNodes
{
public:
  ScalarNodes() = default;

  ScalarNodes(const float* values) // NOLINT(google-explicit-constructor): the usual ones
    : Address(values)
  {
  }

  template <class Integer>
  explicit ScalarNodes(const Integer* values)
    : Address(values)
    , Width(8 * int(sizeof(Integer)))
    , Signed(std::is_signed<Integer>::value)
  {
    static_assert(std::is_integral<Integer>::value && sizeof(Integer) <= 2, "exact as a float");
  }

  bool IsThere() const { return this->Address != nullptr; }

  /// Returns the number of bits of a scalar: 8, 16 or, for floats, 32.
  int Bits() const { return this->Width; }
  bool IsSigned() const { return this->Signed; }
  const void* Memory() const { return this->Address; }

  /// Returns the scalars, which must be floats.
  LIMPID_HD LIMPID_INLINE const float* Floats() const
  {
    return static_cast<const float*>(this->Address);
  }

  LIMPID_HD LIMPID_INLINE float At(Index node) const
  {
    if (this->Width == 32)
    {
      return this->Floats()[node];
    }
    if (this->Width == 16)
    {
      return this->Signed ? float(static_cast<const std::int16_t*>(this->Address)[node])
                          : float(static_cast<const std::uint16_t*>(this->Address)[node]);
    }
    return this->Signed ? float(static_cast<const std::int8_t*>(this->Address)[node])
                        : float(static_cast<const std::uint8_t*>(this->Address)[node]);
  }

  /// Returns the scalars from a node on.
  ScalarNodes From(Index node) const
  {
    ScalarNodes rest = *this;
    rest.Address = static_cast<const std::uint8_t*>(this->Address) + node * (this->Width / 8);
    return rest;
  }

private:
  const void* Address = nullptr;
  int Width = 32;
  bool Signed = true;
};

/// Returns the first `count` scalars as floats.
std::vector<float> FloatsOf(const ScalarNodes& scalars, Index count);
}

#endif
