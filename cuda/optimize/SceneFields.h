// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_SceneFields_h
#define limpid_optimize_SceneFields_h

#include "distributed/ScenePiece.h"
#include "optimize/Settings.h"
#include "scene/Grid.h"

#include <array>
#include <memory>

namespace limpid
{
constexpr float mostExtinction = 3e38f; ///< largest valid extinction [1/length]

/// The fields of a scene. The caller owns the arrays and keeps them while a solver uses them.
struct SceneFields
{
  Grid grid;
  const float* baseExtinction = nullptr; ///< grid.NodeCount() values >= 0, finite [1/length]
  const float* importance = nullptr;     ///< grid.NodeCount() values in [0, 1]

  /// Upper bound of the extinction, Eq. (25): the largest extinction of the transfer function, so
  /// that it depends neither on time nor on cropping. At least, and by default, the largest value
  /// of the base extinction [1/length].
  float majorant = 0;

  /// The despeckled importance for ImportanceSmoothing::Median, grid.NodeCount() values in [0, 1];
  /// null: computed on request.
  const float* despeckled = nullptr;

  /// For each GivenReference grid.NodeCount() values >= 0, finite [1/length]; null: not given.
  std::array<const float*, givenReferences> references{};

  /// This rank's subdomain of a distributed scene: the arrays hold the values of its nodes only,
  /// first axis fastest. Null if they hold all nodes.
  std::shared_ptr<const ScenePiece> piece = nullptr;

  /// Calls visit(field, most) for the pointer to every field, with the upper bound of its values.
  template <class Visitor>
  void ForEachField(const Visitor& visit)
  {
    visit(this->baseExtinction, mostExtinction);
    visit(this->importance, 1.0f);
    visit(this->despeckled, 1.0f);
    for (const float*& reference : this->references)
    {
      visit(reference, mostExtinction);
    }
  }

  /// Number of values in the arrays.
  Index ValueCount() const
  {
    return this->piece ? this->piece->nodes.Count() : this->grid.NodeCount();
  }
};
}

#endif
