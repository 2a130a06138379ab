// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Rays that are cast by something else than the core, such as OpenGL, from fields of the processor.

#ifndef limpid_render_RayCaster_h
#define limpid_render_RayCaster_h

#include "render/PartialPicture.h"
#include "render/RayScene.h"
#include "render/RenderBackend.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace limpid
{
/// Numbers that change whenever the fields of a picture do.
struct FieldVersions
{
  std::uint64_t scalars = 0;
  std::uint64_t functions = 0; ///< transfer functions
  std::uint64_t overlay = 0;
  std::uint64_t shadow = 0;
  std::uint64_t gradient = 0;
  std::uint64_t importance = 0;
  std::uint64_t structures = 0;
  std::uint64_t bricks = 0;     ///< of RayScene::bricks
  std::uint64_t bareBricks = 0; ///< the same of the rays that gather missed importance
};

/// The rays of a picture and the fields that they read, in the memory of the processor.
struct CastTask
{
  const DrawnPart& part;
  const Casting& casting;
  View view;       ///< without depths that all rays have anyway
  RayScene scene;  ///< its shadow is always apart from the gradient
  RayScene missed; ///< of the rays that gather missed importance, if casting.missedColor is set
  FieldVersions versions;
};

/// Casts rays in place of the processor.
class RayCaster
{
public:
  virtual ~RayCaster() = default;

  /// Draws a picture: its rays if this process has the whole, or else, into `parts`, those that it
  /// owns. The output has one value per pixel. Returns whether it can; otherwise the processor
  /// does.
  virtual bool Cast(const CastTask& task, Picture& picture, std::vector<PartialPixel>& parts) = 0;
};

/// Makes a backend that computes fields on the processor and has rays cast elsewhere.
std::unique_ptr<RenderBackend> BackendWith(std::shared_ptr<RayCaster> caster);
}

#endif
