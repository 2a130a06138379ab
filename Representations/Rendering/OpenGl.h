// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The parts of OpenGL that VTK's classes do not cover.

#ifndef limpid_OpenGl_h
#define limpid_OpenGl_h

#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"

#include "math/Require.h"

namespace limpid
{
/// Values of OpenGL by their own names. VTK's header for them is named differently in different
/// versions.
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

/// Returns the window of a renderer. Throws if it has no OpenGL.
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
