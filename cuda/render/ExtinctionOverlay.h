// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_ExtinctionOverlay_h
#define limpid_render_ExtinctionOverlay_h

#include "backend/DeviceArray.h"
#include "render/DrawnPart.h"
#include "render/OverlayKernels.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace limpid
{
class HostDevice;

/// Moves all nodes. Returns whether the overlay may change anything, that is, whether an extinction
/// other than the base was ever given.
template <class AnyDevice>
bool MoveNodes(AnyDevice& device, const MovedNode& body, bool wasChanged)
{
  device.ForNodes("move the overlay", body.nodes, body);
  return wasChanged || body.base != body.extinction;
}

/// The processor's version determines whether any change is nonzero, so that rays need not read an
/// overlay without effect.
bool MoveNodes(HostDevice& device, const MovedNode& body, bool wasChanged);

/**
 * The result of optimisation and lighting for the volume, on a device. Does not wait.
 *
 * Every node of a grid over the same box has two packed numbers: the share of the transfer
 * function's extinction that is kept [1], and the extinction that is added [majorant]. It also has
 * the light that arrives (ArrivingNode), rounded in the same way [packedOne].
 *
 * The extinction of a sample is kept * mu-bar(s) + added. At a node it equals the optimised
 * extinction. Where nothing was changed it is the transfer function's extinction of the
 * interpolated scalar. What was cleared is also clear between the nodes, for any transfer function;
 * an additive difference of extinctions would leave thin layers there.
 */
template <class AnyDevice>
class ExtinctionOverlay
{
public:
  explicit ExtinctionOverlay(std::shared_ptr<AnyDevice> device)
    : Device(std::move(device))
  {
  }

  /// Moves the change by `share` towards extinction - base. `unit`: the majorant [1/length];
  /// `shown`: out, the extinction that results [1/length]; null: not needed.
  void MoveTo(const DrawnPart& part, const float* base, const float* extinction, float unit,
    double share, float* shown)
  {
    const float rescale = unit > 0 && !this->Empty() ? this->Unit / unit : 1.0f;
    this->Fit(part);
    this->Unit = unit;
    this->HasChange = MoveNodes(*this->Device,
      MovedNode{ part.Nodes().nodes, base, extinction, unit, unit > 0 ? 1 / unit : 0.0f,
        static_cast<float>(share), rescale, this->Numbers.Data(), shown },
      this->HasChange);
  }

  /// Returns the overlay at the nodes of another grid: over the same box, or a part of it.
  DeviceArray<AnyDevice, TwoPacked> On(const Grid& grid) const
  {
    const Grid& here = this->Place.Nodes();
    const Int3 from = here.nodes;
    const bool sameBox = here.HasSameBox(grid);
    const Vec3 first = sameBox ? Vec3(0.0) : here.PointToIndex(grid.origin);
    const Vec3 last =
      sameBox ? Vec3(from - 1) : here.PointToIndex(grid.PointToWorld(Vec3(grid.nodes - 1)));
    DeviceArray<AnyDevice, TwoPacked> numbers(
      this->Device, std::size_t(grid.NodeCount()), "the overlay");
    ResampledNode body{ CellGrid(from), this->Packed(), {}, {}, numbers.Data() };
    for (int axis = 0; axis < 3; ++axis)
    {
      body.first[axis] = float(first[axis]);
      body.scale[axis] = float((last[axis] - first[axis]) / std::max(grid.nodes[axis] - 1, 1));
    }
    this->Device->ForNodes("resample the overlay", grid.nodes, body);
    return numbers;
  }

  /// Continues with other numbers at the nodes of a part. `changed`: see Changed.
  void GoOnWith(const DrawnPart& part, const std::vector<TwoPacked>& numbers, bool changed)
  {
    this->Take(part, { this->Device, numbers, "the overlay" });
    this->HasChange = changed;
  }

  /// Discards change and shadow.
  void Clear() { *this = ExtinctionOverlay(this->Device); }

  /// Drops the light that arrives, which is not read any more.
  void ClearShadow() { this->HasShadow = false; }

  /// Interpolates the light that arrives. `part`: its nodes, those of the overlay or all of another
  /// grid over the whole.
  void SetShadow(const DrawnPart& part, const float* light)
  {
    this->HasShadow = true;
    const Int3 nodes = part.Nodes().nodes;
    const Int3 to = this->Nodes().nodes;
    const Index count = this->Nodes().NodeCount();
    float* shadow = this->Arriving.RoomFor(this->Device, std::size_t(count), "the shadows");
    if (part.HasSameNodes(this->Place))
    {
      this->Device->ForIndices("take shadows", count, ShadowedNode{ light, shadow });
      return;
    }
    const char* what = "interpolated shadows";
    const auto placesOf = [&](int axis)
    {
      std::vector<AxisPlace> places;
      places.reserve(static_cast<std::size_t>(to[axis]));
      const Range<int>& along = this->Place.Box().along[std::size_t(axis)];
      for (int node = along.begin; node < along.end; ++node)
      {
        places.emplace_back(node, nodes[axis], this->Place.Whole().nodes[axis]);
      }
      return DeviceArray<AnyDevice, AxisPlace>(this->Device, places, what);
    };
    const auto columnPlaces = placesOf(0);
    const auto rowPlaces = placesOf(1);
    const auto slicePlaces = placesOf(2);
    const Int3 ofRows(nodes.x, to.y, nodes.z);
    const Int3 ofSlices(nodes.x, to.y, to.z);
    Field rows(this->Device, std::size_t(Index(ofRows.x) * ofRows.y * ofRows.z), what);
    Field slices(this->Device, std::size_t(Index(ofSlices.x) * ofSlices.y * ofSlices.z), what);
    this->Device->ForNodes(
      what, ofRows, InterpolatedAlong{ 1, rowPlaces.Data(), light, nodes, rows.Data() });
    this->Device->ForNodes(what, ofSlices,
      InterpolatedAlong{ 2, slicePlaces.Data(), rows.Data(), ofRows, slices.Data() });
    this->Device->ForNodes("take shadows", to,
      InterpolatedShadowNode{
        { 0, columnPlaces.Data(), slices.Data(), ofSlices, nullptr }, shadow });
  }

  /// Returns the light that arrives at a position [nodes]. Waits.
  double ShadowAt(const Vec3& position) const
  {
    const CellGrid grid(this->Nodes().nodes);
    const float at[3] = { float(position.x), float(position.y), float(position.z) };
    const CellPlace place(grid, at);
    float corners[8];
    for (int corner = 0; corner < 8; ++corner)
    {
      const Index node = place.cell + (corner & 1) + (corner >> 1 & 1) * grid.stride[1] +
        (corner >> 2) * grid.stride[2];
      this->Device->Download(&corners[corner], this->Shadow() + node, sizeof(float));
    }
    return InCell(CellGrid({ 2, 2, 2 }), corners, place.fraction[0], place.fraction[1],
             place.fraction[2]) /
      packedOne;
  }

  const TwoPacked* Packed() const { return this->Numbers.Data(); }
  const float* Shadow() const { return this->Arriving.Data(); } ///< [packedOne]
  const DrawnPart& Part() const { return this->Place; }
  const Grid& Nodes() const { return this->Place.Nodes(); }
  float Majorant() const { return this->Unit; } ///< unit of the added extinction [1/length]
  bool Empty() const { return this->Numbers.Empty(); }
  bool Changed() const { return this->HasChange; } ///< whether a change may be nonzero
  bool Shadowed() const { return this->HasShadow; }

private:
  using Field = DeviceArray<AnyDevice, float>;

  /// Resizes the overlay to the nodes of a part, and interpolates the present overlay there.
  void Fit(const DrawnPart& part)
  {
    const Grid& grid = part.Nodes();
    const Grid& here = this->Nodes();
    if (!this->Empty() && grid.nodes == here.nodes && grid.spacing == here.spacing &&
      grid.origin == here.origin)
    {
      this->Place = part;
      return;
    }
    this->Take(part, this->Empty() ? this->Unchanged(grid) : this->On(grid));
  }

  DeviceArray<AnyDevice, TwoPacked> Unchanged(const Grid& grid) const
  {
    const Index count = grid.NodeCount();
    DeviceArray<AnyDevice, TwoPacked> numbers(this->Device, std::size_t(count), "the overlay");
    this->Device->ForIndices("clear the overlay", count, UnchangedNode{ numbers.Data() });
    return numbers;
  }

  void Take(const DrawnPart& part, DeviceArray<AnyDevice, TwoPacked> numbers)
  {
    this->Numbers = std::move(numbers);
    this->HasShadow = false;
    this->Place = part;
  }

  std::shared_ptr<AnyDevice> Device;
  DeviceArray<AnyDevice, TwoPacked> Numbers;
  Field Arriving;  ///< see Shadow
  DrawnPart Place; ///< its nodes
  float Unit = 0;
  bool HasChange = false;
  bool HasShadow = false;
};
}

#endif
