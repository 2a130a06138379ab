// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/CoarseProblem.h"

#include "backend/Backend.h"
#include "distributed/DistributedFields.h"
#include "distributed/OccupancyOnRanks.h"
#include "energy/NodeImportance.h"
#include "optimize/ExtinctionBounds.h"
#include "optimize/Levels.h"
#include "optimize/Neighbourhood.h"

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
  if (!problem.shared)
  {
    return Resampled(from, field, to);
  }
  const Communicator& ranks = *problem.shared->ranks;
  return ResampledBox(ranks, from,
    FieldView::Part(const_cast<float*>(field), OwnSlab(ranks, from.nodes).Box()),
    EvenSlabs(ranks, from.nodes), to, EvenSlabs(ranks, to.nodes));
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
    this->References.push_back(this->Restricted(pull.reference, problem.grid));
  }
  given.shared ? this->ShareFields() : this->UseFields();
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
      const float importance = importances[voxel];
      const bool empty = !(base > 0) && !(importance > 0);
      value = empty ? 0.0f : bounds.Clamp(base + value, importance, base);
    });
  return extinction;
}

/// Resamples a field of the given problem to another grid.
std::vector<float> CoarseProblem::Restricted(const float* field, const Grid& to) const
{
  return MovedTo(*this->Given, this->Given->grid, field + this->Given->OwnSlab().Begin(), to);
}

void CoarseProblem::UseFields()
{
  Problem& problem = this->Coarse;
  this->NodeImportance =
    NodeImportanceOfFilled(problem.grid, this->Base.data(), this->Importance.data());
  problem.baseExtinction = this->Base.data();
  problem.importance = this->Importance.data();
  problem.nodeImportance = this->NodeImportance.data();
  for (std::size_t i = 0; i < this->References.size(); ++i)
  {
    problem.furtherPulls[i].reference = this->References[i].data();
  }
  problem.occupancy = std::make_shared<const Occupancy>(
    problem.grid, problem.baseExtinction, problem.nodeImportance, problem.settings.skipUnneeded);
}

/// UseFields for a distributed problem, where each rank has a slab of the fields.
void CoarseProblem::ShareFields()
{
  Problem& problem = this->Coarse;
  const std::shared_ptr<const Communicator> ranks = problem.shared->ranks;
  const std::vector<NodeBox> slabs = EvenSlabs(*ranks, problem.grid.nodes);
  const NodeBox own = slabs[std::size_t(ranks->Rank())];
  const Neighbourhood around(*ranks, problem.grid, slabs, slabs);
  const NodeValues bases = around.Extended(this->Base.data());
  const NodeValues importances = around.Extended(this->Importance.data());
  const NodeValues nodeImportance =
    around.Inside(NodeImportanceOfFilled(around.Around(), bases.Data(), importances.Data()).data());
  this->NodeImportance.assign(nodeImportance.Data(), nodeImportance.Data() + own.Count());
  const auto fieldOf = [&](std::vector<float>& values)
  {
    return DistributedFields::Field{ FieldView::Part(values.data(), own),
      NodeValues(problem.grid.NodeCount()) };
  };
  const auto fields = std::make_shared<DistributedFields>();
  fields->ranks = ranks;
  fields->pieces = RegionsOf(slabs);
  fields->inSlabs = true;
  fields->places = problem.shared->places;
  fields->base = fieldOf(this->Base);
  fields->importance = fieldOf(this->Importance);
  fields->nodeImportance = fieldOf(this->NodeImportance);
  for (std::vector<float>& reference : this->References)
  {
    fields->references.push_back(fieldOf(reference));
  }
  problem.Use(fields);
  problem.occupancy = std::make_shared<const Occupancy>(OccupancyOnRanks(*ranks, problem.grid, own,
    fields->base.piece, fields->nodeImportance.piece, problem.settings.skipUnneeded));
}
}
