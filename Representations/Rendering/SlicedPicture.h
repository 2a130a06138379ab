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

  /// What the picture is to show.
  struct Wanted
  {
    View view;
    std::vector<float> depth;  ///< where its rays end, in clip coordinates
    std::uint64_t changes = 0; ///< state of what casts them, see Renderer::Changes
  };

  /// Whether it has shown that until now.
  bool Shows(const Wanted& wanted) const;

  /// It begins anew, in so many slices.
  void Begin(Wanted wanted, int numberOfSlices);

  /// Makes slices as long as there is time, at least one, if any is left. Returns whether none was
  /// aborted.
  bool Advance(const std::function<bool()>& isOutOfTime, const Cast& cast);

  bool IsComplete() const
  {
    return this->Goal.view.height > 0 && this->Rows == this->Goal.view.height;
  }
  const Picture& Whole() const { return this->Made; }
  void Clear();

private:
  Wanted Goal;
  int RowsOfSlice = 1;
  int Rows = 0; ///< that are made
  Picture Made;
};
}

#endif
