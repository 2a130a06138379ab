// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "sweep/PyramidOnDevice.h"

#include "backend/Backend.h"

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

StationView ViewOf(const Pyramid& pyramid, int s)
{
  const Station& station = pyramid.stations[std::size_t(s)];
  StationView view{};
  view.slice = station.slice;
  view.scale = station.scale;
  view.layer.front = station.relativeDepth;
  view.ownedColumns = station.ownedColumns;
  view.ownedRows = station.ownedRows;
  if (s < pyramid.LastStation())
  {
    const Station& back = pyramid.stations[std::size_t(s) + 1];
    view.layer = { station.relativeDepth, back.relativeDepth - station.relativeDepth, station.scale,
      back.scale };
    for (int half = 0; half < 2; ++half)
    {
      view.slices[half] = station.planes[0].slices[half];
      view.fractions[half] = station.planes[std::size_t(half)].fraction;
    }
  }
  return view;
}

std::vector<Clip> ClipsOf(const RayAxis& axis)
{
  std::vector<Clip> clips;
  clips.reserve(axis.entry.size());
  for (std::size_t ray = 0; ray < axis.entry.size(); ++ray)
  {
    clips.push_back({ axis.entry[ray], axis.exit[ray] });
  }
  return clips;
}

/// The columns of voxel row `v` at station `s` that rays reach, and of these and the others those
/// that may change.
struct VoxelSpans
{
  Interval work;
  Interval filled;
};

VoxelSpans SpansAt(const Pyramid& pyramid, const Occupancy& occupancy, int s, int v)
{
  const Station& station = pyramid.stations[std::size_t(s)];
  const Interval& rows = station.ownedRows;
  if (station.slice < 0 || v < rows.begin || v >= rows.end)
  {
    return {};
  }
  const Interval filled = SpansOf(pyramid, occupancy, station.slice, v).filled;
  return { FilledRegisters(Intersection(pyramid.VoxelColumns(station, v), station.ownedColumns),
             station.ownedColumns),
    FilledRegisters(Intersection(station.ownedColumns, filled), station.ownedColumns) };
}
}

template <class Device>
PyramidOnDevice<Device>::PyramidOnDevice(std::shared_ptr<Device> device, const Pyramid& pyramid,
  const Grid& grid, const Occupancy& occupancy, Readers readers)
{
  const bool voxels = readers == Readers::RaysAndVoxels;
  const auto count = pyramid.stations.size();
  const auto columns = std::size_t(pyramid.columns);
  const auto rows = std::size_t(pyramid.rows);
  const auto nodesU = voxels ? std::size_t(pyramid.nodesU) : 0;
  const auto nodesV = voxels ? std::size_t(pyramid.nodesV) : 0;
  Packet packet;
  const auto stations = packet.Add<StationView>(count, 1);
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
  const auto work = packet.Add<Interval>(count, rows);
  const auto voxelWork = packet.Add<Interval>(count, nodesV);
  const auto voxelFilled = packet.Add<Interval>(count, nodesV);
  const auto columnClips = packet.Add<Clip>(1, columns);
  const auto rowClips = packet.Add<Clip>(1, rows);
  const auto length = packet.Add<float>(rows, columns);
  const auto shares = packet.Add<double>(rows, columns);
  const auto inView = packet.Add<float>(1, pyramid.inView.size());
  packet.Open();

  ParallelFor(static_cast<Index>(count),
    [&](Index index)
    {
      const auto s = std::size_t(index);
      const Station& station = pyramid.stations[s];
      *packet.Row(stations, s) = ViewOf(pyramid, static_cast<int>(s));
      for (std::size_t half = 0; half < 2; ++half)
      {
        const Plane& plane = station.planes[half];
        packet.Fill(columnIndex, 2 * s + half, plane.rayColumns.index);
        packet.Fill(columnWeight, 2 * s + half, plane.rayColumns.weight);
        packet.Fill(rowIndex, 2 * s + half, plane.rayRows.index);
        packet.Fill(rowWeight, 2 * s + half, plane.rayRows.weight);
      }
      packet.Fill(work, s, station.work);
      if (!voxels)
      {
        return;
      }
      packet.Fill(voxelColumnIndex, s, station.voxelColumns.index);
      packet.Fill(voxelColumnWeight, s, station.voxelColumns.weight);
      packet.Fill(voxelRowIndex, s, station.voxelRows.index);
      packet.Fill(voxelRowWeight, s, station.voxelRows.weight);
      packet.Fill(voxelColumnSides, s, station.columnSides);
      packet.Fill(voxelRowSides, s, station.rowSides);
      packet.Fill(columnEntry, s, station.columnEntry);
      packet.Fill(rowEntry, s, station.rowEntry);
      for (int v = 0; v < pyramid.nodesV; ++v)
      {
        const VoxelSpans spans = SpansAt(pyramid, occupancy, static_cast<int>(s), v);
        packet.Row(voxelWork, s)[v] = spans.work;
        packet.Row(voxelFilled, s)[v] = spans.filled;
      }
    });
  ParallelFor(pyramid.rows, 16,
    [&](Index index)
    {
      const auto row = std::size_t(index);
      const float* lengths = packet.Row(length, row);
      pyramid.FindRayLengths(static_cast<int>(row), packet.Row(length, row));
      for (std::size_t column = 0; column < columns; ++column)
      {
        packet.Row(shares, row)[column] = pyramid.cellMeasure * pyramid.columnAxis.share[column] *
          pyramid.rowAxis.share[row] / double(lengths[column]);
      }
    });
  packet.Fill(columnClips, 0, ClipsOf(pyramid.columnAxis));
  packet.Fill(rowClips, 0, ClipsOf(pyramid.rowAxis));
  packet.Fill(inView, 0, pyramid.inView);
  this->Tables = { std::move(device), packet.Content(), "the plan of a sweep" };

  const unsigned char* base = this->Tables.Data();
  const auto at = [base](auto table)
  {
    using Value = typename decltype(table)::Type;
    return reinterpret_cast<const Value*>(base + table.offset);
  };
  const Index strides[3] = { 1, grid.nodes.x, Index(grid.nodes.x) * grid.nodes.y };
  PyramidView& view = this->Addresses;
  view = {};
  view.nodesU = pyramid.nodesU;
  view.nodesV = pyramid.nodesV;
  view.strideU = strides[pyramid.axisU];
  view.strideV = strides[pyramid.axisV];
  view.strideW = strides[pyramid.axisW];
  view.columns = pyramid.columns;
  view.rows = pyramid.rows;
  view.lastStation = pyramid.LastStation();
  view.firstSlice = pyramid.FirstSlice();
  view.frontDepth = pyramid.FrontDepth();
  view.frontColumns = pyramid.frontColumns;
  view.frontRows = pyramid.frontRows;
  view.stations = at(stations);
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
  view.inView = pyramid.inView.empty() ? nullptr : at(inView);
}

template class PyramidOnDevice<CompiledDevice>;
}
