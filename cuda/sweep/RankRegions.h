// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_RankRegions_h
#define limpid_sweep_RankRegions_h

#include "backend/Communicator.h"
#include "scene/NodeBox.h"
#include "sweep/FaceFrustum.h"
#include "sweep/Occupancy.h"

#include <array>
#include <memory>
#include <vector>

namespace limpid
{
class RankBands;

/// Nodes of a grid: those of its boxes, which may overlap.
using Region = std::vector<NodeBox>;

/// Of each rank its box.
std::vector<Region> RegionsOf(const std::vector<NodeBox>& boxes);

/// The nodes that a rank changes in the sweep of a frustum. Nobody else changes them.
Region RegionChanged(const FaceFrustum& frustum, const RankBands& bands, int rank);

/// The nodes that it reads there, or changes.
Region RegionNeeded(const FaceFrustum& frustum, const RankBands& bands, int rank);

/// A field in memory: the value of node (i, j, k) is values[i stride.x + j stride.y + k stride.z].
struct FieldView
{
  float* values;
  std::array<Index, 3> stride;

  /// All nodes of a grid.
  static FieldView Whole(float* values, const Int3& nodes)
  {
    return { values, { { 1, nodes.x, Index(nodes.x) * nodes.y } } };
  }

  /// The nodes of a box alone.
  static FieldView Part(float* values, const NodeBox& box)
  {
    FieldView view = Whole(values, box.Size());
    if (!box.Empty()) // else the values may be null
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

/// Calls what(first node of a row, count) for the rows of a box, as far as they are filled. `axis`:
/// along which, 0 or 1.
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

/// A field of a piece, which is null where that is empty: then there is one all the same.
template <class Value>
Value* There(Value* field)
{
  static float none = 0;
  return field ? field : &none;
}

/// Sets the values of a box of nodes.
void FillNodes(const NodeBox& box, float value, const FieldView& field);

/// Copies the values of a box of nodes, by rows along an axis, 0 or 1. `filled`: where else both
/// fields are 0; null: nowhere.
void CopyNodes(const NodeBox& box, const FieldView& from, const FieldView& to,
  const Occupancy* filled = nullptr, int axis = 0);

/// Of a scene that ranks share: see Occupancy. `box`: whose values this rank's fields have for it.
Occupancy OccupancyOnRanks(const Communicator& ranks, const Grid& grid, const NodeBox& box,
  const FieldView& extinction, const FieldView& importance, bool skip);

/// Those nodes of a region that are in a box.
Region Intersection(const Region& region, const NodeBox& box);

/// What is on its way in an exchange; for one after the other.
struct PassageRoom
{
  std::vector<std::vector<float>> sent;     ///< [rank]
  std::vector<std::vector<float>> received; ///< [rank]
};

/**
 * What passes where ranks have fields, of each a region, and need them, of each another one. To be
 * found once for fields that pass often.
 */
class Passages
{
public:
  /// Whether what is filled of every row is kept, for it takes time to look it up, or memory.
  enum class Keep
  {
    Rows,
    Boxes
  };

  /// `filled`: where else fields are 0, which need not travel; null: nowhere. Ranks and occupancy
  /// have to stay. `axis`: along which rows travel, 0 or 1.
  Passages(const Communicator& ranks, const std::vector<Region>& had,
    const std::vector<Region>& needed, const Occupancy* filled = nullptr,
    const std::shared_ptr<PassageRoom>& room = std::make_shared<PassageRoom>(),
    Keep keep = Keep::Rows, int axis = 0);

  /// Where a field is that passes, and where it comes to.
  struct Field
  {
    FieldView from;
    FieldView to;
  };

  /// Brings fields to those that need them; what a rank needs of its own it copies, unless both are
  /// one.
  void Bring(const std::vector<Field>& fields) const;

private:
  /// Values that follow each other.
  struct Row
  {
    Int3 first;
    int count;
  };

  /// What passes between this rank and another one.
  struct WithRank
  {
    Region boxes;
    std::vector<Row> rows; ///< what is filled of these, if that is kept
    std::size_t count = 0; ///< of values of a field
  };

  WithRank Between(const Region& had, const Region& needed) const;
  template <class What>
  void ForRows(const WithRank& passing, const What& what) const;
  static std::vector<Communicator::Message> MessagesOf(const std::vector<WithRank>& passing,
    std::size_t fields, std::vector<std::vector<float>>& values);

  const Communicator* All;
  const Occupancy* Filled;
  std::shared_ptr<PassageRoom> Room;
  Keep Kept;
  int Axis;
  std::vector<WithRank> Sent;     ///< [rank]
  std::vector<WithRank> Received; ///< [rank]
  Region Own;                     ///< what this rank has and needs
};

/// Brings a field once, see Passages.
inline void Spread(const Communicator& ranks, const FieldView& from, const std::vector<Region>& had,
  const FieldView& to, const std::vector<Region>& needed, const Occupancy* filled = nullptr)
{
  Passages(ranks, had, needed, filled).Bring({ { from, to } });
}
}

#endif
