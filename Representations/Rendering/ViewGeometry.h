// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// From VTK's camera, window and prop to the rays of a picture.

#ifndef limpid_ViewGeometry_h
#define limpid_ViewGeometry_h

#include "render/Renderer.h"
#include "scene/RaySource.h"

#include <algorithm>
#include <array>
#include <vector>

class vtkMatrix4x4;
class vtkRenderer;
class vtkVolume;

namespace limpid
{
/// The matrix of a prop: from data coordinates to world coordinates.
glm::dmat4 DataToWorld(vtkVolume* volume);

/// As VTK has it, row by row.
glm::dmat4 ToMatrix(vtkMatrix4x4* matrix);

Vec3 TransformPoint(const glm::dmat4& matrix, const Vec3& point);

/// How a renderer sees the box of a grid. Lengths of pictures in pixels, from the left and bottom.
struct ViewGeometry
{
  std::array<int, 2> size{ { 0, 0 } };   ///< of the viewport
  std::array<int, 2> origin{ { 0, 0 } }; ///< of the viewport in the window

  /// What of the viewport the box covers: first and one past the last column, then row. Empty
  /// when it is out of view.
  std::array<int, 4> covered{ { 0, 0, 0, 0 } };
  double nearest = 0;  ///< depth of the box where it is nearest, as in the depth buffer [0, 1]
  double farthest = 1; ///< likewise, where it is farthest

  glm::dmat4 clipToData{ 1.0 }; ///< of the viewport

  /// The camera of the whole picture in data coordinates: of both eyes in stereo, of all tiles.
  Camera camera;

  bool IsVisible() const
  {
    return this->covered[0] < this->covered[1] && this->covered[2] < this->covered[3];
  }
};

/// Throws when the prop or the camera flatten everything.
ViewGeometry GeometryOf(vtkRenderer* renderer, vtkVolume* volume, const Grid& grid);

/// The rectangle of a picture with pixels of another size than the view's, and its place.
struct PictureFrame
{
  std::array<int, 2> whole{ { 0, 0 } };  ///< size of a picture of the whole viewport
  std::array<int, 2> origin{ { 0, 0 } }; ///< of the rectangle in it
  std::array<int, 2> size{ { 0, 0 } };   ///< of the rectangle
};

/// The smallest picture that covers the box, with pixels `pixelSize` >= 1 pixels of the view wide.
PictureFrame FrameOf(const ViewGeometry& geometry, double pixelSize);

/// From clip coordinates of the frame to data coordinates.
glm::dmat4 ClipToData(const ViewGeometry& geometry, const PictureFrame& frame);

/// A value for every pixel of a frame: at(column, row) of the view's pixel in its middle, counted
/// in the viewport and within what the box covers.
template <class At>
std::vector<float> ValuesOf(const ViewGeometry& geometry, const PictureFrame& frame, const At& at)
{
  const auto pixelAt = [&](std::size_t axis, int pixel)
  {
    const double place =
      (frame.origin[axis] + pixel + 0.5) * geometry.size[axis] / frame.whole[axis];
    return std::clamp(
      static_cast<int>(place), geometry.covered[2 * axis], geometry.covered[2 * axis + 1] - 1);
  };
  std::vector<float> values;
  values.reserve(std::size_t(frame.size[0]) * std::size_t(frame.size[1]));
  for (int row = 0; row < frame.size[1]; ++row)
  {
    const int viewRow = pixelAt(1, row);
    for (int column = 0; column < frame.size[0]; ++column)
    {
      values.push_back(at(pixelAt(0, column), viewRow));
    }
  }
  return values;
}

/// Whether they differ by no more than rounding.
bool AreSame(const Camera& a, const Camera& b);
bool AreSame(const std::vector<Camera>& a, const std::vector<Camera>& b);
bool AreSame(const Light& a, const Light& b);
}

#endif
