// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_RenderPasses_h
#define limpid_render_RenderPasses_h

#include "render/ArrivingLight.h"
#include "render/Bricks.h"
#include "render/DrawnPart.h"
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
 * for the importance if missed structures are painted, plus 2 for the structures if they tint. At
 * 256^3 nodes this is 0.54 GB, plus 0.1 GB for the plan of the shadows. The processor reads scalars
 * and extinctions in place, integers of up to 16 bits among them.
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

  void SetScalars(const DrawnPart& part, const ScalarNodes& scalars, const float* shares) override
  {
    this->Part = part;
    const Grid& grid = part.Nodes();
    this->Scalars = {};
    this->Floats = {};
    this->Filled = {};
    if (!grid.HasVolume())
    {
      return;
    }
    const auto count = static_cast<std::size_t>(grid.NodeCount());
    ScalarField field(grid, scalars, shares);
    this->TakeScalars(field, count);
    if (!field.filled.empty())
    {
      this->Filled.Take(this->Device, std::move(field.filled), "the empty nodes");
    }
    this->Empty.SetScalars(grid.nodes, this->Scalars, this->Filled.Data());
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

  void SetExtinction(const DrawnPart& part, const float* base, const float* extinction,
    double share, const float* lightExtinction) override
  {
    const auto count = static_cast<std::size_t>(part.Nodes().NodeCount());
    const char* what = "the extinction";
    const BorrowedArray<AnyDevice, float> baseThere(this->Device, base, count, what);
    BorrowedArray<AnyDevice, float> other;
    if (base != extinction)
    {
      other.Borrow(this->Device, extinction, count, what);
    }
    this->Move(part, baseThere.Data(), base == extinction ? baseThere.Data() : other.Data(), share,
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
    this->Move(grid, base, extinction, share, lightExtinction == nullptr);
    if (lightExtinction)
    {
      this->Device->Copy(this->Opaque.Data(), lightExtinction,
        static_cast<std::size_t>(grid.NodeCount()) * sizeof(float));
    }
  }

  void UseTransferFunction(const DrawnPart& part) override
  {
    const Grid& grid = this->Part.Nodes();
    Field base(this->Device, std::size_t(grid.NodeCount()), extinctionText);
    this->Classify({ 0, grid.nodes.z }, this->Functions.Majorant(), base.Data());
    if (!part.HasSameNodes(this->Part))
    {
      base = this->OnCoarser(part.Nodes(), this->Part, base.Data());
    }
    this->Move(part, base.Data(), base.Data(), 1, true);
  }

  void ClearExtinction() override
  {
    this->CoarseOpaque = {};
    this->Opaque = {};
    this->Shown.Clear();
  }

  bool HasNoExtinction() const override { return this->Shown.Empty(); }

  void CastShadows(const DrawnPart& part, const RaySource& light, double rayDensity) override
  {
    const auto count = static_cast<std::size_t>(part.Nodes().NodeCount());
    const float* opaque = this->ShadowExtinction(part);
    Field transmittance(this->Device, count, "the shadows");
    this->Shadows.Fill(part, opaque, light, rayDensity, transmittance.Data());
    Field arriving(this->Device, count, "the shadows");
    this->FindArriving(part, light, opaque, transmittance.Data(), arriving.Data());
    this->Shown.SetShadow(part, arriving.Data());
    this->GradientHasShadow = false;
  }

  void Wait() override { this->Device->Wait(); }

  void ClearShadows() override { this->Shown.ClearShadow(); }

  void FindGradient() override
  {
    const Grid& grid = this->Part.Nodes();
    const Index perLayer = Index(grid.nodes.x) * grid.nodes.y;
    const Field largest = this->LargestSteepness();
    FourPacked* packed =
      this->Gradient.RoomFor(this->Device, std::size_t(grid.NodeCount()), "gradients");
    this->ForSlabs({ 0, grid.nodes.z },
      [&](const Range<int>& layers, const GradientNode& gradient)
      {
        this->Device->ForNodes("gradient", { grid.nodes.x, grid.nodes.y, layers.Length() },
          PackedGradientNode{
            gradient, layers.begin, largest.Data(), packed + layers.begin * perLayer });
      });
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
      this->Device, importance, std::size_t(this->Part.Nodes().NodeCount()), "the importance");
    this->Empty.FindUnimportant(this->Importance.Data());
  }

  void SetStructures(const StructureRow* rows) override
  {
    this->Structures = {};
    if (rows)
    {
      this->Structures.Borrow(
        this->Device, rows, std::size_t(this->Part.Nodes().NodeCount()), "the structures");
    }
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
    this->Tints = {};
    if (!casting.tints.empty())
    {
      this->Tints.Borrow(this->Device, casting.tints.data(), casting.tints.size(), what);
    }
    PictureRays rays{ RayMaker(this->Part.Whole(), casting.stepLength, view), view.width,
      view.height, nearDepth, depth, pixels, view.RowsWithRays() };
    if (!picture.foremost.empty())
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

protected:
  const DrawnPart& Drawn() const { return this->Part; }

  /// Returns the scene of the rays of a picture.
  RayScene SceneOf(const Casting& casting) const
  {
    RayScene scene;
    scene.grid = CellGrid(this->Part.Nodes().nodes);
    scene.scalars = this->Scalars;
    scene.filled = this->Filled.Data();
    scene.table = this->Table;
    scene.majorant = this->Functions.Majorant();
    scene.opaqueBelow = casting.opaqueBelow;
    scene.stepLength = casting.stepLength;
    scene.light = casting.light;
    scene.gradient = casting.lit ? this->Gradient.Data() : nullptr;
    if (!this->Shown.Empty())
    {
      scene.PlaceOverlay(this->PlaceOfShown());
      scene.overlaySameNodes = this->Shown.Part().HasSameNodes(this->Part);
      scene.addedUnit = this->Shown.Majorant() / scene.majorant;
      scene.overlay = this->Shown.Changed() ? this->Shown.Packed() : nullptr;
      const bool apart = casting.lit && this->Shown.Shadowed() && !this->ShadowsFitGradient();
      scene.shadow = apart ? this->Shown.Shadow() : nullptr;
    }
    if (!casting.tints.empty())
    {
      scene.structures = this->Structures.Data();
      scene.tints = this->Tints.Data();
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

  /// Returns the same scene, with the shadows always apart from the gradient.
  RayScene SceneWithShadow(const Casting& casting) const
  {
    RayScene scene = this->SceneOf(casting);
    scene.shadow = casting.lit && this->Shown.Shadowed() ? this->Shown.Shadow() : nullptr;
    return scene;
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

private:
  using Field = DeviceArray<AnyDevice, float>;
  static constexpr const char* extinctionText = "the transfer function's extinction";

  /// Reads scalars in place, unless some were mended or the device has to have them as floats.
  void TakeScalars(ScalarField& field, std::size_t count)
  {
    const char* what = "the scalars";
    if (!field.mended.empty())
    {
      this->Floats.Take(this->Device, std::move(field.mended), what);
    }
    else if (BorrowedArray<AnyDevice, float>::isCopy && field.values.Bits() == 32)
    {
      this->Floats.Borrow(this->Device, field.values.Floats(), count, what);
    }
    else if (BorrowedArray<AnyDevice, float>::isCopy)
    {
      this->Floats.Take(this->Device, FloatsOf(field.values, Index(count)), what);
    }
    this->Scalars = this->Floats.Empty() ? field.values : ScalarNodes(this->Floats.Data());
  }

  /// Moves the shown extinction. If this fails, nothing is shown. `casts`: whether it casts the
  /// shadows.
  void Move(
    const DrawnPart& part, const float* base, const float* extinction, double share, bool casts)
  {
    try
    {
      const auto count = static_cast<std::size_t>(part.Nodes().NodeCount());
      float* opaque = this->Opaque.RoomFor(this->Device, count, "what casts the shadows");
      this->CoarseOpaque = {};
      if (part.IsWhole() && !this->Shown.Part().IsWhole())
      {
        this->GatherShown(part);
      }
      this->Shown.MoveTo(
        part, base, extinction, this->Functions.Majorant(), share, casts ? opaque : nullptr);
    }
    catch (...)
    {
      this->ClearExtinction();
      throw;
    }
  }

  /// Gathers the extinctions that are shown of all parts.
  void GatherShown(const DrawnPart& all)
  {
    const auto resample = [this](const Grid& some)
    {
      const auto numbers = this->Shown.On(some);
      return std::vector<TwoPacked>(numbers.Data(), numbers.Data() + numbers.Size());
    };
    const std::vector<TwoPacked> gathered = GatheredOverlay(this->Part, all.Nodes(), resample);
    this->Shown.GoOnWith(all, gathered, this->Part.AnyOf(this->Shown.Changed()));
  }

  OverlayGeometry PlaceOfShown() const
  {
    return OverlayGeometry::Of(this->Shown.Part(), this->Part);
  }

  /// Draws the owned part of the rays, and composes the picture.
  void CastPart(const Casting& casting, PictureRays& rays, Picture& picture)
  {
    const RayPart part(this->Part);
    std::vector<PartialPixel> parts(std::size_t(rays.columns) * std::size_t(rays.rows));
    rays.part = &part;
    rays.parts = parts.data();
    CastRays(*this->Device, this->SceneOf(casting), rays, Compositing::FrontToBack);
    Compose(this->Part, parts, casting.opaqueBelow, picture);
  }

  /// Returns the square of the largest length of a gradient at the owned nodes of all parts. Ghost
  /// nodes at the faces of the box have neighbours elsewhere.
  Field LargestSteepness() const
  {
    const char* what = "gradients";
    const Int3 nodes = this->Part.Owned().Size();
    const Int3 first = this->Part.Owned().First() - this->Part.Box().First();
    Field ofNodes;
    Field ofRows;
    Field ofSlices(this->Device, std::size_t(nodes.z), what);
    Field largest(this->Device, 1, what);
    const auto find = [this](const float* values, int length, Index runs, float* ofRuns) {
      this->Device->ForIndices("steepness", runs, LargestOfRun{ values, length, ofRuns });
    };
    this->ForSlabs({ first.z, first.z + nodes.z },
      [&](const Range<int>& layers, const GradientNode& gradient)
      {
        const Int3 here(nodes.x, nodes.y, layers.Length());
        const Index rows = Index(here.y) * here.z;
        float* squared = ofNodes.RoomFor(this->Device, std::size_t(rows * here.x), what);
        float* largestOfRows = ofRows.RoomFor(this->Device, std::size_t(rows), what);
        this->Device->ForNodes("steepness", here,
          SteepnessNode{ gradient, { first.x, first.y, layers.begin }, squared });
        find(squared, nodes.x, rows, largestOfRows);
        find(largestOfRows, nodes.y, here.z, ofSlices.Data() + (layers.begin - first.z));
      });
    find(ofSlices.Data(), nodes.z, 1, largest.Data());
    if (!this->IsDevice()) // devices draw the whole
    {
      *largest.Data() = this->Part.LargestOf(*largest.Data());
    }
    return largest;
  }

  /// Calls body(layers, gradient) for slabs that together are these layers of nodes. The gradient
  /// is that of the transfer function's extinction, for the nodes of the slab.
  template <class Body>
  void ForSlabs(const Range<int>& all, const Body& body) const
  {
    constexpr Index nodesOfSlab = 1 << 20; // their extinction fits into caches
    constexpr int fewestLayers = 16;       // two more are classified, too
    const Grid& grid = this->Part.Nodes();
    const Index perLayer = Index(grid.nodes.x) * grid.nodes.y;
    const int most = std::max(fewestLayers, int(nodesOfSlab / perLayer));
    const int read = std::min(most + 2, grid.nodes.z);
    Field extinction(this->Device, std::size_t(read * perLayer), extinctionText);
    for (int begin = all.begin; begin < all.end; begin += most)
    {
      const Range<int> slab{ begin, std::min(begin + most, all.end) };
      const int first = std::max(slab.begin - 1, 0);
      this->Classify({ first, std::min(slab.end + 1, grid.nodes.z) }, 1, extinction.Data());
      body(
        slab, GradientNode{ extinction.Data(), first, grid.nodes, grid.direction, grid.spacing });
    }
  }

  /// Computes the transfer function's extinction of layers of scalars in a unit [1/length].
  void Classify(const Range<int>& layers, float majorant, float* extinction) const
  {
    const Int3& nodes = this->Part.Nodes().nodes;
    const Index perLayer = Index(nodes.x) * nodes.y;
    const Index first = layers.begin * perLayer;
    const float* filled = this->Filled.Data();
    this->Device->ForIndices("classify", layers.Length() * perLayer,
      ClassifiedNode{ this->Table, this->Scalars.From(first), filled ? filled + first : nullptr,
        majorant, extinction });
  }

  /// Computes the light that arrives at the nodes of a part, from fields there.
  void FindArriving(const DrawnPart& part, const RaySource& light, const float* opaque,
    const float* transmittance, float* arriving)
  {
    ArrivingNode body = ArrivingOn(part.Whole(), this->Part.Nodes().spacing, light);
    const auto around = part.Around(body.LayersRead());
    const auto casts = around.Extended(opaque);
    const auto lit = around.Extended(transmittance);
    body.Within(around.Box(), part.Box());
    body.caster = casts.Data();
    body.transmittance = lit.Data();
    body.arriving = arriving;
    this->Device->ForNodes("light that arrives", part.Nodes().nodes, body);
  }

  /// Returns the extinction that casts the shadows, at the nodes of a part.
  const float* ShadowExtinction(const DrawnPart& part)
  {
    const DrawnPart& from = this->Shown.Part();
    const Grid& grid = part.Nodes();
    this->LimitCaster(from.Nodes(), this->Opaque.Data());
    if (part.HasSameNodes(from))
    {
      return this->Opaque.Data();
    }
    if (this->CoarseOpaque.Empty() || grid.nodes != this->CoarseNodes)
    {
      this->CoarseOpaque = {}; // first, to free memory for the other one
      Field coarse = this->OnCoarser(grid, from, this->Opaque.Data());
      this->LimitCaster(grid, coarse.Data());
      this->CoarseOpaque = std::move(coarse);
      this->CoarseNodes = grid.nodes;
    }
    return this->CoarseOpaque.Data();
  }

  /// Returns an extinction of a part at all nodes of a coarser grid.
  Field OnCoarser(const Grid& grid, const DrawnPart& from, const float* extinction) const
  {
    Field coarse(this->Device, std::size_t(grid.NodeCount()), "a coarser extinction");
    ResamplePart(this->Device, from, extinction, grid, coarse.Data());
    return coarse;
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
  bool ShadowsFitGradient() const { return this->Shown.Part().HasSameNodes(this->Part); }

  /// Stores such shadows with the gradient, so that a sample reads both from one field.
  void ShadowGradient(const Casting& casting)
  {
    if (casting.lit && this->Shown.Shadowed() && this->ShadowsFitGradient() &&
      !this->GradientHasShadow)
    {
      this->Device->ForIndices("shadows of the gradient", this->Part.Nodes().NodeCount(),
        ShadowedGradientNode{ this->Shown.Shadow(), this->Gradient.Data() });
      this->GradientHasShadow = true;
    }
  }

  void AddImportance(const Casting& casting, RayScene& scene) const
  {
    scene.importance = this->Importance.Data();
    if (casting.skipEmpty)
    {
      scene.unimportant = this->Empty.UnimportantDistances();
    }
  }

  Function KindOfFunction() const
  {
    return this->Functions.IsUniform() ? Function::IsUniform : Function::Varies;
  }

  /// Returns whether an extinction other than the transfer function's may be shown.
  bool IsChanged() const { return !this->Shown.Empty() && this->Shown.Changed(); }

  std::shared_ptr<AnyDevice> Device;
  DrawnPart Part; ///< nodes of the scalars; the whole on a GPU
  ScalarNodes Scalars;
  BorrowedArray<AnyDevice, float> Floats; ///< those of Scalars, unless they are the caller's
  BorrowedArray<AnyDevice, float> Filled; ///< empty: all nodes are filled

  Classification Functions;
  BorrowedArray<AnyDevice, OpticalEntry> Entries;
  BorrowedArray<AnyDevice, float> Largest; ///< see OpticalTable
  OpticalTable Table;

  BorrowedArray<AnyDevice, float> Importance;        ///< empty: not needed
  BorrowedArray<AnyDevice, StructureRow> Structures; ///< empty: none
  BorrowedArray<AnyDevice, FourFloats> Tints;        ///< see RayScene
  DeviceArray<AnyDevice, FourPacked> Gradient;
  bool GradientHasShadow = false; ///< whether it includes the shadow of the overlay
  Bricks<AnyDevice> Empty;
  ExtinctionOverlay<AnyDevice> Shown;
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
