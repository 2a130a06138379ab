// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Renderer.h"

#include "backend/ComputeBackend.h"
#include "energy/TransmittanceSweep.h"
#include "math/Require.h"
#include "render/RayScene.h"
#include "render/RenderBackend.h"
#include "scene/Resampling.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace limpid
{
namespace
{
/// The extinction's grid must cover the box of the scalars: rays use one position for both.
void RequireSameBox(const DrawnPart& scalars, const DrawnPart& extinction)
{
  const Grid& grid = extinction.Nodes();
  LIMPID_REQUIRE(grid.HasVolume() && scalars.Whole().HasSameBox(extinction.Whole()) &&
      extinction.Covers(scalars),
    "The extinction's grid of " << grid.nodes.x << " x " << grid.nodes.y << " x " << grid.nodes.z
                                << " nodes does not span the box of the scalars (it would be drawn "
                                   "in the wrong place). Give both over the same box.");
}

void RequireColor(const char* subject, const std::array<float, 3>& color)
{
  for (const float channel : color)
  {
    LIMPID_REQUIRE(channel >= 0 && channel <= 1,
      "A channel of the colour for " << subject << " is " << channel
                                     << " (channels outside [0, 1] cannot be displayed). Keep it "
                                        "between 0 and 1.");
  }
}
} // namespace

bool operator==(const Lighting& one, const Lighting& other)
{
  return one.enabled == other.enabled && one.light == other.light &&
    one.intensity == other.intensity && one.ambient == other.ambient &&
    one.anisotropy == other.anisotropy && one.surface == other.surface &&
    one.specularPower == other.specularPower && one.shadows == other.shadows &&
    one.shadowStrength == other.shadowStrength;
}

struct Renderer::Internals
{
  explicit Internals(std::unique_ptr<RenderBackend> drawing)
    : backend(std::move(drawing))
  {
  }

  std::unique_ptr<RenderBackend> backend;
  DrawnPart part; ///< nodes of the scalars
  bool hasScalars = false;
  bool hasFunctions = false;
  float majorant = 0; ///< of the transfer functions [1/length]
  Lighting lighting;
  double shadowRayDensity = transmittanceRayDensity;
  int shadowCoarseness = 1;
  DrawnPart shown;                   ///< nodes of the extinction
  bool usesTransferFunction = false; ///< as the extinction, if none was given

  bool hasImportance = false;
  std::optional<std::array<float, 3>> missedColor; ///< none: missed structures are not painted
  Compositing compositing = Compositing::FrontToBack;

  std::size_t structureRows = 0; ///< rows of the structures, with row 0; 0: none are given
  double tint = 0;               ///< see TintStructures
  std::vector<std::array<float, 3>> structureColors;

  bool gradientIsCurrent = false;
  bool bricksAreCurrent = false;
  bool bareBricksAreCurrent = false;
  bool shadowIsCurrent = false;
  std::uint64_t changes = 0;

  /// Sets a value and records whether it has changed.
  template <class Value>
  void Take(Value& old, const Value& value)
  {
    this->changes += value == old ? 0 : 1;
    old = value;
  }

  void ForgetBricks()
  {
    this->bricksAreCurrent = false;
    this->bareBricksAreCurrent = false;
  }

  void ForgetImportance()
  {
    this->hasImportance = false;
    this->bareBricksAreCurrent = false;
    this->backend->ClearImportance();
  }

  void ForgetStructures()
  {
    this->structureRows = 0;
    this->backend->SetStructures(nullptr);
  }

  /// Returns the colours of all rows for rays, see RayScene; empty: none are shown.
  std::vector<FourFloats> Tints() const
  {
    if (this->tint <= 0)
    {
      return {};
    }
    std::vector<FourFloats> tints(this->structureRows, FourFloats{});
    const auto share = static_cast<float>(this->tint);
    for (std::size_t row = 1; row < tints.size() && row <= this->structureColors.size(); ++row)
    {
      const std::array<float, 3>& color = this->structureColors[row - 1];
      tints[row] = { { share, share * color[0], share * color[1], share * color[2] } };
    }
    return tints;
  }

  /// If no extinction was given, that of the transfer function casts the shadows.
  void UseTransferFunction()
  {
    this->shown = this->part.Coarse(this->shadowCoarseness);
    this->usesTransferFunction = true;
    this->backend->UseTransferFunction(this->shown);
  }

  void ForgetTransferFunction()
  {
    if (this->usesTransferFunction)
    {
      this->usesTransferFunction = false;
      this->backend->ClearExtinction();
      this->shadowIsCurrent = false;
    }
  }

  /// Returns the nodes of the shadows.
  DrawnPart ShadowPart() const
  {
    return this->usesTransferFunction ? this->shown : this->shown.Coarse(this->shadowCoarseness);
  }

  bool HasVolume() const { return this->part.Nodes().HasVolume(); }
  bool HasScene() const { return this->hasScalars && this->HasVolume() && this->hasFunctions; }

  /// Prepares for a given extinction. Returns whether there is one.
  bool WillShow(const DrawnPart& nodes, const float* base, const float* extinction, double share)
  {
    ++this->changes;
    this->ForgetBricks();
    this->shadowIsCurrent = false;
    this->ForgetTransferFunction();
    this->shown = nodes;
    if (!base || !extinction)
    {
      this->backend->ClearExtinction();
      return false;
    }
    LIMPID_REQUIRE(share > 0 && share <= 1,
      "The share is " << share
                      << " (it blends the displayed extinction with the new one). Keep it above 0 "
                         "and at most 1.");
    LIMPID_REQUIRE(this->hasFunctions,
      "The extinction was given before the transfer functions (they define its unit). Set them "
      "first.");
    return true;
  }

  /// Updates the shadow if needed. Returns whether there was work to do.
  bool UpdateShadow()
  {
    const bool wanted = this->lighting.enabled && this->lighting.shadows;
    if (this->shadowIsCurrent || (this->backend->HasNoExtinction() && !wanted))
    {
      return false;
    }
    if (this->backend->HasNoExtinction())
    {
      this->UseTransferFunction();
    }
    if (wanted)
    {
      const DrawnPart nodes = this->ShadowPart();
      this->backend->CastShadows(
        nodes, SourceOfLight(this->lighting.light, nodes.Whole()), this->shadowRayDensity);
    }
    else
    {
      this->backend->ClearShadows();
    }
    this->shadowIsCurrent = true;
    return true;
  }

  /// Updates everything that rays read and that is outdated.
  void Prepare()
  {
    if (!this->backend->HasNoExtinction())
    {
      RequireSameBox(this->part, this->shown);
    }
    if (this->lighting.enabled)
    {
      SourceOfLight(this->lighting.light, this->part.Whole()); // throws if the light is invalid
    }
    this->UpdateShadow();
    if (this->lighting.enabled && !this->gradientIsCurrent)
    {
      this->backend->FindGradient();
      this->gradientIsCurrent = true;
    }
    if (!this->bricksAreCurrent)
    {
      this->backend->FindEmptyBricks();
      this->bricksAreCurrent = true;
    }
    if (this->hasImportance && this->missedColor && !this->bareBricksAreCurrent)
    {
      this->backend->FindBareBricks();
      this->bareBricksAreCurrent = true;
    }
  }

  Casting CastingOf(const View& view) const
  {
    const Vec3& spacing = this->part.Whole().spacing;
    Casting casting;
    casting.opaqueBelow = static_cast<float>(view.opaqueBelow);
    casting.stepLength =
      static_cast<float>(view.sampleDistance * std::min({ spacing.x, spacing.y, spacing.z }));
    casting.lit = this->lighting.enabled;
    if (casting.lit)
    {
      casting.light = MakeRayLight(this->lighting, this->part.Whole(), view);
    }
    if (this->hasImportance)
    {
      casting.missedColor = view.paintsMissed ? this->missedColor : std::nullopt;
      casting.compositing = this->compositing;
    }
    casting.tints = this->Tints();
    // Samples at a larger distance could step over a brick.
    casting.skipEmpty = view.skipEmpty && view.sampleDistance <= BrickDistances::size;
    return casting;
  }
};

Renderer::Renderer()
  : Renderer(ProcessorBackend().MakeRenderBackend())
{
}

Renderer::Renderer(std::unique_ptr<RenderBackend> backend)
  : State(std::make_unique<Internals>(std::move(backend)))
{
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::SetScalars(const DrawnPart& part, const ScalarNodes& scalars, const float* shares)
{
  part.Whole().Require();
  LIMPID_REQUIRE(
    scalars.IsThere(), "There are no scalars (there is nothing to draw). Give an array.");
  Internals& state = *this->State;
  part.RequireOn(state.backend->IsDevice());
  ++state.changes;
  state.hasScalars = false; // in case one of the next lines throws
  state.ForgetImportance();
  state.ForgetStructures();
  state.backend->SetScalars(part, scalars, shares);
  state.part = part;
  state.hasScalars = true;
  state.ForgetBricks();
  state.gradientIsCurrent = false;
  state.ForgetTransferFunction();
}

void Renderer::SetTransferFunctions(const TransferFunctions& functions)
{
  Internals& state = *this->State;
  const Classification classification(functions);
  ++state.changes;
  state.hasFunctions = false; // in case the next line throws
  state.backend->SetTransferFunctions(classification);
  state.majorant = classification.Majorant();
  state.hasFunctions = true;
  state.ForgetTransferFunction();
  state.ForgetBricks();
  state.gradientIsCurrent = false;
}

void Renderer::SetImportance(const float* importance)
{
  Internals& state = *this->State;
  ++state.changes;
  state.ForgetImportance();
  if (!importance)
  {
    return;
  }
  LIMPID_REQUIRE(state.hasScalars,
    "The importance was given before the scalars (it is defined on their grid). Set them first.");
  if (state.HasVolume())
  {
    state.backend->SetImportance(importance);
    state.hasImportance = true;
  }
}

void Renderer::ShowMissed(const std::optional<std::array<float, 3>>& color)
{
  RequireColor("missed structures", color.value_or(std::array<float, 3>{}));
  this->State->Take(this->State->missedColor, color);
}

void Renderer::SetStructures(const StructureRow* rows)
{
  Internals& state = *this->State;
  ++state.changes;
  state.ForgetStructures();
  if (!rows)
  {
    return;
  }
  LIMPID_REQUIRE(state.hasScalars,
    "The structures were given before the scalars (they are defined on their grid). Set them "
    "first.");
  if (state.HasVolume())
  {
    state.backend->SetStructures(rows);
    state.structureRows =
      std::size_t(*std::max_element(rows, rows + state.part.Nodes().NodeCount())) + 1;
  }
}

void Renderer::TintStructures(double share, const std::vector<std::array<float, 3>>& colors)
{
  LIMPID_REQUIRE(share >= 0 && share <= 1,
    "The share of the colours of structures is "
      << share
      << " (it blends the colours of the transfer functions with them). Keep it between 0 "
         "and 1.");
  for (const std::array<float, 3>& color : colors)
  {
    RequireColor("a structure", color);
  }
  this->State->Take(this->State->tint, share);
  this->State->Take(this->State->structureColors, colors);
}

void Renderer::ComposeBy(Compositing compositing)
{
  this->State->Take(this->State->compositing, compositing);
}

void Renderer::SetExtinction(const DrawnPart& part, const float* base, const float* extinction,
  double share, const float* lightExtinction)
{
  if (this->State->WillShow(part, base, extinction, share))
  {
    this->State->backend->SetExtinction(part, base, extinction, share, lightExtinction);
  }
}

bool Renderer::DrawsOnDevice() const
{
  return this->State->backend->IsDevice();
}

void Renderer::ShowThere(const Grid& grid, const float* base, const float* extinction, double share,
  const float* lightExtinction)
{
  if (this->State->WillShow(grid, base, extinction, share))
  {
    this->State->backend->ShowThere(grid, base, extinction, share, lightExtinction);
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
  state.Take(state.lighting, lighting);
}

void Renderer::SetShadowRayDensity(double density)
{
  LIMPID_REQUIRE(density > 0 && density <= 16,
    "The ray density of shadows is "
      << density << " (it is in rays per voxel and axis). Keep it above 0 and at most 16.");
  this->State->shadowIsCurrent =
    this->State->shadowIsCurrent && density == this->State->shadowRayDensity;
  this->State->Take(this->State->shadowRayDensity, density);
}

void Renderer::SetShadowCoarseness(int factor)
{
  LIMPID_REQUIRE(factor >= 1,
    "The coarseness of shadows is " << factor
                                    << " (it is a multiple of the grid spacing). Set 1 or more.");
  Internals& state = *this->State;
  if (factor != state.shadowCoarseness)
  {
    state.ForgetTransferFunction();
    state.shadowIsCurrent = false;
    state.Take(state.shadowCoarseness, factor);
  }
}

bool Renderer::UpdateShadows()
{
  const bool made = this->State->HasScene() && this->State->UpdateShadow();
  if (made)
  {
    this->State->backend->Wait();
  }
  return made;
}

std::uint64_t Renderer::Changes() const
{
  return this->State->changes;
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
  const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
  picture.rgba.assign(4 * pixels, 0);
  picture.foremost.assign(state.part.IsWhole() ? 0 : pixels, -1);
  LIMPID_REQUIRE(state.hasScalars && state.hasFunctions,
    "There are no scalars or no transfer functions (nothing can "
    "be drawn). Set both.");
  if (picture.rgba.empty() || !state.HasVolume() || !(state.majorant > 0))
  {
    return; // an empty picture
  }
  RequireView(view);
  state.Prepare();
  state.backend->Cast(state.CastingOf(view), view, picture);
}

double Renderer::ArrivingLightAt(const Vec3& world)
{
  this->UpdateShadows();
  const Internals& state = *this->State;
  const bool wanted = state.lighting.enabled && state.lighting.shadows;
  if (state.backend->HasNoExtinction() || !wanted || !state.shadowIsCurrent)
  {
    return 1;
  }
  const Grid& grid = state.shown.Nodes();
  const Vec3 index = grid.PointToIndex(world);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (index[axis] < 0 || index[axis] > grid.nodes[axis] - 1)
    {
      return 1;
    }
  }
  return state.backend->ArrivingLightAt(index);
}
} // namespace limpid
