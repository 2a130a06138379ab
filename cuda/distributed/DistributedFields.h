// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_distributed_DistributedFields_h
#define limpid_distributed_DistributedFields_h

#include "distributed/Communicator.h"
#include "distributed/ScenePiece.h"
#include "scene/FieldView.h"
#include "scene/NodeValues.h"

#include <memory>
#include <vector>

namespace limpid
{
/// The values of a field in this rank's subdomain, and an array of all nodes for those that the
/// rank needs.
class DistributedField
{
public:
  DistributedField() = default;

  /// Makes the array.
  DistributedField(const FieldView& piece, const Grid& grid)
    : Here(piece)
    , Own(grid.NodeCount())
    , All(this->Own.Data())
  {
  }

  /// Borrows `field` as the array if the subdomain has all nodes.
  DistributedField(float* field, const ScenePiece& piece, const Grid& grid)
    : Here(FieldView::Part(field, piece.nodes))
    , Own(piece.IsWhole() ? NodeValues() : NodeValues(grid.NodeCount()))
    , All(piece.IsWhole() ? field : this->Own.Data())
  {
  }

  const FieldView& Piece() const { return this->Here; }
  float* Values() const { return this->All; }
  bool IsBorrowed() const { return this->Own.Empty(); }

private:
  FieldView Here{};
  NodeValues Own;
  float* All = nullptr;
};

/// The fields of a problem and their distribution among ranks. FieldDistribution delivers the
/// values that a rank needs. The default is that of a process that works alone, with fields in the
/// caller's arrays.
struct DistributedFields
{
  std::shared_ptr<const Communicator> ranks = ThisProcess();
  std::vector<Region> pieces; ///< [rank]: nodes whose values the rank provides
  std::vector<Region> wanted; ///< [rank]: nodes whose results the rank receives
  bool inSlabs = false;       ///< whether work is also done in slabs, see FieldDistribution
  FieldPlaces places = FieldPlaces::Chosen;

  DistributedField base;                    ///< [1/length]
  DistributedField importance;              ///< [0, 1]
  DistributedField nodeImportance;          ///< [0, 1]
  std::vector<DistributedField> references; ///< one per further pull of the problem [1/length]

  /// Whether all values that this process needs are in place already.
  bool AreInPlace() const { return this->base.IsBorrowed(); }
};
}

#endif
