// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Draws volumes between translucent surfaces that VTK peels layer by layer.

#ifndef limpid_DepthPeeling_h
#define limpid_DepthPeeling_h

#include "vtkNew.h"

#include <array>
#include <functional>
#include <vector>

class vtkAbstractMapper;
class vtkOpenGLFramebufferObject;
class vtkProp;
class vtkRenderer;
class vtkTextureObject;
class vtkWindow;

namespace limpid
{
/// Two segments of the ray of each pixel of a viewport, bottom row first.
struct RayParts
{
  std::array<int, 2> size{ { 0, 0 } }; ///< size of the viewport [pixels]

  /// Whether this is the first layer of a frame: its segments are in front of all translucent
  /// surfaces, and behind them up to opaque geometry.
  bool outermost = false;

  /// Depths as in the depth buffer [0, 1], four per pixel: begin and end of the first segment, then
  /// of the second. A segment whose end is not behind its begin is empty.
  std::vector<float> depths;
};

/**
 * The volume's part of vtkDualDepthPeelingPass.
 *
 * The pass calls several times per frame, each time with the surfaces in front of and behind what
 * is left to be peeled, and needs the volume between them and the previous surfaces. It does so in
 * shaders: it replaces tags in a volume's shader with code that calls castRay(start, end) for a
 * pixel, once in front and once at the back, and blends the results. This class has two steps.
 * First it supplies a castRay that records its arguments; once the pictures have been computed
 * elsewhere, one that returns their pixels.
 */
class DepthPeeling
{
public:
  DepthPeeling();
  ~DepthPeeling();
  DepthPeeling(const DepthPeeling&) = delete;
  DepthPeeling& operator=(const DepthPeeling&) = delete;

  /// Returns whether the pass is active and needs a segment of the volume now.
  static bool IsUnderWay(vtkProp* volume);

  /// Returns the segments that the pass needs. Throws if this version of VTK has other tags, or if
  /// the window has no OpenGL.
  RayParts Ask(vtkRenderer* renderer, vtkProp* volume, vtkAbstractMapper* mapper);

  /// Draws the picture of a segment, 0 or 1: everything that `draw` draws into the viewport,
  /// blended.
  void DrawPart(vtkRenderer* renderer, std::size_t part, const std::function<void()>& draw);

  /// Passes the pictures of both segments to the pass.
  void Answer(vtkRenderer* renderer, vtkProp* volume, vtkAbstractMapper* mapper);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void DrawInto(vtkRenderer* renderer, vtkTextureObject* texture, const std::array<float, 4>& clear,
    const std::function<void()>& draw);
  void RunShader(vtkRenderer* renderer, vtkProp* volume, vtkAbstractMapper* mapper,
    const char* castRay, const char* end);

  vtkNew<vtkOpenGLFramebufferObject> Target;
  vtkNew<vtkTextureObject> Wanted;
  std::array<vtkNew<vtkTextureObject>, 2> Pictures;
};
}

#endif
