// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OpenGlFunctions.h"

#include "math/Require.h"

#include <iomanip>
#include <sstream>

namespace limpid
{
namespace gl
{
void ForgetErrors()
{
  constexpr int most = 100; // a lost context may report errors forever
  for (int i = 0; i < most && glGetError() != GL_NO_ERROR; ++i)
  {
  }
}

void RequireNoError(bool done, int width, int height, int depth, int bytes)
{
  const GLenum error = glGetError();
  if (done && error == GL_NO_ERROR)
  {
    return;
  }
  constexpr double megabyte = 1 << 20;
  std::ostringstream message;
  message << "OpenGL could not store " << width << " x " << height << " x " << depth << " values, "
          << std::fixed << std::setprecision(1) << double(width) * height * depth * bytes / megabyte
          << " MB (" << (error == GL_OUT_OF_MEMORY ? "out of memory" : "error ");
  if (error != GL_OUT_OF_MEMORY)
  {
    message << error;
  }
  message << ").";
  throw DeviceError(message.str());
}

void UploadBox(
  const int* first, const int* size, unsigned format, unsigned type, const void* texels)
{
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage3D(GL_TEXTURE_3D, 0, first[0], first[1], first[2], size[0], size[1], size[2], format,
    type, texels);
}

void ReadPixels(int width, int height, unsigned type, void* rgba)
{
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, type, rgba);
}

int MostBufferTexels()
{
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  return most;
}

std::string RendererName()
{
  const GLubyte* name = glGetString(GL_RENDERER);
  return name ? reinterpret_cast<const char*>(name) : std::string();
}
}
}
