// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Pixels that a shader writes and the processor reads.

#ifndef limpid_OffScreenTarget_h
#define limpid_OffScreenTarget_h

#include "vtkNew.h"

#include <array>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace limpid
{
/// An output of a shader: four numbers per pixel, bottom row first.
struct PixelOutput
{
  int type; ///< VTK_UNSIGNED_CHAR or VTK_FLOAT
  void* pixels;
};

class OffScreenTarget
{
public:
  OffScreenTarget();
  ~OffScreenTarget();

  /// Runs a shader that is ready for every pixel, and reads its outputs, one or two. Throws
  /// DeviceError if OpenGL fails.
  void Draw(vtkOpenGLRenderWindow* window, const std::array<int, 2>& size,
    const std::vector<PixelOutput>& outputs, vtkOpenGLQuadHelper& quad);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Allocate(vtkOpenGLRenderWindow* window, const std::array<int, 2>& size, int type,
    vtkTextureObject& texture);

  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  std::array<vtkNew<vtkTextureObject>, 2> Textures;
};
}

#endif
