// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Interpolates a coarse picture at the pixels of a finer one, bilinearly like a texture.

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
  /// `coarse`: must outlive this object; `frame`: of the coarse picture; `fine`: frame of the finer
  /// one.
  EnlargedPicture(const Picture& coarse, const PictureFrame& frame, const PictureFrame& fine);

  /// Returns a channel at a pixel of the finer frame [0, 255].
  float At(int column, int row, std::size_t channel) const
  {
    const Between& x = this->Places[0][std::size_t(column)];
    const Between& y = this->Places[1][std::size_t(row)];
    const float low = this->Along(x, y.first, channel);
    return low + y.fraction * (this->Along(x, y.second, channel) - low);
  }

  /// Returns whose part is foremost there or nearby, see Picture.
  std::int32_t ForemostAt(int column, int row) const;

  /// Returns the whole picture, rounded.
  Picture Whole() const;

private:
  /// Position of a pixel of the finer picture between two of the coarse one.
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
  std::array<std::vector<Between>, 2> Places; ///< for columns and rows
};
}

#endif
