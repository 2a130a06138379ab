// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A coarse picture at the pixels of a finer one, interpolated as a texture is.

#ifndef limpid_EnlargedPicture_h
#define limpid_EnlargedPicture_h

#include "ViewGeometry.h"

#include "render/Renderer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace limpid
{
class EnlargedPicture
{
public:
  /// `coarse`: stays with the caller; `frame`: its own; `fine`: that of the finer one.
  EnlargedPicture(const Picture& coarse, const PictureFrame& frame, const PictureFrame& fine);

  /// A channel of a pixel of the finer frame [0, 255].
  float At(int column, int row, std::size_t channel) const
  {
    const Between& x = this->Places[0][std::size_t(column)];
    const Between& y = this->Places[1][std::size_t(row)];
    const float low = this->Along(x, y.first, channel);
    return low + y.fraction * (this->Along(x, y.second, channel) - low);
  }

  /// Whose part is foremost there, or nearby, see Picture.
  std::int32_t ForemostAt(int column, int row) const;

  /// All of it, rounded.
  Picture Whole() const;

private:
  /// Where a pixel of the finer picture lies between two of the coarse one.
  struct Between
  {
    int first;
    int second;
    float fraction;
  };

  static std::vector<Between> PlacesOf(
    std::size_t axis, const PictureFrame& fine, const PictureFrame& coarse);

  float Along(const Between& x, int row, std::size_t channel) const
  {
    const std::uint8_t* values =
      this->Coarse->rgba.data() + 4 * std::size_t(row) * std::size_t(this->Coarse->width) + channel;
    const float left = values[4 * std::size_t(x.first)];
    const float right = values[4 * std::size_t(x.second)];
    return left + x.fraction * (right - left);
  }

  const Picture* Coarse;
  std::array<std::vector<Between>, 2> Places; ///< of columns and rows
};
}

#endif
