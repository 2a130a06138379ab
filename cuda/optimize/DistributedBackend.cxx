// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/DistributedBackend.h"

#include "backend/LargePages.h"
#include "distributed/EvenSlabs.h"
#include "distributed/ExchangePlan.h"
#include "distributed/OccupancyOnRanks.h"
#include "energy/TransmittanceOnRanks.h"
#include "energy/VisibilityTerm.h"
#include "optimize/Permuted.h"
#include "optimize/PreparedScene.h"
#include "optimize/RestoringMinimizer.h"

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

/// View of a field in this rank's subdomain, with permuted axes.
FieldView PieceOf(const ScenePiece& piece, const AxisPermutation& order, const float* field)
{
  return InOrder(FieldView::Part(const_cast<float*>(field), piece.nodes), order);
}

std::shared_ptr<const Occupancy> FindOccupancy(const ScenePiece& piece, const Grid& grid,
  const AxisPermutation& order, const FieldView& extinction, const FieldView& importance, bool skip)
{
  const NodeBox box = InOrder(piece.Owned(), order);
  return std::make_shared<const Occupancy>(
    OccupancyOnRanks(*piece.ranks, order.Of(grid), box, extinction, importance, skip));
}

/// Returns the permuted problem with distributed fields. `warm`: whether iterations start from a
/// given extinction.
Problem Shared(
  const ScenePiece& piece, const Problem& problem, const AxisPermutation& order, bool warm)
{
  const auto fields = std::make_shared<DistributedFields>();
  fields->ranks = piece.ranks;
  fields->pieces = RegionsOf(InOrder(piece.owned, order));
  fields->wanted = RegionsOf(InOrder(piece.boxes, order));
  fields->places = piece.places;
  const Settings& settings = problem.settings;
  fields->inSlabs = warm || !problem.furtherPulls.empty() || problem.IsThick() ||
    settings.solver == SolverKind::Adam || settings.smoothness > 0;
  const auto fieldOf = [&](const float* values)
  { return DistributedField(PieceOf(piece, order, values), problem.grid); };
  fields->base = fieldOf(problem.baseExtinction);
  fields->importance = fieldOf(problem.importance);
  fields->nodeImportance = fieldOf(problem.nodeImportance);
  for (const Pull& pull : problem.furtherPulls)
  {
    fields->references.push_back(fieldOf(pull.reference));
  }

  Problem shared = Reordered(problem, order);
  shared.Use(fields);
  shared.occupancy = FindOccupancy(piece, problem.grid, order, fields->base.Piece(),
    fields->nodeImportance.Piece(), problem.settings.skipUnneeded);
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
  // Numbers are equal if their minimum equals their maximum: minima of each word w and of -1 - w.
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

class DistributedMinimizer : public RestoringMinimizer
{
public:
  DistributedMinimizer(const ScenePiece& piece, const Problem& problem, bool warm)
    : Piece(&piece)
    , Given(&problem)
    , Order(OrderFor(problem))
    , Inside(Shared(piece, problem, this->Order, warm))
  {
  }

  const Problem& ProblemInside() const { return this->Inside; }

  /// `start`: in this rank's subdomain.
  StartingExtinction InSlab(const StartingExtinction& start) const
  {
    if (!start)
    {
      return {};
    }
    const DistributedFields& fields = *this->Inside.shared;
    const Slab own = this->Inside.OwnSlab();
    std::vector<float> values(std::size_t(own.Count()));
    Spread(*fields.ranks, PieceOf(*this->Piece, this->Order, start->data()), fields.pieces,
      FieldView::Part(values.data(), own.Box()),
      RegionsOf(EvenSlabs(*fields.ranks, this->Inside.grid.nodes)));
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
    // Voxels that no sweep reaches keep the base extinction.
    const float* base = this->Given->baseExtinction;
    best.assign(base, base + this->Piece->nodes.Count());
    inner.BestToPiece(PieceOf(*this->Piece, this->Order, best.data()));
  }

  const ScenePiece* Piece;
  const Problem* Given;
  AxisPermutation Order;
  Problem Inside; ///< the permuted problem
};

class SweepsOnRanks : public SourceSweeps
{
public:
  SweepsOnRanks(const ScenePiece& piece, const Problem& problem, const RaySource& source)
    : Ranks(piece.ranks.get())
    , Given(&problem)
    , Occupied(FindOccupancy(piece, problem.grid, AxisPermutation(),
        PieceOf(piece, AxisPermutation(), problem.baseExtinction),
        PieceOf(piece, AxisPermutation(), problem.nodeImportance), problem.settings.skipUnneeded))
    , Term(HostDevice::Shared(), problem.grid, *this->Occupied, source, problem.settings.rayDensity,
        problem.fine)
  {
    SweepSubdomains(this->Term.Frusta(), piece, this->Occupied.get());
  }

  Score ScoreOf(const ExtinctionInPlace& extinction) override
  {
    const SmallPages small;
    const float* base = There(this->Given->baseExtinction);
    if (!this->Base)
    {
      this->Base = this->See(base, nullptr).all;
    }
    // A rank with an empty subdomain cannot tell whether this is the base extinction.
    if (!this->Ranks->AnyOf(extinction.values != this->Given->baseExtinction))
    {
      return ScoreOfBase(*this->Base);
    }
    return limpid::ScoreOf(this->See(There(extinction.values), base), this->Base->unattenuated);
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
    throw JointError(
      "A preview was requested in a distributed run (this is not supported). Use Solver.");
  }

private:
  /// `base`: null if kept base extinction is not counted.
  Seen See(const float* extinction, const float* base)
  {
    Seen seen;
    this->Term.Forward({ extinction, There(this->Given->importance), nullptr, base }, &seen);
    return seen;
  }

  const Communicator* Ranks;
  const Problem* Given;
  std::shared_ptr<const Occupancy> Occupied;
  VisibilityTerm<HostDevice> Term;
  std::optional<Visible> Base; ///< empty before the first sweep
};

class DistributedBackend : public SolverBackend
{
public:
  DistributedBackend(
    std::shared_ptr<const ScenePiece> piece, std::unique_ptr<SolverBackend> processor)
    : Piece(std::move(piece))
    , Processor(std::move(processor))
  {
  }

  std::string Describe(const std::string& processor) const override
  {
    return NameOnRanks(processor, *this->Piece->ranks);
  }

  std::unique_ptr<Minimizer> MakeMinimizer(
    const Problem& problem, StartingExtinction&& start, bool warm) override
  {
    const SmallPages small;
    auto minimizer =
      std::make_unique<DistributedMinimizer>(*this->Piece, problem, start.has_value());
    minimizer->Use(this->Processor->MakeMinimizer(
      minimizer->ProblemInside(), minimizer->InSlab(std::exchange(start, {})), warm));
    return minimizer;
  }

  std::unique_ptr<SourceSweeps> SweepsFrom(const Problem& problem, const RaySource& source) override
  {
    const SmallPages small;
    return std::make_unique<SweepsOnRanks>(*this->Piece, problem, source);
  }

  void FindByMethod(const Problem&, std::vector<float>&) override
  {
    throw JointError(
      "A method without iterations was requested in a distributed run (this is not supported). Use "
      "the method Optimized.");
  }

  void FindTransmittance(const Problem& problem, const RaySource& source, double rayDensity,
    const float* extinction, float* transmittance) override
  {
    FindTransmittanceOnRanks(
      problem.grid, *this->Piece, source, rayDensity, extinction, transmittance);
    if (problem.IsThick())
    {
      RefineTransmittanceOnRanks(problem.grid, *this->Piece, source, extinction, transmittance);
    }
  }

private:
  std::shared_ptr<const ScenePiece> Piece;
  std::unique_ptr<SolverBackend> Processor;
};
}

std::string NotOnRanks(const Settings& settings)
{
  if (settings.method != Method::Optimized)
  {
    return std::string("the method ") + InfoOf(settings.method).name;
  }
  return {};
}

Settings AdaptedTo(const PreparedScene& scene, Settings settings)
{
  if (scene.Piece().IsWhole())
  {
    return settings;
  }
  const std::string left = NotOnRanks(settings);
  LIMPID_REQUIRE(left.empty(),
    "Ranks share the scene, and " << left
                                  << " is set (this is not supported in distributed runs). Turn it "
                                     "off, or give one rank the whole scene.");
  LIMPID_REQUIRE(settings.backend != BackendKind::Cuda,
    "Ranks share the scene, and the backend is CUDA (distributed runs are supported on CPUs only). "
    "Use the backend Auto or CPU.");
  settings.backend = BackendKind::Cpu;
  return settings;
}

void RequireAlike(const PreparedScene& scene, const Camera& camera, const Light& light,
  const Settings& settings, double nearness)
{
  const Grid& grid = scene.Nodes();
  const Communicator& ranks = *scene.Piece().ranks;
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
  Settings compared = settings;
  compared.backend = BackendKind::Cpu; // of ranks, whatever each of them says
  const std::vector<double> values = NumbersOf(compared);
  numbers.insert(numbers.end(), values.begin(), values.end());
  numbers.push_back(nearness);
  if (!AreAlike(ranks, { double(numbers.size()) }) || !AreAlike(ranks, numbers))
  {
    throw JointError(
      "The ranks differ in the camera, the light, the settings or the position of the image "
      "(distributed runs need these to be equal). Give all ranks the same.");
  }
}

std::unique_ptr<SolverBackend> BackendFor(
  const PreparedScene& scene, std::unique_ptr<SolverBackend> here)
{
  return scene.Piece().IsWhole()
    ? std::move(here)
    : std::make_unique<DistributedBackend>(scene.Arrays().piece, std::move(here));
}
}
