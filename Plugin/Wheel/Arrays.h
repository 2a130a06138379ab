// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Passes arrays of numpy to the core, and arrays of the core to numpy.

#ifndef limpid_wheel_Arrays_h
#define limpid_wheel_Arrays_h

#include "math/Vec.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace limpid::python
{
/// A field over a grid: one number per node, first axis of the grid fastest. It is used in place,
/// never copied.
using Field =
  nanobind::ndarray<const float, nanobind::ndim<1>, nanobind::c_contig, nanobind::device::cpu>;

/// A table of `Columns` numbers per row.
template <class Value, int Columns>
using Table = nanobind::ndarray<const Value, nanobind::shape<-1, Columns>, nanobind::c_contig,
  nanobind::device::cpu>;

/// An optional field.
using OptionalField = std::optional<Field>;

inline const float* DataOf(const OptionalField& field)
{
  return field ? field->data() : nullptr;
}

using Triple = std::array<double, 3>;

inline Vec3 ToVec3(const Triple& vector)
{
  return { vector[0], vector[1], vector[2] };
}

inline Triple ToTriple(const Vec3& vector)
{
  return { { vector.x, vector.y, vector.z } };
}

/// Moves the memory of a vector to a one-dimensional array of numpy.
template <class Value>
nanobind::object ToNumpy(std::vector<Value>&& values)
{
  auto* kept = new std::vector<Value>(std::move(values));
  const nanobind::capsule owner(
    kept, [](void* memory) noexcept { delete static_cast<std::vector<Value>*>(memory); });
  using Array = nanobind::ndarray<nanobind::numpy, Value, nanobind::ndim<1>>;
  return nanobind::cast(Array(kept->data(), { kept->size() }, owner));
}
}

#endif
