// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Renderer.h"

#include "backend/Backend.h"
#include "energy/TransmittanceVolume.h"
#include "math/Require.h"
#include "optimize/Levels.h"
#include "render/Medium.h"
#include "render/Raycast.h"

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
  ScalarField scalars;
  Classification classification;
  GradientField gradient;
  Bricks bricks;
  Medium medium;
  Lighting lighting;
  double shadowRayDensity = transmittanceRayDensity;
  int shadowCoarseness = 1;
  std::vector<float> coarseExtinction; ///< casts the shadows; empty: not current, or not coarse

  // What was given as the extinction; the arrays belong to the caller.
  Grid extinctionGrid;
  const float* base = nullptr;
  const float* lightExtinction = nullptr; ///< null: what is shown
  std::vector<float> ownBase;             ///< of the transfer function, when nothing was given

  bool gradientIsCurrent = false;
  bool bricksAreCurrent = false;
  bool shadowIsCurrent = false;

  /// Without any extinction given, the transfer function's casts the shadows.
  void UseTransferFunction()
  {
    const Index count = this->scalars.grid.NodeCount();
    this->ownBase.resize(std::size_t(count));
    ParallelFor(count, 32768,
      [this](Index node)
      {
        const float scalar = this->classification.Position(this->scalars.values[node]);
        const float filled =
          this->scalars.filled.empty() ? 1.0f : this->scalars.filled[std::size_t(node)];
        this->ownBase[std::size_t(node)] =
          this->classification.At(scalar)[0] * filled * this->classification.Majorant();
      });
    this->extinctionGrid = CoarseGrid(this->scalars.grid, this->shadowCoarseness);
    if (this->shadowCoarseness > 1)
    {
      this->ownBase = Restrict(this->scalars.grid, this->ownBase.data(), this->extinctionGrid);
    }
    this->base = this->ownBase.data();
    this->medium.MoveTo(
      this->extinctionGrid, this->base, this->base, this->classification.Majorant(), 1);
  }

  void ForgetOwnBase()
  {
    if (!this->ownBase.empty())
    {
      this->ownBase.clear();
      this->coarseExtinction.clear();
      this->medium.Clear();
      this->shadowIsCurrent = false;
    }
  }

  /// The grid of the shadows.
  Grid ShadowGrid() const
  {
    return this->ownBase.empty() ? CoarseGrid(this->extinctionGrid, this->shadowCoarseness)
                                 : this->extinctionGrid;
  }

  /// What casts the shadows, at the nodes of their grid. `memory` is for what is not kept.
  const float* ShadowExtinction(const Grid& grid, std::vector<float>& memory)
  {
    if (!this->coarseExtinction.empty())
    {
      return this->coarseExtinction.data();
    }
    const float* extinction = this->lightExtinction;
    if (!extinction)
    {
      memory = this->medium.ShownExtinction(this->base);
      extinction = memory.data();
    }
    if (grid.nodes == this->extinctionGrid.nodes)
    {
      return extinction;
    }
    this->coarseExtinction = Restrict(this->extinctionGrid, extinction, grid);
    return this->coarseExtinction.data();
  }

  bool HasScene() const
  {
    return this->scalars.values && this->scalars.grid.HasVolume() && !this->classification.Empty();
  }

  /// Returns whether there was anything to do.
  bool UpdateShadow()
  {
    const bool wanted = this->lighting.enabled && this->lighting.shadows;
    if (this->shadowIsCurrent || (this->medium.Empty() && !wanted))
    {
      return false;
    }
    this->shadowIsCurrent = true;
    if (this->medium.Empty())
    {
      this->UseTransferFunction();
    }
    if (!wanted)
    {
      this->medium.ClearShadow();
      return true;
    }
    const Grid grid = this->ShadowGrid();
    std::vector<float> memory;
    const float* extinction = this->ShadowExtinction(grid, memory);
    std::vector<float> transmittance(static_cast<std::size_t>(grid.NodeCount()));
    FillTransmittance(grid, extinction, EyeOfLight(this->lighting.light, grid),
      this->shadowRayDensity, transmittance.data());
    this->medium.SetShadow(grid.nodes, transmittance.data());
    return true;
  }

  /// Direction of travel of the light in the middle of the volume, and its
  /// place.
  void PlaceLight(RayLight& target, Vec3& travel) const
  {
    const Light& light = this->lighting.light;
    const Grid& grid = this->scalars.grid;
    const Vec3 place = (light.position - grid.Centre()) / grid.Radius();
    // From so far away, light is directional to single precision.
    const bool point = light.type == LightType::Point && glm::length(place) < 1e6;
    travel = light.type == LightType::Point ? -place : light.focalPoint - light.position;
    const double length = glm::length(travel);
    travel = length > 0 ? travel / length : Vec3(0, 0, -1);
    target.isPoint = point ? 1.0f : 0.0f;
    const Vec3 origin = point ? place : -travel;
    for (int axis = 0; axis < 3; ++axis)
    {
      target.origin[axis] = static_cast<float>(origin[axis]);
    }
  }

  /// Direction to the viewer from the middle of the volume. It does not depend on where the camera
  /// looks, unless that is all that there is to know.
  Vec3 ToViewer(const View& view) const
  {
    const Grid& grid = this->scalars.grid;
    const glm::dvec4 eye = view.clipToWorld * glm::dvec4(0, 0, 1, 0);
    const Vec3 way = Vec3(eye) / eye.w - grid.Centre();
    const double distance = glm::length(way);
    if (distance > 1e-6 * grid.Radius() && distance < 1e9 * grid.Radius())
    {
      return way / distance;
    }
    const glm::dvec4 front = view.clipToWorld * glm::dvec4(0, 0, -1, 1);
    const glm::dvec4 back = view.clipToWorld * glm::dvec4(0, 0, 1, 1);
    const Vec3 along = Vec3(front) / front.w - Vec3(back) / back.w;
    return along / glm::length(along);
  }

  RayLight MakeLight(const View& view) const
  {
    const Lighting& settings = this->lighting;
    RayLight light;
    Vec3 travel;
    this->PlaceLight(light, travel);
    const double middle =
      HenyeyGreenstein(settings.anisotropy, glm::dot(travel, this->ToViewer(view)));
    light.ambient = static_cast<float>(settings.ambient);
    // In a dense medium that is lit from the viewer's side, light and view fade alike: what arrives
    // from optical depth d is exp(-2 d), half of all. That half is to keep its colour.
    const double shadow = settings.shadows ? settings.shadowStrength : 0.0;
    const double exposure = settings.intensity / (1 - 0.5 * shadow);
    light.diffuse = static_cast<float>((1 - settings.ambient) * exposure);
    light.anisotropy = static_cast<float>(settings.anisotropy);
    light.phaseUnit = static_cast<float>(1 / middle);
    light.surface = static_cast<float>(settings.surface);
    light.shadow = static_cast<float>(shadow);
    light.lobe.factor = static_cast<float>(BlinnPhongNormalization(settings.specularPower));
    light.lobe.power = static_cast<float>(settings.specularPower);
    return light;
  }

  /// Makes what rays read and is not current.
  void Prepare()
  {
    const Grid& grid = this->scalars.grid;
    if (!this->medium.Empty())
    {
      RequireSameBox(grid, this->extinctionGrid);
    }
    if (this->lighting.enabled)
    {
      EyeOfLight(this->lighting.light, grid); // says what is wrong with a light, if anything is
    }
    this->UpdateShadow();
    if (this->lighting.enabled && !this->gradientIsCurrent)
    {
      this->gradient = PackGradient(this->scalars, this->classification);
      this->gradientIsCurrent = true;
    }
    if (!this->bricksAreCurrent)
    {
      this->bricks.Classify(this->classification, this->medium.Field());
      this->bricksAreCurrent = true;
    }
  }

  RayScene MakeScene(const View& view)
  {
    this->Prepare();
    const Grid& grid = this->scalars.grid;
    RayScene scene;
    scene.scalars = &this->scalars;
    scene.classification = &this->classification;
    scene.majorant = this->classification.Majorant();
    scene.opaqueBelow = static_cast<float>(view.opaqueBelow);
    scene.stepLength = static_cast<float>(
      view.sampleDistance * std::min({ grid.spacing.x, grid.spacing.y, grid.spacing.z }));
    const MediumField& field = this->medium.Field();
    if (!this->medium.Empty() && (field.changed || (field.shadowed && this->lighting.enabled)))
    {
      scene.medium = &field;
      scene.addedUnit = this->medium.Majorant() / scene.majorant;
      for (int axis = 0; axis < 3; ++axis)
      {
        scene.mediumScale[axis] =
          float(field.nodes[axis] - 1) / float(std::max(grid.nodes[axis] - 1, 1));
      }
    }
    if (this->lighting.enabled)
    {
      scene.gradient = &this->gradient;
      scene.light = this->MakeLight(view);
    }
    // Farther samples could step over a brick.
    const bool skips = view.skipEmpty && view.sampleDistance <= Bricks::size;
    scene.bricks = skips ? &this->bricks : nullptr;
    return scene;
  }
};

Renderer::Renderer()
  : State(std::make_unique<Internals>())
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
  state.scalars = ScalarField(grid, scalars);
  state.bricks = grid.HasVolume() ? Bricks(state.scalars) : Bricks();
  state.bricksAreCurrent = false;
  state.gradientIsCurrent = false;
  state.ForgetOwnBase();
}

void Renderer::SetTransferFunctions(const TransferFunctions& functions)
{
  Internals& state = *this->State;
  state.classification = Classification(functions);
  state.ForgetOwnBase();
  state.bricksAreCurrent = false;
  state.gradientIsCurrent = false;
}

void Renderer::SetExtinction(const Grid& grid, const float* base, const float* extinction,
  double share, const float* lightExtinction)
{
  Internals& state = *this->State;
  state.bricksAreCurrent = false;
  state.shadowIsCurrent = false;
  state.base = base;
  state.lightExtinction = lightExtinction;
  state.extinctionGrid = grid;
  state.coarseExtinction.clear();
  state.ForgetOwnBase();
  if (!base || !extinction)
  {
    state.medium.Clear();
    return;
  }
  LIMPID_REQUIRE(share > 0 && share <= 1,
    "The share is " << share
                    << " (the picture moves that far towards the "
                       "new extinction). Keep it "
                    << "above 0 and at most 1.");
  LIMPID_REQUIRE(!state.classification.Empty(),
    "The extinction was given before the transfer functions (they "
    "have its unit). Set them first.");
  state.medium.MoveTo(grid, base, extinction, state.classification.Majorant(), share);
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
    state.ForgetOwnBase();
    state.coarseExtinction.clear();
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
  if (this->State->HasScene() && this->State->classification.Majorant() > 0)
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
  LIMPID_REQUIRE(state.scalars.values && !state.classification.Empty(),
    "There are no scalars or no transfer functions (nothing can "
    "be drawn). Set both.");
  if (picture.rgba.empty() || !state.scalars.grid.HasVolume() ||
    !(state.classification.Majorant() > 0))
  {
    return; // an empty picture
  }
  RequireView(view);
  Raycast(state.MakeScene(view), view,
    state.lighting.enabled ? state.lighting.color : Lighting().color, picture);
}

double Renderer::LightTransmittanceAt(const Vec3& world)
{
  this->UpdateShadows();
  const Internals& state = *this->State;
  const MediumField& field = state.medium.Field();
  if (state.medium.Empty() || !field.shadowed)
  {
    return 1;
  }
  const Vec3 index = state.medium.Nodes().PointToIndex(world);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (index[axis] < 0 || index[axis] > field.nodes[axis] - 1)
    {
      return 1;
    }
  }
  const float position[3] = { float(index.x), float(index.y), float(index.z) };
  return InterpolateMedium(field, position)[2] / packedOne;
}
} // namespace limpid
