// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Problem.h"

#include "backend/Backend.h"
#include "distributed/EvenSlabs.h"
#include "distributed/ExchangePlan.h"
#include "optimize/Differences.h"
#include "optimize/ExtinctionBounds.h"
#include "sweep/ResolvedLayer.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
std::vector<TermSource> SourcesOf(
  const Camera& camera, const Light& light, const Settings& settings, const Grid& grid)
{
  std::vector<TermSource> sources{ { SourceKind::Camera,
    SourceOfCamera(camera, grid, settings.restrictToView) } };
  for (const Camera& other : settings.otherCameras)
  {
    sources.push_back({ SourceKind::Camera, SourceOfCamera(other, grid, settings.restrictToView) });
  }
  sources.push_back({ SourceKind::Light, SourceOfLight(light, grid) });
  return sources;
}

void Problem::Use(const std::shared_ptr<const DistributedFields>& fields)
{
  this->baseExtinction = fields->base.Values();
  this->importance = fields->importance.Values();
  this->nodeImportance = fields->nodeImportance.Values();
  for (std::size_t i = 0; i < this->furtherPulls.size(); ++i)
  {
    this->furtherPulls[i].reference = fields->references[i].Values();
    this->furtherPulls[i].onDevice = nullptr;
  }
  this->shared = fields;
}

Slab Problem::OwnSlab() const
{
  return limpid::OwnSlab(*this->shared->ranks, this->grid.nodes);
}

void Problem::SumOverAll(ExactSum* sums, std::size_t count) const
{
  this->shared->ranks->Sum(sums, count);
}

double Problem::SumOverRows(const std::function<double(int y, int z)>& ofRow) const
{
  const Slab slab = this->OwnSlab();
  std::vector<ExactSum> slices(std::size_t(slab.slices.Length()));
  ParallelFor(slab.slices.Length(),
    [&](Index slice)
    {
      for (int y = 0; y < slab.nodes.y; ++y)
      {
        slices[std::size_t(slice)].Add(ofRow(y, slab.slices.begin + static_cast<int>(slice)));
      }
    });
  ExactSum sum;
  for (const ExactSum& slice : slices)
  {
    sum += slice;
  }
  this->SumOverAll(&sum, 1);
  return sum.Value();
}

void Problem::SlabToPiece(const float* values, const FieldView& piece) const
{
  const Slab own = this->OwnSlab();
  const Communicator& ranks = *this->shared->ranks;
  Spread(ranks, FieldView::Part(const_cast<float*>(values), own.Box()),
    RegionsOf(EvenSlabs(ranks, own.nodes)), piece, this->shared->wanted, this->occupancy.get());
}

double Problem::SquaresFrom(const float* other, const float* extinction) const
{
  // Empty voxels equal the base: the starting extinction of Solver is 0 there, too.
  const Int3& nodes = this->grid.nodes;
  return this->SumOverRows(
    [&](int y, int z)
    {
      const Range<int> filled = this->occupancy->Row(0, y, z).filled;
      const Index first = (Index(z) * nodes.y + y) * nodes.x + filled.begin;
      return SumOfSquares(extinction + first, other + first, std::max(filled.Length(), 0));
    });
}

double Problem::WeightOf(const TermSource& source) const
{
  const Weights& weights = this->settings.weights;
  return source.kind == SourceKind::Camera ? weights.view / this->NumberOfCameras() : weights.light;
}

double Problem::NormalisedRegularization() const
{
  const Weights& weights = this->settings.weights;
  const double depth = this->grid.Radius() * double(this->majorant);
  if (!(this->settings.clearingThreshold > 0 && depth > 0))
  {
    return weights.regularization;
  }
  // A voxel is cleared where q T (V - g) > p R mu-bar.
  const double atStake = weights.view > 0 ? weights.view : weights.light;
  return this->settings.clearingThreshold * atStake / depth;
}

double Problem::WeightOfRange(double share) const
{
  const Weights& weights = this->settings.weights;
  return this->majorant > 0 ? share * (weights.view + weights.light) / double(this->majorant) : 0.0;
}

bool Problem::IsSmall() const
{
  constexpr Index small = Index(44) * 44 * 44;
  return this->grid.NodeCount() < small;
}

bool Problem::MayHaveThickLayers() const
{
  return this->majorant * glm::length(this->grid.spacing) > UsualCuts::thick;
}

bool Problem::MayHaveThickLayers(const RaySource& source) const
{
  return this->majorant * LongestLayer(source, this->grid) > UsualCuts::thick;
}

double Problem::NodeDistance() const
{
  return std::cbrt(this->grid.CellVolume());
}

double Problem::MostNodeDepth() const
{
  return double(this->majorant) * this->NodeDistance();
}

bool Problem::IsThick() const
{
  constexpr double thin = 0.5;
  return this->MostNodeDepth() > thin;
}

double Problem::SmoothingStrength() const
{
  return this->WeightOfRange(this->settings.smoothness);
}

std::vector<Pull> Problem::Pulls() const
{
  std::vector<Pull> all{ { this->baseExtinction, this->RegularizationWeight(),
    [](Energy& energy) -> double& { return energy.regularization; } } };
  all.insert(all.end(), this->furtherPulls.begin(), this->furtherPulls.end());
  return all;
}

void Problem::DrawTo(const std::vector<PullWithReferences>& pulls, bool forTheLight, bool onDevice)
{
  this->furtherPulls.clear();
  for (const PullWithReferences& pull : pulls)
  {
    this->furtherPulls.push_back(pull.Of(forTheLight, this->WeightOfRange(pull.share), onDevice));
  }
}

double Problem::EnergyOf(const Pull& pull, double squares) const
{
  return 0.5 * pull.weight * this->grid.CellVolume() * squares;
}

void Problem::TakeIntoBounds(std::vector<float>& extinction) const
{
  const ExtinctionBounds<float> bounds = BoundsOf(*this);
  ParallelFor(static_cast<Index>(extinction.size()), 65536,
    [&](Index voxel)
    {
      float& value = extinction[std::size_t(voxel)];
      value = bounds.Within(value, this->importance[voxel], this->baseExtinction[voxel]);
    });
}

double Problem::MeanChange(double changes) const
{
  const auto filled = double(this->occupancy->FilledVoxels());
  return filled > 0 && this->majorant > 0 ? changes / filled / this->majorant : 0.0;
}
}
