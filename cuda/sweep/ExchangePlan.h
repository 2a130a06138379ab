// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_ExchangePlan_h
#define limpid_sweep_ExchangePlan_h

#include "backend/Communicator.h"
#include "scene/NodeBox.h"
#include "sweep/FaceFrustum.h"
#include "sweep/Occupancy.h"

#include <array>
#include <memory>
#include <vector>

namespace limpid
{
class BandDecomposition;

/// A set of nodes of a grid, given as boxes, which may overlap.
using Region = std::vector<NodeBox>;

/// One box per rank.
std::vector<Region> RegionsOf(const std::vector<NodeBox>& boxes);

/// Returns the nodes that a rank owns in the sweep of a frustum. No other rank changes them.
Region RegionChanged(const FaceFrustum& frustum, const BandDecomposition& bands, int rank);

/// Returns the nodes that a rank owns or reads in the sweep of a frustum.
Region RegionNeeded(const FaceFrustum& frustum, const BandDecomposition& bands, int rank);

/// A strided field: the value of node (i, j, k) is values[i stride.x + j stride.y + k stride.z].
struct FieldView
{
  float* values;
  std::array<Index, 3> stride;

  /// View of a field that holds all nodes of a grid.
  static FieldView Whole(float* values, const Int3& nodes)
  {
    return { values, { { 1, nodes.x, Index(nodes.x) * nodes.y } } };
  }

  /// View of a field that holds only the nodes of a box.
  static FieldView Part(float* values, const NodeBox& box)
  {
    FieldView view = Whole(values, box.Size());
    if (!box.Empty()) // otherwise `values` may be null
    {
      view.values -= view.At(box.along[0].begin, box.along[1].begin, box.along[2].begin);
    }
    return view;
  }

  Index At(int i, int j, int k) const
  {
    return i * this->stride[0] + j * this->stride[1] + k * this->stride[2];
  }
};

/// Calls what(first node of a row, count) for the filled parts of the rows of a box. `axis`:
/// direction of the rows, 0 or 1. If `filled` is null, whole rows are visited.
template <class What>
void ForRowsOf(const NodeBox& box, const Occupancy* filled, const What& what, int axis = 0)
{
  const Range<int>& along = box.along[std::size_t(axis)];
  const Range<int>& beside = box.along[std::size_t(1 - axis)];
  for (int k = box.along[2].begin; k < box.along[2].end; ++k)
  {
    for (int number = beside.begin; number < beside.end; ++number)
    {
      const Range<int> row =
        filled ? Intersection(along, filled->Row(axis, number, k).filled) : along;
      if (!row.Empty())
      {
        what(axis == 0 ? Int3(row.begin, number, k) : Int3(number, row.begin, k), row.Length());
      }
    }
  }
}

/// Returns `field`, or the address of a dummy value if it is null because the subdomain is empty.
template <class Value>
Value* There(Value* field)
{
  static float none = 0;
  return field ? field : &none;
}

/// Sets the values of a box of nodes.
void FillNodes(const NodeBox& box, float value, const FieldView& field);

/// Copies the values of a box, row by row along `axis` (0 or 1). `filled`: outside of it both
/// fields are known to be 0; null if nothing is known.
void CopyNodes(const NodeBox& box, const FieldView& from, const FieldView& to,
  const Occupancy* filled = nullptr, int axis = 0);

/// Computes the Occupancy of a distributed scene. `box`: nodes whose values this rank contributes.
Occupancy OccupancyOnRanks(const Communicator& ranks, const Grid& grid, const NodeBox& box,
  const FieldView& extinction, const FieldView& importance, bool skip);

/// Returns the part of a region inside a box.
Region Intersection(const Region& region, const NodeBox& box);

/// Message buffers, to be reused by consecutive exchanges.
struct ExchangeBuffers
{
  std::vector<std::vector<float>> sent;     ///< [rank]
  std::vector<std::vector<float>> received; ///< [rank]
};

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
  static std::vector<Communicator::Message> MessagesOf(const std::vector<WithRank>& passing,
    std::size_t fields, std::vector<std::vector<float>>& values);

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
