// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PictureQuad.h"

#include "OpenGl.h"

#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include "render/Renderer.h"

namespace limpid
{
namespace
{
const char* const VertexShader = R"(//VTK::System::Dec
in vec4 ndCoordIn;
in vec2 texCoordIn;
out vec2 texCoord;
uniform vec4 rectangle; // middle, half the size, in clip coordinates
uniform float depth;    // in clip coordinates
void main()
{
  gl_Position = vec4(rectangle.xy + rectangle.zw * ndCoordIn.xy, depth, 1.0);
  texCoord = texCoordIn;
}
)";

const char* const FragmentShader = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec2 texCoord;
uniform sampler2D picture;
uniform vec4 mask; // colour; alpha that is left out, negative: draw the picture itself
void main()
{
  vec4 color = texture2D(picture, texCoord);
  if (mask.a >= 0.0)
  {
    if (color.a <= mask.a)
    {
      discard;
    }
    color = vec4(mask.rgb, 1.0);
  }
  gl_FragData[0] = color;
}
)";

std::array<float, 4> RectangleOf(const PictureFrame& frame)
{
  std::array<float, 4> rectangle;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double whole = frame.whole[axis];
    const double size = frame.size[axis];
    rectangle[axis] = static_cast<float>((2.0 * frame.origin[axis] + size) / whole - 1);
    rectangle[axis + 2] = static_cast<float>(size / whole);
  }
  return rectangle;
}
}

PictureQuad::PictureQuad() = default;
PictureQuad::~PictureQuad() = default;

void PictureQuad::Draw(
  vtkRenderer* renderer, const Picture& picture, const PictureFrame& frame, double depth)
{
  this->Draw(renderer, picture, frame, depth, { { 0, 0, 0, -1 } });
}

void PictureQuad::DrawMask(vtkRenderer* renderer, const Picture& picture, const PictureFrame& frame,
  double depth, const float color[3], double threshold)
{
  this->Draw(renderer, picture, frame, depth,
    { { color[0], color[1], color[2], static_cast<float>(threshold) } });
}

void PictureQuad::Draw(vtkRenderer* renderer, const Picture& picture, const PictureFrame& frame,
  double depth, const std::array<float, 4>& mask)
{
  vtkOpenGLRenderWindow* window = WindowOf(renderer);
  if (!this->Quad)
  {
    this->Quad =
      std::make_unique<vtkOpenGLQuadHelper>(window, VertexShader, FragmentShader, nullptr);
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(this->Quad->Program);
  }
  LIMPID_REQUIRE(this->Quad->Program,
    "The shader that draws pictures could not be made (OpenGL is too old or gone). Check the "
    "graphics driver.");

  const bool masked = mask[3] >= 0;
  std::array<int, 2> size;
  renderer->GetTiledSize(&size[0], &size[1]);
  const bool samePixels = frame.whole == size;
  const int filter = masked || samePixels ? vtkTextureObject::Nearest : vtkTextureObject::Linear;
  this->Texture->SetContext(window);
  this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
  this->Texture->SetMinificationFilter(filter);
  this->Texture->SetMagnificationFilter(filter);
  // VTK does not write to the picture.
  this->Texture->Create2DFromRaw(static_cast<unsigned>(picture.width),
    static_cast<unsigned>(picture.height), 4, VTK_UNSIGNED_CHAR,
    const_cast<std::uint8_t*>(picture.rgba.data()));

  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blending(state, gl::blend);
  const vtkOpenGLState::ScopedglEnableDisable culling(state, gl::cullFace);
  const vtkOpenGLState::ScopedglEnableDisable testing(state, gl::depthTest);
  const vtkOpenGLState::ScopedglBlendFuncSeparate function(state);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  state->SetEnumState(gl::blend, !masked);
  state->vtkglDisable(gl::cullFace);
  state->vtkglEnable(gl::depthTest);
  state->vtkglBlendFunc(gl::one, gl::oneMinusSourceAlpha); // colours are multiplied by alpha
  state->vtkglDepthMask(0);

  const std::array<float, 4> rectangle = RectangleOf(frame);
  this->Texture->Activate();
  vtkShaderProgram* program = this->Quad->Program;
  program->SetUniformi("picture", this->Texture->GetTextureUnit());
  program->SetUniform4f("rectangle", rectangle.data());
  program->SetUniform4f("mask", mask.data());
  program->SetUniformf("depth", static_cast<float>(2 * depth - 1));
  this->Quad->Render();
  this->Texture->Deactivate();
}

void PictureQuad::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Texture->ReleaseGraphicsResources(window);
  this->Quad.reset();
}
}
