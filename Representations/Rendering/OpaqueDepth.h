// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The depth of opaque geometry, at which the rays of a volume end.

#ifndef limpid_OpaqueDepth_h
#define limpid_OpaqueDepth_h

#include "ViewGeometry.h"

#include "scene/OpaqueGeometry.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

class vtkRenderer;

namespace limpid
{
class Communicator;

/// Depths as in the depth buffer, from 0 to 1.
struct DepthRange
{
  float nearest;
  float farthest;

  /// Up to here a pixel shows what lies before the nearest depth, and from here on gradually what
  /// lies before the farthest: the nearest depth, or, where two things are far apart, the end of
  /// the one in front.
  float turns;
};

class OpaqueDepth
{
public:
  /// Reads what has been drawn before, where the box covers the view. Throws when it cannot be
  /// read.
  OpaqueDepth(vtkRenderer* renderer, const ViewGeometry& geometry);

  /// Makes the depth of each pixel the least of all processes', and takes its colour there.
  void TakeNearestOf(const Communicator& ranks);

  /// The colour that was drawn of a pixel of a frame, red, green and blue, where the frame's pixels
  /// are those of the view; null: nothing was drawn. After TakeNearestOf.
  const std::uint8_t* ColorAt(const PictureFrame& frame, int column, int row) const;

  /// Whether nothing has been drawn before.
  bool IsEmpty() const { return this->Values.empty(); }

  /// The depths of the pixels of the view that the box covers, row by row, and the size of that
  /// rectangle [pixels].
  const std::vector<float>& OfPixels() const { return this->Values; }
  const std::array<int, 2>& Size() const { return this->Covered; }

  /// Returns for each pixel of a frame the depth of the view's pixel at its centre, in clip
  /// coordinates.
  std::vector<float> InMiddles(const PictureFrame& frame) const;

  /// What of it may hide anything of the box, in data coordinates; none: nothing.
  std::optional<OpaqueGeometry> InBox() const;

  /**
   * For each pixel of a coarse frame, the depths of the view's pixels that it gives something to
   * when the picture is interpolated, as far as they are within those of the box. Empty when no
   * pixel has two of them.
   */
  std::vector<DepthRange> RangesOf(const PictureFrame& frame) const;

private:
  struct Pixels
  {
    int first;
    int end; // one past the last
  };
  Pixels FedBy(const PictureFrame& frame, std::size_t axis, int pixel) const;
  std::vector<Pixels> ColumnsFedBy(const PictureFrame& frame) const;
  std::vector<DepthRange> AlongRows(const std::vector<Pixels>& columns) const;
  float TurnOf(const DepthRange& range, const Pixels& columns, const Pixels& rows) const;

  vtkRenderer* Target;
  ViewGeometry Geometry;
  std::array<int, 2> Covered; ///< size [pixels]
  std::vector<float> Values;
  std::vector<std::array<std::uint8_t, 4>> Colors;
};

/// In clip coordinates, where a ray ends that is not to be cast.
constexpr float noRay = -2;

/// From the depth buffer to clip coordinates.
inline float ToClip(float depth)
{
  return 2 * depth - 1;
}
}

#endif
