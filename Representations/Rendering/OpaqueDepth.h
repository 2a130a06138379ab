// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The depths of opaque geometry, where the rays of a volume end.

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

/// A range of depths as in the depth buffer, in [0, 1].
struct DepthRange
{
  float nearest;
  float farthest;

  /// The depth at which a pixel changes gradually from the picture up to the nearest depth to the
  /// picture up to the farthest. It is the nearest depth, or, if two objects are far apart, the end
  /// of the front one.
  float turns;
};

class OpaqueDepth
{
public:
  /// Reads what has been drawn before, in the part of the view that the box covers. Throws if it
  /// cannot be read.
  OpaqueDepth(vtkRenderer* renderer, const ViewGeometry& geometry);

  /// Reduces the depth of each pixel to the least of all processes, and takes the colour there.
  void TakeNearestOf(const Communicator& ranks);

  /// Returns the colour drawn at a pixel of a frame (red, green, blue), if the frame has the pixels
  /// of the view; null if nothing was drawn. Call TakeNearestOf first.
  const std::uint8_t* ColorAt(const PictureFrame& frame, int column, int row) const;

  /// Returns whether nothing was drawn before.
  bool IsEmpty() const { return this->Values.empty(); }

  /// The depths of the pixels of the view that the box covers, row by row, and the size of that
  /// rectangle [pixels].
  const std::vector<float>& OfPixels() const { return this->Values; }
  const std::array<int, 2>& Size() const { return this->Covered; }

  /// Returns for each pixel of a frame the depth of the view's pixel at its centre, in clip
  /// coordinates.
  std::vector<float> InMiddles(const PictureFrame& frame) const;

  /// Returns the geometry that may hide any part of the box, in data coordinates; none if there is
  /// none.
  std::optional<OpaqueGeometry> InBox() const;

  /**
   * Returns for each pixel of a coarse frame the range of depths of those pixels of the view that
   * it contributes to when the picture is interpolated, clipped to that of the box. Empty if every
   * range is a single depth.
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
  std::array<int, 2> Covered; ///< size of the rectangle [pixels]
  std::vector<float> Values;
  std::vector<std::array<std::uint8_t, 4>> Colors;
};

/// The end of a ray that is not to be cast, in clip coordinates.
constexpr float noRay = -2;

/// Converts a depth of the depth buffer to clip coordinates.
inline float ToClip(float depth)
{
  return 2 * depth - 1;
}
}

#endif
