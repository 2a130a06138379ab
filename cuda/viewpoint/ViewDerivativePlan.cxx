// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/ViewDerivativePlan.h"

#include "backend/Backend.h"
#include "sweep/RayFormulas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace limpid
{
namespace
{
using Plan = OwnedTables<ViewDerivativePlan>;

/// Returns the edges of rays along an axis, from one before the first ray's first edge to one
/// after the last ray's last edge.
std::vector<double> EdgesOf(const Lateral& lateral)
{
  std::vector<double> edges;
  for (int edge = -1; edge < lateral.count + 2; ++edge)
  {
    edges.push_back(lateral.Edge(edge));
  }
  return edges;
}

/// Returns the weights of four values, at `places`, for the derivative at `at` of the cubic
/// through them.
std::array<double, 4> DerivativeWeights(const double places[4], double at)
{
  std::array<double, 4> weights{};
  for (std::size_t i = 0; i < 4; ++i)
  {
    double scale = 1;
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
    {
      if (k == i)
      {
        continue;
      }
      scale /= places[i] - places[k];
      double product = 1;
      for (std::size_t m = 0; m < 4; ++m)
      {
        product *= m == i || m == k ? 1.0 : at - places[m];
      }
      sum += product;
    }
    weights[i] = scale * sum;
  }
  return weights;
}

void FillStencil(
  const Lateral& lateral, const std::vector<double>& edges, const Table<float>& table, Plan& plan)
{
  for (int ray = 0; ray < lateral.count; ++ray)
  {
    const std::array<double, 4> weights =
      DerivativeWeights(&edges[std::size_t(ray)], lateral.Coordinate(ray));
    for (int k = 0; k < 4; ++k)
    {
      plan.Room(table, k)[ray] = static_cast<float>(weights[std::size_t(k)]);
    }
  }
}

/// Maps some ray coordinates to voxels on a plane.
void FillMap(const Lateral& lateral, const std::vector<double>& coordinates, const Range<int>& some,
  double depth, const MapTable& table, Index plane, Plan& plan)
{
  int* index = plan.Room(table.index, plane);
  float* weight = plan.Room(table.weight, plane);
  const double last = lateral.nodes - 2;
  for (int i = some.begin; i < some.end; ++i)
  {
    const double position = lateral.Position(coordinates[std::size_t(i)], depth);
    const double node = std::min(std::max(std::floor(position), 0.0), last);
    *index++ = static_cast<int>(node);
    *weight++ = static_cast<float>(position - node);
  }
}

constexpr int between = 3; // number of edges minus number of rays

void FillPlanes(const PlannedFrustum& frustum, Plan& plan)
{
  const Lateral& u = frustum.lateralU;
  const Lateral& v = frustum.lateralV;
  const std::vector<double> edgesU = EdgesOf(u);
  const std::vector<double> edgesV = EdgesOf(v);
  FillStencil(u, edgesU, plan.columnStencil, plan);
  FillStencil(v, edgesV, plan.rowStencil, plan);
  const int perLayer = 2 * plan.parts;
  ParallelFor(Index(frustum.lastSlice) * perLayer, 8,
    [&](Index plane)
    {
      const auto s = static_cast<int>(plane / perLayer);
      const int part = static_cast<int>(plane / 2 % plan.parts);
      const double front = frustum.SliceAt(s).depth;
      const double back = frustum.SliceAt(s + 1).depth;
      const double depth = front + (part + gaussPoints[plane % 2]) * (back - front) / plan.parts;
      plan.Room(plan.fractions)[plane] = static_cast<float>(1.0 - (back - depth));
      plan.Room(plan.perIndex)[plane] = u.parallel ? 1.0f : static_cast<float>(1 / depth);
      const Range<int>& columns = frustum.SliceAt(s).rayColumns;
      const Range<int>& rows = frustum.SliceAt(s).rayRows;
      FillMap(u, u.Coordinates(), columns, depth, plan.columns, plane, plan);
      FillMap(v, v.Coordinates(), rows, depth, plan.rows, plane, plan);
      FillMap(
        u, edgesU, { columns.begin, columns.end + between }, depth, plan.columnEdges, plane, plan);
      FillMap(v, edgesV, { rows.begin, rows.end + between }, depth, plan.rowEdges, plane, plan);
    });
}

/// Computes the action of a move along u, v and depth [index] on the rays.
void FillMove(const PlannedFrustum& frustum, int m, const Vec3& move, Plan& plan)
{
  plan.moveAcross[m] = static_cast<float>(move.x);
  plan.moveDepth[m] = static_cast<float>(move.z);
  // If the eye is inside the medium, moving it along a ray leaves some medium behind.
  const bool atEye = frustum.SliceAt(0).node < 0;
  plan.moveFront[m] = atEye ? static_cast<float>(-move.z) : 0.0f;
  const Vec3& h = frustum.spacing;
  float* side = plan.Room(plan.moveSide, m);
  float* along = plan.Room(plan.moveAlong, m);
  for (int row = 0; row < frustum.rows; ++row)
  {
    const double b = frustum.lateralV.Slope(row);
    const RowLength length(h, b);
    const double down = move.y - b * move.z;
    plan.Room(plan.moveDown, m)[row] = static_cast<float>(down);
    plan.Room(plan.moveRow, m)[row] = b != 0 ? static_cast<float>(down / b) : 0.0f;
    const Range<int>& columns = frustum.ColumnsOf(row);
    for (int column = columns.begin; column < columns.end; ++column)
    {
      const double a = frustum.lateralU.Slope(column);
      const double across = move.x - a * move.z;
      const double size = length.Of(a);
      *side++ = a != 0 ? static_cast<float>(across / a * size) : 0.0f;
      *along++ =
        static_cast<float>((a * h.x * across * h.x + b * h.y * down * h.y) / (size * size));
    }
  }
}

void MakeTables(const PlannedFrustum& frustum, Plan& plan)
{
  const int rays = static_cast<int>(frustum.RayCount());
  const Index planes = Index(frustum.lastSlice) * 2 * plan.parts;
  TableRoom room;
  room.Add(plan.fractions, 1, static_cast<int>(planes));
  room.Add(plan.perIndex, 1, static_cast<int>(planes));
  int columns = 0;
  int rows = 0;
  for (int s = 0; s < frustum.lastSlice; ++s)
  {
    columns = std::max(columns, frustum.SliceAt(s).rayColumns.Length());
    rows = std::max(rows, frustum.SliceAt(s).rayRows.Length());
  }
  room.Add(plan.columns, planes, columns);
  room.Add(plan.rows, planes, rows);
  room.Add(plan.columnEdges, planes, columns + between);
  room.Add(plan.rowEdges, planes, rows + between);
  room.Add(plan.columnStencil, 4, frustum.columns);
  room.Add(plan.rowStencil, 4, frustum.rows);
  room.Add(plan.columnSlope, 1, frustum.columns);
  room.Add(plan.moveDown, 2, frustum.rows);
  room.Add(plan.moveRow, 2, frustum.rows);
  room.Add(plan.moveSide, 2, rays);
  room.Add(plan.moveAlong, 2, rays);
  room.Give(plan);
}
}

OwnedTables<ViewDerivativePlan> PlanViewDerivative(
  const PlannedFrustum& frustum, const Grid& grid, const EyeMoves& by, int parts)
{
  Plan plan;
  plan.parts = parts;
  MakeTables(frustum, plan);
  FillPlanes(frustum, plan);
  for (int column = 0; column < frustum.columns; ++column)
  {
    plan.Room(plan.columnSlope)[column] = static_cast<float>(frustum.lateralU.Slope(column));
  }
  plan.parallel = frustum.lateralU.parallel;
  plan.front = frustum.frontDepth;
  plan.depth = static_cast<float>(frustum.SliceAt(frustum.firstNodeSlice).depth);
  plan.inverse = static_cast<float>(1 / by.distance);
  const int* nodes = frustum.SliceAt(0).nodes;
  const double sign = nodes[1] - nodes[0]; // positive if depth grows with the index
  for (int m = 0; m < 2; ++m)
  {
    const Vec3 move = grid.DirectionToIndex(by.moves[m]);
    FillMove(
      frustum, m, { move[frustum.axisU], move[frustum.axisV], sign * move[frustum.axisW] }, plan);
  }
  return plan;
}
}
