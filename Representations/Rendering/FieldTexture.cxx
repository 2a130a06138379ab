// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "FieldTexture.h"

#include "OpenGlFunctions.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace limpid
{
namespace
{
constexpr int brickSize = 32; // nodes

struct TexelFormat
{
  unsigned internal;
  unsigned format;
  unsigned type;
  int bytes;       ///< of a node in the texture
  int sourceBytes; ///< of a node in the field
  bool interpolates;
};

TexelFormat FormatOf(TexelKind kind)
{
  switch (kind)
  {
    case TexelKind::Float:
      return { GL_R32F, GL_RED, GL_FLOAT, 4, 4, true };
    case TexelKind::FloatOfInt8:
    case TexelKind::FloatOfUInt8:
      return { GL_R32F, GL_RED, GL_FLOAT, 4, 1, true };
    case TexelKind::FloatOfInt16:
    case TexelKind::FloatOfUInt16:
      return { GL_R32F, GL_RED, GL_FLOAT, 4, 2, true };
    case TexelKind::OneNumber:
      return { GL_R16_SNORM, GL_RED, GL_SHORT, 2, 4, true };
    case TexelKind::TwoNumbers:
      return { GL_RG16_SNORM, GL_RG, GL_SHORT, 4, 4, true };
    case TexelKind::FirstOfTwo:
      return { GL_R16_SNORM, GL_RED, GL_SHORT, 2, 4, true };
    case TexelKind::FourNumbers:
      return { GL_RGBA16_SNORM, GL_RGBA, GL_SHORT, 8, 8, true };
    case TexelKind::SmallInteger:
      return { GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1, 1, false };
    case TexelKind::Integer:
      return { GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT, 2, 2, false };
  }
  return {};
}

/// A brick of nodes.
struct Brick
{
  Int3 first;
  Int3 size;

  /// Calls visit(index of the first node) for all rows.
  template <class Visit>
  void ForRows(const Int3& nodes, const Visit& visit) const
  {
    for (int k = this->first.z; k < this->first.z + this->size.z; ++k)
    {
      for (int j = this->first.y; j < this->first.y + this->size.y; ++j)
      {
        visit(this->first.x + nodes.x * (j + Index(nodes.y) * k));
      }
    }
  }
};

std::vector<Brick> BricksOf(const Int3& nodes)
{
  std::vector<Brick> bricks;
  for (int k = 0; k < nodes.z; k += brickSize)
  {
    for (int j = 0; j < nodes.y; j += brickSize)
    {
      for (int i = 0; i < nodes.x; i += brickSize)
      {
        const Int3 first(i, j, k);
        bricks.push_back({ first, glm::min(Int3(brickSize), nodes - first) });
      }
    }
  }
  return bricks;
}

/// Continues a hash with some bytes [FNV-1a, by words].
std::uint64_t HashOf(const std::uint8_t* bytes, std::size_t count, std::uint64_t hash)
{
  constexpr std::uint64_t prime = 0x100000001b3;
  constexpr std::size_t word = sizeof(std::uint64_t);
  for (std::size_t at = 0; at < count; at += word)
  {
    std::uint64_t next = 0;
    std::memcpy(&next, bytes + at, std::min(word, count - at));
    hash = (hash ^ next) * prime;
    hash ^= hash >> 32; // high bits of words would only reach high bits
  }
  return hash;
}

/// Returns a number of a node in 16 bits.
std::int16_t PackedOf(TexelKind kind, const std::uint8_t* node)
{
  std::int16_t packed = 0;
  if (kind == TexelKind::OneNumber)
  {
    float value = 0;
    std::memcpy(&value, node, sizeof(value));
    packed = static_cast<std::int16_t>(value);
  }
  else
  {
    std::memcpy(&packed, node, sizeof(packed));
  }
  return packed;
}

/// Returns nodes that textures have as floats.
ScalarNodes IntegersOf(TexelKind kind, const std::uint8_t* nodes)
{
  switch (kind)
  {
    case TexelKind::FloatOfInt8:
      return ScalarNodes(reinterpret_cast<const std::int8_t*>(nodes));
    case TexelKind::FloatOfUInt8:
      return ScalarNodes(nodes);
    case TexelKind::FloatOfInt16:
      return ScalarNodes(reinterpret_cast<const std::int16_t*>(nodes));
    case TexelKind::FloatOfUInt16:
      return ScalarNodes(reinterpret_cast<const std::uint16_t*>(nodes));
    default:
      return {};
  }
}

/// Appends nodes in the form of the texture.
void Append(TexelKind kind, const std::uint8_t* from, int count, std::vector<std::uint8_t>& texels)
{
  const TexelFormat format = FormatOf(kind);
  const std::size_t before = texels.size();
  texels.resize(before + std::size_t(count) * std::size_t(format.bytes));
  std::uint8_t* to = &texels[before];
  if (format.bytes == format.sourceBytes)
  {
    std::memcpy(to, from, texels.size() - before);
    return;
  }
  const ScalarNodes integers = IntegersOf(kind, from);
  for (int i = 0; i < count; ++i)
  {
    if (integers.IsThere())
    {
      const float scalar = integers.At(i);
      std::memcpy(to + std::ptrdiff_t(i) * format.bytes, &scalar, sizeof(scalar));
      continue;
    }
    const std::int16_t packed = PackedOf(kind, from + std::ptrdiff_t(i) * format.sourceBytes);
    std::memcpy(to + std::ptrdiff_t(i) * format.bytes, &packed, sizeof(packed));
  }
}
}

TexelKind KindOf(const ScalarNodes& scalars)
{
  switch (scalars.Bits())
  {
    case 8:
      return scalars.IsSigned() ? TexelKind::FloatOfInt8 : TexelKind::FloatOfUInt8;
    case 16:
      return scalars.IsSigned() ? TexelKind::FloatOfInt16 : TexelKind::FloatOfUInt16;
    default:
      return TexelKind::Float;
  }
}

FieldTexture::FieldTexture() = default;
FieldTexture::~FieldTexture() = default;

Index FieldTexture::Use(vtkOpenGLRenderWindow* window, const void* values, const Int3& nodes,
  TexelKind kind, std::uint64_t version)
{
  const bool fits = this->HasValues && this->Nodes == nodes && this->Kind == kind;
  if (!fits)
  {
    this->Release(window);
    this->Nodes = nodes;
    this->Kind = kind;
    this->Allocate(window);
  }
  this->Texture->Activate();
  this->IsActive = true;
  if (!fits || this->Version != version)
  {
    this->HasValues = false; // in case the next line throws
    const Index uploaded = this->UploadChanged(values, !fits);
    this->HasValues = true;
    this->Version = version;
    return uploaded;
  }
  return 0;
}

void FieldTexture::Allocate(vtkOpenGLRenderWindow* window)
{
  const TexelFormat format = FormatOf(this->Kind);
  const int filter = format.interpolates ? vtkTextureObject::Linear : vtkTextureObject::Nearest;
  this->Texture->SetContext(window);
  this->Texture->ResetFormatAndType();
  this->Texture->SetInternalFormat(format.internal);
  this->Texture->SetFormat(format.format);
  this->Texture->SetDataType(format.type);
  this->Texture->SetMinificationFilter(filter);
  this->Texture->SetMagnificationFilter(filter);
  this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapR(vtkTextureObject::ClampToEdge);
  gl::ForgetErrors();
  const bool made = this->Texture->Create3DFromRaw(static_cast<unsigned>(this->Nodes.x),
    static_cast<unsigned>(this->Nodes.y), static_cast<unsigned>(this->Nodes.z), 1, VTK_FLOAT,
    nullptr);
  gl::RequireNoError(made, this->Nodes.x, this->Nodes.y, this->Nodes.z, format.bytes);
}

Index FieldTexture::UploadChanged(const void* values, bool all)
{
  const TexelFormat format = FormatOf(this->Kind);
  const auto* bytes = static_cast<const std::uint8_t*>(values);
  const auto at = [&](Index node) { return bytes + node * format.sourceBytes; };
  const std::vector<Brick> bricks = BricksOf(this->Nodes);
  std::vector<std::uint64_t> hashes(bricks.size());
  ParallelFor(Index(bricks.size()),
    [&](Index number)
    {
      const Brick& brick = bricks[std::size_t(number)];
      const auto length = std::size_t(brick.size.x) * std::size_t(format.sourceBytes);
      std::uint64_t hash = 0xcbf29ce484222325;
      brick.ForRows(this->Nodes, [&](Index node) { hash = HashOf(at(node), length, hash); });
      hashes[std::size_t(number)] = hash;
    });
  gl::ForgetErrors();
  Index uploaded = 0;
  std::vector<std::uint8_t> texels;
  for (std::size_t number = 0; number < bricks.size(); ++number)
  {
    if (!all && hashes[number] == this->Hashes[number])
    {
      continue;
    }
    const Brick& brick = bricks[number];
    texels.clear();
    brick.ForRows(
      this->Nodes, [&](Index node) { Append(this->Kind, at(node), brick.size.x, texels); });
    gl::UploadBox(&brick.first[0], &brick.size[0], format.format, format.type, texels.data());
    uploaded += Index(texels.size());
  }
  gl::RequireNoError(true, this->Nodes.x, this->Nodes.y, this->Nodes.z, format.bytes);
  this->Hashes = std::move(hashes);
  return uploaded;
}

void FieldTexture::Deactivate()
{
  if (this->IsActive)
  {
    this->Texture->Deactivate();
    this->IsActive = false;
  }
}

void FieldTexture::Release(vtkWindow* window)
{
  this->Deactivate();
  this->Texture->ReleaseGraphicsResources(window);
  this->HasValues = false;
}

int FieldTexture::Unit() const
{
  return this->Texture->GetTextureUnit();
}
}
