// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What we use of OpenGL beside VTK's classes.

#ifndef limpid_OpenGl_h
#define limpid_OpenGl_h

#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"

#include "math/Require.h"

namespace limpid
{
/// OpenGL's own names and values; VTK's header for them has another name in every other version.
namespace gl
{
constexpr unsigned one = 1;
constexpr unsigned oneMinusSourceAlpha = 0x0303;
constexpr unsigned cullFace = 0x0B44;
constexpr unsigned depthTest = 0x0B71;
constexpr unsigned viewport = 0x0BA2;
constexpr unsigned blend = 0x0BE2;
constexpr unsigned colorBufferBit = 0x4000;
constexpr unsigned addToBlend = 0x8006;
constexpr unsigned blendEquation = 0x8009;
}

/// Throws when the window has no OpenGL.
inline vtkOpenGLRenderWindow* WindowOf(vtkRenderer* renderer)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  LIMPID_REQUIRE(window,
    "The render window is a "
      << renderer->GetRenderWindow()->GetClassName()
      << " (pictures are drawn with OpenGL). Use a window of VTK's OpenGL modules.");
  return window;
}
}

#endif
