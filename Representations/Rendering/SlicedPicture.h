// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A picture that is made in several frames, so that none of them takes long.

#ifndef limpid_SlicedPicture_h
#define limpid_SlicedPicture_h

#include "render/Renderer.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace limpid
{
/// Each slice is some rows of the picture. Together they have the same bits as the picture that is
/// made at once.
class SlicedPicture
{
public:
  /// Makes a picture with the rays of a view. Returns null where that was aborted.
  using Cast = std::function<const Picture*(const View&)>;

  /**
   * What the picture is to show: a view, where its rays end in clip coordinates, and the state of
   * what casts them (Renderer::Changes). If that is not what it has shown until now, it begins
   * anew, in so many slices.
   */
  void Begin(const View& view, std::vector<float> depth, std::uint64_t changes, int numberOfSlices);

  /// Makes slices for so many seconds, at least one, if any is left. Returns whether none was
  /// aborted.
  bool Advance(double seconds, const Cast& cast);

  bool IsComplete() const { return this->Rays.height > 0 && this->Rows == this->Rays.height; }
  const Picture& Whole() const { return this->Made; }
  void Clear();

private:
  View Rays;
  std::vector<float> Depth;
  std::uint64_t Changes = 0;
  int RowsOfSlice = 1;
  int Rows = 0; ///< that are made
  Picture Made;
};
}

#endif
