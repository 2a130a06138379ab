// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/CoarseProblem.h"

#include "backend/Backend.h"
#include "distributed/EvenSlabs.h"
#include "distributed/FieldResampling.h"
#include "distributed/Neighbourhood.h"
#include "distributed/OccupancyOnRanks.h"
#include "energy/NodeImportance.h"
#include "optimize/ExtinctionBounds.h"

namespace limpid
{
namespace
{
constexpr Index valuesPerTask = 65536;

/// Returns the source in index space of another grid over the same box.
RaySource Rescaled(const RaySource& source, const Grid& from, const Grid& to)
{
  RaySource other = source;
  const Vec3 scale = from.spacing / to.spacing;
  other.origin = source.origin * scale;
  other.direction = source.direction * scale;
  for (RaySource::Plane& plane : other.viewPlanes)
  {
    plane.normal = plane.normal / scale;
  }
  return other;
}
}

std::vector<float> MovedTo(
  const Problem& problem, const Grid& from, const float* field, const Grid& to)
{
  const std::shared_ptr<const Communicator>& ranks = problem.shared->ranks;
  return ResampledIn(ScenePiece::Slabs(ranks, from), from, field, to, EvenSlabs(*ranks, to.nodes));
}

CoarseProblem::CoarseProblem(const Problem& given, int factor)
  : Given(&given)
  , Coarse(given)
{
  Problem& problem = this->Coarse;
  problem.grid = CoarseGrid(given.grid, factor);
  problem.resident = nullptr; // the coarse fields cannot be cached with the scene
  this->Base = this->Restricted(given.baseExtinction, problem.grid);
  this->Importance = this->Restricted(given.importance, problem.grid);
  for (const Pull& pull : given.furtherPulls)
  {
    this->References.push_back(this->Restricted(pull.ReferenceOnHost(), problem.grid));
  }
  this->UseFields();
  for (TermSource& source : problem.sources)
  {
    source.rays = Rescaled(source.rays, given.grid, problem.grid);
  }
}

std::vector<float> CoarseProblem::ChangedOn(
  const Grid& finer, const std::vector<float>& found) const
{
  std::vector<float> change(found.size());
  const float* coarser = this->Coarse.baseExtinction + this->Coarse.OwnSlab().Begin();
  ParallelFor(static_cast<Index>(change.size()), valuesPerTask,
    [&](Index voxel) { change[std::size_t(voxel)] = found[std::size_t(voxel)] - coarser[voxel]; });
  std::vector<float> extinction = MovedTo(*this->Given, this->Coarse.grid, change.data(), finer);
  const bool full = finer.nodes == this->Given->grid.nodes;
  const std::vector<float> ownBase =
    full ? std::vector<float>() : this->Restricted(this->Given->baseExtinction, finer);
  const std::vector<float> ownImportance =
    full ? std::vector<float>() : this->Restricted(this->Given->importance, finer);
  const Index begin = this->Given->OwnSlab().Begin();
  const float* bases = full ? this->Given->baseExtinction + begin : ownBase.data();
  const float* importances = full ? this->Given->importance + begin : ownImportance.data();
  const ExtinctionBounds<float> bounds = BoundsOf(*this->Given);
  ParallelFor(static_cast<Index>(extinction.size()), valuesPerTask,
    [&](Index voxel)
    {
      float& value = extinction[std::size_t(voxel)];
      const float base = bases[voxel];
      value = bounds.Within(base + value, importances[voxel], base);
    });
  return extinction;
}

/// Resamples a field of the given problem to another grid.
std::vector<float> CoarseProblem::Restricted(const float* field, const Grid& to) const
{
  return MovedTo(*this->Given, this->Given->grid, field + this->Given->OwnSlab().Begin(), to);
}

/// Distributes the fields, of which each rank has a slab.
void CoarseProblem::UseFields()
{
  Problem& problem = this->Coarse;
  const ScenePiece slabs = ScenePiece::Slabs(problem.shared->ranks, problem.grid);
  const Neighbourhood around(slabs, problem.grid);
  const FieldInBox bases = around.Extended(this->Base.data());
  const FieldInBox importances = around.Extended(this->Importance.data());
  NodeValues means(around.Around().NodeCount());
  FillNodeImportanceOfFilled(
    around.Around(), bases.Data(), importances.Data(), means.Data(), [](int, const Range<int>&) {});
  this->NodeImportance = around.Inside(std::move(means));
  const auto fieldOf = [&](float* values) { return DistributedField(values, slabs, problem.grid); };
  const auto fields = std::make_shared<DistributedFields>();
  fields->ranks = slabs.ranks;
  fields->pieces = RegionsOf(slabs.boxes);
  fields->inSlabs = true;
  fields->places = problem.shared->places;
  fields->base = fieldOf(this->Base.data());
  fields->importance = fieldOf(this->Importance.data());
  fields->nodeImportance = fieldOf(this->NodeImportance.Data());
  for (std::vector<float>& reference : this->References)
  {
    fields->references.push_back(fieldOf(reference.data()));
  }
  problem.occupancy =
    std::make_shared<const Occupancy>(OccupancyOnRanks(*slabs.ranks, problem.grid, slabs.nodes,
      fields->base.Piece(), fields->nodeImportance.Piece(), problem.settings.skipUnneeded));
  problem.Use(fields);
}
}
