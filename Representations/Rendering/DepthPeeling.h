// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Volumes among translucent surfaces that VTK peels off one by one.

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
/// Two parts of the ray of every pixel of a viewport, first row at the bottom.
struct RayParts
{
  std::array<int, 2> size{ { 0, 0 } }; ///< of the viewport [pixels]

  /// The pass comes for the first time in a frame: its parts are in front of all translucent
  /// surfaces and behind them, up to what is opaque.
  bool outermost = false;

  /// As in the depth buffer [0, 1], four per pixel: where the first part begins and ends, and the
  /// second one. A part that does not end behind its beginning is empty.
  std::vector<float> depths;
};

/**
 * The volume's side of vtkDualDepthPeelingPass.
 *
 * The pass comes several times per frame, each time with surfaces in front of and behind what is
 * left to be peeled, and wants the volume between them and the surfaces before. It asks in
 * shaders: it replaces tags in the one of a volume with code that calls castRay(start, end) for a
 * pixel, in front and at the back, and mixes what that returns. We answer in two steps: with a
 * castRay that notes what it is called for, and, when the pictures have been computed elsewhere,
 * with one that returns their pixels.
 */
class DepthPeeling
{
public:
  DepthPeeling();
  ~DepthPeeling();
  DepthPeeling(const DepthPeeling&) = delete;
  DepthPeeling& operator=(const DepthPeeling&) = delete;

  /// Whether the pass is at work and wants a part of the volume now.
  static bool IsUnderWay(vtkProp* volume);

  /// What it wants. Throws when this VTK asks in another way, or the window has no OpenGL.
  RayParts Ask(vtkRenderer* renderer, vtkProp* volume, vtkAbstractMapper* mapper);

  /// Makes what `draw` draws into the viewport, over each other, the picture of a part, 0 or 1.
  void DrawPart(vtkRenderer* renderer, std::size_t part, const std::function<void()>& draw);

  /// Gives the pictures of both parts to the pass.
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
