// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "render/RendererOnDevice.h"

#include "render/Fields.h"
#include "render/RaycastOnDevice.h"

#include <algorithm>

namespace limpid
{
namespace
{
constexpr Index steepLanes[3] = { 65536, 256, 1 };

bool SameGrid(const Grid& one, const Grid& other)
{
  return one.nodes == other.nodes && one.spacing == other.spacing && one.origin == other.origin &&
    one.direction == other.direction;
}
}

template <class Device>
RendererOnDevice<Device>::RendererOnDevice(std::shared_ptr<Device> device)
  : Home(std::move(device))
  , Shown(this->Home)
{
}

template <class Device>
template <class Value>
Value* RendererOnDevice<Device>::RoomFor(DeviceArray<Device, Value>& array, std::size_t count,
  const std::shared_ptr<Device>& device, const char* what)
{
  if (array.Size() < count)
  {
    array = {}; // first, so that there is room for the other one
    array = { device, count, what };
  }
  return array.Data();
}

template <class Device>
void RendererOnDevice<Device>::SetScalars(const Grid& grid, const float* scalars)
{
  this->Scene = grid;
  this->Scalars = {};
  this->Filled = {};
  if (!grid.HasVolume())
  {
    return;
  }
  const ScalarField field(grid, scalars);
  const auto count = static_cast<std::size_t>(grid.NodeCount());
  this->Scalars = { this->Home, field.values, count, "the scalars" };
  if (!field.filled.empty())
  {
    this->Filled = { this->Home, field.filled, "the empty nodes" };
  }
  const NodeCounts bricks = this->BrickCounts();
  RoomFor(this->Ranges, std::size_t(bricks.Count()), this->Home, "the bricks");
  this->Home->ForIndices("ranges of bricks", bricks.Count(),
    RangeOfBrick{ CountsOf(grid.nodes), bricks, this->Scalars.Data(), this->Ranges.Data() });
}

template <class Device>
void RendererOnDevice<Device>::SetTransferFunctions(const Classification& classification)
{
  this->Entries = { this->Home, classification.Entries(), "the transfer functions" };
  this->Integrals = { this->Home, classification.IntegralsOfEntries(), "the transfer functions" };
  this->Largest = { this->Home, classification.LargestOfEntries(), "the transfer functions" };
  this->Table = classification.Table();
  this->Table.values = this->Entries.Data();
  this->Table.integrals = this->Integrals.Data();
  this->Table.maxima = this->Largest.Data();
  this->Majorant = classification.Majorant();
}

template <class Device>
void RendererOnDevice<Device>::SetExtinction(const Grid& grid, const float* base,
  const float* extinction, double share, const float* lightExtinction)
{
  const auto count = static_cast<std::size_t>(grid.NodeCount());
  float* baseThere = RoomFor(this->Passing, 2 * count, this->Home, "the extinction");
  float* extinctionThere = base == extinction ? baseThere : baseThere + count;
  this->Home->Upload(baseThere, base, count * sizeof(float));
  if (base != extinction)
  {
    this->Home->Upload(extinctionThere, extinction, count * sizeof(float));
  }
  this->ShowThere(grid, baseThere, extinctionThere, share, nullptr);
  if (lightExtinction)
  {
    this->Home->Upload(this->Opaque.Data(), lightExtinction, count * sizeof(float));
  }
}

template <class Device>
void RendererOnDevice<Device>::ShowThere(const Grid& grid, const float* base,
  const float* extinction, double share, const float* lightExtinction)
{
  const auto count = static_cast<std::size_t>(grid.NodeCount());
  float* opaque = RoomFor(this->Opaque, count, this->Home, "what casts the shadows");
  this->ExtinctionGrid = grid;
  this->CoarseOpaque = {};
  this->Shown.MoveTo(
    grid, base, extinction, this->Majorant, share, lightExtinction ? nullptr : opaque);
  if (lightExtinction)
  {
    this->Home->Copy(opaque, lightExtinction, count * sizeof(float));
  }
}

template <class Device>
void RendererOnDevice<Device>::UseTransferFunction(const Grid& grid)
{
  const auto count = static_cast<std::size_t>(this->Scene.NodeCount());
  Field base(this->Home, count, "the base extinction");
  this->Home->ForIndices("base extinction", this->Scene.NodeCount(),
    BaseNode{ this->Classified(), this->Majorant, base.Data() });
  if (grid.nodes != this->Scene.nodes)
  {
    Field coarse;
    this->Restrict(this->Scene, base.Data(), grid, coarse);
    base = std::move(coarse);
  }
  this->ShowThere(grid, base.Data(), base.Data(), 1, nullptr);
}

template <class Device>
void RendererOnDevice<Device>::ClearExtinction()
{
  this->CoarseOpaque = {};
  this->Opaque = {};
  this->Shown.Clear();
}

template <class Device>
void RendererOnDevice<Device>::CastShadows(
  const Grid& grid, const RaySource& light, double rayDensity)
{
  const float* opaque = this->ShadowExtinction(grid);
  if (!this->Plan || !this->Plan->IsOf(grid, light, rayDensity))
  {
    this->PlanShadows(grid, light, rayDensity);
  }
  float* transmittance =
    RoomFor(this->Passing, static_cast<std::size_t>(grid.NodeCount()), this->Home, "the shadows");
  this->Plan->volume.Fill(opaque, transmittance);
  this->Shown.SetShadow(grid.nodes, transmittance);
}

template <class Device>
bool RendererOnDevice<Device>::ShadowPlan::IsOf(
  const Grid& nodes, const RaySource& eye, double density) const
{
  return SameGrid(this->grid, nodes) && this->light.parallel == eye.parallel &&
    this->light.origin == eye.origin && this->light.direction == eye.direction &&
    this->rayDensity == density;
}

template <class Device>
void RendererOnDevice<Device>::PlanShadows(
  const Grid& grid, const RaySource& light, double rayDensity)
{
  this->Plan.reset(); // first, so that there is room for the other one
  // Of a volume that is filled everywhere, so that it lasts when the extinction changes.
  const std::vector<float> nothing(static_cast<std::size_t>(grid.NodeCount()));
  const Occupancy everywhere(grid, nothing.data(), nothing.data(), false);
  this->Plan.emplace(
    ShadowPlan{ grid, light, rayDensity, { this->Home, grid, everywhere, light, rayDensity } });
}

template <class Device>
const float* RendererOnDevice<Device>::ShadowExtinction(const Grid& grid)
{
  if (grid.nodes == this->ExtinctionGrid.nodes)
  {
    return this->Opaque.Data();
  }
  if (this->CoarseOpaque.Empty() || grid.nodes != this->CoarseNodes)
  {
    this->Restrict(this->ExtinctionGrid, this->Opaque.Data(), grid, this->CoarseOpaque);
    this->CoarseNodes = grid.nodes;
  }
  return this->CoarseOpaque.Data();
}

template <class Device>
void RendererOnDevice<Device>::Restrict(
  const Grid& from, const float* field, const Grid& to, Field& result)
{
  Int3 nodes = from.nodes;
  Field before;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (nodes[axis] == to.nodes[axis])
    {
      continue;
    }
    const NodeCounts fine = CountsOf(nodes);
    nodes[axis] = to.nodes[axis];
    const NodeCounts coarse = CountsOf(nodes);
    Field after(this->Home, std::size_t(coarse.Count()), "a coarser extinction");
    this->Home->ForIndices(
      "restrict", coarse.Count(), RestrictedNode{ fine, field, coarse, axis, after.Data() });
    before = std::move(after);
    field = before.Data();
  }
  result = std::move(before);
}

template <class Device>
ClassifiedNode RendererOnDevice<Device>::Classified() const
{
  return { this->Table, this->Scalars.Data(), this->Filled.Data() };
}

template <class Device>
void RendererOnDevice<Device>::FindGradient()
{
  const Index count = this->Scene.NodeCount();
  const GradientNode gradient{ this->Classified(), CountsOf(this->Scene.nodes),
    this->Scene.direction, this->Scene.spacing };
  float* wide = RoomFor(this->Steepness, std::size_t(steepLanes[0] + steepLanes[1] + steepLanes[2]),
    this->Home, "gradients");
  float* narrow = wide + steepLanes[0];
  float* largest = narrow + steepLanes[1];
  this->Home->ForIndices("steepness", steepLanes[0],
    LargestOfLane<SteepnessOfNode>{ { gradient }, count, steepLanes[0], wide });
  this->Home->ForIndices("steepness", steepLanes[1],
    LargestOfLane<FoundSteepness>{ { wide }, steepLanes[0], steepLanes[1], narrow });
  this->Home->ForIndices("steepness", steepLanes[2],
    LargestOfLane<FoundSteepness>{ { narrow }, steepLanes[1], steepLanes[2], largest });
  RoomFor(this->Gradient, static_cast<std::size_t>(4 * count), this->Home, "the gradient");
  this->Home->ForIndices(
    "gradient", count, PackedGradientNode{ gradient, largest, this->Gradient.Data() });
}

template <class Device>
NodeCounts RendererOnDevice<Device>::BrickCounts() const
{
  return CountsOf((this->Scene.nodes + (BrickDistances::size - 2)) / BrickDistances::size);
}

template <class Device>
void RendererOnDevice<Device>::FindEmptyBricks()
{
  const NodeCounts bricks = this->BrickCounts();
  const auto count = static_cast<std::size_t>(bricks.Count());
  std::uint8_t* distance = RoomFor(this->Distance, count, this->Home, "the bricks");
  std::uint8_t* other = RoomFor(this->OtherDistance, count, this->Home, "the bricks");
  const bool changed = !this->Shown.Empty() && this->Shown.Changed();
  this->Home->ForIndices("empty bricks", bricks.Count(),
    EmptyBrick{ CountsOf(this->Scene.nodes), bricks, this->Table, this->Ranges.Data(),
      changed ? this->Shown.Packed() : nullptr, CountsOf(this->Shown.Nodes()), other });
  this->Home->ForIndices(
    "distances of bricks", bricks.Count(), SpreadBrick{ bricks, 0, other, distance });
  this->Home->ForIndices(
    "distances of bricks", bricks.Count(), SpreadBrick{ bricks, 1, distance, other });
  this->Home->ForIndices(
    "distances of bricks", bricks.Count(), SpreadBrick{ bricks, 2, other, distance });
}

template <class Device>
RaySceneOf<FourFloats> RendererOnDevice<Device>::SceneOf(const Casting& casting) const
{
  RaySceneOf<FourFloats> scene;
  scene.grid = CellGrid(this->Scene.nodes);
  scene.scalars = this->Scalars.Data();
  scene.filled = this->Filled.Data();
  scene.table = this->Table;
  scene.majorant = this->Majorant;
  scene.opaqueBelow = casting.opaqueBelow;
  scene.stepLength = casting.stepLength;
  scene.light = casting.light;
  scene.gradient = casting.lit ? this->Gradient.Data() : nullptr;
  const bool shadowed = this->Shown.Shadowed() && casting.lit;
  if (!this->Shown.Empty() && (this->Shown.Changed() || shadowed))
  {
    scene.overlay = this->Shown.Packed();
    scene.PlaceOverlay(this->Shown.Nodes(), this->Scene.nodes);
    scene.addedUnit = this->Shown.Majorant() / this->Majorant;
  }
  if (casting.skipEmpty)
  {
    scene.bricks = BrickDistances::Of(this->Scene.nodes, this->Distance.Data());
  }
  return scene;
}

template <class Device>
void RendererOnDevice<Device>::Cast(const Casting& casting, const View& view, Picture& picture)
{
  const std::size_t count = std::size_t(view.width) * std::size_t(view.height);
  const float* depth = nullptr;
  if (view.depth)
  {
    float* room = RoomFor(this->Depth, count, this->Home, "the depths of a picture");
    this->Home->Upload(room, view.depth, count * sizeof(float));
    depth = room;
  }
  std::uint32_t* pixels = RoomFor(this->Pixels, count, this->Home, "a picture");
  RaycastOnDevice(*this->Home, this->SceneOf(casting),
    RayMaker(this->Scene, casting.stepLength, view), view, casting.lightColor, depth, pixels);
  this->Home->Download(picture.rgba.data(), pixels, count * sizeof(std::uint32_t));
}

template <class Device>
double RendererOnDevice<Device>::LightTransmittanceAt(const Vec3& position)
{
  const CellGrid grid(this->Shown.Nodes());
  const CellPlace place(grid, float(position.x), float(position.y), float(position.z));
  FourPacked corners[8];
  for (int corner = 0; corner < 8; ++corner)
  {
    const Index node = place.cell + (corner & 1) + (corner >> 1 & 1) * grid.stride[1] +
      (corner >> 2) * grid.stride[2];
    this->Home->Download(&corners[corner], this->Shown.Packed() + 4 * node, sizeof(FourPacked));
  }
  const CellPlace among(
    CellGrid({ 2, 2, 2 }), place.fraction[0], place.fraction[1], place.fraction[2]);
  return among.Sample(CellGrid({ 2, 2, 2 }), corners)[2] / packedOne;
}

template <class Device>
std::unique_ptr<PictureEngine> PicturesOn(std::shared_ptr<Device> device)
{
  return std::make_unique<RendererOnDevice<Device>>(std::move(device));
}

template class RendererOnDevice<CompiledDevice>;
template std::unique_ptr<PictureEngine> PicturesOn(std::shared_ptr<CompiledDevice>);
}
