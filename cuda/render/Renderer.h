// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_Renderer_h
#define limpid_render_Renderer_h

#include "methods/Method.h"
#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "scene/ScenePiece.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace limpid
{
class RenderBackend;

/// Transfer functions of a scalar, sampled at equal steps from `low` to `high`, constant outside.
struct TransferFunctions
{
  double low = 0;
  double high = 1;                         ///< above low
  std::vector<float> extinction;           ///< two or more values >= 0, finite [1/length]
  std::vector<std::array<float, 3>> color; ///< as many colours [0, 1]
};

/**
 * How the overlay is lit, Eqs. (3)-(6). Off: every sample has the colour of the transfer function.
 *
 * A sample sends its colour times
 *   ambient + (1 - ambient) exposure (1 - strength (1 - T_L)) (f_v' + k_s pi f_s (w_L.n)+) / (1 +
 * k_s) to the viewer: f_v' is the Henyey-Greenstein function over its value in the middle of the
 * volume, f_s see SurfaceScattering, k_s = surface |grad mu-bar| / its largest value, and exposure
 * = intensity / (1 - strength / 2), see Documentation/Method.md.
 */
struct Lighting
{
  bool enabled = false;
  Light light;                 ///< in world coordinates
  double intensity = 1;        ///< 1: what faces light and viewer has its own colour, >= 0
  double ambient = 0.35;       ///< share of the light that comes from everywhere [0, 1]
  double anisotropy = 0.6;     ///< a of the Henyey-Greenstein function (-1, 1)
  double surface = 2;          ///< k_s where the base extinction is steepest, >= 0
  double specularPower = 20;   ///< exponent of the Blinn-Phong lobe, >= 0
  bool shadows = true;         ///< T_L of Eq. (4); off: 1
  double shadowStrength = 0.7; ///< share of the shadow that is drawn [0, 1]
};

bool operator==(const Lighting& one, const Lighting& other);

/// A picture to be made: where its rays run, where they end, how they are sampled.
struct View
{
  int width = 0;  ///< pixels
  int height = 0; ///< pixels, first row at the bottom

  /// From clip coordinates of the picture, x, y, z in [-1, 1] (left, bottom, near: -1), to world
  /// coordinates; perspective or parallel. Columns as in OpenGL.
  glm::dmat4 clipToWorld{ 1.0 };

  /// Clip z in [-1, 1] at which the ray of a pixel ends, width * height values; null: all at 1.
  const float* depth = nullptr;

  /// Clip z in [-1, 1] at which it begins, likewise; null: all at -1. Where it begins behind the
  /// entry into the box, its samples are some of those of the whole ray, so that what two parts of
  /// a ray meet adds up. A ray that ends before it begins meets nothing.
  const float* nearDepth = nullptr;

  /// Whether what is missed is painted over the picture, see Renderer::ShowMissed.
  bool paintsMissed = true;

  /// Clip z to which what is missed is gathered, from the viewer on, likewise; null: between the
  /// two above. For the foremost of several parts, which are not rays of their own: what one hides
  /// may lie in another one.
  const float* missedDepth = nullptr;

  /// Rays run where dot(plane, (x, y, z, 1)) >= 0 for all of these planes, in world coordinates;
  /// RayMaker::mostPlanes at most.
  std::vector<glm::dvec4> planes;

  double sampleDistance = 1; ///< between samples, in units of the smallest spacing, > 0
  bool jitter = false;       ///< shift the samples of each ray by a fixed pseudo-random amount
  bool skipEmpty = true;     ///< leave out what is empty; never changes the picture
  double opaqueBelow = 1 / 1024.0; ///< a ray ends when its transmittance is below; 0: never
};

/// A picture, first row at the bottom.
struct Picture
{
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba; ///< colours multiplied by alpha, 4 per pixel

  /// Where ranks have drawn: of each pixel the one whose part is foremost, whose box is sure to be
  /// seen there; -1: there is nothing. Else empty.
  std::vector<std::int32_t> foremost;
};

/**
 * Renders a volume with single scattering, Eqs. (1)-(6).
 *
 * The extinction of a sample is clamp(mu-bar(s) + delta, 0, majorant): the transfer function of the
 * interpolated scalar, as ordinary volume rendering has it, plus the interpolated change that the
 * optimisation made (Documentation/Method.md).
 *
 * Fields belong to the caller, who keeps them while the renderer uses them.
 */
class Renderer
{
public:
  /// Draws with the processor.
  Renderer();

  /// Draws with what is given.
  explicit Renderer(std::unique_ptr<RenderBackend> backend);

  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /**
   * What this rank has of a volume that ranks draw together, see ScenePiece; null: all. Fields and
   * their grid are those of piece->nodes then, in which every rank needs two nodes along each
   * axis at least, and around its own two more than samples are apart [nodes]: half a segment, the
   * rest of a cell, and one for gradients. To be called before the scalars.
   *
   * All ranks have to make the same calls with the same values, but for fields; every rank gets all
   * of the pictures. Shadows of a piece's extinction are as fine as
   * that, and there is no importance and no other compositing than front to back.
   */
  void SetPiece(const Grid& whole, std::shared_ptr<const ScenePiece> piece);

  /// The scalars at the nodes of a grid, NodeCount() values; NaN: an empty node. `shares`: the part
  /// of the transfer function's extinction that is left at each node [0, 1]; null: all of it. They
  /// are copied.
  void SetScalars(const Grid& grid, const float* scalars, const float* shares = nullptr);

  /// Call it again when a function has changed.
  void SetTransferFunctions(const TransferFunctions& functions);

  /**
   * The extinction to be shown: `base` and `extinction` at the nodes of a grid over the same box,
   * as fine as the scalars' or coarser, NodeCount() values each [1/length]. What counts is their
   * difference, and for shadows `extinction` itself. Null for both: the transfer function's alone.
   *
   * `share` in (0, 1]: how far to move from what is shown now to the new extinction; 1 at once.
   * `lightExtinction`: what casts the shadows, if that is another extinction.
   */
  void SetExtinction(const Grid& grid, const float* base, const float* extinction, double share = 1,
    const float* lightExtinction = nullptr);

  /// Sets the extinction if ranks draw together, on a grid over the box of all. Every rank passes
  /// the whole field. For pictures during interaction, in which no rank waits for others.
  void SetExtinctionOfAll(const Grid& grid, const float* base, const float* extinction,
    double share = 1, const float* lightExtinction = nullptr);

  /// Whether a device with a memory of its own draws.
  bool DrawsOnDevice() const;

  /// SetExtinction with arrays in the memory of the device that draws, which may go after the call;
  /// with the processor, the arrays are the caller's and stay, as above.
  void ShowThere(const Grid& grid, const float* base, const float* extinction, double share = 1,
    const float* lightExtinction = nullptr);

  /// Light for the following pictures. Shadows are computed when they are needed next.
  void SetLighting(const Lighting& lighting);

  /// The importance at the nodes of the scalars [0, 1], for what follows here; null: there is none,
  /// as after new scalars. The array is the caller's and stays.
  void SetImportance(const float* importance);

  /// Paints over the following pictures, in a colour, where they miss something important: where it
  /// was removed, or is hidden and could be seen in that pixel (RayImportance). None: no longer.
  void ShowMissed(const std::optional<std::array<float, 3>>& color);

  /// How the following pictures are made of samples. Without importance: front to back.
  void ComposeBy(Compositing compositing);

  /// Rays of the shadow volume per voxel and axis. Default 3.
  void SetShadowRayDensity(double density);

  /// Shadows are computed on a grid with nodes so many times farther apart along each axis than
  /// the extinction's, for pictures that move; where ranks show the transfer function's, on one
  /// over the box of all, of which every rank has all. Default 1.
  void SetShadowCoarseness(int factor);

  /// Computes the shadows now if the next picture would, and waits until they are there. Returns
  /// whether there was anything to do.
  bool UpdateShadows();

  /// Makes everything for the next picture but its rays, which are all that is left to Render.
  void Prepare();

  /// How often something has changed that pictures depend on, beside their views.
  std::uint64_t Changes() const;

  /// Throws limpid::Error when there are no scalars or transfer functions, or the view is unusable.
  void Render(const View& view, Picture& picture);

  /// Transmittance of the light at a world position [0, 1], as the shadows have it; 1 outside of
  /// the grid and without shadows.
  double LightTransmittanceAt(const Vec3& world);

private:
  struct Internals;
  std::unique_ptr<Internals> State;
};
}

#endif
