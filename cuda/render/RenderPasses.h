// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_RenderPasses_h
#define limpid_render_RenderPasses_h

#include "distributed/FieldResampling.h"
#include "distributed/Neighbourhood.h"
#include "energy/TransmittanceOnRanks.h"
#include "render/ArrivingLight.h"
#include "render/Bricks.h"
#include "render/ExtinctionOverlay.h"
#include "render/GatheredOverlay.h"
#include "render/GradientKernels.h"
#include "render/Raycast.h"
#include "render/RenderBackend.h"
#include "render/ScalarField.h"
#include "render/ShadowVolume.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace limpid
{
/**
 * The passes of a Renderer on a device, the processor or a GPU. All fields stay there. Only new
 * input of the renderer and the depths of opaque geometry are copied to a GPU, and the picture is
 * copied back. Only Cast and ArrivingLightAt wait.
 *
 * Bytes on a GPU per node: scalars 4, gradient 8, overlay with shadows 8, the extinction that casts
 * them 4, and temporarily 8 for two new extinctions or for a new gradient. The sum is 32, plus 4
 * for the importance if missed structures are painted. At 256^3 nodes this is 0.54 GB, plus 0.1 GB
 * for the plan of the shadows. The processor reads scalars and extinctions in place.
 *
 * Memory traffic of a picture, counted: 1024^2 pixels, of which half see a box of 256^3 nodes, have
 * 92 M samples at the distance of the nodes if nothing is empty or opaque. A lit sample in an
 * overlay reads 8 scalars, 8 nodes each of overlay and gradient, and 4 entries of the table: 192
 * bytes, in total 17.7 GB through the first-level caches. Its neighbours read the same nodes, and
 * the fields themselves have 0.34 GB. The picture that is copied back has 4.2 MB, as have the
 * depths that are copied to the device, if any. New shadows add the traffic of TransmittanceSweep.
 */
template <class AnyDevice>
class RenderPasses : public RenderBackend
{
public:
  explicit RenderPasses(std::shared_ptr<AnyDevice> device)
    : Device(std::move(device))
    , Empty(this->Device)
    , Shown(this->Device)
    , Shadows(this->Device)
  {
  }

  void SetPiece(const Grid& whole, std::shared_ptr<const ScenePiece> piece) override
  {
    this->Whole = whole;
    this->Piece = std::move(piece);
  }

  void SetScalars(const Grid& grid, const float* scalars, const float* shares) override
  {
    this->Nodes = grid;
    this->Whole = this->Piece ? this->Whole : grid;
    this->Scalars = {};
    this->Filled = {};
    if (!grid.HasVolume())
    {
      return;
    }
    const auto count = static_cast<std::size_t>(grid.NodeCount());
    ScalarField field(grid, scalars, shares);
    if (field.mended.empty())
    {
      this->Scalars.Borrow(this->Device, field.values, count, "the scalars");
    }
    else
    {
      this->Scalars.Take(this->Device, std::move(field.mended), "the scalars");
    }
    if (!field.filled.empty())
    {
      this->Filled.Take(this->Device, std::move(field.filled), "the empty nodes");
    }
    this->Empty.SetScalars(grid.nodes, this->Scalars.Data(), this->Filled.Data());
  }

  void SetTransferFunctions(const Classification& classification) override
  {
    this->Functions = classification;
    const auto borrow = [this](auto& array, const auto& values)
    { array.Borrow(this->Device, values.data(), values.size(), "the transfer functions"); };
    borrow(this->Entries, this->Functions.Entries());
    borrow(this->Largest, this->Functions.LargestOfEntries());
    this->Table = this->Functions.Table();
    this->Table.entries = this->Entries.Data();
    this->Table.maxima = this->Largest.Data();
  }

  void SetExtinction(const ShownNodes& nodes, const float* base, const float* extinction,
    double share, const float* lightExtinction) override
  {
    const auto count = static_cast<std::size_t>(nodes.grid.NodeCount());
    const char* what = "the extinction";
    const BorrowedArray<AnyDevice, float> baseThere(this->Device, base, count, what);
    BorrowedArray<AnyDevice, float> other;
    if (base != extinction)
    {
      other.Borrow(this->Device, extinction, count, what);
    }
    this->Move(nodes, baseThere.Data(), base == extinction ? baseThere.Data() : other.Data(), share,
      lightExtinction == nullptr);
    if (lightExtinction)
    {
      this->Device->Upload(this->Opaque.Data(), lightExtinction, count * sizeof(float));
    }
  }

  bool IsDevice() const override { return !AnyDevice::readsHostMemory; }

  void ShowThere(const Grid& grid, const float* base, const float* extinction, double share,
    const float* lightExtinction) override
  {
    this->Move({ grid }, base, extinction, share, lightExtinction == nullptr);
    if (lightExtinction)
    {
      this->Device->Copy(this->Opaque.Data(), lightExtinction,
        static_cast<std::size_t>(grid.NodeCount()) * sizeof(float));
    }
  }

  void UseTransferFunction(const ShownNodes& nodes) override
  {
    const char* what = "a coarser extinction";
    const Grid& grid = nodes.grid;
    Field base = this->Classified(this->Functions.Majorant());
    if (nodes.ofAll)
    {
      base =
        Field(this->Device, ResampledForAll(*this->Piece, this->Whole, base.Data(), grid), what);
    }
    else if (grid.nodes != this->Nodes.nodes)
    {
      Field coarse(this->Device, std::size_t(grid.NodeCount()), what);
      Resample(this->Device, this->Nodes, base.Data(), grid, coarse.Data());
      base = std::move(coarse);
    }
    this->Move(nodes, base.Data(), base.Data(), 1, true);
  }

  void ClearExtinction() override
  {
    this->CoarseOpaque = {};
    this->Opaque = {};
    this->Shown.Clear();
    this->CoversAllRanks = false;
  }

  bool HasNoExtinction() const override { return this->Shown.Empty(); }

  void CastShadows(const Grid& grid, const RaySource& light, double rayDensity) override
  {
    const float* opaque = this->ShadowExtinction(grid);
    Field transmittance(this->Device, std::size_t(grid.NodeCount()), "the shadows");
    this->Piece && !this->CoversAllRanks
      ? FindTransmittanceOnRanks(
          this->Whole, *this->Piece, light, rayDensity, opaque, transmittance.Data())
      : this->Shadows.Fill(grid, opaque, light, rayDensity, transmittance.Data());
    Field arriving(this->Device, std::size_t(grid.NodeCount()), "the shadows");
    this->FindArriving(
      ArrivingOn(grid, this->Nodes.spacing, light), opaque, transmittance.Data(), arriving.Data());
    this->Shown.SetShadow(grid.nodes, arriving.Data());
    this->GradientHasShadow = false;
  }

  void Wait() override { this->Device->Wait(); }

  void ClearShadows() override { this->Shown.ClearShadow(); }

  void FindGradient() override
  {
    const Int3 nodes = this->Nodes.nodes;
    const Index rows = Index(nodes.y) * nodes.z;
    const char* what = "gradients";
    const Field extinction = this->Classified(1);
    const GradientNode gradient{ extinction.Data(), nodes, this->Nodes.direction,
      this->Nodes.spacing };
    Field ofNodes(this->Device, std::size_t(rows * nodes.x), what);
    Field ofRows(this->Device, std::size_t(rows), what);
    Field ofSlices(this->Device, std::size_t(nodes.z), what);
    Field largest(this->Device, 1, what);
    this->Device->ForNodes("steepness", nodes, SteepnessNode{ gradient, ofNodes.Data() });
    if (this->Piece)
    {
      this->ClearUnowned(ofNodes.Data());
    }
    const auto find = [&](const Field& values, int length, Field& ofRuns)
    {
      this->Device->ForIndices(
        "steepness", Index(ofRuns.Size()), LargestOfRun{ values.Data(), length, ofRuns.Data() });
    };
    find(ofNodes, nodes.x, ofRows);
    find(ofRows, nodes.y, ofSlices);
    find(ofSlices, nodes.z, largest);
    if (this->Piece)
    {
      *largest.Data() = this->Piece->ranks->LargestOf(*largest.Data());
    }
    FourPacked* packed = this->Gradient.RoomFor(this->Device, ofNodes.Size(), what);
    this->Device->ForNodes(
      "gradient", nodes, PackedGradientNode{ gradient, largest.Data(), packed });
    this->GradientHasShadow = false;
  }

  void FindEmptyBricks() override
  {
    this->Empty.FindEmpty(this->Table, this->KindOfFunction(),
      this->IsChanged() ? this->Shown.Packed() : nullptr, this->PlaceOfShown());
  }

  void SetImportance(const float* importance) override
  {
    this->Importance.Borrow(
      this->Device, importance, std::size_t(this->Nodes.NodeCount()), "the importance");
    this->Empty.FindUnimportant(this->Importance.Data());
  }

  void ClearImportance() override
  {
    this->Importance = {};
    this->Empty.ForgetImportance();
  }

  void FindBareBricks() override
  {
    this->Empty.FindBare(this->Table, this->KindOfFunction(),
      this->IsChanged() ? this->Shown.Packed() : nullptr, this->PlaceOfShown());
  }

  void Cast(const Casting& casting, const View& view, Picture& picture) override
  {
    const std::size_t count = std::size_t(view.width) * std::size_t(view.height);
    const char* what = "a picture";
    const auto borrow = [&](BorrowedArray<AnyDevice, float>& there, const float* values)
    {
      if (values)
      {
        there.Borrow(this->Device, values, count, what);
      }
      return values ? there.Data() : nullptr;
    };
    const float* nearDepth = borrow(this->NearDepth, view.nearDepth);
    const float* depth = borrow(this->Depth, view.depth);
    Rgba* pixels = this->Pixels.RoomFor(this->Device, count, what);
    this->ShadowGradient(casting);
    PictureRays rays{ RayMaker(this->Whole, casting.stepLength, view), view.width, view.height,
      nearDepth, depth, pixels };
    if (this->Piece)
    {
      this->CastPart(casting, rays, picture);
      return;
    }
    CastRays(*this->Device, this->SceneOf(casting), rays, casting.compositing);
    if (casting.missedColor)
    {
      if (view.missedDepth)
      {
        rays.nearDepth = nullptr;
        rays.depth = borrow(this->Depth, view.missedDepth);
      }
      const std::array<float, 3>& color = *casting.missedColor;
      PaintMissed(*this->Device, this->MissedSceneOf(casting), rays,
        MissedPaint{ { color[0], color[1], color[2] } });
    }
    this->Device->Download(picture.rgba.data(), pixels, count * sizeof(Rgba));
  }

  double ArrivingLightAt(const Vec3& position) override { return this->Shown.ShadowAt(position); }

private:
  using Field = DeviceArray<AnyDevice, float>;

  /// Moves the shown extinction. If this fails, nothing is shown. `casts`: whether it casts the
  /// shadows.
  void Move(
    const ShownNodes& nodes, const float* base, const float* extinction, double share, bool casts)
  {
    const Grid& grid = nodes.grid;
    try
    {
      const auto count = static_cast<std::size_t>(grid.NodeCount());
      float* opaque = this->Opaque.RoomFor(this->Device, count, "what casts the shadows");
      this->CoarseOpaque = {};
      if (nodes.ofAll && !this->CoversAllRanks && !this->Shown.Empty())
      {
        this->GatherShown(grid);
      }
      this->CoversAllRanks = nodes.ofAll;
      this->Shown.MoveTo(
        grid, base, extinction, this->Functions.Majorant(), share, casts ? opaque : nullptr);
    }
    catch (...)
    {
      this->ClearExtinction();
      throw;
    }
  }

  /// Gathers the extinction that all ranks show of their pieces.
  void GatherShown(const Grid& grid)
  {
    const auto resample = [this](const Grid& part)
    {
      const auto numbers = this->Shown.On(part);
      return std::vector<TwoPacked>(numbers.Data(), numbers.Data() + numbers.Size());
    };
    const std::vector<TwoPacked> ofAll = GatheredOverlay(*this->Piece, this->Whole, grid, resample);
    this->Shown.GoOnWith(grid, ofAll, this->Piece->ranks->AnyOf(this->Shown.Changed()));
  }

  OverlayGeometry PlaceOfShown() const
  {
    const Int3& nodes = this->Shown.Nodes().nodes;
    if (!this->CoversAllRanks)
    {
      return OverlayGeometry::Over(this->Nodes.nodes, nodes);
    }
    const std::array<Range<int>, 3>& along = this->Piece->nodes.along;
    return { nodes, this->Whole.nodes, { along[0].begin, along[1].begin, along[2].begin } };
  }

  /// Draws this rank's part of the rays, and composes the picture.
  void CastPart(const Casting& casting, PictureRays& rays, Picture& picture)
  {
    const Communicator& ranks = *this->Piece->ranks;
    const RayPart part(
      this->Piece->owned[std::size_t(ranks.Rank())], this->Piece->nodes, this->Whole.nodes);
    std::vector<PartialPixel> parts(std::size_t(rays.columns) * std::size_t(rays.rows));
    rays.part = &part;
    rays.parts = parts.data();
    CastRays(*this->Device, this->SceneOf(casting), rays, Compositing::FrontToBack);
    Compose(ranks, parts, casting.opaqueBelow, picture);
  }

  /// Sets values of ghost nodes to 0, since no rank has all neighbours of nodes at the faces of its
  /// box.
  void ClearUnowned(float* values) const
  {
    const ScenePiece& piece = *this->Piece;
    const NodeBox& own = piece.owned[std::size_t(piece.ranks->Rank())];
    std::vector<float> kept(std::size_t(own.Count()));
    const FieldView all = FieldView::Part(values, piece.nodes);
    CopyNodes(own, all, FieldView::Part(kept.data(), own));
    FillNodes(piece.nodes, 0, all);
    CopyNodes(own, FieldView::Part(kept.data(), own), all);
  }

  /// Returns the transfer function's extinction of all scalars in a unit [1/length].
  Field Classified(float majorant) const
  {
    const Index count = this->Nodes.NodeCount();
    Field extinction(this->Device, std::size_t(count), "the transfer function's extinction");
    this->Device->ForIndices("classify", count,
      ClassifiedNode{
        this->Table, this->Scalars.Data(), this->Filled.Data(), majorant, extinction.Data() });
    return extinction;
  }

  /// Computes the light that arrives at the nodes of this rank, from fields there.
  void FindArriving(
    ArrivingNode body, const float* opaque, const float* transmittance, float* arriving)
  {
    const Int3 nodes = body.nodes;
    body.arriving = arriving;
    if (this->Piece && !this->CoversAllRanks)
    {
      const ScenePiece& piece = *this->Piece;
      body.nodes = this->Whole.nodes;
      const std::vector<NodeBox> wanted = WithGhosts(piece.boxes, body.LayersRead(), body.nodes);
      const FieldInBox casts = FieldIn(piece, wanted, opaque);
      const FieldInBox lit = FieldIn(piece, wanted, transmittance);
      body.Within(wanted[std::size_t(piece.ranks->Rank())], piece.nodes);
      this->FindArrivingFrom(body, nodes, casts.Data(), lit.Data());
      return;
    }
    this->FindArrivingFrom(body, nodes, opaque, transmittance);
  }

  void FindArrivingFrom(
    ArrivingNode body, const Int3& nodes, const float* opaque, const float* transmittance)
  {
    body.caster = opaque;
    body.transmittance = transmittance;
    this->Device->ForNodes("light that arrives", nodes, body);
  }

  /// Returns the extinction that casts the shadows, at the nodes of their grid.
  const float* ShadowExtinction(const Grid& grid)
  {
    const Grid& from = this->Shown.Nodes();
    this->LimitCaster(from, this->Opaque.Data());
    if (grid.nodes == from.nodes)
    {
      return this->Opaque.Data();
    }
    if (this->CoarseOpaque.Empty() || grid.nodes != this->CoarseNodes)
    {
      this->CoarseOpaque = {}; // first, to free memory for the other one
      Field coarse(this->Device, std::size_t(grid.NodeCount()), "a coarser extinction");
      Resample(this->Device, from, this->Opaque.Data(), grid, coarse.Data());
      this->LimitCaster(grid, coarse.Data());
      this->CoarseOpaque = std::move(coarse);
      this->CoarseNodes = grid.nodes;
    }
    return this->CoarseOpaque.Data();
  }

  /// Limits the extinction that casts shadows to what they resolve, see mostCasting.
  void LimitCaster(const Grid& grid, float* extinction)
  {
    const Vec3& spacing = grid.spacing;
    const double cell = std::max({ spacing.x, spacing.y, spacing.z });
    this->Device->ForIndices("limit what casts the shadows", grid.NodeCount(),
      LimitedNode{ float(mostCasting / cell), extinction });
  }

  /// Returns whether the shadows have the nodes of the gradient.
  bool ShadowsFitGradient() const
  {
    return !this->CoversAllRanks && this->Shown.Nodes().nodes == this->Nodes.nodes;
  }

  /// Stores such shadows with the gradient, so that a sample reads both from one field.
  void ShadowGradient(const Casting& casting)
  {
    if (casting.lit && this->Shown.Shadowed() && this->ShadowsFitGradient() &&
      !this->GradientHasShadow)
    {
      this->Device->ForIndices("shadows of the gradient", this->Nodes.NodeCount(),
        ShadowedGradientNode{ this->Shown.Shadow(), this->Gradient.Data() });
      this->GradientHasShadow = true;
    }
  }

  RayScene SceneOf(const Casting& casting) const
  {
    RayScene scene;
    scene.grid = CellGrid(this->Nodes.nodes);
    scene.scalars = this->Scalars.Data();
    scene.filled = this->Filled.Data();
    scene.table = this->Table;
    scene.majorant = this->Functions.Majorant();
    scene.opaqueBelow = casting.opaqueBelow;
    scene.stepLength = casting.stepLength;
    scene.light = casting.light;
    scene.gradient = casting.lit ? this->Gradient.Data() : nullptr;
    if (!this->Shown.Empty())
    {
      scene.PlaceOverlay(this->PlaceOfShown(), this->Nodes.nodes);
      scene.addedUnit = this->Shown.Majorant() / scene.majorant;
      scene.overlay = this->Shown.Changed() ? this->Shown.Packed() : nullptr;
      const bool apart = casting.lit && this->Shown.Shadowed() && !this->ShadowsFitGradient();
      scene.shadow = apart ? this->Shown.Shadow() : nullptr;
    }
    if (casting.skipEmpty)
    {
      scene.bricks = this->Empty.Distances();
    }
    if (casting.compositing != Compositing::FrontToBack)
    {
      this->AddImportance(casting, scene);
    }
    return scene;
  }

  void AddImportance(const Casting& casting, RayScene& scene) const
  {
    scene.importance = this->Importance.Data();
    if (casting.skipEmpty)
    {
      scene.unimportant = this->Empty.UnimportantDistances();
    }
  }

  /// Returns the scene of the rays that accumulate missed importance, which need no light.
  RayScene MissedSceneOf(const Casting& casting) const
  {
    RayScene scene = this->SceneOf(casting);
    this->AddImportance(casting, scene);
    scene.gradient = nullptr;
    scene.shadow = nullptr;
    if (casting.skipEmpty)
    {
      scene.bricks = this->Empty.BareDistances();
    }
    return scene;
  }

  Function KindOfFunction() const
  {
    return this->Functions.IsUniform() ? Function::IsUniform : Function::Varies;
  }

  /// Returns whether an extinction other than the transfer function's may be shown.
  bool IsChanged() const { return !this->Shown.Empty() && this->Shown.Changed(); }

  std::shared_ptr<AnyDevice> Device;
  Grid Nodes;                              ///< grid of the scalars
  Grid Whole;                              ///< grid of the scalars of all ranks
  std::shared_ptr<const ScenePiece> Piece; ///< piece of this rank; null: everything, as on a GPU
  BorrowedArray<AnyDevice, float> Scalars;
  BorrowedArray<AnyDevice, float> Filled; ///< empty: all nodes are filled

  Classification Functions;
  BorrowedArray<AnyDevice, OpticalEntry> Entries;
  BorrowedArray<AnyDevice, float> Largest; ///< see OpticalTable
  OpticalTable Table;

  BorrowedArray<AnyDevice, float> Importance; ///< empty: not needed
  DeviceArray<AnyDevice, FourPacked> Gradient;
  bool GradientHasShadow = false; ///< whether it includes the shadow of the overlay
  Bricks<AnyDevice> Empty;
  ExtinctionOverlay<AnyDevice> Shown;
  bool CoversAllRanks = false; ///< whether the overlay covers the box of all ranks
  ShadowVolume<AnyDevice> Shadows;
  Field Opaque;       ///< extinction that casts the shadows, at the nodes of the overlay
  Field CoarseOpaque; ///< this on a coarser grid; empty: outdated or not needed
  Int3 CoarseNodes{ 0 };

  BorrowedArray<AnyDevice, float> NearDepth;
  BorrowedArray<AnyDevice, float> Depth;
  DeviceArray<AnyDevice, Rgba> Pixels;
};
}

#endif
