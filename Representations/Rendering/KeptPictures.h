// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The finished pictures of a view at rest with and without optimisation, so that either can be
// shown again at once.

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
  FrameSettings frame; ///< of it, what a finished picture depends on
  ViewGeometry geometry;
  View rays;                ///< of the picture in full resolution, but for where they end
  std::vector<float> depth; ///< where they end, in clip coordinates; empty: at the end of the range
  std::array<std::uint64_t, 4> data{}; ///< versions of scalars, functions, importance and scene
  std::uint64_t found = 0;             ///< version of what was optimised; 0: the picture is without

  /// The subject of the picture without optimisation beside it.
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
  /// The finished picture of a subject; null: it was not kept.
  const KeptPicture* Find(const PictureSubject& subject) const;

  /// The last one with optimisation; null: there is none.
  const KeptPicture* Optimized() const { return this->Slots[1] ? &*this->Slots[1] : nullptr; }

  /// In place of the last one with, or without, optimisation.
  void Keep(KeptPicture kept);

  void Clear();

private:
  std::array<std::optional<KeptPicture>, 2> Slots; ///< without and with optimisation
};

/// Whether two views have the same rays, but for where these begin and end.
bool AreSameRays(const View& one, const View& other);
}

#endif
