// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "DepthPeeling.h"

#include "OpenGl.h"

#include "vtkDualDepthPeelingPass.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkProp.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <string>

namespace limpid
{
namespace
{
// The code that the pass inserts into volume shaders uses the names declared here.
const char* const FragmentShader = R"(//VTK::System::Dec
//VTK::Output::Dec
//VTK::DepthPeeling::Dec
in vec2 texCoord;
#define in_inverseWindowSize (texCoord / gl_FragCoord.xy)
const float g_opacityThreshold = 2.0; // nothing is too opaque to look behind it
int parts = 0;
void initializeRayCast()
{
}
//CastRay
void main()
{
  //VTK::CallWorker::Impl
  //End
}
)";

const char* const NoteParts = R"(
vec2 wanted[2] = vec2[2](vec2(1.0, 0.0), vec2(1.0, 0.0));
vec4 castRay(float zStart, float zEnd)
{
  wanted[parts++] = vec2(zStart, zEnd);
  return vec4(0.0);
}
)";
const char* const TellParts = "gl_FragData[0] = vec4(wanted[0], wanted[1]);";

const char* const ReturnPictures = R"(
uniform sampler2D firstPicture;
uniform sampler2D secondPicture;
vec4 castRay(float zStart, float zEnd)
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  return parts++ == 0 ? texelFetch(firstPicture, pixel, 0) : texelFetch(secondPicture, pixel, 0);
}
)";

// Returns the active passes of a prop.
std::vector<vtkDualDepthPeelingPass*> PassesOf(vtkProp* prop)
{
  std::vector<vtkDualDepthPeelingPass*> passes;
  vtkInformation* keys = prop->GetPropertyKeys();
  vtkInformationObjectBaseVectorKey* key = vtkOpenGLRenderPass::RenderPasses();
  const int count = keys && keys->Has(key) ? keys->Length(key) : 0;
  for (int i = 0; i < count; ++i)
  {
    if (auto* pass = vtkDualDepthPeelingPass::SafeDownCast(keys->Get(key, i)))
    {
      passes.push_back(pass);
    }
  }
  return passes;
}

// Returns the size of the textures that the pass draws into.
std::array<int, 2> SizeOf(vtkRenderer* renderer)
{
  std::array<int, 4> viewport{ { 0, 0, 0, 0 } };
  WindowOf(renderer)->GetState()->vtkglGetIntegerv(gl::viewport, viewport.data());
  return { { viewport[2], viewport[3] } };
}

void MakeRoom(vtkTextureObject* texture, vtkOpenGLRenderWindow* window,
  const std::array<int, 2>& size, int type)
{
  const auto width = static_cast<unsigned>(size[0]);
  const auto height = static_cast<unsigned>(size[1]);
  texture->SetContext(window);
  if (texture->GetHandle() == 0)
  {
    texture->Allocate2D(width, height, 4, type);
  }
  texture->Resize(width, height);
}
}

DepthPeeling::DepthPeeling() = default;
DepthPeeling::~DepthPeeling() = default;

bool DepthPeeling::IsUnderWay(vtkProp* volume)
{
  return !PassesOf(volume).empty();
}

// Runs a shader, as the pass has modified it, on the whole viewport.
void DepthPeeling::RunShader(vtkRenderer* renderer, vtkProp* volume, vtkAbstractMapper* mapper,
  const char* castRay, const char* end)
{
  std::string vertexShader;
  std::string geometryShader;
  std::string shader = FragmentShader;
  vtkShaderProgram::Substitute(shader, "//CastRay", castRay);
  vtkShaderProgram::Substitute(shader, "//End", end);
  for (vtkDualDepthPeelingPass* pass : PassesOf(volume))
  {
    pass->PreReplaceShaderValues(vertexShader, geometryShader, shader, mapper, volume);
    pass->PostReplaceShaderValues(vertexShader, geometryShader, shader, mapper, volume);
  }
  vtkOpenGLQuadHelper quad(WindowOf(renderer), nullptr, shader.c_str(), nullptr);
  LIMPID_REQUIRE(quad.Program && shader.find("//VTK::CallWorker::Impl") == std::string::npos,
    "This version of VTK peels volumes differently (the volume and translucent geometry cannot be "
    "blended). Call UseDepthPeelingForVolumesOff of the renderer.");

  vtkOpenGLState* state = WindowOf(renderer)->GetState();
  const vtkOpenGLState::ScopedglEnableDisable culling(state, gl::cullFace);
  state->vtkglDisable(gl::cullFace);
  for (vtkDualDepthPeelingPass* pass : PassesOf(volume))
  {
    pass->SetShaderParameters(quad.Program, mapper, volume, quad.VAO);
  }
  quad.Program->SetUniformi("firstPicture", this->Pictures[0]->GetTextureUnit());
  quad.Program->SetUniformi("secondPicture", this->Pictures[1]->GetTextureUnit());
  quad.Render();
}

// Draws into a texture. The state of OpenGL is unchanged afterwards.
void DepthPeeling::DrawInto(vtkRenderer* renderer, vtkTextureObject* texture,
  const std::array<float, 4>& clear, const std::function<void()>& draw)
{
  vtkOpenGLRenderWindow* window = WindowOf(renderer);
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blending(state, gl::blend);
  const vtkOpenGLState::ScopedglClearColor clearColor(state);
  int equation = 0;
  state->vtkglGetIntegerv(gl::blendEquation, &equation);
  state->PushFramebufferBindings();
  const auto restore = [&]()
  {
    state->PopFramebufferBindings();
    state->vtkglBlendEquation(static_cast<unsigned>(equation));
  };
  try
  {
    this->Target->SetContext(window);
    this->Target->Bind();
    this->Target->AddColorAttachment(0, texture);
    this->Target->ActivateDrawBuffer(0);
    state->vtkglClearColor(clear[0], clear[1], clear[2], clear[3]);
    state->vtkglClear(gl::colorBufferBit);
    state->vtkglDisable(gl::blend);
    state->vtkglBlendEquation(gl::addToBlend);
    draw();
  }
  catch (...)
  {
    restore();
    throw;
  }
  restore();
}

RayParts DepthPeeling::Ask(vtkRenderer* renderer, vtkProp* volume, vtkAbstractMapper* mapper)
{
  RayParts parts;
  parts.size = SizeOf(renderer);
  MakeRoom(this->Wanted, WindowOf(renderer), parts.size, VTK_FLOAT);
  this->DrawInto(renderer, this->Wanted, { { 1, 0, 1, 0 } },
    [&]() { this->RunShader(renderer, volume, mapper, NoteParts, TellParts); });

  this->Wanted->Activate(); // otherwise Download would replace one of the pass's textures
  const auto buffer = vtkSmartPointer<vtkPixelBufferObject>::Take(this->Wanted->Download());
  std::array<unsigned, 2> size{ { unsigned(parts.size[0]), unsigned(parts.size[1]) } };
  std::array<vtkIdType, 2> gaps{ { 0, 0 } };
  parts.depths.resize(4 * std::size_t(size[0]) * size[1]);
  LIMPID_REQUIRE(
    buffer && buffer->Download2D(VTK_FLOAT, parts.depths.data(), size.data(), 4, gaps.data()),
    "The buffers of depth peeling of "
      << size[0] << " x " << size[1]
      << " pixels cannot be read (the volume and translucent geometry cannot be blended). Check "
         "the graphics driver.");
  return parts;
}

void DepthPeeling::DrawPart(
  vtkRenderer* renderer, std::size_t part, const std::function<void()>& draw)
{
  vtkTextureObject* picture = this->Pictures[part];
  MakeRoom(picture, WindowOf(renderer), SizeOf(renderer), VTK_UNSIGNED_CHAR);
  this->DrawInto(renderer, picture, { { 0, 0, 0, 0 } }, draw);
}

void DepthPeeling::Answer(vtkRenderer* renderer, vtkProp* volume, vtkAbstractMapper* mapper)
{
  for (const auto& picture : this->Pictures)
  {
    picture->Activate();
  }
  this->RunShader(renderer, volume, mapper, ReturnPictures, "");
  for (const auto& picture : this->Pictures)
  {
    picture->Deactivate();
  }
}

void DepthPeeling::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Target->ReleaseGraphicsResources(window);
  this->Wanted->ReleaseGraphicsResources(window);
  for (const auto& picture : this->Pictures)
  {
    picture->ReleaseGraphicsResources(window);
  }
}
}
