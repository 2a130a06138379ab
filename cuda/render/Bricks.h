// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_Bricks_h
#define limpid_render_Bricks_h

#include "backend/DeviceArray.h"
#include "render/RayScene.h"
#include "scene/IndexBox.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace limpid
{
/// The largest distance that is distinguished; it must fit into a byte.
constexpr int farthestBrick = 255;

/// The box of nodes from which the cells of a brick are interpolated.
struct BrickNodes
{
  Int3 first;
  Int3 last;

  /// `brick`: index of the brick along each axis; `nodes`: of the grid.
  LIMPID_HD static LIMPID_INLINE BrickNodes Of(const Int3& brick, const Int3& nodes)
  {
    const Int3 low = BrickDistances::size * brick;
    return { low, glm::min(low + BrickDistances::size, nodes - 1) };
  }

  /// Returns whether is(node) holds for any node of the box in a grid of `nodes`.
  template <class Is>
  LIMPID_HD LIMPID_INLINE bool Any(const Int3& nodes, const Is& is) const
  {
    return IndexBox{ this->first, this->last }.Any(nodes, is);
  }
};

/// Nodes along an axis.
struct NodeSpan
{
  int first;
  int last; ///< included
};

/// The nodes of an overlay from which the cells of bricks may be interpolated, along each axis.
struct OverlaySpans
{
  Int3 nodes{ 0 };               ///< of the overlay
  const NodeSpan* along[3] = {}; ///< one per brick

  LIMPID_HD LIMPID_INLINE IndexBox Of(int i, int j, int k) const
  {
    const NodeSpan& x = this->along[0][i];
    const NodeSpan& y = this->along[1][j];
    const NodeSpan& z = this->along[2][k];
    return { { x.first, y.first, z.first }, { x.last, y.last, z.last } };
  }
};

struct ScalarRange
{
  float least = 3.4e38f;
  float most = -3.4e38f;

  LIMPID_HD LIMPID_INLINE void Include(float value)
  {
    this->least = std::min(this->least, value);
    this->most = std::max(this->most, value);
  }
};

/// Computes the range of the scalars at the nodes of a brick.
struct RangeOfBrick
{
  Int3 nodes;
  ScalarNodes scalars;
  ScalarRange* ranges; ///< out

  LIMPID_HD void operator()(Index brick, int i, int j, int k) const
  {
    ScalarRange range;
    BrickNodes::Of({ i, j, k }, this->nodes)
      .Any(this->nodes,
        [&](Index node)
        {
          range.Include(this->scalars.At(node));
          return false;
        });
    this->ranges[brick] = range;
  }
};

/// Whether bricks whose extinction was cleared completely count as empty.
enum class Cleared
{
  IsEmpty,
  IsNot
};

/// Whether the transfer function has the same extinction for all scalars. Then a segment is empty
/// if both of its ends are at nodes without a share of that extinction. If it varies, a segment may
/// have extinction if only one of its ends is at such nodes.
enum class Function
{
  Varies,
  IsUniform
};

/// Writes 0 for a brick that may have extinction, else the largest distance.
struct EmptyBrick
{
  OpticalTable table;
  const ScalarRange* ranges;
  const std::uint8_t* unfilled; ///< not 0 where no node is filled; null: only scalars decide
  const TwoPacked* overlay;     ///< see ExtinctionOverlay; null: unchanged
  OverlaySpans spans;
  Cleared cleared;
  std::uint8_t* distance; ///< out

  LIMPID_HD void operator()(Index brick, int i, int j, int k) const
  {
    const ScalarRange range = this->ranges[brick];
    const bool classified = !(this->unfilled && this->unfilled[brick] != 0) &&
      this->table.LargestBetween(
        this->table.axis.Position(range.least), this->table.axis.Position(range.most)) > 0;
    bool filled = classified;
    if (this->overlay)
    {
      filled = this->spans.Of(i, j, k).Any(this->spans.nodes,
        [&](Index node)
        {
          const std::int16_t* change = this->overlay[node].values;
          const bool kept = change[0] > 0 || this->cleared == Cleared::IsNot;
          return (classified && kept) || change[1] > 0;
        });
    }
    this->distance[brick] = filled ? 0 : farthestBrick;
  }
};

/// Writes 0 for a brick where a field is above zero at any node, else the largest distance.
struct ZeroBrick
{
  Int3 nodes;
  const float* field;
  std::uint8_t* distance; ///< out

  LIMPID_HD void operator()(Index brick, int i, int j, int k) const
  {
    const bool any = BrickNodes::Of({ i, j, k }, this->nodes)
                       .Any(this->nodes, [this](Index node) { return this->field[node] > 0; });
    this->distance[brick] = any ? 0 : farthestBrick;
  }
};

/// Computes one axis of the Chebyshev distance to the nearest zero: the distance is the maximum of
/// those along the previous axes and along this one.
struct SpreadBrick
{
  Int3 bricks;
  int axis;
  const std::uint8_t* before; ///< distances along the previous axes
  std::uint8_t* distance;     ///< out

  LIMPID_HD void operator()(Index brick, int i, int j, int k) const
  {
    const int at = this->axis == 0 ? i : (this->axis == 1 ? j : k);
    const int count =
      this->axis == 0 ? this->bricks.x : (this->axis == 1 ? this->bricks.y : this->bricks.z);
    const Index stride = this->axis == 0
      ? 1
      : (this->axis == 1 ? Index(this->bricks.x) : Index(this->bricks.x) * this->bricks.y);
    const int toEnd = at < count - 1 - at ? count - 1 - at : at; // bricks farther away do not exist
    int least = this->before[brick];
    for (int way = 1; way < least && way <= toEnd; ++way)
    {
      for (int side = -1; side <= 1; side += 2)
      {
        const int other = at + side * way;
        if (other >= 0 && other < count)
        {
          const int there = this->before[brick + side * way * stride];
          const int reached = there > way ? there : way;
          least = reached < least ? reached : least;
        }
      }
    }
    this->distance[brick] = static_cast<std::uint8_t>(least);
  }
};

/**
 * Finds the empty parts of a volume on a device: bricks of `size` cells along each axis. Does not
 * wait.
 *
 * A brick is empty if no scalar and no change that are possible in its cells give an extinction
 * above zero; for a function with a single extinction, its shares at the nodes decide. Neighbouring
 * bricks share their nodes, so their ranges of scalars overlap: a segment between samples in two
 * empty neighbours has no extinction either.
 */
template <class AnyDevice>
class Bricks
{
public:
  explicit Bricks(std::shared_ptr<AnyDevice> device)
    : Device(std::move(device))
  {
  }

  /// Computes the ranges of the scalars at the nodes of a grid, and where none of them is filled.
  /// `filled`: see ScalarField; null: all nodes are.
  void SetScalars(const Int3& nodes, const ScalarNodes& scalars, const float* filled)
  {
    constexpr int size = BrickDistances::size;
    this->Nodes = nodes;
    this->Count = (nodes + (size - 2)) / size;
    ScalarRange* ranges = this->Ranges.RoomFor(this->Device, this->Total(), "the bricks");
    this->Device->ForNodes("ranges of bricks", this->Count, RangeOfBrick{ nodes, scalars, ranges });
    this->Unfilled = {};
    if (filled)
    {
      std::uint8_t* unfilled = this->Unfilled.RoomFor(this->Device, this->Total(), "the bricks");
      this->Device->ForNodes("unfilled bricks", this->Count, ZeroBrick{ nodes, filled, unfilled });
    }
  }

  /// Computes the distances to non-empty bricks. `overlay`: at `overlayPlace`; null: no change.
  void FindEmpty(const OpticalTable& table, Function function, const TwoPacked* overlay,
    const OverlayGeometry& overlayPlace)
  {
    this->Find(this->Distance, table, function, overlay, overlayPlace, Cleared::IsEmpty);
  }

  /// Computes the distances to bricks that are not empty even without the change.
  void FindBare(const OpticalTable& table, Function function, const TwoPacked* overlay,
    const OverlayGeometry& overlayPlace)
  {
    this->Find(this->BareDistance, table, function, overlay, overlayPlace, Cleared::IsNot);
  }

  /// Computes the distances to bricks with important nodes, at the nodes of the scalars.
  void FindUnimportant(const float* importance)
  {
    this->Spread(this->UnimportantDistance,
      [&](std::uint8_t* out) {
        return ZeroBrick{ this->Nodes, importance, out };
      });
  }

  /// Frees the memory of the distances to bare and to unimportant bricks.
  void ForgetImportance()
  {
    this->BareDistance = {};
    this->UnimportantDistance = {};
  }

  BrickDistances Distances() const
  {
    return BrickDistances::Of(this->Nodes, this->Distance.Data());
  }

  BrickDistances BareDistances() const
  {
    return BrickDistances::Of(this->Nodes, this->BareDistance.Data());
  }

  BrickDistances UnimportantDistances() const
  {
    return BrickDistances::Of(this->Nodes, this->UnimportantDistance.Data());
  }

private:
  using DistanceArray = DeviceArray<AnyDevice, std::uint8_t>;

  void Find(DistanceArray& distances, const OpticalTable& table, Function function,
    const TwoPacked* overlay, const OverlayGeometry& overlayPlace, Cleared cleared)
  {
    const std::uint8_t* unfilled =
      function == Function::IsUniform ? this->Unfilled.Data() : nullptr;
    const OverlaySpans spans = overlay ? this->SpansOn(overlayPlace) : OverlaySpans();
    this->Spread(distances,
      [&](std::uint8_t* out) {
        return EmptyBrick{ table, this->Ranges.Data(), unfilled, overlay, spans, cleared, out };
      });
  }

  OverlaySpans SpansOn(const OverlayGeometry& place)
  {
    OverlaySpans spans;
    spans.nodes = place.nodes;
    const bool isKnown = this->SpansAreOf == place && this->SpansAreFor == this->Nodes;
    for (int axis = 0; axis < 3; ++axis)
    {
      DeviceArray<AnyDevice, NodeSpan>& along = this->Spans[std::size_t(axis)];
      if (!isKnown)
      {
        along = { this->Device, this->SpansAlong(axis, place), "the bricks" };
      }
      spans.along[axis] = along.Data();
    }
    this->SpansAreOf = place;
    this->SpansAreFor = this->Nodes;
    return spans;
  }

  std::vector<NodeSpan> SpansAlong(int axis, const OverlayGeometry& place) const
  {
    std::vector<NodeSpan> spans;
    const int last = place.nodes[axis] - 1;
    for (int brick = 0; brick < this->Count[axis]; ++brick)
    {
      const BrickNodes cells = BrickNodes::Of(Int3(brick), this->Nodes);
      const auto on = [&](int node) { return (node + place.first[axis]) * place.scale[axis]; };
      const int from = int(std::floor(on(cells.first[axis]) - 1e-6));
      const int to = int(std::ceil(on(cells.last[axis]) + 1e-6));
      spans.push_back({ glm::clamp(from, 0, last), glm::clamp(to, 0, last) });
    }
    return spans;
  }

  /// Computes distances from flags of empty bricks. `emptyInto(out)`: creates the body that writes
  /// the flags.
  template <class EmptyInto>
  void Spread(DistanceArray& distances, const EmptyInto& emptyInto)
  {
    const char* what = "the bricks";
    std::uint8_t* distance = distances.RoomFor(this->Device, this->Total(), what);
    std::uint8_t* other = this->OtherDistance.RoomFor(this->Device, this->Total(), what);
    this->Device->ForNodes("empty bricks", this->Count, emptyInto(other));
    const auto spread = [&](int axis, const std::uint8_t* from, std::uint8_t* to)
    {
      this->Device->ForNodes(
        "distances of bricks", this->Count, SpreadBrick{ this->Count, axis, from, to });
    };
    spread(0, other, distance);
    spread(1, distance, other);
    spread(2, other, distance);
  }

  std::size_t Total() const
  {
    return std::size_t(Index(this->Count.x) * this->Count.y * this->Count.z);
  }

  std::shared_ptr<AnyDevice> Device;
  Int3 Nodes{ 0 };
  Int3 Count{ 0 };
  DeviceArray<AnyDevice, ScalarRange> Ranges;
  std::array<DeviceArray<AnyDevice, NodeSpan>, 3> Spans; ///< see OverlaySpans
  OverlayGeometry SpansAreOf;
  Int3 SpansAreFor{ 0 };  ///< nodes of the scalars
  DistanceArray Unfilled; ///< empty: all nodes are filled
  DeviceArray<AnyDevice, std::uint8_t> Distance;
  DeviceArray<AnyDevice, std::uint8_t> BareDistance;        ///< empty: not requested
  DeviceArray<AnyDevice, std::uint8_t> UnimportantDistance; ///< empty: not requested
  DeviceArray<AnyDevice, std::uint8_t> OtherDistance;       ///< temporary, between axes
};
}

#endif
