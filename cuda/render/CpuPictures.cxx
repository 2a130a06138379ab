// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/Backend.h"
#include "energy/TransmittanceVolume.h"
#include "optimize/Levels.h"
#include "render/Bricks.h"
#include "render/ExtinctionOverlay.h"
#include "render/PictureEngine.h"
#include "render/Raycast.h"

namespace limpid
{
namespace
{
class ProcessorPictures : public PictureEngine
{
public:
  void SetScalars(const Grid& grid, const float* scalars) override
  {
    this->Scalars = ScalarField(grid, scalars);
    this->Empty = grid.HasVolume() ? Bricks(this->Scalars) : Bricks();
  }

  void SetTransferFunctions(const Classification& classification) override
  {
    this->Functions = classification;
  }

  void SetExtinction(const Grid& grid, const float* base, const float* extinction, double share,
    const float* lightExtinction) override
  {
    this->ExtinctionGrid = grid;
    this->Base = base;
    this->LightExtinction = lightExtinction;
    this->CoarseExtinction.clear();
    this->Shown.MoveTo(grid, base, extinction, this->Functions.Majorant(), share);
  }

  void ShowThere(const Grid& grid, const float* base, const float* extinction, double share,
    const float* lightExtinction) override
  {
    this->SetExtinction(grid, base, extinction, share, lightExtinction);
  }

  void UseTransferFunction(const Grid& grid) override
  {
    const OpticalTable<FourFloats> table = this->Functions.Table();
    const ScalarField& scalars = this->Scalars;
    this->OwnBase.resize(std::size_t(scalars.grid.NodeCount()));
    ParallelFor(scalars.grid.NodeCount(), 32768,
      [&](Index node)
      {
        const float scalar = table.Position(scalars.values[node]);
        const float filled = scalars.filled.empty() ? 1.0f : scalars.filled[std::size_t(node)];
        this->OwnBase[std::size_t(node)] =
          table.At(scalar)[0] * filled * this->Functions.Majorant();
      });
    if (grid.nodes != scalars.grid.nodes)
    {
      this->OwnBase = Restrict(scalars.grid, this->OwnBase.data(), grid);
    }
    this->SetExtinction(grid, this->OwnBase.data(), this->OwnBase.data(), 1, nullptr);
  }

  void ClearExtinction() override
  {
    this->CoarseExtinction.clear();
    this->OwnBase.clear();
    this->Shown.Clear();
  }

  bool HasNoExtinction() const override { return this->Shown.Empty(); }

  void CastShadows(const Grid& grid, const RaySource& light, double rayDensity) override
  {
    std::vector<float> memory;
    const float* extinction = this->ShadowExtinction(grid, memory);
    std::vector<float> transmittance(static_cast<std::size_t>(grid.NodeCount()));
    FillTransmittance(grid, extinction, light, rayDensity, transmittance.data());
    this->Shown.SetShadow(grid.nodes, transmittance.data());
  }

  void ClearShadows() override { this->Shown.ClearShadow(); }

  void FindGradient() override { this->Gradient = PackGradient(this->Scalars, this->Functions); }

  void FindEmptyBricks() override { this->Empty.Classify(this->Functions, this->Shown.Field()); }

  void Cast(const Casting& casting, const View& view, Picture& picture) override
  {
    Raycast(this->SceneOf(casting), RayMaker(this->Scalars.grid, casting.stepLength, view), view,
      casting.lightColor, picture);
  }

  double LightTransmittanceAt(const Vec3& position) override
  {
    const float at[3] = { float(position.x), float(position.y), float(position.z) };
    return InterpolateOverlay(this->Shown.Field(), at)[2] / packedOne;
  }

private:
  /// What casts the shadows, at the nodes of their grid. `memory` is for what is not kept.
  const float* ShadowExtinction(const Grid& grid, std::vector<float>& memory)
  {
    if (!this->CoarseExtinction.empty() && grid.nodes == this->CoarseNodes)
    {
      return this->CoarseExtinction.data();
    }
    const float* extinction = this->LightExtinction;
    if (!extinction)
    {
      memory = this->Shown.ShownExtinction(this->Base);
      extinction = memory.data();
    }
    if (grid.nodes == this->ExtinctionGrid.nodes)
    {
      return extinction;
    }
    this->CoarseExtinction = Restrict(this->ExtinctionGrid, extinction, grid);
    this->CoarseNodes = grid.nodes;
    return this->CoarseExtinction.data();
  }

  RayScene SceneOf(const Casting& casting) const
  {
    const Grid& grid = this->Scalars.grid;
    RayScene scene;
    scene.grid = CellGrid(grid.nodes);
    scene.scalars = this->Scalars.values;
    scene.filled = this->Scalars.filled.empty() ? nullptr : this->Scalars.filled.data();
    scene.table = this->Functions.Table().As<Optical>();
    scene.majorant = this->Functions.Majorant();
    scene.opaqueBelow = casting.opaqueBelow;
    scene.stepLength = casting.stepLength;
    scene.light = casting.light;
    scene.gradient = casting.lit ? this->Gradient.packed.data() : nullptr;
    const OverlayField& overlay = this->Shown.Field();
    if (!this->Shown.Empty() && (overlay.changed || (overlay.shadowed && casting.lit)))
    {
      scene.overlay = overlay.packed.data();
      scene.PlaceOverlay(overlay.nodes, grid.nodes);
      scene.addedUnit = this->Shown.Majorant() / scene.majorant;
    }
    if (casting.skipEmpty)
    {
      scene.bricks = this->Empty.Distances();
    }
    return scene;
  }

  ScalarField Scalars;
  Classification Functions;
  GradientField Gradient;
  Bricks Empty;
  ExtinctionOverlay Shown;
  Grid ExtinctionGrid;
  const float* Base = nullptr;
  const float* LightExtinction = nullptr; ///< null: what is shown
  std::vector<float> OwnBase;             ///< of the transfer function
  std::vector<float> CoarseExtinction;    ///< casts the shadows; empty: not current, or not coarse
  Int3 CoarseNodes{ 0 };
};
}

std::unique_ptr<PictureEngine> CpuPictures()
{
  return std::make_unique<ProcessorPictures>();
}
}
