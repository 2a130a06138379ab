// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OffScreenTarget.h"

#include "OpenGlFunctions.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

namespace limpid
{
namespace
{
constexpr std::array<unsigned, 4> disabled{ { GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST,
  GL_SCISSOR_TEST } };

/// Switches off, while alive, what would change or hide pixels.
class PlainDrawing
{
public:
  PlainDrawing(vtkOpenGLState* state, const std::array<int, 2>& size)
    : State(state)
    , Viewport(state)
    , Mask(state)
  {
    state->PushFramebufferBindings();
    for (std::size_t i = 0; i < disabled.size(); ++i)
    {
      this->Before[i] = state->GetEnumState(disabled[i]);
      state->vtkglDisable(disabled[i]);
    }
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    state->vtkglViewport(0, 0, size[0], size[1]);
  }

  ~PlainDrawing()
  {
    for (std::size_t i = 0; i < disabled.size(); ++i)
    {
      this->State->SetEnumState(disabled[i], this->Before[i]);
    }
    this->State->PopFramebufferBindings();
  }

  PlainDrawing(const PlainDrawing&) = delete;
  PlainDrawing& operator=(const PlainDrawing&) = delete;

private:
  vtkOpenGLState* State;
  vtkOpenGLState::ScopedglViewport Viewport;
  vtkOpenGLState::ScopedglColorMask Mask;
  std::array<bool, disabled.size()> Before;
};
}

OffScreenTarget::OffScreenTarget() = default;
OffScreenTarget::~OffScreenTarget() = default;

void OffScreenTarget::Draw(vtkOpenGLRenderWindow* window, const std::array<int, 2>& size,
  const std::vector<PixelOutput>& outputs, vtkOpenGLQuadHelper& quad)
{
  gl::ForgetErrors();
  const PlainDrawing plain(window->GetState(), size);
  this->Framebuffer->SetContext(window);
  this->Framebuffer->Bind();
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    this->Allocate(window, size, outputs[i].type, *this->Textures[i]);
    this->Framebuffer->AddColorAttachment(static_cast<unsigned>(i), this->Textures[i]);
  }
  this->Framebuffer->ActivateDrawBuffers(static_cast<unsigned>(outputs.size()));
  quad.Render();
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    this->Framebuffer->ActivateReadBuffer(static_cast<unsigned>(i));
    gl::ReadPixels(size[0], size[1],
      outputs[i].type == VTK_FLOAT ? unsigned(GL_FLOAT) : unsigned(GL_UNSIGNED_BYTE),
      outputs[i].pixels);
  }
  this->Framebuffer->RemoveColorAttachments(static_cast<unsigned>(outputs.size()));
  gl::RequireNoError(true, size[0], size[1], 1, 4);
}

void OffScreenTarget::Allocate(vtkOpenGLRenderWindow* window, const std::array<int, 2>& size,
  int type, vtkTextureObject& texture)
{
  const auto width = static_cast<unsigned>(size[0]);
  const auto height = static_cast<unsigned>(size[1]);
  if (texture.GetHandle() == 0 || texture.GetWidth() != width || texture.GetHeight() != height ||
    texture.GetVTKDataType() != type)
  {
    texture.ReleaseGraphicsResources(window);
    texture.ResetFormatAndType();
    texture.SetContext(window);
    const bool done = texture.Allocate2D(width, height, 4, type);
    gl::RequireNoError(done, size[0], size[1], 1, type == VTK_FLOAT ? 16 : 4);
  }
}

void OffScreenTarget::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Framebuffer->ReleaseGraphicsResources(window);
  for (vtkTextureObject* texture : this->Textures)
  {
    texture->ReleaseGraphicsResources(window);
  }
}
}
