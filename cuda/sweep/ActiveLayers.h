// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The layers in which rays have work, for sweeps that move one ray through all layers on a device.

#ifndef limpid_sweep_ActiveLayers_h
#define limpid_sweep_ActiveLayers_h

#include "backend/DeviceArray.h"
#include "sweep/FaceFrustum.h"
#include "sweep/RayTiles.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace limpid
{
/// For groups of adjacent rays of a row: one bit per layer, set where any of them is active. The
/// threads of a GPU's warp have a group, so that they take the same steps.
struct LayerMasks
{
  static constexpr int groupColumns = 32;
  static constexpr int bits = 32;
  using Word = std::uint32_t;

  int groups = 0;              ///< per row of rays
  int words = 0;               ///< per group
  const Word* masks = nullptr; ///< [row][group][word]

  LayerMasks() = default;
  explicit LayerMasks(const FaceFrustum& frustum)
    : groups((frustum.columns + groupColumns - 1) / groupColumns)
    , words((frustum.lastSlice + bits - 1) / bits)
  {
  }

  /// Calls visit(layer) for the layers in which the ray's group is active, front to back.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void FrontToBack(int column, int row, const Visit& visit) const
  {
    for (int word = 0; word < this->words; ++word)
    {
      int layer = word * bits;
      for (Word left = this->MasksOf(column, row)[word]; left != 0; left >>= 1, ++layer)
      {
        if ((left & 1u) != 0)
        {
          visit(layer);
        }
      }
    }
  }

  /// Back to front.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void BackToFront(int column, int row, const Visit& visit) const
  {
    constexpr Word highest = Word(1) << (bits - 1);
    for (int word = this->words; word-- > 0;)
    {
      int layer = word * bits + bits - 1;
      for (Word left = this->MasksOf(column, row)[word]; left != 0; left <<= 1, --layer)
      {
        if ((left & highest) != 0)
        {
          visit(layer);
        }
      }
    }
  }

private:
  LIMPID_HD LIMPID_INLINE const Word* MasksOf(int column, int row) const
  {
    return this->masks + (Index(row) * this->groups + column / groupColumns) * this->words;
  }
};

/// Computes a word of LayerMasks.
struct MadeLayerMask
{
  FaceFrustum frustum;
  LayerMasks layout;
  LayerMasks::Word* masks;

  LIMPID_HD void operator()(Index index) const
  {
    const int word = static_cast<int>(index % this->layout.words);
    const Index before = index / this->layout.words;
    const int group = static_cast<int>(before % this->layout.groups);
    const int row = static_cast<int>(before / this->layout.groups);
    const Range<int> columns{ group * LayerMasks::groupColumns,
      (group + 1) * LayerMasks::groupColumns };
    LayerMasks::Word mask = 0;
    for (int bit = 0; bit < LayerMasks::bits; ++bit)
    {
      const int layer = word * LayerMasks::bits + bit;
      const bool active = layer < this->frustum.lastSlice &&
        AnyRayIsActive(this->frustum, { layer, layer + 1 }, columns, { row, row + 1 });
      mask |= active ? LayerMasks::Word(1) << bit : 0;
    }
    this->masks[index] = mask;
  }
};

/// LayerMasks of a frustum and their memory.
template <class AnyDevice>
class ActiveLayers
{
public:
  ActiveLayers(const std::shared_ptr<AnyDevice>& device, const FaceFrustum& frustum)
    : Layout(frustum)
  {
    const Index count = Index(frustum.rows) * this->Layout.groups * this->Layout.words;
    this->Memory = { device, static_cast<std::size_t>(count), "the plan of a sweep" };
    device->ForIndices("plan", count, MadeLayerMask{ frustum, this->Layout, this->Memory.Data() });
    this->Layout.masks = this->Memory.Data();
  }

  const LayerMasks& Masks() const { return this->Layout; }

private:
  LayerMasks Layout;
  DeviceArray<AnyDevice, LayerMasks::Word> Memory;
};
}

#endif
