// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Ranked.h"

#include "backend/LargePages.h"
#include "energy/TransmittanceSweep.h"
#include "energy/VisibilityTerm.h"
#include "optimize/FieldsOfRanks.h"
#include "optimize/Permuted.h"
#include "optimize/RestoringMinimizer.h"
#include "optimize/SolverBackend.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <optional>
#include <utility>

namespace limpid
{
namespace
{
NodeBox InOrder(const NodeBox& box, const AxisPermutation& order)
{
  NodeBox permuted;
  for (int axis = 0; axis < 3; ++axis)
  {
    permuted.along[std::size_t(axis)] = box.along[std::size_t(order.axes[axis])];
  }
  return permuted;
}

FieldView InOrder(const FieldView& view, const AxisPermutation& order)
{
  FieldView permuted{ view.values, {} };
  for (int axis = 0; axis < 3; ++axis)
  {
    permuted.stride[std::size_t(axis)] = view.stride[std::size_t(order.axes[axis])];
  }
  return permuted;
}

std::vector<NodeBox> InOrder(std::vector<NodeBox> boxes, const AxisPermutation& order)
{
  for (NodeBox& box : boxes)
  {
    box = InOrder(box, order);
  }
  return boxes;
}

/// A field of this rank's piece, in another order.
FieldView PieceOf(const Problem& problem, const AxisPermutation& order, const float* field)
{
  return InOrder(FieldView::Part(const_cast<float*>(field), problem.piece->nodes), order);
}

std::shared_ptr<const Occupancy> FindOccupancy(const ScenePiece& piece, const Grid& grid,
  const AxisPermutation& order, const FieldView& extinction, const FieldView& importance, bool skip)
{
  const NodeBox box = InOrder(piece.owned[std::size_t(piece.ranks->Rank())], order);
  return std::make_shared<const Occupancy>(
    OccupancyOnRanks(*piece.ranks, order.Of(grid), box, extinction, importance, skip));
}

/// The problem in another order, with room for the fields that ranks share. `warm`: whether
/// iterations start from an extinction of their own.
Problem Shared(const Problem& problem, const AxisPermutation& order, bool warm)
{
  const ScenePiece& piece = *problem.piece;
  const auto fields = std::make_shared<FieldsOfRanks>();
  fields->ranks = piece.ranks;
  fields->pieces = RegionsOf(InOrder(piece.owned, order));
  fields->wanted = RegionsOf(InOrder(piece.boxes, order));
  fields->places = piece.places;
  const Settings& settings = problem.settings;
  const bool staysNear = piece.ranks->AnyOf(problem.previous != nullptr); // a piece may be empty
  fields->inSlabs = warm || staysNear || problem.IsThick() || settings.solver == SolverKind::Adam ||
    settings.smoothness > 0;
  const auto fieldOf = [&](const float* values)
  {
    return FieldsOfRanks::Field{ PieceOf(problem, order, values),
      NodeValues(problem.grid.NodeCount()) };
  };
  fields->base = fieldOf(problem.baseExtinction);
  fields->importance = fieldOf(problem.importance);
  fields->nodeImportance = fieldOf(problem.nodeImportance);

  if (staysNear)
  {
    fields->previous = fieldOf(problem.previous);
  }

  Problem shared = Reordered(problem, order);
  shared.Use(fields);
  shared.occupancy = FindOccupancy(piece, problem.grid, order, fields->base.piece,
    fields->nodeImportance.piece, problem.settings.skipUnneeded);
  shared.piece = nullptr;
  return shared;
}

void Add(const Vec3& vector, std::vector<double>& numbers)
{
  numbers.insert(numbers.end(), { vector.x, vector.y, vector.z });
}

void Add(const Camera& camera, std::vector<double>& numbers)
{
  for (const Vec3& vector : { camera.position, camera.focalPoint, camera.viewUp })
  {
    Add(vector, numbers);
  }
  numbers.insert(numbers.end(),
    { camera.viewAngle, double(camera.parallel), camera.parallelScale, camera.aspect,
      double(camera.corners.size()) });
}

/// Whether all ranks have the same numbers.
bool AreAlike(const Communicator& ranks, const std::vector<double>& numbers)
{
  // The least of all is the largest where all are the same: of each, and of what it lacks of -1.
  std::vector<std::int32_t> words(2 * numbers.size());
  std::memcpy(words.data(), numbers.data(), words.size() * sizeof(std::int32_t));
  std::vector<std::int32_t> both = words;
  std::transform(words.begin(), words.end(), std::back_inserter(both),
    [](std::int32_t word) { return -1 - word; });
  ranks.TakeLeast(both.data(), both.size());
  bool alike = true;
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    alike = alike && both[i] == -1 - both[words.size() + i];
  }
  return alike;
}

class RankedMinimizer : public RestoringMinimizer
{
public:
  RankedMinimizer(const Problem& problem, const AxisPermutation& order, bool warm)
    : Given(&problem)
    , Order(order)
    , Inside(Shared(problem, order, warm))
  {
  }

  const Problem& ProblemInside() const { return this->Inside; }

  /// `start`: of this rank's piece.
  StartingExtinction InSlab(const StartingExtinction& start) const
  {
    if (!start)
    {
      return {};
    }
    const FieldsOfRanks& fields = *this->Inside.shared;
    const Slab own = this->Inside.OwnSlab();
    std::vector<float> values(std::size_t(own.Count()));
    Spread(*fields.ranks, PieceOf(*this->Given, this->Order, start->data()), fields.pieces,
      FieldView::Part(values.data(), own.Box()),
      RegionsOf(SlabsOf(*fields.ranks, this->Inside.grid.nodes)));
    return values;
  }

  IterationRecord Start() override
  {
    const SmallPages small;
    return RestoringMinimizer::Start();
  }

  IterationRecord Iterate() override
  {
    const SmallPages small;
    return RestoringMinimizer::Iterate();
  }

  IterationRecord Smooth() override
  {
    const SmallPages small;
    return RestoringMinimizer::Smooth();
  }

private:
  void Restore(const Minimizer& inner, std::vector<float>& best) const override
  {
    // What no sweep comes to stays as it is.
    const float* base = this->Given->baseExtinction;
    best.assign(base, base + this->Given->piece->nodes.Count());
    inner.BestToPiece(PieceOf(*this->Given, this->Order, best.data()));
  }

  const Problem* Given;
  AxisPermutation Order;
  Problem Inside; ///< the problem in that order
};

/// Makes sweeps visit fields of ranks' pieces. `filled`: see SlabDelivery.
void VisitPieces(
  std::vector<FrustumRays<HostDevice>>& frusta, const ScenePiece& piece, const Occupancy* filled)
{
  const HomeOfFields home(piece.nodes, RegionsOf(piece.owned), RegionsOf(piece.boxes));
  const auto room = std::make_shared<PassageRoom>();
  for (FrustumRays<HostDevice>& rays : frusta)
  {
    rays.SweepFieldsOf(home, filled, room);
  }
}

class SweepsOnRanks : public SourceSweeps
{
public:
  SweepsOnRanks(const Problem& problem, const RaySource& source)
    : Given(&problem)
    , Occupied(FindOccupancy(*problem.piece, problem.grid, AxisPermutation(),
        PieceOf(problem, AxisPermutation(), problem.baseExtinction),
        PieceOf(problem, AxisPermutation(), problem.nodeImportance), problem.settings.skipUnneeded))
    , Term(HostDevice::Shared(), problem.grid, *this->Occupied, source, problem.settings.rayDensity,
        problem.piece->ranks.get(), problem.fine)
  {
    VisitPieces(this->Term.Frusta(), *problem.piece, this->Occupied.get());
  }

  Score ScoreOf(const float* extinction) override
  {
    const SmallPages small;
    const float* base = There(this->Given->baseExtinction);
    if (!this->Base)
    {
      this->Base = this->See(base, nullptr).all;
    }
    // A rank without a piece cannot tell.
    if (!this->Given->piece->ranks->AnyOf(extinction != this->Given->baseExtinction))
    {
      return ScoreOfBase(*this->Base);
    }
    return limpid::ScoreOf(this->See(There(extinction), base), this->Base->unattenuated);
  }

  Ceiling CeilingOf(const float* least, const MostExtinction<float>& most) override
  {
    const SmallPages small;
    const CeilingFields fields{ There(this->Given->baseExtinction), There(this->Given->importance),
      least ? There(least) : nullptr, most };
    Seen seen;
    this->Term.FindCeiling(fields, &seen);
    return limpid::CeilingOf(seen, fields.CountsKept());
  }

  void SweepPolicyOnce(double, std::vector<float>&) override
  {
    throw JointError("A preview was asked for where ranks share the scene (they cannot make one "
                     "together yet). Use Solver.");
  }

private:
  /// `base`: null: what is kept is not counted.
  Seen See(const float* extinction, const float* base)
  {
    Seen seen;
    this->Term.Forward({ extinction, There(this->Given->importance), nullptr, base }, &seen);
    return seen;
  }

  const Problem* Given;
  std::shared_ptr<const Occupancy> Occupied;
  VisibilityTerm<HostDevice> Term;
  std::optional<Visible> Base; ///< not seen yet
};
}

void RequireAlike(const Communicator& ranks, const Grid& grid, const Camera& camera,
  const Light& light, const Settings& settings, double nearness)
{
  std::vector<double> numbers;
  for (int axis = 0; axis < 3; ++axis)
  {
    numbers.insert(
      numbers.end(), { double(grid.nodes[axis]), grid.origin[axis], grid.spacing[axis] });
    Add(grid.direction[axis], numbers);
  }
  Add(camera, numbers);
  for (const Camera& other : settings.otherCameras)
  {
    Add(other, numbers);
  }
  numbers.push_back(double(light.type));
  Add(light.position, numbers);
  Add(light.focalPoint, numbers);
  const Weights& weights = settings.weights;
  numbers.insert(numbers.end(),
    { weights.regularization, weights.view, weights.light, double(settings.mode),
      double(settings.maximumIterations), settings.tolerance, settings.maximumSeconds,
      double(settings.derivative), settings.rayDensity, double(settings.skipUnneeded),
      double(settings.restrictToView), settings.protectImportance, settings.emphasis,
      settings.clearingThreshold, double(settings.importanceSmoothing), double(settings.method),
      double(settings.solver), settings.learningRate, settings.smoothness,
      settings.temporalCoherence, double(settings.scoreIterations), nearness });
  numbers.insert(
    numbers.end(), settings.iterationsPerLevel.begin(), settings.iterationsPerLevel.end());
  if (!AreAlike(ranks, { double(numbers.size()) }) || !AreAlike(ranks, numbers))
  {
    throw JointError(
      "The ranks differ in the camera, the light, the settings or where the image is "
      "(what they say to each other follows from these). Give all of them the same.");
  }
}

std::unique_ptr<SourceSweeps> SweepsFromOnRanks(const Problem& problem, const RaySource& source)
{
  const SmallPages small;
  return std::make_unique<SweepsOnRanks>(problem, source);
}

void FindTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  double rayDensity, const float* extinction, float* transmittance)
{
  const SmallPages small;
  const FieldView given = FieldView::Part(const_cast<float*>(extinction), piece.nodes);
  const auto occupancy = FindOccupancy(piece, grid, AxisPermutation(), given, given, /*skip=*/true);
  TransmittanceSweep<HostDevice> sweep(
    HostDevice::Shared(), grid, *occupancy, source, rayDensity, piece.ranks.get());
  VisitPieces(sweep.Frusta(), piece, nullptr);
  std::fill(transmittance, transmittance + piece.nodes.Count(), 1.0f); // where no ray comes
  sweep.Sweep(There(extinction), There(transmittance));
}

std::unique_ptr<Minimizer> MakeRanked(const Problem& problem, const StartingExtinction& start,
  const std::function<std::unique_ptr<Minimizer>(const Problem&, StartingExtinction&&)>& make)
{
  const SmallPages small;
  auto minimizer = std::make_unique<RankedMinimizer>(problem, OrderFor(problem), start.has_value());
  minimizer->Use(make(minimizer->ProblemInside(), minimizer->InSlab(start)));
  return minimizer;
}
}
