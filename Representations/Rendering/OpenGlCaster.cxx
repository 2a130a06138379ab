// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OpenGlCaster.h"

#include "CastRays.h"
#include "OpenGl.h"
#include "OpenGlFunctions.h"
#include "ShaderRays.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include "backend/Backend.h"
#include "backend/Interruption.h"
#include "math/Require.h"
#include "render/RayPart.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <sstream>
#include <vector>

namespace limpid
{
namespace
{
std::array<float, 3> Floats(const Vec3& vector)
{
  return { { float(vector.x), float(vector.y), float(vector.z) } };
}

void SetVector(vtkShaderProgram& program, const char* name, const Vec3& vector)
{
  program.SetUniform3f(name, Floats(vector).data());
}

void SetVector(vtkShaderProgram& program, const char* name, const float (&vector)[3])
{
  program.SetUniform3f(name, vector);
}

constexpr int texelsOfEntry = 2; ///< of an OpticalEntry

Int3 NodesOf(const CellGrid& grid)
{
  return Int3(Vec3(grid.lastNode[0], grid.lastNode[1], grid.lastNode[2])) + 1;
}

Int3 BricksOf(const Int3& nodes)
{
  return (nodes + (BrickDistances::size - 2)) / BrickDistances::size;
}

/// What the shader needs for a picture, see CastRays.glsl.
std::string DefinitionsFor(const CastTask& task)
{
  const RayScene& scene = task.scene;
  const View& view = task.view;
  const bool missed = task.casting.missedColor.has_value();
  std::string all;
  const auto define = [&all](bool needed, const char* name)
  { all += needed ? std::string("#define ") + name + "\n" : std::string(); };
  define(scene.gradient, "LIT");
  define(scene.shadow, "SHADOWED");
  define(scene.overlay, "OVERLAID");
  define(scene.filled, "MASKED");
  define(scene.structures, "TINTED");
  define(scene.bricks.distance, "SKIPPING");
  define(!task.part.IsWhole(), "IN_PARTS");
  define(view.nearDepth, "BEGINNING");
  define(view.depth, "ENDING");
  define(missed, "MISSED");
  define(missed && view.missedDepth, "MISSED_ENDING");
  return all;
}

std::string RefusalFor(const CastTask& task, const ShaderRays& rays, vtkOpenGLRenderWindow* window)
{
  std::ostringstream why;
  const int mostEntries = gl::MostBufferTexels() / texelsOfEntry;
  const int largest = vtkTextureObject::GetMaximumTextureSize3D(window);
  const Int3 nodes = glm::max(NodesOf(task.scene.grid), NodesOf(task.scene.overlayGrid));
  if (task.casting.compositing != Compositing::FrontToBack)
  {
    why << "the method weights samples by importance";
  }
  else if (std::max({ nodes.x, nodes.y, nodes.z }) > largest)
  {
    why << "the volume has " << nodes.x << " x " << nodes.y << " x " << nodes.z
        << " points, and textures have at most " << largest << " along an axis";
  }
  else if (task.scene.table.axis.last >= mostEntries)
  {
    why << "the transfer functions need " << task.scene.table.axis.last + 1
        << " entries, and buffers have at most " << mostEntries;
  }
  else if (!rays.isPlain)
  {
    why << "the projection is neither perspective nor parallel";
  }
  return why.str();
}

void SetRays(const CastTask& task, const ShaderRays& rays, vtkShaderProgram& program)
{
  const View& view = task.view;
  const Grid& grid = task.part.Whole();
  const float size[2] = { float(view.width), float(view.height) };
  const float depths[2] = { float(rays.front.depth), float(rays.back.depth) };
  const double unit = std::max(rays.front.weight, rays.back.weight); // only their ratio matters
  const float weights[2] = { float(rays.front.weight / unit), float(rays.back.weight / unit) };
  const Range<int> rows = view.RowsWithRays();
  const float drawn[2] = { float(rows.begin), float(rows.end) };
  program.SetUniform2f("pictureSize", size);
  program.SetUniform2f("drawnRows", drawn);
  program.SetUniform2f("clipDepths", depths);
  program.SetUniform2f("clipWeights", weights);
  SetVector(program, "frontMiddle", rays.front.middle);
  SetVector(program, "frontRight", rays.front.right);
  SetVector(program, "frontUp", rays.front.up);
  SetVector(program, "backMiddle", rays.back.middle);
  SetVector(program, "backRight", rays.back.right);
  SetVector(program, "backUp", rays.back.up);
  float toRadii[9];
  for (int column = 0; column < 3; ++column)
  {
    const Vec3 axis = grid.direction[column] * (grid.spacing[column] / grid.Radius());
    std::copy_n(Floats(axis).data(), 3, toRadii + 3 * column);
  }
  program.SetUniformMatrix3x3("toRadii", toRadii);
  program.SetUniformf("stepLength", float(task.casting.stepLength / grid.Radius()));
  program.SetUniformi("jitters", view.jitter ? 1 : 0);
  SetVector(program, "wholeLastNode", Vec3(grid.nodes - 1));
  if (!task.part.IsWhole())
  {
    const RayPart part(task.part);
    SetVector(program, "partLow", part.low);
    SetVector(program, "partHigh", part.high);
    SetVector(program, "partFirst", part.first);
  }
  program.SetUniformi("planeCount", int(rays.planes.size()));
  if (!rays.planes.empty())
  {
    program.SetUniform4fv("planes", int(rays.planes.size()),
      reinterpret_cast<const float(*)[4]>(rays.planes.front().data()));
  }
}

void SetLight(const RayLight& light, vtkShaderProgram& program)
{
  SetVector(program, "lightOrigin", light.origin);
  program.SetUniformf("isPoint", light.isPoint);
  program.SetUniformf("ambient", light.ambient);
  program.SetUniformf("diffuse", light.diffuse);
  program.SetUniformf("anisotropy", light.anisotropy);
  program.SetUniformf("phaseUnit", light.phaseUnit);
  program.SetUniformf("surface", light.surface);
  program.SetUniformf("shadowStrength", light.shadow);
  program.SetUniformf("lobeFactor", light.lobe.factor);
  program.SetUniformf("lobePower", light.lobe.power);
}
}

struct OpenGlCaster::OtherTexture
{
  vtkNew<vtkTextureObject> texture;
  vtkNew<vtkOpenGLBufferObject> buffer; ///< of a buffer texture
  std::uint64_t version = 0;
  bool isThere = false;

  void Release(vtkWindow* window)
  {
    this->texture->ReleaseGraphicsResources(window);
    this->buffer->ReleaseGraphicsResources();
    this->isThere = false;
  }
};

OpenGlCaster::OpenGlCaster(vtkOpenGLRenderWindow* window)
  : Window(window)
{
}

OpenGlCaster::~OpenGlCaster()
{
  this->DrawIn(nullptr);
}

void OpenGlCaster::DrawIn(vtkOpenGLRenderWindow* window)
{
  if (this->Window && this->Window != window && this->HoldsMemory)
  {
    this->Window->MakeCurrent();
    this->ReleaseGraphicsResources(this->Window);
  }
  this->Window = window;
}

void OpenGlCaster::ReleaseGraphicsResources(vtkWindow* window)
{
  for (auto& [name, field] : this->Fields)
  {
    field.Release(window);
  }
  for (auto& [name, other] : this->Others)
  {
    other.Release(window);
  }
  this->Quads.clear();
  this->Target.ReleaseGraphicsResources(window);
  this->HoldsMemory = false;
}

bool OpenGlCaster::Cast(const CastTask& task, Picture& picture, std::vector<PartialPixel>& parts)
{
  this->Began = false;
  if (this->Failed)
  {
    return false;
  }
  try
  {
    if (!this->Window)
    {
      throw DeviceError("The window of the OpenGL context is gone.");
    }
    this->Window->MakeCurrent();
    const ShaderRays rays(task.part.Whole(), task.view);
    this->WhyNot = RefusalFor(task, rays, this->Window);
    if (this->WhyNot.empty() && rays.seesBox)
    {
      this->DrawPicture(task, rays, picture, parts);
    }
  }
  catch (const DeviceError& error)
  {
    this->Failed = true;
    this->WhyNot = error.what();
    this->Deactivate();
    if (this->Window)
    {
      this->ReleaseGraphicsResources(this->Window);
    }
  }
  return this->WhyNot.empty();
}

void OpenGlCaster::DrawPicture(
  const CastTask& task, const ShaderRays& rays, Picture& picture, std::vector<PartialPixel>& parts)
{
  Interruptible::Check(0);
  this->HoldsMemory = true;
  vtkOpenGLQuadHelper& quad = this->ReadyQuad(task);
  vtkShaderProgram& program = *quad.Program;
  SetRays(task, rays, program);
  SetLight(task.casting.light, program);
  this->SetFields(task, program);
  this->SetDepths(task.view, program);
  const std::array<int, 2> size{ { picture.width, picture.height } };
  if (parts.empty())
  {
    this->Target.Draw(this->Window, size, { { VTK_UNSIGNED_CHAR, picture.rgba.data() } }, quad);
  }
  else
  {
    std::vector<FourFloats> received(parts.size());
    std::vector<FourFloats> first(parts.size());
    this->Target.Draw(
      this->Window, size, { { VTK_FLOAT, received.data() }, { VTK_FLOAT, first.data() } }, quad);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      const float* light = received[i].values;
      parts[i] = { { light[0], light[1], light[2] }, light[3], static_cast<int>(first[i][0]) };
    }
  }
  this->Deactivate();
  Interruptible::Check(1);
}

void OpenGlCaster::Deactivate()
{
  for (auto& [name, field] : this->Fields)
  {
    field.Deactivate();
  }
  for (auto& [name, other] : this->Others)
  {
    other.texture->Deactivate();
  }
}

vtkOpenGLQuadHelper& OpenGlCaster::ReadyQuad(const CastTask& task)
{
  const std::string definitions = DefinitionsFor(task);
  std::unique_ptr<vtkOpenGLQuadHelper>& quad = this->Quads[definitions];
  if (!quad)
  {
    this->Began = true;
    std::string shader = CastRays;
    shader.insert(shader.find("//VTK::Output::Dec"), definitions);
    quad = std::make_unique<vtkOpenGLQuadHelper>(this->Window, nullptr, shader.c_str(), nullptr);
  }
  else if (quad->Program)
  {
    this->Window->GetShaderCache()->ReadyShaderProgram(quad->Program);
  }
  if (!quad->Program || !quad->Program->GetCompiled())
  {
    throw DeviceError("The shader that casts rays could not be compiled (the OpenGL context is too "
                      "old or lost).");
  }
  return *quad;
}

void OpenGlCaster::SetFields(const CastTask& task, vtkShaderProgram& program)
{
  const RayScene& scene = task.scene;
  const FieldVersions& versions = task.versions;
  const Int3 nodes = NodesOf(scene.grid);
  const auto use = [&](const char* name, const void* values, const Int3& size, TexelKind kind,
                     std::uint64_t version)
  {
    if (values)
    {
      this->UseField(name, values, size, kind, version, program);
    }
  };
  SetVector(program, "lastNode", scene.grid.lastNode);
  use("scalars", scene.scalars.Memory(), nodes, KindOf(scene.scalars), versions.scalars);
  use("filledShares", scene.filled, nodes, TexelKind::Float, versions.scalars);
  use("gradients", scene.gradient, nodes, TexelKind::FourNumbers, versions.gradient);
  use("bricks", scene.bricks.distance, BricksOf(nodes), TexelKind::SmallInteger, versions.bricks);

  const Int3 overlayNodes = NodesOf(scene.overlayGrid);
  SetVector(program, "overlayShift", scene.overlayShift);
  SetVector(program, "overlayScale", scene.overlayScale);
  SetVector(program, "overlayNodes", Vec3(overlayNodes));
  if (scene.overlay)
  {
    const TexelKind kind =
      this->Adds(scene, versions.overlay) ? TexelKind::TwoNumbers : TexelKind::FirstOfTwo;
    this->UseField("overlay", scene.overlay, overlayNodes, kind, versions.overlay, program);
  }
  use("shadows", scene.shadow, overlayNodes, TexelKind::OneNumber,
    versions.overlay + versions.shadow);

  const TableAxis& axis = scene.table.axis;
  program.SetUniformf("tableLow", axis.low);
  program.SetUniformf("tableScale", axis.scale);
  program.SetUniformi("tableLast", axis.last);
  this->UseBuffer("table", scene.table.entries->value.values,
    std::size_t(texelsOfEntry) * (std::size_t(axis.last) + 1), versions.functions, program);
  program.SetUniformf("opaqueBelow", scene.opaqueBelow);
  program.SetUniformf("depthUnit", scene.stepLength * scene.majorant);
  program.SetUniformf("addedUnit", scene.addedUnit);

  use("structures", scene.structures, nodes, TexelKind::Integer, versions.structures);
  if (scene.structures)
  {
    const std::vector<FourFloats>& tints = task.casting.tints;
    this->Others["tints"].isThere = false; // they are few
    this->UseBuffer("tints", tints.front().values, tints.size(), 0, program);
  }
  if (task.casting.missedColor)
  {
    SetVector(program, "missedColor",
      *reinterpret_cast<const float(*)[3]>(task.casting.missedColor->data()));
    use("importances", task.missed.importance, nodes, TexelKind::Float, versions.importance);
    use("unimportant", task.missed.unimportant.distance, BricksOf(nodes), TexelKind::SmallInteger,
      versions.importance);
    use("bareBricks", task.missed.bricks.distance, BricksOf(nodes), TexelKind::SmallInteger,
      versions.bareBricks);
  }
}

bool OpenGlCaster::Adds(const RayScene& scene, std::uint64_t version)
{
  if (this->AddsOf != version)
  {
    const Int3 nodes = NodesOf(scene.overlayGrid);
    std::atomic<bool> any{ false };
    ParallelFor(Index(nodes.y) * nodes.z,
      [&](Index row)
      {
        const TwoPacked* first = scene.overlay + row * nodes.x;
        const auto adds = [](const TwoPacked& node) { return node.values[1] != 0; };
        if (!any && std::any_of(first, first + nodes.x, adds))
        {
          any = true;
        }
      });
    this->AddsAnything = any;
    this->AddsOf = version;
  }
  return this->AddsAnything;
}

void OpenGlCaster::SetDepths(const View& view, vtkShaderProgram& program)
{
  this->UseDepth("nearDepth", view.nearDepth, view, program);
  this->UseDepth("endDepth", view.depth, view, program);
  this->UseDepth("missedDepth", view.missedDepth, view, program);
}

void OpenGlCaster::UseField(const char* name, const void* values, const Int3& nodes, TexelKind kind,
  std::uint64_t version, vtkShaderProgram& program)
{
  FieldTexture& field = this->Fields[name];
  this->Began = this->Began || !field.IsThere();
  this->Uploaded += field.Use(this->Window, values, nodes, kind, version);
  program.SetUniformi(name, field.Unit());
}

void OpenGlCaster::UseBuffer(const char* name, const float* values, std::size_t texels,
  std::uint64_t version, vtkShaderProgram& program)
{
  OtherTexture& other = this->Others[name];
  if (!other.isThere || other.version != version)
  {
    gl::ForgetErrors();
    other.texture->SetContext(this->Window);
    const bool done =
      other.buffer->Upload(values, 4 * texels, vtkOpenGLBufferObject::TextureBuffer) &&
      other.texture->CreateTextureBuffer(static_cast<unsigned>(texels), 4, VTK_FLOAT, other.buffer);
    gl::RequireNoError(done, int(texels), 1, 1, 16);
    this->Uploaded += Index(16 * texels);
    other.isThere = true;
    other.version = version;
  }
  other.texture->Activate();
  program.SetUniformi(name, other.texture->GetTextureUnit());
}

void OpenGlCaster::UseDepth(
  const char* name, const float* values, const View& view, vtkShaderProgram& program)
{
  if (!values)
  {
    return;
  }
  vtkTextureObject* texture = this->Others[name].texture;
  gl::ForgetErrors();
  texture->SetContext(this->Window);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  // The cast is safe: VTK does not write to the values.
  const bool done = texture->Create2DFromRaw(static_cast<unsigned>(view.width),
    static_cast<unsigned>(view.height), 1, VTK_FLOAT, const_cast<float*>(values));
  gl::RequireNoError(done, view.width, view.height, 1, 4);
  this->Uploaded += Index(sizeof(float)) * view.width * view.height;
  texture->Activate();
  program.SetUniformi(name, texture->GetTextureUnit());
}
}
