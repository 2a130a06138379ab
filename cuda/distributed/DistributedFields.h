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
/// The fields of a distributed problem: their source, and arrays for all nodes of which only those
/// are valid that FieldDistribution delivers.
struct DistributedFields
{
  std::shared_ptr<const Communicator> ranks;
  std::vector<Region> pieces; ///< [rank]: nodes whose values the rank provides
  std::vector<Region> wanted; ///< [rank]: nodes whose results the rank receives
  bool inSlabs = false;       ///< whether work is also done in slabs, see FieldDistribution
  FieldPlaces places = FieldPlaces::Chosen;

  /// The values of a field in this rank's subdomain, and an array for all values that the rank
  /// needs.
  struct Field
  {
    FieldView piece;
    NodeValues values;
  };
  Field base;                    ///< [1/length]
  Field importance;              ///< [0, 1]
  Field nodeImportance;          ///< [0, 1]
  std::vector<Field> references; ///< one per further pull of the problem [1/length]
};
}

#endif
