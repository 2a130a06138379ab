// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_FieldsOfRanks_h
#define limpid_optimize_FieldsOfRanks_h

#include "backend/Communicator.h"
#include "scene/NodeValues.h"
#include "scene/ScenePiece.h"
#include "sweep/RankRegions.h"

#include <memory>
#include <vector>

namespace limpid
{
/// The fields of a problem that ranks share, where they come from and where they are: arrays of all
/// nodes that have values where TermsOnRanks brings them.
struct FieldsOfRanks
{
  std::shared_ptr<const Communicator> ranks;
  std::vector<Region> pieces; ///< the nodes whose values ranks have at first
  std::vector<Region> wanted; ///< those whose results they get
  bool inSlabs = false;       ///< whether there is work in slabs, too, see TermsOnRanks
  FieldPlaces places = FieldPlaces::Chosen;

  /// A field's values in this rank's piece, and an array for what this rank needs.
  struct Field
  {
    FieldView piece;
    NodeValues values;
  };
  Field base;           ///< [1/length]
  Field importance;     ///< [0, 1]
  Field nodeImportance; ///< [0, 1]
  Field previous;       ///< see Problem::previous [1/length]; no values: null
};
}

#endif
