// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_distributed_ExchangePlan_h
#define limpid_distributed_ExchangePlan_h

#include "distributed/PackedExchange.h"
#include "scene/FieldView.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace limpid
{
/**
 * An exchange plan: redistributes fields from the nodes that each rank has to the nodes that each
 * rank needs. Build it once for fields that are exchanged often.
 */
class ExchangePlan
{
public:
  /// Whether the filled part of every row is stored (more memory) or looked up each time (slower).
  enum class Keep
  {
    Rows,
    Boxes
  };

  /// `filled`: fields are 0 outside of it and need not be sent there; null if nothing is known.
  /// `ranks` and `filled` must outlive this object. `axis`: direction of the rows in messages, 0
  /// or 1.
  ExchangePlan(const Communicator& ranks, const std::vector<Region>& had,
    const std::vector<Region>& needed, const Occupancy* filled = nullptr,
    const std::shared_ptr<ExchangeBuffers>& room = std::make_shared<ExchangeBuffers>(),
    Keep keep = Keep::Rows, int axis = 0);

  /// Source and target of a field that is redistributed.
  struct Field
  {
    FieldView from;
    FieldView to;
  };

  /// Redistributes fields. A rank copies the values that it both has and needs, unless source and
  /// target are the same memory.
  void Bring(const std::vector<Field>& fields) const;

private:
  /// A row of consecutive nodes.
  struct Row
  {
    Int3 first;
    int count;
  };

  /// The exchange between this rank and another one.
  struct WithRank
  {
    Region boxes;
    std::vector<Row> rows; ///< filled parts of the boxes, if they are stored
    std::size_t count = 0; ///< number of values per field
  };

  WithRank Between(const Region& had, const Region& needed) const;
  template <class What>
  void ForRows(const WithRank& passing, const What& what) const;

  const Communicator* All;
  const Occupancy* Filled;
  std::shared_ptr<ExchangeBuffers> Room;
  Keep Kept;
  int Axis;
  std::vector<WithRank> Sent;     ///< [rank]
  std::vector<WithRank> Received; ///< [rank]
  Region Own;                     ///< nodes that this rank both has and needs
};

/// Redistributes a field once, see ExchangePlan.
inline void Spread(const Communicator& ranks, const FieldView& from, const std::vector<Region>& had,
  const FieldView& to, const std::vector<Region>& needed, const Occupancy* filled = nullptr)
{
  ExchangePlan(ranks, had, needed, filled).Bring({ { from, to } });
}
}

#endif
