// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ViewGeometry.h"

#include "Vectors.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include "math/Require.h"
#include "scene/GridCorners.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
// VTK's own matrices have view z from -1 to 1. An explicit projection matrix, which IceT sets, has
// the same range.
glm::dmat4 ProjectionOf(vtkRenderer* renderer, bool bothEyes)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const vtkTypeBool stereo = camera->GetStereo();
  if (bothEyes && stereo)
  {
    // The matrix that VTK picks with has no shear for an eye; it includes the view.
    vtkNew<vtkMatrix4x4> composite;
    composite->DeepCopy(
      camera->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
    return ToMatrix(composite) * glm::inverse(ToMatrix(camera->GetViewTransformMatrix()));
  }
  return ToMatrix(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
}

glm::dmat4 Inverse(const glm::dmat4& matrix, const char* whose)
{
  const glm::dmat4 inverse = glm::inverse(matrix);
  bool finite = true;
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      finite &= std::isfinite(inverse[column][row]);
    }
  }
  LIMPID_REQUIRE(finite,
    "The matrix of the " << whose << " has the determinant " << glm::determinant(matrix)
                         << " (it must be invertible to map pixels to rays). Check scale, "
                            "orientation, position and clipping range.");
  return inverse;
}

// Returns the viewport of the renderer in clip coordinates of this window's part of it: left,
// right, bottom, top. It is larger than the clip range if the window is a tile of a larger picture.
std::array<double, 4> WholeViewport(vtkRenderer* renderer)
{
  std::array<double, 4> whole{ { -1, 1, -1, 1 } };
  double tile[4] = { 0, 0, 1, 1 };
  renderer->GetRenderWindow()->GetTileViewport(tile);
  const double* viewport = renderer->GetViewport();
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double first = std::max(viewport[axis], tile[axis]);
    const double last = std::min(viewport[axis + 2], tile[axis + 2]);
    const bool tiled = tile[axis] > 0 || tile[axis + 2] < 1;
    if (tiled && last > first)
    {
      whole[2 * axis] = 2 * (viewport[axis] - first) / (last - first) - 1;
      whole[2 * axis + 1] = 2 * (viewport[axis + 2] - first) / (last - first) - 1;
    }
  }
  return whole;
}

bool IsParallel(const glm::dmat4& projection)
{
  const double perspective =
    glm::length(Vec3(projection[0][3], projection[1][3], projection[2][3]));
  return !(perspective > 1e-12 * std::abs(projection[3][3]));
}

// Returns the eye and the corners of a picture from its matrix, however it was composed: the eye is
// the point that is mapped to infinity along the view direction. The result does not depend on the
// clipping range.
Camera CameraOfMatrix(
  const glm::dmat4& clipToData, bool parallel, const Grid& grid, const std::array<double, 4>& whole)
{
  const auto at = [&clipToData](double x, double y, double z)
  { return TransformPoint(clipToData, Vec3(x, y, z)); };

  // The centre of the whole picture may differ from that of a tile.
  const double x = 0.5 * (whole[0] + whole[1]);
  const double y = 0.5 * (whole[2] + whole[3]);
  Camera camera;
  camera.parallel = parallel;
  const Vec3 direction = glm::normalize(at(x, y, 1) - at(x, y, -1));
  if (parallel)
  {
    const Vec3 front = at(x, y, -1);
    const double depth = glm::dot(grid.Centre() - front, direction);
    camera.position = front + (depth - 2 * grid.Radius()) * direction;
    camera.focalPoint = front + depth * direction;
  }
  else
  {
    const glm::dvec4 eye = clipToData * glm::dvec4(0, 0, 1, 0);
    camera.position = Vec3(eye) / eye.w;
    const double distance = glm::distance(grid.Centre(), camera.position);
    camera.focalPoint = camera.position + std::max(distance, grid.Radius()) * direction;
  }
  camera.viewUp = glm::normalize(at(0, 1, 0) - at(0, -1, 0));
  camera.corners = { at(whole[0], whole[2], 0), at(whole[1], whole[2], 0),
    at(whole[1], whole[3], 0), at(whole[0], whole[3], 0) };
  return camera;
}

// Replaces numbers that the matrix has only rounded by the exact ones of VTK's camera.
void TakeExactPlace(vtkCamera* source, const glm::dmat4& worldToData, Camera& camera)
{
  const Vec3 position = TransformPoint(worldToData, ToVec3(source->GetPosition()));
  const Vec3 focalPoint = TransformPoint(worldToData, ToVec3(source->GetFocalPoint()));
  const double distance = glm::distance(position, focalPoint);
  const Vec3 direction = (focalPoint - position) / distance;
  const Vec3 seen = glm::normalize(camera.focalPoint - camera.position);
  const bool sameDirection = glm::distance(direction, seen) < 1e-6;
  const bool samePlace =
    camera.parallel || glm::distance(position, camera.position) < 1e-6 * distance;
  if (distance > 0 && sameDirection && samePlace)
  {
    camera.position = position;
    camera.focalPoint = focalPoint;
  }
}

// Moves the corners to the plane through the focal point; their original plane depends on the
// clipping range.
void PlaceCorners(Camera& camera)
{
  const double distance = glm::distance(camera.position, camera.focalPoint);
  const Vec3 forward = (camera.focalPoint - camera.position) / distance;
  for (Vec3& corner : camera.corners)
  {
    const Vec3 ray = corner - camera.position;
    const double depth = glm::dot(ray, forward);
    if (camera.parallel)
    {
      corner += (distance - depth) * forward;
    }
    else if (depth > 0)
    {
      corner = camera.position + distance / depth * ray;
    }
  }
}

// Computes the part of the viewport that the box covers, and the range of its depths.
void Cover(const glm::dmat4& dataToClip, const Grid& grid, ViewGeometry& geometry)
{
  Vec3 low(1e300);
  Vec3 high(-1e300);
  bool behind = false;
  bool allBehind = true;
  for (const Vec3& corner : CornersOf(grid))
  {
    const glm::dvec4 clip = dataToClip * glm::dvec4(corner, 1.0);
    behind |= !(clip.w > 0);
    allBehind &= clip.w <= 0;
    low = glm::min(low, Vec3(clip) / clip.w);
    high = glm::max(high, Vec3(clip) / clip.w);
  }
  if (allBehind)
  {
    return;
  }
  if (behind)
  {
    // The box extends behind the eye: it may cover any pixel.
    low = Vec3(-1.0);
    high = Vec3(1.0);
  }
  if (!(low.z <= 1 && high.z >= -1))
  {
    return; // outside of the clipping range
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    const double pixels = geometry.size[std::size_t(axis)];
    const auto pixel = [pixels](double clip)
    { return static_cast<int>(std::min(std::max(0.5 * (clip + 1) * pixels, 0.0), pixels)); };
    geometry.covered[2 * std::size_t(axis)] = pixel(low[axis]);
    geometry.covered[2 * std::size_t(axis) + 1] =
      high[axis] >= -1 && low[axis] <= 1 ? std::min(pixel(high[axis]) + 1, int(pixels)) : 0;
  }
  geometry.nearest = std::clamp(0.5 * (low.z + 1), 0.001, 0.999);
  geometry.farthest = std::clamp(0.5 * (high.z + 1), geometry.nearest, 1.0);
}

// Tolerance: a hundredth of a pixel of the largest pictures. The cameras of tiles, in which VTK
// makes pictures larger than the window, equal those of the whole picture only to 3e-8, since VTK
// uses 3.1415926 for pi there.
bool AreClose(const Vec3& a, const Vec3& b, double size)
{
  return glm::distance(a, b) <= 1e-6 * size;
}
}

glm::dmat4 ToMatrix(vtkMatrix4x4* matrix)
{
  glm::dmat4 result;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      result[column][row] = matrix->GetElement(row, column);
    }
  }
  return result;
}

glm::dmat4 DataToWorld(vtkVolume* volume)
{
  vtkNew<vtkMatrix4x4> matrix;
  volume->GetModelToWorldMatrix(matrix); // takes the coordinate system of the prop into account
  return ToMatrix(matrix);
}

Vec3 TransformPoint(const glm::dmat4& matrix, const Vec3& point)
{
  const glm::dvec4 transformed = matrix * glm::dvec4(point, 1.0);
  return Vec3(transformed) / transformed.w;
}

ViewGeometry GeometryOf(vtkRenderer* renderer, vtkVolume* volume, const Grid& grid)
{
  ViewGeometry geometry;
  renderer->GetTiledSizeAndOrigin(
    &geometry.size[0], &geometry.size[1], &geometry.origin[0], &geometry.origin[1]);
  if (geometry.size[0] < 1 || geometry.size[1] < 1)
  {
    return geometry;
  }

  vtkCamera* camera = renderer->GetActiveCamera();
  const glm::dmat4 dataToWorld = DataToWorld(volume);
  const glm::dmat4 worldToData = Inverse(dataToWorld, "volume");
  const glm::dmat4 dataToView = ToMatrix(camera->GetModelViewTransformMatrix()) * dataToWorld;
  const glm::dmat4 dataToClip = ProjectionOf(renderer, false) * dataToView;
  Cover(dataToClip, grid, geometry);
  if (!geometry.IsVisible())
  {
    return geometry; // with everything behind the camera, ParaView's clipping range has no depth
  }
  geometry.clipToData = Inverse(dataToClip, "camera");
  const glm::dmat4 projection = ProjectionOf(renderer, true);
  geometry.camera = CameraOfMatrix(Inverse(projection * dataToView, "camera"),
    IsParallel(projection), grid, WholeViewport(renderer));
  TakeExactPlace(camera, worldToData, geometry.camera);
  PlaceCorners(geometry.camera);
  return geometry;
}

PictureFrame FrameOf(const ViewGeometry& geometry, double pixelSize)
{
  PictureFrame frame;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double pixels = geometry.size[axis];
    frame.whole[axis] = std::max(1, static_cast<int>(std::lround(pixels / pixelSize)));
    const double shrink = frame.whole[axis] / pixels;
    const int first = static_cast<int>(std::floor(geometry.covered[2 * axis] * shrink));
    const int last = static_cast<int>(std::ceil(geometry.covered[2 * axis + 1] * shrink));
    frame.origin[axis] = first;
    frame.size[axis] = std::min(last, frame.whole[axis]) - first;
  }
  return frame;
}

glm::dmat4 ClipToData(const ViewGeometry& geometry, const PictureFrame& frame)
{
  glm::dmat4 toWhole(1.0);
  for (int axis = 0; axis < 2; ++axis)
  {
    const double whole = frame.whole[std::size_t(axis)];
    const double size = frame.size[std::size_t(axis)];
    toWhole[axis][axis] = size / whole;
    toWhole[3][axis] = (2.0 * frame.origin[std::size_t(axis)] + size) / whole - 1;
  }
  return geometry.clipToData * toWhole;
}

bool AreSame(const Camera& a, const Camera& b)
{
  const double size = glm::distance(a.position, a.focalPoint);
  const bool corners = std::equal(a.corners.begin(), a.corners.end(), b.corners.begin(),
    b.corners.end(), [size](const Vec3& x, const Vec3& y) { return AreClose(x, y, size); });
  return corners && a.parallel == b.parallel && AreClose(a.position, b.position, size) &&
    AreClose(a.focalPoint, b.focalPoint, size);
}

bool AreSame(const std::vector<Camera>& a, const std::vector<Camera>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const Camera& one, const Camera& other) { return AreSame(one, other); });
}

bool AreSame(const Light& a, const Light& b)
{
  const double size = glm::distance(a.position, a.focalPoint);
  return a.type == b.type && AreClose(a.position, b.position, size) &&
    AreClose(a.focalPoint, b.focalPoint, size);
}
}
