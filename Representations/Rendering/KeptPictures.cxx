// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "KeptPictures.h"

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

// Not: how a frame comes to its finished picture, and how long that takes.
bool AreSameFrames(const FrameSettings& one, const FrameSettings& other)
{
  return one.optimize == other.optimize && one.measure == other.measure && one.once == other.once &&
    one.paused == other.paused && one.solver == other.solver &&
    AreSameSets(one.views, other.views) && AreSameLights(one.light, other.light) &&
    one.lighting == other.lighting && one.lit == other.lit && one.showMissed == other.showMissed &&
    one.missedColor == other.missedColor;
}

bool AreSameGeometries(const ViewGeometry& one, const ViewGeometry& other)
{
  return one.size == other.size && one.origin == other.origin && one.covered == other.covered &&
    one.nearest == other.nearest && one.farthest == other.farthest &&
    one.clipToData == other.clipToData && one.camera == other.camera;
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
  other.frame.solver.method = Method::Optimized; // as frames of the method Ordinary have it
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
  return slot && slot->subject == subject ? &*slot : nullptr;
}

void KeptPictures::Keep(KeptPicture kept)
{
  this->Slots[kept.subject.frame.optimize ? 1 : 0] = std::move(kept);
}

void KeptPictures::Clear()
{
  *this = KeptPictures();
}
}
