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
#include <vector>

namespace limpid
{
/// Parameters of ray casting that do not depend on the device.
struct Casting
{
  bool lit = false;
  RayLight light; ///< if there is lighting
  bool skipEmpty = true;
  float opaqueBelow = 0;
  float stepLength = 1;                               ///< distance of samples [length]
  std::optional<std::array<float, 3>> missedColor;    ///< none: missed structures are not painted
  Compositing compositing = Compositing::FrontToBack; ///< the others need importance
  std::vector<FourFloats> tints;                      ///< see RayScene; empty: not tinted
};

/**
 * Draws for a Renderer, on the processor or on a GPU. The backend holds the fields in the form that
 * rays read. The renderer tracks changes and calls only the passes that are needed.
 *
 * Arrays passed to it belong to the caller and must stay valid.
 */
class RenderBackend
{
public:
  virtual ~RenderBackend() = default;

  /// See Renderer. If the part has no volume, nothing else is called.
  virtual void SetScalars(
    const DrawnPart& part, const ScalarNodes& scalars, const float* shares) = 0;

  virtual void SetTransferFunctions(const Classification& classification) = 0;

  /// See Renderer. Only the last array may be null. Transfer functions must have been set.
  virtual void SetExtinction(const DrawnPart& part, const float* base, const float* extinction,
    double share, const float* lightExtinction) = 0;

  /// Returns whether it is a device with its own memory.
  virtual bool IsDevice() const = 0;

  /// SetExtinction with arrays in the memory of the drawing device. They are read before any later
  /// work there.
  virtual void ShowThere(const Grid& grid, const float* base, const float* extinction, double share,
    const float* lightExtinction) = 0;

  /// Shows the transfer function's extinction of the scalars, at the nodes of this part.
  virtual void UseTransferFunction(const DrawnPart& part) = 0;

  /// Discards the extinction and its shadows.
  virtual void ClearExtinction() = 0;

  /// Returns whether there is no extinction, neither given nor from the transfer function.
  virtual bool HasNoExtinction() const = 0;

  /// Computes the shadows of the shown extinction, or of the lightExtinction that was given, at the
  /// nodes of this part. Requires an extinction.
  virtual void CastShadows(const DrawnPart& part, const RaySource& light, double rayDensity) = 0;

  /// Waits until all work is done.
  virtual void Wait() = 0;

  /// Discards the shadows. They must be cast again before a picture that needs them.
  virtual void ClearShadows() = 0;

  /// Computes the gradient of the transfer function's extinction.
  virtual void FindGradient() = 0;

  /// Computes where there is no extinction.
  virtual void FindEmptyBricks() = 0;

  /// Sets the importance at the nodes of the scalars [0, 1].
  virtual void SetImportance(const float* importance) = 0;

  /// Discards the importance and derived data. It must be set again before a picture shows what is
  /// missed.
  virtual void ClearImportance() = 0;

  /// Sets the rows of structures at the nodes of the scalars; null: none. They must be set again
  /// after new scalars before a picture is tinted.
  virtual void SetStructures(const StructureRow* rows) = 0;

  /// Computes where neither the transfer function nor a change has any extinction; cleared parts
  /// are not empty here.
  virtual void FindBareBricks() = 0;

  /// Draws a picture of the view's size. With room for Picture::foremost, it is composed of the
  /// parts of all processes.
  virtual void Cast(const Casting& casting, const View& view, Picture& picture) = 0;

  /// Returns the light that arrives at a position among the nodes of the extinction [index].
  virtual double ArrivingLightAt(const Vec3& position) = 0;
};
}

#endif
