// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "KeptPictures.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace limpid
{
namespace
{
bool AreSameSets(const ViewSet& one, const ViewSet& other)
{
  return one.kind == other.kind && one.count == other.count && one.eyeAngle == other.eyeAngle;
}

bool AreSameLights(const ChosenLight& one, const ChosenLight& other)
{
  return one.found == other.found && one.light == other.light &&
    one.movesWithCamera == other.movesWithCamera && one.description == other.description;
}

// Compares settings, except those of the way to the finished picture and its time.
bool AreSameFrames(const FrameSettings& one, const FrameSettings& other)
{
  return one.optimize == other.optimize && one.measure == other.measure && one.once == other.once &&
    one.paused == other.paused && one.solver == other.solver &&
    AreSameSets(one.views, other.views) && AreSameLights(one.light, other.light) &&
    one.lighting == other.lighting && one.lit == other.lit && one.drawOn == other.drawOn &&
    one.showMissed == other.showMissed && one.missedColor == other.missedColor &&
    one.structureColors == other.structureColors && one.colorsOfRows == other.colorsOfRows;
}

bool AreSameGeometries(const ViewGeometry& one, const ViewGeometry& other)
{
  return one.size == other.size && one.origin == other.origin && one.covered == other.covered &&
    one.nearest == other.nearest && one.farthest == other.farthest &&
    one.clipToData == other.clipToData && one.camera == other.camera;
}

// Returns whether two subjects may be tiles of one picture, or the pictures of two eyes.
bool MayBeTilesOfOne(const PictureSubject& one, const PictureSubject& other)
{
  return one.data == other.data && one.found == other.found &&
    AreSameFrames(one.frame, other.frame) && one.geometry.size == other.geometry.size &&
    AreSame(one.geometry.camera, other.geometry.camera);
}

// Size up to which tiles are kept: a picture of 7680 x 4320 pixels. With opaque geometry, its
// depths take as much again.
constexpr std::size_t MostBytes = std::size_t(4) * 7680 * 4320;

std::size_t BytesOf(const std::vector<KeptPicture>& tiles)
{
  return std::accumulate(tiles.begin(), tiles.end(), std::size_t(0),
    [](std::size_t bytes, const KeptPicture& tile) { return bytes + tile.picture.rgba.size(); });
}
}

bool AreSameRays(const View& one, const View& other)
{
  return one.width == other.width && one.height == other.height &&
    one.clipToWorld == other.clipToWorld && one.planes == other.planes &&
    one.sampleDistance == other.sampleDistance && one.jitter == other.jitter;
}

PictureSubject PictureSubject::WithoutOptimization() const
{
  PictureSubject other = *this;
  other.frame.optimize = false;
  other.frame.solver.method = Method::Optimized; // as in frames of the method Ordinary
  other.found = 0;
  return other;
}

bool operator==(const PictureSubject& one, const PictureSubject& other)
{
  return one.data == other.data && one.found == other.found &&
    AreSameFrames(one.frame, other.frame) && AreSameGeometries(one.geometry, other.geometry) &&
    AreSameRays(one.rays, other.rays) && one.depth == other.depth;
}

const KeptPicture* KeptPictures::Find(const PictureSubject& subject) const
{
  const std::optional<KeptPicture>& slot = this->Slots[subject.frame.optimize ? 1 : 0];
  if (slot && slot->subject == subject)
  {
    return &*slot;
  }
  const auto tile = std::find_if(this->Tiles.begin(), this->Tiles.end(),
    [&](const KeptPicture& kept) { return kept.subject == subject; });
  return tile != this->Tiles.end() ? &*tile : nullptr;
}

void KeptPictures::Keep(KeptPicture kept)
{
  this->Slots[kept.subject.frame.optimize ? 1 : 0] = std::move(kept);
}

void KeptPictures::KeepTile(KeptPicture kept)
{
  const auto isOfAnother = [&](const KeptPicture& other)
  { return !MayBeTilesOfOne(other.subject, kept.subject); };
  this->Tiles.erase(
    std::remove_if(this->Tiles.begin(), this->Tiles.end(), isOfAnother), this->Tiles.end());
  this->Tiles.push_back(std::move(kept));
  while (BytesOf(this->Tiles) > MostBytes)
  {
    this->Tiles.erase(this->Tiles.begin());
  }
}
}
