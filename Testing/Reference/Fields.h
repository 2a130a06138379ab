// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Functions of a scalar and fields on a lattice, in double precision.

#ifndef limpid_testing_Fields_h
#define limpid_testing_Fields_h

#include "Rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace truth
{
inline double Plus(double a, double share, double b)
{
  return a + share * b;
}

inline Vector Plus(const Vector& a, double share, const Vector& b)
{
  return Along(a, share, b);
}

/// Values at equal steps from low to high, linear between, constant outside.
template <class Value>
struct Table
{
  double low = 0;
  double high = 1;
  std::vector<Value> values; ///< two or more

  Value operator()(double s) const
  {
    const double last = double(values.size() - 1);
    const double place = std::min(std::max((s - low) / (high - low) * last, 0.0), last);
    const std::size_t entry = std::min(static_cast<std::size_t>(place), values.size() - 2);
    const double share = place - double(entry);
    return Plus(Plus(Value{}, 1 - share, values[entry]), share, values[entry + 1]);
  }
};

/// Values at the nodes of a lattice, first axis fastest, trilinear between.
template <class Value>
struct Field
{
  Lattice lattice;
  std::vector<Value> values;

  const Value& Node(int i, int j, int k) const
  {
    return values[std::size_t(i) +
      std::size_t(lattice.nodes[0]) *
        (std::size_t(j) + std::size_t(lattice.nodes[1]) * std::size_t(k))];
  }

  /// At a world position; outside of the box, the value on its surface.
  Value operator()(const Vector& position) const
  {
    const Vector index = lattice.Index(position);
    std::array<int, 3> cell{};
    Vector share{};
    for (int c = 0; c < 3; ++c)
    {
      const double inside = std::min(std::max(index[c], 0.0), lattice.nodes[c] - 1.0);
      cell[c] = std::max(0, std::min(static_cast<int>(inside), lattice.nodes[c] - 2));
      share[c] = inside - cell[c];
    }
    Value sum{};
    for (int corner = 0; corner < 8; ++corner)
    {
      const std::array<int, 3> side{ { corner & 1, (corner >> 1) & 1, corner >> 2 } };
      double weight = 1;
      for (int c = 0; c < 3; ++c)
      {
        weight *= side[c] ? share[c] : 1 - share[c];
      }
      if (weight > 0)
      {
        sum = Plus(sum, weight, Node(cell[0] + side[0], cell[1] + side[1], cell[2] + side[2]));
      }
    }
    return sum;
  }
};

/// Calls visit(i, j, k) for every node, first axis fastest.
template <class Visit>
void ForEachNode(const Lattice& lattice, Visit visit)
{
  for (int k = 0; k < lattice.nodes[2]; ++k)
  {
    for (int j = 0; j < lattice.nodes[1]; ++j)
    {
      for (int i = 0; i < lattice.nodes[0]; ++i)
      {
        visit(i, j, k);
      }
    }
  }
}

/// Gradient of a field at its nodes in world directions, from central differences, at the border
/// from one-sided ones [values/length].
inline Field<Vector> Gradient(const Field<double>& field)
{
  const Lattice& lattice = field.lattice;
  Field<Vector> gradient{ lattice, {} };
  ForEachNode(lattice,
    [&](int i, int j, int k)
    {
      const std::array<int, 3> node{ { i, j, k } };
      Vector sum{};
      for (int c = 0; c < 3; ++c)
      {
        std::array<int, 3> one = node;
        std::array<int, 3> other = node;
        one[c] = std::max(0, node[c] - 1);
        other[c] = std::min(lattice.nodes[c] - 1, node[c] + 1);
        const double distance = (other[c] - one[c]) * lattice.spacing[c];
        const double slope = distance > 0
          ? (field.Node(other[0], other[1], other[2]) - field.Node(one[0], one[1], one[2])) /
            distance
          : 0.0;
        const Vector axis{ { lattice.direction[c], lattice.direction[3 + c],
          lattice.direction[6 + c] } };
        sum = Along(sum, slope, axis);
      }
      gradient.values.push_back(sum);
    });
  return gradient;
}
}

#endif
