// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A picture that is computed over several frames, so that none of them takes long.

#ifndef limpid_SlicedPicture_h
#define limpid_SlicedPicture_h

#include "render/Renderer.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace limpid
{
/// Each slice is a number of rows. Together they equal the picture computed at once, bit by bit.
class SlicedPicture
{
public:
  /// Computes a picture with the rays of a view. Returns null if aborted.
  using Cast = std::function<const Picture*(const View&)>;

  /// The content of the picture.
  struct Wanted
  {
    View view;
    std::vector<float> depth;  ///< ends of its rays in clip coordinates
    std::uint64_t changes = 0; ///< version of what the rays see, see Renderer::Changes
  };

  /// Returns whether the picture has this content.
  bool Shows(const Wanted& wanted) const;

  /// Starts a new picture, in this number of slices.
  void Begin(Wanted wanted, int numberOfSlices);

  /// Computes slices while there is time, at least one if any is left. Returns false if one was
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
  int Rows = 0; ///< number of finished rows
  Picture Made;
};
}

#endif
