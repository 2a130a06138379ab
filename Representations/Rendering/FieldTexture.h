// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A field of nodes in the memory of OpenGL.

#ifndef limpid_FieldTexture_h
#define limpid_FieldTexture_h

#include "math/Vec.h"
#include "render/ScalarNodes.h"

#include "vtkNew.h"

#include <cstdint>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace limpid
{
/// What a node has, and how the shader reads it.
enum class TexelKind
{
  Float,
  FloatOfInt8, ///< an integer, stored as a float
  FloatOfUInt8,
  FloatOfInt16,
  FloatOfUInt16,
  OneNumber,    ///< a float in [0, packedOne], stored in 16 bits and read in [0, 1]
  TwoNumbers,   ///< packed, read in [0, 1]
  FirstOfTwo,   ///< the same, without the second, which is read as 0
  FourNumbers,  ///< packed, read in [-1, 1]
  SmallInteger, ///< of 8 bits
  Integer       ///< of 16 bits
};

/// Returns how textures have such scalars.
TexelKind KindOf(const ScalarNodes& scalars);

/// A 3-D texture. Only bricks of nodes that have changed are uploaded.
class FieldTexture
{
public:
  FieldTexture();
  ~FieldTexture();

  /// Activates the texture; first uploads what has changed if the version is another one. Returns
  /// the bytes that were uploaded. The context must be current. Throws DeviceError if there is no
  /// memory.
  Index Use(vtkOpenGLRenderWindow* window, const void* values, const Int3& nodes, TexelKind kind,
    std::uint64_t version);

  void Deactivate();

  /// Frees the memory. The context must be current.
  void Release(vtkWindow* window);

  int Unit() const;
  bool IsThere() const { return this->HasValues; }

private:
  void Allocate(vtkOpenGLRenderWindow* window);
  Index UploadChanged(const void* values, bool all);

  vtkNew<vtkTextureObject> Texture;
  bool IsActive = false;
  Int3 Nodes{ 0 };
  TexelKind Kind = TexelKind::Float;
  std::uint64_t Version = 0;
  bool HasValues = false;
  std::vector<std::uint64_t> Hashes; ///< of the bricks
};
}

#endif
