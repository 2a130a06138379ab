// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Casts the rays of pictures by OpenGL.

#ifndef limpid_OpenGlCaster_h
#define limpid_OpenGlCaster_h

#include "FieldTexture.h"
#include "OffScreenTarget.h"

#include "render/RayCaster.h"

#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace limpid
{
struct ShaderRays;

/**
 * The shader, CastRays.glsl, has the formulas of the core. Fields are 3-D textures: scalars with 32
 * bits, gradient, overlay and shadows with 16 bits each; 16 bytes per node with light and
 * optimisation, 18 if that adds extinction. The picture is copied to the processor, where it is
 * treated like any other.
 */
class OpenGlCaster : public RayCaster
{
public:
  explicit OpenGlCaster(vtkOpenGLRenderWindow* window);
  ~OpenGlCaster() override;

  /// Draws with the context of another window from now on.
  void DrawIn(vtkOpenGLRenderWindow* window);

  bool Cast(const CastTask& task, Picture& picture, std::vector<PartialPixel>& parts) override;

  /// Returns why the last picture was not drawn; empty if it was.
  const std::string& Refusal() const { return this->WhyNot; }

  /// Returns whether OpenGL has failed. It is not used again.
  bool HasFailed() const { return this->Failed; }

  /// Returns whether the last picture made something that later ones use, which took time.
  bool HasBegun() const { return this->Began; }

  /// Returns the bytes of fields, tables and depths that pictures have uploaded since the last
  /// call.
  Index TakeUploadedBytes() { return std::exchange(this->Uploaded, 0); }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  vtkOpenGLQuadHelper& ReadyQuad(const CastTask& task);
  void SetFields(const CastTask& task, vtkShaderProgram& program);
  bool Adds(const RayScene& scene, std::uint64_t version);
  void SetDepths(const View& view, vtkShaderProgram& program);
  void UseField(const char* name, const void* values, const Int3& nodes, TexelKind kind,
    std::uint64_t version, vtkShaderProgram& program);
  void UseBuffer(const char* name, const float* values, std::size_t texels, std::uint64_t version,
    vtkShaderProgram& program);
  void UseDepth(const char* name, const float* values, const View& view, vtkShaderProgram& program);
  void DrawPicture(const CastTask& task, const ShaderRays& rays, Picture& picture,
    std::vector<PartialPixel>& parts);
  void Deactivate();

  /// A texture other than a field.
  struct OtherTexture;

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  bool HoldsMemory = false; ///< of OpenGL
  bool Failed = false;
  std::string WhyNot;
  std::map<std::string, std::unique_ptr<vtkOpenGLQuadHelper>> Quads; ///< by what they define
  std::map<std::string, FieldTexture> Fields; ///< by their names in the shader
  std::map<std::string, OtherTexture> Others;
  OffScreenTarget Target;
  bool AddsAnything = false; ///< whether the overlay adds extinction anywhere
  std::uint64_t AddsOf = 0;  ///< version of the overlay; 0: unknown
  Index Uploaded = 0;
  bool Began = false;
};
}

#endif
