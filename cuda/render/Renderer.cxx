// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Renderer.h"

#include "energy/TransmittanceVolume.h"
#include "math/Require.h"
#include "optimize/Levels.h"
#include "render/PictureEngine.h"
#include "render/RayScene.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
void RequireView(const View& view)
{
  bool finite = true;
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      finite &= std::isfinite(view.clipToWorld[column][row]);
    }
  }
  LIMPID_REQUIRE(finite && glm::determinant(view.clipToWorld) != 0,
    "The view's matrix is singular or not finite (no ray belongs "
    "to a pixel). Check the camera: "
    "position, focal point, clipping range.");
  LIMPID_REQUIRE(view.sampleDistance > 0 && std::isfinite(view.sampleDistance),
    "The sample distance is " << view.sampleDistance
                              << " (rays would not advance). Set a number above zero.");
  LIMPID_REQUIRE(view.opaqueBelow >= 0 && view.opaqueBelow < 1,
    "Rays end below the transmittance " << view.opaqueBelow
                                        << " (transmittance lies between 0 and 1, and a ray begins "
                                           "with 1). Set a number from 0 to below 1.");
}

void RequireLighting(const Lighting& lighting)
{
  LIMPID_REQUIRE(lighting.anisotropy > -1 && lighting.anisotropy < 1,
    "The anisotropy is " << lighting.anisotropy
                         << " (the Henyey-Greenstein function is not defined there). Keep it "
                            "between -1 and 1.");
  LIMPID_REQUIRE(lighting.specularPower >= 0 && std::isfinite(lighting.specularPower),
    "The specular power is " << lighting.specularPower
                             << " (the highlight would not be finite). Keep it at or above zero.");
  LIMPID_REQUIRE(lighting.intensity >= 0 && std::isfinite(lighting.intensity) &&
      lighting.surface >= 0 && std::isfinite(lighting.surface),
    "The light's intensity is " << lighting.intensity << " and the surface share "
                                << lighting.surface
                                << " (light does not become less than none). Keep both finite and "
                                   "at or above zero.");
  LIMPID_REQUIRE(lighting.ambient >= 0 && lighting.ambient <= 1 && lighting.shadowStrength >= 0 &&
      lighting.shadowStrength <= 1,
    "The ambient light is " << lighting.ambient << " and the strength of shadows "
                            << lighting.shadowStrength << " (both are shares). Keep them between 0 "
                            << "and 1.");
  for (const float channel : lighting.color)
  {
    LIMPID_REQUIRE(channel >= 0 && std::isfinite(channel),
      "A channel of the light's colour is " << channel
                                            << " (light does not become less than none). Keep it "
                                               "finite and at or above zero.");
  }
}

/// The extinction's grid has to cover the scalars' box: rays read both by the same position.
void RequireSameBox(const Grid& scalars, const Grid& extinction)
{
  const double tolerance = 1e-4 * scalars.Radius();
  const Vec3 first = extinction.PointToWorld(Vec3(0.0)) - scalars.PointToWorld(Vec3(0.0));
  const Vec3 last = extinction.PointToWorld(Vec3(extinction.nodes - 1)) -
    scalars.PointToWorld(Vec3(scalars.nodes - 1));
  LIMPID_REQUIRE(
    extinction.HasVolume() && glm::length(first) <= tolerance && glm::length(last) <= tolerance,
    "The extinction's grid of " << extinction.nodes.x << " x " << extinction.nodes.y << " x "
                                << extinction.nodes.z
                                << " nodes does not span the box of the scalars (it would be drawn "
                                   "in the wrong place). Give both over the same box.");
}
} // namespace

struct Renderer::Internals
{
  explicit Internals(std::unique_ptr<PictureEngine> pictures)
    : engine(std::move(pictures))
  {
  }

  std::unique_ptr<PictureEngine> engine;
  Grid grid; ///< of the scalars
  bool hasScalars = false;
  bool hasFunctions = false;
  float majorant = 0; ///< of the transfer functions [1/length]
  Lighting lighting;
  double shadowRayDensity = transmittanceRayDensity;
  int shadowCoarseness = 1;
  Grid extinctionGrid;
  bool usesTransferFunction = false; ///< as the extinction, when none was given

  bool gradientIsCurrent = false;
  bool bricksAreCurrent = false;
  bool shadowIsCurrent = false;

  /// Without any extinction given, the transfer function's casts the shadows.
  void UseTransferFunction()
  {
    this->extinctionGrid = CoarseGrid(this->grid, this->shadowCoarseness);
    this->usesTransferFunction = true;
    this->engine->UseTransferFunction(this->extinctionGrid);
  }

  void ForgetTransferFunction()
  {
    if (this->usesTransferFunction)
    {
      this->usesTransferFunction = false;
      this->engine->ClearExtinction();
      this->shadowIsCurrent = false;
    }
  }

  /// The grid of the shadows.
  Grid ShadowGrid() const
  {
    return this->usesTransferFunction ? this->extinctionGrid
                                      : CoarseGrid(this->extinctionGrid, this->shadowCoarseness);
  }

  bool HasScene() const { return this->hasScalars && this->grid.HasVolume() && this->hasFunctions; }

  /// Makes way for a given extinction. Returns whether there is one.
  bool WillShow(const Grid& nodes, const float* base, const float* extinction, double share)
  {
    this->bricksAreCurrent = false;
    this->shadowIsCurrent = false;
    this->ForgetTransferFunction();
    this->extinctionGrid = nodes;
    if (!base || !extinction)
    {
      this->engine->ClearExtinction();
      return false;
    }
    LIMPID_REQUIRE(share > 0 && share <= 1,
      "The share is " << share
                      << " (the picture moves that far towards the new extinction). Keep it above "
                         "0 and at most 1.");
    LIMPID_REQUIRE(this->hasFunctions,
      "The extinction was given before the transfer functions (they have its unit). Set them "
      "first.");
    return true;
  }

  /// Returns whether there was anything to do.
  bool UpdateShadow()
  {
    const bool wanted = this->lighting.enabled && this->lighting.shadows;
    if (this->shadowIsCurrent || (this->engine->HasNoExtinction() && !wanted))
    {
      return false;
    }
    this->shadowIsCurrent = true;
    if (this->engine->HasNoExtinction())
    {
      this->UseTransferFunction();
    }
    if (!wanted)
    {
      this->engine->ClearShadows();
      return true;
    }
    const Grid nodes = this->ShadowGrid();
    this->engine->CastShadows(
      nodes, SourceOfLight(this->lighting.light, nodes), this->shadowRayDensity);
    return true;
  }

  /// Makes what rays read and is not current.
  void Prepare()
  {
    if (!this->engine->HasNoExtinction())
    {
      RequireSameBox(this->grid, this->extinctionGrid);
    }
    if (this->lighting.enabled)
    {
      SourceOfLight(
        this->lighting.light, this->grid); // says what is wrong with a light, if anything
    }
    this->UpdateShadow();
    if (this->lighting.enabled && !this->gradientIsCurrent)
    {
      this->engine->FindGradient();
      this->gradientIsCurrent = true;
    }
    if (!this->bricksAreCurrent)
    {
      this->engine->FindEmptyBricks();
      this->bricksAreCurrent = true;
    }
  }

  Casting CastingOf(const View& view) const
  {
    const Vec3& spacing = this->grid.spacing;
    Casting casting;
    casting.opaqueBelow = static_cast<float>(view.opaqueBelow);
    casting.stepLength =
      static_cast<float>(view.sampleDistance * std::min({ spacing.x, spacing.y, spacing.z }));
    casting.lit = this->lighting.enabled;
    if (casting.lit)
    {
      casting.light = MakeRayLight(this->lighting, this->grid, view);
      casting.lightColor = this->lighting.color;
    }
    // Farther samples could step over a brick.
    casting.skipEmpty = view.skipEmpty && view.sampleDistance <= BrickDistances::size;
    return casting;
  }
};

Renderer::Renderer()
  : Renderer(CpuPictures())
{
}

Renderer::Renderer(std::unique_ptr<PictureEngine> engine)
  : State(std::make_unique<Internals>(std::move(engine)))
{
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::SetScalars(const Grid& grid, const float* scalars)
{
  grid.Require();
  LIMPID_REQUIRE(
    scalars != nullptr, "There are no scalars (nothing tells what is where). Give an array.");
  Internals& state = *this->State;
  state.engine->SetScalars(grid, scalars);
  state.grid = grid;
  state.hasScalars = true;
  state.bricksAreCurrent = false;
  state.gradientIsCurrent = false;
  state.ForgetTransferFunction();
}

void Renderer::SetTransferFunctions(const TransferFunctions& functions)
{
  Internals& state = *this->State;
  const Classification classification(functions);
  state.engine->SetTransferFunctions(classification);
  state.majorant = classification.Majorant();
  state.hasFunctions = true;
  state.ForgetTransferFunction();
  state.bricksAreCurrent = false;
  state.gradientIsCurrent = false;
}

void Renderer::SetExtinction(const Grid& grid, const float* base, const float* extinction,
  double share, const float* lightExtinction)
{
  if (this->State->WillShow(grid, base, extinction, share))
  {
    this->State->engine->SetExtinction(grid, base, extinction, share, lightExtinction);
  }
}

void Renderer::ShowThere(const Grid& grid, const float* base, const float* extinction, double share,
  const float* lightExtinction)
{
  if (this->State->WillShow(grid, base, extinction, share))
  {
    this->State->engine->ShowThere(grid, base, extinction, share, lightExtinction);
  }
}

void Renderer::SetLighting(const Lighting& lighting)
{
  RequireLighting(lighting);
  Internals& state = *this->State;
  const Lighting& old = state.lighting;
  const bool sameShadow = old.enabled == lighting.enabled && old.shadows == lighting.shadows &&
    old.light.type == lighting.light.type && old.light.position == lighting.light.position &&
    old.light.focalPoint == lighting.light.focalPoint;
  state.shadowIsCurrent = state.shadowIsCurrent && sameShadow;
  state.lighting = lighting;
}

void Renderer::SetShadowRayDensity(double density)
{
  LIMPID_REQUIRE(density > 0 && density <= 16,
    "The ray density of shadows is " << density
                                     << " (rays per voxel and axis). Keep it above 0 and at most "
                                        "16.");
  this->State->shadowIsCurrent =
    this->State->shadowIsCurrent && density == this->State->shadowRayDensity;
  this->State->shadowRayDensity = density;
}

void Renderer::SetShadowCoarseness(int factor)
{
  LIMPID_REQUIRE(factor >= 1,
    "The coarseness of shadows is " << factor
                                    << " (times the distance of the nodes). Set 1 or more.");
  Internals& state = *this->State;
  if (factor != state.shadowCoarseness)
  {
    state.ForgetTransferFunction();
    state.shadowIsCurrent = false;
    state.shadowCoarseness = factor;
  }
}

bool Renderer::UpdateShadows()
{
  return this->State->HasScene() && this->State->UpdateShadow();
}

void Renderer::Prepare()
{
  if (this->State->HasScene() && this->State->majorant > 0)
  {
    this->State->Prepare();
  }
}

void Renderer::Render(const View& view, Picture& picture)
{
  Internals& state = *this->State;
  picture.width = std::max(view.width, 0);
  picture.height = std::max(view.height, 0);
  picture.rgba.assign(std::size_t(4) * std::size_t(picture.width) * std::size_t(picture.height), 0);
  LIMPID_REQUIRE(state.hasScalars && state.hasFunctions,
    "There are no scalars or no transfer functions (nothing can "
    "be drawn). Set both.");
  if (picture.rgba.empty() || !state.grid.HasVolume() || !(state.majorant > 0))
  {
    return; // an empty picture
  }
  RequireView(view);
  state.Prepare();
  state.engine->Cast(state.CastingOf(view), view, picture);
}

double Renderer::LightTransmittanceAt(const Vec3& world)
{
  this->UpdateShadows();
  const Internals& state = *this->State;
  const bool wanted = state.lighting.enabled && state.lighting.shadows;
  if (state.engine->HasNoExtinction() || !wanted || !state.shadowIsCurrent)
  {
    return 1;
  }
  const Vec3 index = state.extinctionGrid.PointToIndex(world);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (index[axis] < 0 || index[axis] > state.extinctionGrid.nodes[axis] - 1)
    {
      return 1;
    }
  }
  return state.engine->LightTransmittanceAt(index);
}
} // namespace limpid
