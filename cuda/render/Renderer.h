// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_Renderer_h
#define limpid_render_Renderer_h

#include "math/Range.h"
#include "methods/Method.h"
#include "render/DrawnPart.h"
#include "render/ScalarNodes.h"
#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "scene/Structures.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace limpid
{
class RenderBackend;

/// Transfer functions of a scalar, sampled at equal steps from `low` to `high` and constant
/// outside.
struct TransferFunctions
{
  double low = 0;
  double high = 1;                         ///< above low
  std::vector<float> extinction;           ///< two or more values >= 0, finite [1/length]
  std::vector<std::array<float, 3>> color; ///< as many colours [0, 1]
};

/**
 * The lighting, Eqs. (3)-(6). Off: every sample has the colour of the transfer function.
 *
 * A sample sends this multiple of its colour to the viewer (Documentation/Method.md):
 *   ambient + (1 - ambient) exposure (1 - strength (1 - T_L)) L
 *   L = (f_v' + k_s pi f_s (w_L.n)+) / (1 + k_s)
 *   k_s = surface |grad mu-bar| / its largest value
 *   exposure = intensity / (1 - strength / 2)
 *
 * f_v' is the Henyey-Greenstein function over its value at the centre of the volume. For f_s, see
 * SurfaceScattering.
 */
struct Lighting
{
  bool enabled = false;
  Light light;                 ///< in world coordinates
  double intensity = 1;        ///< brightness, >= 0; at 1, what faces light and viewer has its own
                               ///< colour
  double ambient = 0.35;       ///< share of ambient light [0, 1]
  double anisotropy = 0.6;     ///< a of the Henyey-Greenstein function (-1, 1)
  double surface = 2;          ///< k_s where the base extinction is steepest, >= 0
  double specularPower = 20;   ///< exponent of the Blinn-Phong lobe, >= 0
  bool shadows = true;         ///< T_L of Eq. (4); off: 1
  double shadowStrength = 0.7; ///< strength of the shadow [0, 1]
};

bool operator==(const Lighting& one, const Lighting& other);

/// A picture to render: the course, the ends and the sampling of its rays.
struct View
{
  int width = 0;  ///< width [pixels]
  int height = 0; ///< height [pixels], bottom row first

  /// The matrix from clip coordinates of the picture, with x, y, z in [-1, 1] (left, bottom, near:
  /// -1), to world coordinates; perspective or parallel. Columns as in OpenGL.
  glm::dmat4 clipToWorld{ 1.0 };

  /// Clip z in [-1, 1] where the ray of a pixel ends, width * height values; null: 1 for all.
  const float* depth = nullptr;

  /// Clip z in [-1, 1] where the ray of a pixel begins, width * height values; null: -1 for all. If
  /// a ray begins behind its entry into the box, its samples are a subset of those of the whole
  /// ray, so that the contributions of two parts of a ray add up. A ray that ends before it begins
  /// is empty.
  const float* nearDepth = nullptr;

  /// Whether missed structures are painted over the picture, see Renderer::ShowMissed.
  bool paintsMissed = true;

  /// Clip z up to which missed importance is accumulated, starting at the viewer, width * height
  /// values; null: between the two above. For the foremost of several parts of rays: what is hidden
  /// by one part may be in another one.
  const float* missedDepth = nullptr;

  /// Rays are limited to dot(plane, (x, y, z, 1)) >= 0 for all of these planes, in world
  /// coordinates; at most RayMaker::mostPlanes.
  std::vector<glm::dvec4> planes;

  double sampleDistance = 1; ///< distance of samples, in units of the smallest spacing, > 0
  Range<int> rows;           ///< of pixels with rays, others are empty; empty: all have rays
  bool jitter = false;       ///< shift the samples of each ray by a fixed pseudo-random amount
  bool skipEmpty = true;     ///< skip what is empty; never changes the picture
  double opaqueBelow = 1 / 1024.0; ///< a ray ends when its transmittance falls below this; 0: never

  Range<int> RowsWithRays() const
  {
    return this->rows.Empty() ? Range<int>{ 0, this->height } : this->rows;
  }
};

/// A picture, bottom row first.
struct Picture
{
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba; ///< colours premultiplied by alpha, 4 bytes per pixel

  /// If processes have drawn parts, for each pixel the process whose part is foremost, whose box is
  /// certainly visible there; -1: none. Otherwise empty.
  std::vector<std::int32_t> foremost;
};

/**
 * Renders a volume with single scattering, Eqs. (1)-(6).
 *
 * The extinction of a sample is clamp(mu-bar(s) + delta, 0, majorant): the transfer function of the
 * interpolated scalar, as in ordinary volume rendering, plus the interpolated change by the
 * optimisation (Documentation/Method.md).
 *
 * Fields belong to the caller and must stay valid while the renderer uses them.
 */
class Renderer
{
public:
  /// Draws on the processor.
  Renderer();

  /// Draws with this backend.
  explicit Renderer(std::unique_ptr<RenderBackend> backend);

  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /**
   * Sets the scalars at the nodes of a grid, or of the part of it that this process has; NaN: an
   * empty node. The array belongs to the caller and must stay valid. `shares`: the share of the
   * transfer function's extinction that is kept at each node [0, 1], which is copied; null:
   * everything.
   *
   * If several processes draw parts, all methods are collective, with equal arguments except
   * fields, and every process gets the whole pictures. A part must have at least two nodes along
   * each axis, and ghosts around the owned nodes: two more than the distance of samples [nodes],
   * for half a segment, the rest of a cell, and gradients. Importance is not supported then, nor
   * are GPUs, nor compositing other than front to back.
   */
  void SetScalars(const DrawnPart& part, const ScalarNodes& scalars, const float* shares = nullptr);

  /// Sets the transfer functions; call it again after changes.
  void SetTransferFunctions(const TransferFunctions& functions);

  /**
   * Sets the extinction to show: `base` and `extinction` at the nodes of the scalars, or at all
   * nodes of a grid over the whole box, as fine or coarser [1/length]; during interaction,
   * processes that draw parts need not wait for each other with the latter. Only their difference
   * matters, and for shadows `extinction` itself. Null for both: the transfer function's extinction
   * alone.
   *
   * `share` in (0, 1]: how far to move from the shown extinction to the new one; 1: at once.
   * `lightExtinction`: casts the shadows, if it differs from `extinction`.
   */
  void SetExtinction(const DrawnPart& part, const float* base, const float* extinction,
    double share = 1, const float* lightExtinction = nullptr);

  /// Returns whether a device with its own memory draws.
  bool DrawsOnDevice() const;

  /// SetExtinction with arrays in the memory of the drawing device, which may be freed after the
  /// call. On the processor, the arrays belong to the caller and must stay valid, as above.
  void ShowThere(const Grid& grid, const float* base, const float* extinction, double share = 1,
    const float* lightExtinction = nullptr);

  /// Sets the light of the following pictures. Shadows are computed when they are needed.
  void SetLighting(const Lighting& lighting);

  /// Sets the importance at the nodes of the scalars [0, 1]; null: none, as after new scalars. The
  /// array belongs to the caller and must stay valid.
  void SetImportance(const float* importance);

  /// Sets the colour that is painted over the following pictures where they miss important
  /// structures: these were removed, or are hidden and could be seen in that pixel (RayImportance).
  /// None: no paint.
  void ShowMissed(const std::optional<std::array<float, 3>>& color);

  /// Sets the row of the structure at each node of the scalars; null: none, as after new scalars.
  /// The array belongs to the caller and must stay valid.
  void SetStructures(const StructureRow* rows);

  /// Sets how far the colours of samples are moved to those of their structures [0, 1], and these
  /// colours from row 1 on. What is in none of them keeps the transfer function's colour.
  void TintStructures(double share, const std::vector<std::array<float, 3>>& colors);

  /// Sets the compositing of the following pictures. Without importance, it must be front to back.
  void ComposeBy(Compositing compositing);

  /// Sets the number of rays of the shadow volume per voxel and axis. Default 3.
  void SetShadowRayDensity(double density);

  /// Sets the spacing of the nodes of the shadows along each axis, in units of that of the
  /// extinction's nodes, for pictures during interaction. Above 1, every process has all of them.
  /// Default 1.
  void SetShadowCoarseness(int factor);

  /// Computes the shadows if the next picture needs them, and waits for them. Returns whether there
  /// was work to do.
  bool UpdateShadows();

  /// Computes everything for the next picture except its rays, which Render casts.
  void Prepare();

  /// Returns a number that grows with every change that affects pictures, except changes of views.
  std::uint64_t Changes() const;

  /// Throws limpid::Error if there are no scalars or transfer functions, or if the view is invalid.
  void Render(const View& view, Picture& picture);

  /// Returns the light that arrives at a world position [0, 1], see ArrivingNode; 1 outside of the
  /// grid and without shadows.
  double ArrivingLightAt(const Vec3& world);

private:
  struct Internals;
  std::unique_ptr<Internals> State;
};
}

#endif
