// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PictureQuad.h"

#include "OpaqueDepth.h"
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

// Of two pictures, see PicturesBetween
uniform int between; // 0: there is one
uniform sampler2D nearPicture;
uniform sampler2D ranges; // see DepthRange
uniform sampler2D depths; // of the view's pixels
uniform vec2 depthRange;  // of the box
uniform vec4 depthPlace;  // of the rectangle in `depths`: left bottom, width height [pixels]

ivec2 inPictures(ivec2 pixel)
{
  return clamp(pixel, ivec2(0), textureSize(ranges, 0) - 1);
}

// The share of the far picture that a pixel has at a depth, which is in its range.
float shareAt(ivec2 pixel, float depth)
{
  vec3 range = texelFetch(ranges, inPictures(pixel), 0).rgb;
  float beyond = depth - range.b;
  return range.b < range.g ? clamp(beyond / (range.g - range.b), 0.0, 1.0) : 1.0;
}

vec4 colorAt(ivec2 pixel, float share)
{
  pixel = inPictures(pixel);
  return mix(texelFetch(nearPicture, pixel, 0), texelFetch(picture, pixel, 0), share);
}

// Where pixels side by side have other shares, they are mixed before they are interpolated:
// nothing from behind one of them gets into another.
vec4 colorBetween()
{
  ivec2 own = ivec2(floor(depthPlace.xy + depthPlace.zw * texCoord));
  float depth = texelFetch(depths, clamp(own, ivec2(0), textureSize(depths, 0) - 1), 0).r;
  depth = clamp(depth, depthRange.x, depthRange.y);
  vec2 place = texCoord * vec2(textureSize(ranges, 0)) - 0.5;
  ivec2 first = ivec2(floor(place));
  vec2 share = place - vec2(first);
  ivec2 right = first + ivec2(1, 0);
  ivec2 up = first + ivec2(0, 1);
  ivec2 both = first + ivec2(1, 1);
  vec4 far =
    vec4(shareAt(first, depth), shareAt(right, depth), shareAt(up, depth), shareAt(both, depth));
  if (far == vec4(far.x))
  {
    return mix(texture2D(nearPicture, texCoord), texture2D(picture, texCoord), far.x);
  }
  vec4 below = mix(colorAt(first, far.x), colorAt(right, far.y), share.x);
  vec4 above = mix(colorAt(up, far.z), colorAt(both, far.w), share.x);
  return mix(below, above, share.y);
}

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
  if (between != 0)
  {
    color = colorBetween();
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

constexpr std::array<float, 4> noMask{ { 0, 0, 0, -1 } };

// Creates a texture of values and activates it on a unit.
void SetTexture(vtkRenderer* renderer, const std::array<int, 2>& size, int components, int type,
  const void* values, int filter, vtkTextureObject* texture)
{
  texture->SetContext(WindowOf(renderer));
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->SetMinificationFilter(filter);
  texture->SetMagnificationFilter(filter);
  // The cast is safe: VTK does not write to the values.
  texture->Create2DFromRaw(static_cast<unsigned>(size[0]), static_cast<unsigned>(size[1]),
    components, type, const_cast<void*>(values));
  texture->Activate();
}

void SetPicture(
  vtkRenderer* renderer, const Picture& picture, int filter, vtkTextureObject* texture)
{
  const std::array<int, 2> size{ { picture.width, picture.height } };
  SetTexture(renderer, size, 4, VTK_UNSIGNED_CHAR, picture.rgba.data(), filter, texture);
}
}

PictureQuad::PictureQuad() = default;
PictureQuad::~PictureQuad() = default;

void PictureQuad::Draw(
  vtkRenderer* renderer, const Picture& picture, const PictureFrame& frame, double depth)
{
  this->Draw(renderer, picture, frame, depth, noMask, true);
}

void PictureQuad::DrawMask(vtkRenderer* renderer, const Picture& picture, const PictureFrame& frame,
  double depth, const float color[3], double threshold)
{
  this->Draw(renderer, picture, frame, depth,
    { { color[0], color[1], color[2], static_cast<float>(threshold) } }, false);
}

void PictureQuad::Draw(vtkRenderer* renderer, const Picture& picture, const PictureFrame& frame,
  double depth, const std::array<float, 4>& mask, bool interpolates)
{
  std::array<int, 2> size;
  renderer->GetTiledSize(&size[0], &size[1]);
  const bool samePixels = frame.whole == size;
  this->Ready(renderer);
  SetPicture(renderer, picture,
    !interpolates || samePixels ? vtkTextureObject::Nearest : vtkTextureObject::Linear,
    this->Texture);
  this->Quad->Program->SetUniformi("between", 0);
  this->Blend(renderer, frame, depth, mask);
}

void PictureQuad::DrawBetween(vtkRenderer* renderer, const PicturesBetween& pictures,
  const PictureFrame& frame, const ViewGeometry& geometry)
{
  this->Ready(renderer);
  const int single = vtkTextureObject::Nearest;
  SetPicture(renderer, pictures.farthest, vtkTextureObject::Linear, this->Texture);
  SetPicture(renderer, pictures.nearest, vtkTextureObject::Linear, this->NearTexture);
  SetTexture(renderer, frame.size, 3, VTK_FLOAT, pictures.ranges.data(), single, this->Ranges);
  SetTexture(renderer, pictures.opaque.Size(), 1, VTK_FLOAT, pictures.opaque.OfPixels().data(),
    vtkTextureObject::Nearest, this->Depths);

  std::array<float, 4> place;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double pixel = double(geometry.size[axis]) / frame.whole[axis];
    place[axis] = static_cast<float>(frame.origin[axis] * pixel - geometry.covered[2 * axis]);
    place[axis + 2] = static_cast<float>(frame.size[axis] * pixel);
  }
  const std::array<float, 2> depthRange{ { static_cast<float>(geometry.nearest),
    static_cast<float>(geometry.farthest) } };
  vtkShaderProgram* program = this->Quad->Program;
  program->SetUniformi("between", 1);
  program->SetUniformi("nearPicture", this->NearTexture->GetTextureUnit());
  program->SetUniformi("ranges", this->Ranges->GetTextureUnit());
  program->SetUniformi("depths", this->Depths->GetTextureUnit());
  program->SetUniform2f("depthRange", depthRange.data());
  program->SetUniform4f("depthPlace", place.data());
  this->Blend(renderer, frame, geometry.nearest, noMask);
}

std::array<vtkTextureObject*, 4> PictureQuad::Textures()
{
  return { { this->Texture, this->NearTexture, this->Ranges, this->Depths } };
}

void PictureQuad::Ready(vtkRenderer* renderer)
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
    "The shader that draws pictures could not be compiled (the OpenGL context is too old or lost). "
    "Check the graphics driver.");
}

void PictureQuad::Blend(
  vtkRenderer* renderer, const PictureFrame& frame, double depth, const std::array<float, 4>& mask)
{
  vtkOpenGLState* state = WindowOf(renderer)->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blending(state, gl::blend);
  const vtkOpenGLState::ScopedglEnableDisable culling(state, gl::cullFace);
  const vtkOpenGLState::ScopedglEnableDisable testing(state, gl::depthTest);
  const vtkOpenGLState::ScopedglBlendFuncSeparate function(state);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  state->SetEnumState(gl::blend, mask[3] < 0);
  state->vtkglDisable(gl::cullFace);
  state->vtkglEnable(gl::depthTest);
  state->vtkglBlendFunc(gl::one, gl::oneMinusSourceAlpha); // colours are premultiplied by alpha
  state->vtkglDepthMask(0);

  const std::array<float, 4> rectangle = RectangleOf(frame);
  vtkShaderProgram* program = this->Quad->Program;
  program->SetUniformi("picture", this->Texture->GetTextureUnit());
  program->SetUniform4f("rectangle", rectangle.data());
  program->SetUniform4f("mask", mask.data());
  program->SetUniformf("depth", static_cast<float>(2 * depth - 1));
  this->Quad->Render();
  for (vtkTextureObject* texture : this->Textures())
  {
    texture->Deactivate();
  }
}

void PictureQuad::ReleaseGraphicsResources(vtkWindow* window)
{
  for (vtkTextureObject* texture : this->Textures())
  {
    texture->ReleaseGraphicsResources(window);
  }
  this->Quad.reset();
}
}
