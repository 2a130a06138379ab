// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "sweep/FrustumOnDevice.h"

#include "backend/Backend.h"
#include "sweep/Registers.h"

#include <algorithm>
#include <vector>

namespace limpid
{
namespace
{
/// Tables that travel to a device together.
class Packet
{
public:
  template <class Value>
  struct Table
  {
    using Type = Value;
    std::size_t offset;
    std::size_t rowLength;
  };

  template <class Value>
  Table<Value> Add(std::size_t rows, std::size_t rowLength)
  {
    constexpr std::size_t alignment = 256;
    const Table<Value> table{ this->Size, rowLength };
    const std::size_t end = this->Size + rows * rowLength * sizeof(Value);
    this->Size = (end + alignment - 1) / alignment * alignment;
    return table;
  }

  /// Makes room for all tables that were added.
  void Open() { this->Bytes.assign(this->Size, 0); }

  template <class Value>
  Value* Row(const Table<Value>& table, std::size_t row)
  {
    return reinterpret_cast<Value*>(this->Bytes.data() + table.offset) + row * table.rowLength;
  }

  template <class Value>
  void Fill(const Table<Value>& table, std::size_t row, const std::vector<Value>& values)
  {
    std::copy(values.begin(), values.end(), this->Row(table, row));
  }

  const std::vector<unsigned char>& Content() const { return this->Bytes; }

private:
  std::size_t Size = 0;
  std::vector<unsigned char> Bytes;
};

SliceView ViewOf(const FaceFrustum& frustum, int s)
{
  const Slice& slice = frustum.slices[std::size_t(s)];
  SliceView view{};
  view.node = slice.node;
  view.scale = slice.scale;
  view.layer.front = slice.relativeDepth;
  view.ownedColumns = slice.ownedColumns;
  view.ownedRows = slice.ownedRows;
  if (s < frustum.LastSlice())
  {
    const Slice& back = frustum.slices[std::size_t(s) + 1];
    view.layer = { slice.relativeDepth, back.relativeDepth - slice.relativeDepth, slice.scale,
      back.scale };
    for (int half = 0; half < 2; ++half)
    {
      view.nodes[half] = slice.planes[0].nodes[half];
      view.fractions[half] = slice.planes[std::size_t(half)].fraction;
    }
  }
  return view;
}

std::vector<Range<float>> ClipsOf(const RayAxis& axis)
{
  std::vector<Range<float>> clips;
  clips.reserve(axis.entry.size());
  for (std::size_t ray = 0; ray < axis.entry.size(); ++ray)
  {
    clips.push_back({ axis.entry[ray], axis.exit[ray] });
  }
  return clips;
}

/// The columns of voxel row `v` at slice `s` that rays reach, and of these and the others those
/// that may change.
struct VoxelSpans
{
  Range<int> work;
  Range<int> filled;
};

VoxelSpans SpansAt(const FaceFrustum& frustum, const Occupancy& occupancy, int s, int v)
{
  const Slice& slice = frustum.slices[std::size_t(s)];
  const Range<int>& rows = slice.ownedRows;
  if (slice.node < 0 || v < rows.begin || v >= rows.end)
  {
    return {};
  }
  const Range<int> filled = SpansOf(frustum, occupancy, slice.node, v).filled;
  return { WholeRegisters(
             Intersection(frustum.VoxelColumns(slice, v), slice.ownedColumns), slice.ownedColumns),
    WholeRegisters(Intersection(slice.ownedColumns, filled), slice.ownedColumns) };
}
}

template <class Device>
FrustumOnDevice<Device>::FrustumOnDevice(std::shared_ptr<Device> device, const FaceFrustum& frustum,
  const Grid& grid, const Occupancy& occupancy, Readers readers)
{
  const bool voxels = readers == Readers::RaysAndVoxels;
  const auto count = frustum.slices.size();
  const auto columns = std::size_t(frustum.columns);
  const auto rows = std::size_t(frustum.rows);
  const auto nodesU = voxels ? std::size_t(frustum.nodesU) : 0;
  const auto nodesV = voxels ? std::size_t(frustum.nodesV) : 0;
  Packet packet;
  const auto slices = packet.Add<SliceView>(count, 1);
  const auto columnIndex = packet.Add<int>(2 * count, columns);
  const auto columnWeight = packet.Add<float>(2 * count, columns);
  const auto rowIndex = packet.Add<int>(2 * count, rows);
  const auto rowWeight = packet.Add<float>(2 * count, rows);
  const auto voxelColumnIndex = packet.Add<int>(count, nodesU);
  const auto voxelColumnWeight = packet.Add<float>(count, nodesU);
  const auto voxelRowIndex = packet.Add<int>(count, nodesV);
  const auto voxelRowWeight = packet.Add<float>(count, nodesV);
  const auto voxelColumnSides = packet.Add<float>(count, nodesU);
  const auto voxelRowSides = packet.Add<float>(count, nodesV);
  const auto columnEntry = packet.Add<float>(count, nodesU);
  const auto rowEntry = packet.Add<float>(count, nodesV);
  const auto work = packet.Add<Range<int>>(count, rows);
  const auto voxelWork = packet.Add<Range<int>>(count, nodesV);
  const auto voxelFilled = packet.Add<Range<int>>(count, nodesV);
  const auto columnClips = packet.Add<Range<float>>(1, columns);
  const auto rowClips = packet.Add<Range<float>>(1, rows);
  const auto length = packet.Add<float>(rows, columns);
  const auto shares = packet.Add<double>(rows, columns);
  const auto inView = packet.Add<float>(1, frustum.inView.size());
  packet.Open();

  ParallelFor(static_cast<Index>(count),
    [&](Index index)
    {
      const auto s = std::size_t(index);
      const Slice& slice = frustum.slices[s];
      *packet.Row(slices, s) = ViewOf(frustum, static_cast<int>(s));
      for (std::size_t half = 0; half < 2; ++half)
      {
        const Plane& plane = slice.planes[half];
        packet.Fill(columnIndex, 2 * s + half, plane.rayColumns.index);
        packet.Fill(columnWeight, 2 * s + half, plane.rayColumns.weight);
        packet.Fill(rowIndex, 2 * s + half, plane.rayRows.index);
        packet.Fill(rowWeight, 2 * s + half, plane.rayRows.weight);
      }
      packet.Fill(work, s, slice.work);
      if (!voxels)
      {
        return;
      }
      packet.Fill(voxelColumnIndex, s, slice.voxelColumns.index);
      packet.Fill(voxelColumnWeight, s, slice.voxelColumns.weight);
      packet.Fill(voxelRowIndex, s, slice.voxelRows.index);
      packet.Fill(voxelRowWeight, s, slice.voxelRows.weight);
      packet.Fill(voxelColumnSides, s, slice.columnSides);
      packet.Fill(voxelRowSides, s, slice.rowSides);
      packet.Fill(columnEntry, s, slice.columnEntry);
      packet.Fill(rowEntry, s, slice.rowEntry);
      for (int v = 0; v < frustum.nodesV; ++v)
      {
        const VoxelSpans spans = SpansAt(frustum, occupancy, static_cast<int>(s), v);
        packet.Row(voxelWork, s)[v] = spans.work;
        packet.Row(voxelFilled, s)[v] = spans.filled;
      }
    });
  ParallelFor(frustum.rows, 16,
    [&](Index index)
    {
      const auto row = std::size_t(index);
      const float* lengths = packet.Row(length, row);
      frustum.FindRayLengths(static_cast<int>(row), packet.Row(length, row));
      for (std::size_t column = 0; column < columns; ++column)
      {
        packet.Row(shares, row)[column] = frustum.cellMeasure * frustum.columnAxis.share[column] *
          frustum.rowAxis.share[row] / double(lengths[column]);
      }
    });
  packet.Fill(columnClips, 0, ClipsOf(frustum.columnAxis));
  packet.Fill(rowClips, 0, ClipsOf(frustum.rowAxis));
  packet.Fill(inView, 0, frustum.inView);
  this->Tables = { std::move(device), packet.Content(), "the plan of a sweep" };

  const unsigned char* base = this->Tables.Data();
  const auto at = [base](auto table)
  {
    using Value = typename decltype(table)::Type;
    return reinterpret_cast<const Value*>(base + table.offset);
  };
  const Index strides[3] = { 1, grid.nodes.x, Index(grid.nodes.x) * grid.nodes.y };
  FrustumView& view = this->Addresses;
  view = {};
  view.nodesU = frustum.nodesU;
  view.nodesV = frustum.nodesV;
  view.strideU = strides[frustum.axisU];
  view.strideV = strides[frustum.axisV];
  view.strideW = strides[frustum.axisW];
  view.columns = frustum.columns;
  view.rows = frustum.rows;
  view.lastSlice = frustum.LastSlice();
  view.firstNodeSlice = frustum.FirstNodeSlice();
  view.frontDepth = frustum.FrontDepth();
  view.frontColumns = frustum.frontColumns;
  view.frontRows = frustum.frontRows;
  view.slices = at(slices);
  view.planeColumns = { at(columnIndex), at(columnWeight) };
  view.planeRows = { at(rowIndex), at(rowWeight) };
  view.voxelColumns = { at(voxelColumnIndex), at(voxelColumnWeight) };
  view.voxelRows = { at(voxelRowIndex), at(voxelRowWeight) };
  view.voxelColumnSides = at(voxelColumnSides);
  view.voxelRowSides = at(voxelRowSides);
  view.voxelColumnEntry = at(columnEntry);
  view.voxelRowEntry = at(rowEntry);
  view.work = at(work);
  view.voxelWork = at(voxelWork);
  view.voxelFilled = at(voxelFilled);
  view.columnClips = at(columnClips);
  view.rowClips = at(rowClips);
  view.length = at(length);
  view.shares = at(shares);
  view.inView = frustum.inView.empty() ? nullptr : at(inView);
}

template class FrustumOnDevice<CompiledDevice>;
}
