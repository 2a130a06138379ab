// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_PictureEngine_h
#define limpid_render_PictureEngine_h

#include "render/Classification.h"
#include "render/RayLight.h"
#include "render/Renderer.h"

#include <array>
#include <memory>

namespace limpid
{
/// How rays are cast, apart from where they run.
struct Casting
{
  bool lit = false;
  RayLight light;                                          ///< if lit
  std::array<float, 3> lightColor{ { 1.0f, 1.0f, 1.0f } }; ///< likewise
  bool skipEmpty = true;
  float opaqueBelow = 0;
  float stepLength = 1; ///< between samples [length]
};

/**
 * What draws for a Renderer: the processor or a GPU. It holds the fields in the form in which rays
 * read them; the renderer knows what has changed and calls what has to be done, no more.
 *
 * Arrays that are given belong to the caller, who keeps them.
 */
class PictureEngine
{
public:
  virtual ~PictureEngine() = default;

  /// See Renderer. The grid may be without volume; then nothing else is called.
  virtual void SetScalars(const Grid& grid, const float* scalars) = 0;

  virtual void SetTransferFunctions(const Classification& classification) = 0;

  /// See Renderer; no array but the last one is null. Call it with transfer functions.
  virtual void SetExtinction(const Grid& grid, const float* base, const float* extinction,
    double share, const float* lightExtinction) = 0;

  /// The same with arrays in the memory of the device that draws, which takes what it needs of them
  /// before what follows there.
  virtual void ShowThere(const Grid& grid, const float* base, const float* extinction, double share,
    const float* lightExtinction) = 0;

  /// The transfer function's extinction of the scalars, unchanged, on a grid over the same box.
  virtual void UseTransferFunction(const Grid& grid) = 0;

  /// No extinction is given any more, and there are no shadows.
  virtual void ClearExtinction() = 0;

  /// Whether there is neither a given nor a used extinction.
  virtual bool HasNoExtinction() const = 0;

  /// What is shown, or the lightExtinction that was given, casts shadows. `grid`: over the same
  /// box. Call it with an extinction.
  virtual void CastShadows(const Grid& grid, const RaySource& light, double rayDensity) = 0;

  virtual void ClearShadows() = 0;

  /// The gradient of the transfer function's extinction.
  virtual void FindGradient() = 0;

  /// Where there is no extinction.
  virtual void FindEmptyBricks() = 0;

  /// `picture`: of the size of the view.
  virtual void Cast(const Casting& casting, const View& view, Picture& picture) = 0;

  /// Transmittance of the light at a position among the nodes of the extinction [index].
  virtual double LightTransmittanceAt(const Vec3& position) = 0;
};

std::unique_ptr<PictureEngine> CpuPictures();

/// Throws limpid::Error if there is no GPU.
std::unique_ptr<PictureEngine> CudaPictures();
}

#endif
