// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Keeps the finished pictures of a still view with and without optimisation, so that either can be
// shown again at once, and the tiles of the last whole picture, so that they are not computed again
// if it is drawn over another background.

#ifndef limpid_KeptPictures_h
#define limpid_KeptPictures_h

#include "Frame.h"
#include "ViewGeometry.h"

#include "render/Renderer.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace limpid
{
/// Everything that a finished picture depends on.
struct PictureSubject
{
  FrameSettings frame; ///< the settings that a finished picture depends on
  ViewGeometry geometry;
  View rays;                ///< rays of the picture at full resolution, except their ends
  std::vector<float> depth; ///< ends of the rays in clip coordinates; empty: the end of the range
  std::array<std::uint64_t, 3> data{}; ///< versions of scalars, functions and scene
  std::uint64_t found = 0;             ///< version of the optimisation; 0: picture without it

  /// Returns the subject of the picture without optimisation of this view.
  PictureSubject WithoutOptimization() const;
};

bool operator==(const PictureSubject& one, const PictureSubject& other);

struct KeptPicture
{
  PictureSubject subject;
  Picture picture;
  FrameResult result;
  FrameMessages messages;
};

class KeptPictures
{
public:
  /// Returns the finished picture of a subject; null if it was not kept.
  const KeptPicture* Find(const PictureSubject& subject) const;

  /// Returns the last picture with optimisation; null if there is none.
  const KeptPicture* Optimized() const { return this->Slots[1] ? &*this->Slots[1] : nullptr; }

  /// Replaces the last picture with, or without, optimisation.
  void Keep(KeptPicture kept);

  /// Adds a tile: a part of a picture that is drawn in several frames, or all of it. Discards those
  /// of other pictures.
  void KeepTile(KeptPicture kept);
  void ClearTiles() { this->Tiles.clear(); }

private:
  std::array<std::optional<KeptPicture>, 2> Slots; ///< without and with optimisation
  std::vector<KeptPicture> Tiles;
};

/// Returns whether two views have the same rays, except where these begin and end.
bool AreSameRays(const View& one, const View& other);
}

#endif
