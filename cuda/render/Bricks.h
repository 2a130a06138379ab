// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_Bricks_h
#define limpid_render_Bricks_h

#include "render/BrickNodes.h"
#include "render/Fields.h"

#include <vector>

namespace limpid
{
/**
 * Where a volume is empty: the cells in bricks of `size` cells along each axis.
 *
 * A brick is empty if no scalar that its cells can have and no change that they can have give an
 * extinction above zero. Neighbouring bricks share their nodes, so their ranges of scalars touch:
 * a segment between samples in two empty neighbours meets no extinction either.
 */
class Bricks
{
public:
  static constexpr int size = BrickDistances::size; ///< cells

  Bricks() = default;

  /// Finds the ranges of the scalars.
  explicit Bricks(const ScalarField& scalars);

  /// Finds the empty bricks, and how far around each all are empty.
  void Classify(const Classification& classification, const OverlayField& overlay);

  BrickDistances Distances() const;

  /// Share of the bricks that are empty [0, 1].
  double EmptyShare() const;

private:
  Int3 Nodes{ 0 };
  Int3 Count{ 0 };
  std::vector<ScalarRange> Ranges;
  std::vector<std::uint8_t> Distance;
};
}

#endif
