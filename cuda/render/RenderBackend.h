// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_RenderBackend_h
#define limpid_render_RenderBackend_h

#include "render/Classification.h"
#include "render/RayLight.h"
#include "render/Renderer.h"

#include <array>
#include <memory>
#include <optional>

namespace limpid
{
/// How rays are cast, apart from where they run.
struct Casting
{
  bool lit = false;
  RayLight light; ///< if lit
  bool skipEmpty = true;
  float opaqueBelow = 0;
  float stepLength = 1;                               ///< between samples [length]
  std::optional<std::array<float, 3>> missedColor;    ///< none: what is missed is not painted
  Compositing compositing = Compositing::FrontToBack; ///< others need the importance
};

/// The nodes of an extinction that is shown.
struct ShownNodes
{
  Grid grid;          ///< over the box of the scalars that are here, or of those of all ranks
  bool ofAll = false; ///< that: every rank has all of them
};

/**
 * Draws for a Renderer, on the processor or on a GPU. The backend holds the fields in the form in
 * which rays read them; the renderer knows what has changed and calls no pass without need.
 *
 * Arrays that are given belong to the caller, who keeps them.
 */
class RenderBackend
{
public:
  virtual ~RenderBackend() = default;

  /// See Renderer; before the scalars. Null: all is here.
  virtual void SetPiece(const Grid& whole, std::shared_ptr<const ScenePiece> piece) = 0;

  /// See Renderer. The grid may be without volume; then nothing else is called.
  virtual void SetScalars(const Grid& grid, const float* scalars, const float* shares) = 0;

  virtual void SetTransferFunctions(const Classification& classification) = 0;

  /// See Renderer; no array but the last one is null. Transfer functions were set before.
  virtual void SetExtinction(const ShownNodes& nodes, const float* base, const float* extinction,
    double share, const float* lightExtinction) = 0;

  /// Whether that is a device with a memory of its own.
  virtual bool IsDevice() const = 0;

  /// SetExtinction with arrays in the memory of the device that draws. It takes what it needs of
  /// them before what follows there.
  virtual void ShowThere(const Grid& grid, const float* base, const float* extinction, double share,
    const float* lightExtinction) = 0;

  /// Shows the transfer function's extinction of the scalars.
  virtual void UseTransferFunction(const ShownNodes& nodes) = 0;

  /// Forgets the extinction and its shadows.
  virtual void ClearExtinction() = 0;

  /// Whether there is neither a given nor a used extinction.
  virtual bool HasNoExtinction() const = 0;

  /// Finds the shadows of what is shown, or of the lightExtinction that was given, on a grid over
  /// the same box. There is an extinction.
  virtual void CastShadows(const Grid& grid, const RaySource& light, double rayDensity) = 0;

  /// Waits until all work is done.
  virtual void Wait() = 0;

  /// Forgets the shadows. No picture asks for them before they are cast again.
  virtual void ClearShadows() = 0;

  /// Finds the gradient of the transfer function's extinction.
  virtual void FindGradient() = 0;

  /// Finds where there is no extinction.
  virtual void FindEmptyBricks() = 0;

  /// Takes the importance at the nodes of the scalars [0, 1].
  virtual void SetImportance(const float* importance) = 0;

  /// Forgets the importance and what belongs to it. No picture asks for what is missed before it is
  /// set again.
  virtual void ClearImportance() = 0;

  /// Finds where neither the transfer function nor a change has any extinction: what is cleared is
  /// not empty here.
  virtual void FindBareBricks() = 0;

  /// Draws a picture, which has the size of the view.
  virtual void Cast(const Casting& casting, const View& view, Picture& picture) = 0;

  /// Transmittance of the light at a position among the nodes of the extinction [index].
  virtual double LightTransmittanceAt(const Vec3& position) = 0;
};
}

#endif
