// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Functions of OpenGL by their own names, where VTK's classes do not cover them.

#ifndef limpid_OpenGlFunctions_h
#define limpid_OpenGlFunctions_h

#if __has_include("vtk_glad.h")
#include "vtk_glad.h" // from VTK 9.4 on
#else
#include "vtk_glew.h"
#endif

#include <string>

namespace limpid
{
namespace gl
{
/// Discards errors of earlier calls of others.
void ForgetErrors();

/// Throws DeviceError if a call since ForgetErrors has failed or `done` is false, in which case a
/// texture of this size did not fit. `bytes`: of a texel.
void RequireNoError(bool done, int width, int height, int depth, int bytes);

/// Uploads a box of texels to the 3-D texture that is active.
void UploadBox(
  const int* first, const int* size, unsigned format, unsigned type, const void* texels);

/// Copies the pixels of the framebuffer that is bound, four numbers each.
void ReadPixels(int width, int height, unsigned type, void* rgba);

/// Returns the largest number of texels of a buffer texture.
int MostBufferTexels();

/// Returns the name of the renderer: of the graphics card, or of the software.
std::string RendererName();
}
}

#endif
