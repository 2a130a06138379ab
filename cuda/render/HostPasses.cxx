// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Passes with a special version for the processor.

#include "backend/HostDevice.h"
#include "backend/Interruption.h"
#include "render/ExtinctionOverlay.h"
#include "render/HostTrace.h"
#include "render/RayLanes.h"
#include "render/Raycast.h"

#include <algorithm>
#include <atomic>

namespace limpid
{
namespace
{
constexpr int tileWidth = 4; // pixels
constexpr int tileHeight = RayLanes::count / tileWidth;
constexpr int tilesAtATime = 8; ///< neighbours along a row, which read the same nodes

/// Traces rays of a scene by a kind of compositing.
class Tracer
{
public:
  Tracer(const RayScene& scene, Compositing compositing)
    : Scene(scene)
    , BeginsAtObject(compositing == Compositing::FromObject)
    , Trace(compositing == Compositing::ImportanceMean ? HostTraceImportanceMean(scene)
                                                       : HostTraceFrontToBack(scene))
  {
  }

  void operator()(const Ray& ray, HostPixel& pixel) const
  {
    this->Trace(this->Scene, this->BeginsAtObject ? this->PartOf(ray) : ray, pixel);
  }

private:
  Ray PartOf(const Ray& ray) const
  {
    return RunMultiversioned(
      [&]() LIMPID_INLINE_LAMBDA { return PartFromObject<BlockSampler>(this->Scene, ray); });
  }

  const RayScene& Scene;
  bool BeginsAtObject;
  TraceOneRay Trace;
};

template <bool overlaid>
RayImportance Gather(const RayScene& scene, const Ray& ray)
{
  return RunMultiversioned(
    [&]() LIMPID_INLINE_LAMBDA { return TraceMissed<BlockSampler, overlaid>(scene, ray); });
}

/// Pixels from (left, bottom) to (right - 1, top - 1).
struct Tile
{
  int left;
  int bottom;
  int right;
  int top;

  /// Calls action(column, row) for all pixels.
  template <class Action>
  void ForPixels(const Action& action) const
  {
    for (int row = this->bottom; row < this->top; ++row)
    {
      for (int column = this->left; column < this->right; ++column)
      {
        action(column, row);
      }
    }
  }
};

/// Calls action(tile) for all tiles of a picture. Can be interrupted, and tells the share that has
/// been done.
template <class Action>
void ForTiles(const PictureRays& rays, const Action& action)
{
  const int across = (rays.columns + tileWidth - 1) / tileWidth;
  const int down = (rays.rows + tileHeight - 1) / tileHeight;
  const int tasks = (across + tilesAtATime - 1) / tilesAtATime;
  const Index count = Index(tasks) * down;
  std::atomic<Index> finished{ 0 };
  ParallelFor(count,
    [&](Index task)
    {
      Interruptible::Check(double(finished) / double(count));
      const int bottom = int(task / tasks) * tileHeight;
      const int first = int(task % tasks) * tilesAtATime;
      for (int column = first; column < std::min(first + tilesAtATime, across); ++column)
      {
        const int left = column * tileWidth;
        action(Tile{ left, bottom, std::min(left + tileWidth, rays.columns),
          std::min(bottom + tileHeight, rays.rows) });
      }
      ++finished;
    });
}

/// Advances the beginnings of RayLanes::count rays past empty bricks.
void SkipEmptyFronts(const BrickDistances& bricks, Ray* rays)
{
  std::int32_t begins[RayLanes::count];
  RunMultiversioned(
    [&]() LIMPID_INLINE_LAMBDA
    {
      const RayLanes lanes(rays);
      BrickWalk<RayLanes>(bricks, lanes).SkipEmpty(lanes.begin).Store(begins);
    });
  for (int i = 0; i < RayLanes::count; ++i)
  {
    rays[i].begin = begins[i];
    rays[i].skipped = true;
  }
}

void CastTile(const RayScene& scene, const PictureRays& rays, const Tracer& trace, const Tile& tile)
{
  Ray all[RayLanes::count];
  const auto of = [&](int column, int row) -> Ray&
  { return all[(row - tile.bottom) * tileWidth + column - tile.left]; };
  tile.ForPixels([&](int column, int row) { rays.Make(column, row, of(column, row)); });
  if (scene.bricks.distance)
  {
    SkipEmptyFronts(scene.bricks, all);
  }
  tile.ForPixels(
    [&](int column, int row)
    {
      const Ray& ray = of(column, row);
      HostPixel received;
      if (ray.begin < ray.segments)
      {
        trace(ray, received);
      }
      rays.Show(column, row, ray, received);
    });
}
}

void CastRays(HostDevice&, const RayScene& scene, const PictureRays& rays, Compositing compositing)
{
  const Tracer trace(scene, compositing);
  ForTiles(rays, [&](const Tile& tile) { CastTile(scene, rays, trace, tile); });
}

void PaintMissed(
  HostDevice&, const RayScene& scene, const PictureRays& rays, const MissedPaint& paint)
{
  const auto gather = scene.overlay ? Gather<true> : Gather<false>;
  ForTiles(rays,
    [&](const Tile& tile)
    {
      tile.ForPixels([&](int column, int row)
        { rays.Paint(column, row, paint, [&](const Ray& ray) { return gather(scene, ray); }); });
    });
}

bool MoveNodes(HostDevice& device, const MovedNode& body, bool)
{
  std::atomic<bool> changed{ false };
  device.ForRows("move the overlay", body.nodes,
    [&](Index first, int j, int k)
    {
      const MovedNode moved = body; // a copy, which cannot alias the output
      bool any = false;
      for (int i = 0; i < moved.nodes.x; ++i)
      {
        any |= moved.Move(first + i, i, j, k);
      }
      for (int i = 0; i < moved.nodes.x && moved.shown; ++i)
      {
        moved.Tell(first + i);
      }
      if (any)
      {
        changed = true;
      }
    });
  return changed;
}
}
