// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Converts VTK's camera, window and prop to the rays of a picture.

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
/// Returns the matrix of a prop, from data coordinates to world coordinates.
glm::dmat4 DataToWorld(vtkVolume* volume);

/// Converts a matrix of VTK, which is stored row by row.
glm::dmat4 ToMatrix(vtkMatrix4x4* matrix);

Vec3 TransformPoint(const glm::dmat4& matrix, const Vec3& point);

/// The box of a grid as a renderer sees it. Positions in pictures are in pixels from the lower left
/// corner.
struct ViewGeometry
{
  std::array<int, 2> size{ { 0, 0 } };   ///< size of the viewport
  std::array<int, 2> origin{ { 0, 0 } }; ///< lower left corner of the viewport in the window

  /// The part of the viewport that the box covers: first and one past the last column, then row.
  /// Empty if it is out of view.
  std::array<int, 4> covered{ { 0, 0, 0, 0 } };
  double nearest = 0;  ///< nearest depth of the box, as in the depth buffer [0, 1]
  double farthest = 1; ///< farthest depth of the box, as in the depth buffer [0, 1]

  glm::dmat4 clipToData{ 1.0 }; ///< clip coordinates of the viewport

  /// The camera of the whole picture in data coordinates; in stereo of both eyes, and of all tiles.
  Camera camera;

  bool IsVisible() const
  {
    return this->covered[0] < this->covered[1] && this->covered[2] < this->covered[3];
  }
};

/// Throws if the matrix of the prop or of the camera is singular. Of a box out of view it returns
/// no more than that.
ViewGeometry GeometryOf(vtkRenderer* renderer, vtkVolume* volume, const Grid& grid);

/// The rectangle of a picture whose pixels may be larger than the view's.
struct PictureFrame
{
  std::array<int, 2> whole{ { 0, 0 } };  ///< size of a picture of the whole viewport
  std::array<int, 2> origin{ { 0, 0 } }; ///< lower left corner of the rectangle in it
  std::array<int, 2> size{ { 0, 0 } };   ///< size of the rectangle
};

/// Returns the smallest frame that covers the box, with pixels `pixelSize` >= 1 pixels of the view
/// wide.
PictureFrame FrameOf(const ViewGeometry& geometry, double pixelSize);

/// Returns the matrix from clip coordinates of the frame to data coordinates.
glm::dmat4 ClipToData(const ViewGeometry& geometry, const PictureFrame& frame);

/// Returns a value for every pixel of a frame: at(column, row) for the pixel of the view at its
/// centre, counted in the viewport and clamped to what the box covers.
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

/// Returns whether two cameras are equal up to rounding.
bool AreSame(const Camera& a, const Camera& b);
bool AreSame(const std::vector<Camera>& a, const std::vector<Camera>& b);
bool AreSame(const Light& a, const Light& b);
}

#endif
