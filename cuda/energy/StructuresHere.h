// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_StructuresHere_h
#define limpid_energy_StructuresHere_h

#include <array>
#include <cstddef>

namespace limpid
{
/// The structures that a ray meets in a layer. At both Gauss points: their membership, and
/// `bound` of their nodes.
struct StructuresHere
{
  using AtGaussPoints = std::array<float, 2>;

  static constexpr int most = 18; ///< nodes that the samples of a layer may read

  std::size_t count = 0;
  std::array<float, most> number; ///< of the row
  std::array<AtGaussPoints, most> share;
  std::array<AtGaussPoints, most> bound;

  std::size_t IndexOf(float wanted)
  {
    for (std::size_t k = 0; k < this->count; ++k)
    {
      if (this->number[k] == wanted)
      {
        return k;
      }
    }
    this->number[this->count] = wanted;
    this->share[this->count] = this->bound[this->count] = { 0, 0 };
    return this->count++;
  }
};

/// The rows of nodes that the row of rays interpolates at a Gauss point: [2 slice + row].
struct RowsOfStructures
{
  const int* first;      ///< [column of rays]: first column of nodes
  const float* sideways; ///< weight of the second one
  float weight[4];
  const float* number[4]; ///< of rows of structures
  const float* bound[4];  ///< null if there is none

  /// Adds what is at the nodes about a ray to the structures there.
  void AddShares(int column, std::size_t half, StructuresHere& here) const
  {
    const int at = this->first[column];
    const float second = this->sideways[column];
    float numbers[8];
    float weights[8];
    for (int row = 0; row < 4; ++row)
    {
      numbers[2 * row] = this->number[row][at];
      numbers[2 * row + 1] = this->number[row][at + 1];
      weights[2 * row] = this->weight[row] * (1 - second);
      weights[2 * row + 1] = this->weight[row] * second;
    }
    for (std::size_t node = 0; node < 8; ++node)
    {
      const std::size_t k = here.IndexOf(numbers[node]);
      here.share[k][half] += weights[node];
      if (const float* bounds = this->bound[node / 2])
      {
        here.bound[k][half] += weights[node] * bounds[at + int(node % 2)];
      }
    }
  }
};
}

#endif
