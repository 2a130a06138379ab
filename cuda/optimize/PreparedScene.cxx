// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/PreparedScene.h"

#include "backend/Backend.h"
#include "distributed/Neighbourhood.h"
#include "energy/Despeckle.h"
#include "energy/SceneSurvey.h"
#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace limpid
{
namespace
{
void RequireFields(const SceneFields& scene)
{
  scene.grid.Require();
  LIMPID_REQUIRE(scene.baseExtinction != nullptr || scene.ValueCount() == 0,
    "There is no base extinction (the optimisation starts from it). Give an array.");
  LIMPID_REQUIRE(scene.importance != nullptr || scene.ValueCount() == 0,
    "There is no importance (it defines which structures to reveal). Give an array.");
  LIMPID_REQUIRE(scene.majorant >= 0 && scene.majorant <= mostExtinction,
    "The majorant is " << scene.majorant
                       << " (Eq. (25) needs an upper bound of the extinction). Give the largest "
                          "extinction of the transfer function, or 0 for that of the scene.");
}

/// Returns the index in the grid of a node, from its index in the arrays.
Index NumberOf(const SceneFields& scene, Index value)
{
  const NodeBox& box = scene.piece->nodes;
  const Int3 size = box.Size();
  const Index i = box.along[0].begin + value % size.x;
  const Index j = box.along[1].begin + value / size.x % size.y;
  const Index k = box.along[2].begin + value / size.x / size.y;
  return (k * scene.grid.nodes.y + j) * scene.grid.nodes.x + i;
}

/// Surveys this process's subdomain. The occupancy is that of the scene if there are no others.
SceneSurvey Survey(const SceneFields& scene, float mostExtinction, const float* importance)
{
  const Neighbourhood around(*scene.piece, scene.grid);
  const FieldInBox extinctions = around.Extended(scene.baseExtinction);
  const FieldInBox importances = around.Extended(importance);
  SceneSurvey found;
  if (!around.Empty())
  {
    found = SurveyScene(around.Around(), extinctions.Data(), mostExtinction, importances.Data(), 1);
    found.nodeImportance = around.Inside(std::move(found.nodeImportance));
  }
  return found;
}

std::shared_ptr<const NodeValues> Shared(NodeValues&& values)
{
  return std::make_shared<const NodeValues>(std::move(values));
}

/// Returns the despeckled importance, see Despeckle.
NodeValues DespeckledImportance(const SceneFields& scene)
{
  const Neighbourhood around(*scene.piece, scene.grid);
  const FieldInBox extinctions = around.Extended(scene.baseExtinction);
  const FieldInBox importances = around.Extended(scene.importance);
  NodeValues values(around.Around().NodeCount());
  if (!around.Empty())
  {
    limpid::Despeckle(around.Around(), extinctions.Data(), importances.Data(), values.Data());
  }
  return around.Inside(std::move(values));
}

/// A field with its name and valid range, for checks.
struct CheckedField
{
  const float* values;
  float most;
  const char* name;
  const char* range;
};

void RequireRange(const SceneFields& scene, const CheckedField& field, const FieldRange& found)
{
  const Index count = scene.ValueCount();
  Index voxel = found.valid ? count : 0;
  while (voxel < count && field.values[voxel] >= 0 && field.values[voxel] <= field.most)
  {
    ++voxel;
  }
  LIMPID_REQUIRE(voxel == count,
    "The " << field.name << " of voxel " << NumberOf(scene, voxel) << " is " << field.values[voxel]
           << " (the energy of Eq. (21) is not defined for it). Keep it " << field.range << '.');
}

/// Checks the references that are given, which all ranks with nodes must have.
void RequireReferences(const SceneFields& scene)
{
  const Communicator& ranks = *scene.piece->ranks;
  for (const float* values : scene.references)
  {
    const bool isGiven = ranks.AnyOf(values != nullptr);
    RequireOnAllRanks(ranks,
      [&]
      {
        LIMPID_REQUIRE(values || !isGiven || scene.ValueCount() == 0,
          "A reference extinction is given on some ranks only (a pull needs it everywhere). Give "
          "it on all of them.");
        RequireRange(scene,
          { values, mostExtinction, "reference extinction", "finite and not negative" },
          { 0, values == nullptr });
      });
  }
}

/// Returns a reference that the caller gave. Throws if there is none.
std::optional<CarriedExtinction> ReferenceOf(const SceneFields& scene, GivenReference which)
{
  const float* values = scene.references[static_cast<std::size_t>(which)];
  LIMPID_REQUIRE(scene.piece->ranks->AnyOf(values != nullptr), // an empty subdomain has none
    "A pull towards a reference has a weight, and there is no reference (there is nothing to stay "
    "near). Give an extinction as the reference, or set the weight to 0.");
  CarriedExtinction given;
  given.extinction.assign(values, values + scene.ValueCount());
  return given;
}

void RequireDistances(const std::vector<TermSource>& sources, const Grid& grid)
{
  for (const TermSource& source : sources)
  {
    const double distance = glm::length(source.rays.origin - 0.5 * Vec3(grid.nodes - 1));
    LIMPID_REQUIRE(source.rays.parallel || distance < 1e12 * glm::length(Vec3(grid.nodes)),
      "The " << (source.kind == SourceKind::Camera ? "camera" : "light") << " is "
             << distance / glm::length(Vec3(grid.nodes))
             << " image diagonals away (its rays would be numerically parallel). Move it closer or "
                "use a parallel projection.");
  }
}
}

double RayDensityOfScores(const Problem& problem)
{
  const bool thick = problem.IsThick();
  const double most = !problem.IsSmall() ? 2 : thick ? 6 : 4;
  const double fewestAcross = thick ? 256 : problem.IsSmall() ? 110 : 0;
  const double wanted =
    fewestAcross / std::cbrt(double(std::max<Index>(problem.grid.NodeCount(), 1)));
  return std::max(problem.settings.rayDensity, std::min(wanted, most));
}

void RequireSettings(const Settings& settings)
{
  settings.Require();
  ChooseBackend(settings.backend, {});
}

void RequireReach(const Problem& problem)
{
  RequireDistances(problem.sources, problem.grid);
}

bool IsSampledAsScores(const Problem& problem)
{
  return RayDensityOfScores(problem) == problem.settings.rayDensity &&
    problem.fine == problem.MayHaveThickLayers();
}

void RequireView(
  const Camera& camera, const Light& light, const Settings& settings, const Grid& grid)
{
  RequireDistances(SourcesOf(camera, light, settings, grid), grid);
}

std::shared_ptr<PreparedScene> PreparedScene::Make(const SceneFields& given)
{
  return NotifyingOnFailure(*OrWhole(given.piece, given.grid)->ranks,
    [&given] { return std::make_shared<PreparedScene>(given); });
}

PreparedScene::PreparedScene(const SceneFields& given)
  : Fields(given)
{
  SceneFields& scene = this->Fields;
  scene.piece = OrWhole(given.piece, given.grid);
  this->OfArrays = GridOf(*scene.piece, scene.grid);
  const Communicator& ranks = *scene.piece->ranks;
  RequireOnAllRanks(ranks, [&] { RequireFields(scene); });
  const CheckedField extinction{ scene.baseExtinction, mostExtinction, "base extinction",
    "finite and not negative" };
  const CheckedField importance{ scene.importance, 1, "importance", "between 0 and 1" };
  SceneSurvey found = Survey(scene, extinction.most, importance.values);
  RequireOnAllRanks(ranks,
    [&]
    {
      RequireRange(scene, extinction, found.extinction);
      RequireRange(scene, importance, found.importance);
    });
  RequireReferences(scene);
  found.extinction.largest = ranks.LargestOf(found.extinction.largest);
  found.importance.largest = ranks.LargestOf(found.importance.largest);
  // Without any absorption there is nothing to optimise, whatever the transfer function allows.
  const float largest = found.extinction.largest;
  this->LargestExtinction = largest > 0 ? std::max(largest, scene.majorant) : 0.0f;
  this->SomethingImportant = found.importance.largest > 0;
  this->Given.values = importance.values;
  this->Given.derived.nodeImportance = Shared(std::move(found.nodeImportance));
  this->Given.occupancy = std::move(found.occupancy);
}

bool PreparedScene::SomethingToSee() const
{
  return this->SomethingImportant && this->LargestExtinction > 0 && this->Fields.grid.HasVolume();
}

/// Sets the despeckled importance, and at first what is derived from it.
void PreparedScene::Despeckle(Important& important) const
{
  const SceneFields& scene = this->Fields;
  important.values = scene.despeckled;
  if (!scene.despeckled)
  {
    important.derived.importance = Shared(DespeckledImportance(scene));
    important.values = important.derived.importance->Data();
  }
  if (!important.occupancy)
  {
    SceneSurvey found = Survey(scene, mostExtinction, important.values);
    important.derived.nodeImportance = Shared(std::move(found.nodeImportance));
    important.occupancy = std::move(found.occupancy);
  }
}

/// Scores and ceilings do not need the node importance of the importance as given. It is freed
/// while there is a despeckled importance.
PreparedScene::Important& PreparedScene::ImportantFor(ImportanceSmoothing smoothing, bool minimised)
{
  if (smoothing != ImportanceSmoothing::Off && !this->Despeckled)
  {
    this->Despeckled = std::make_unique<Important>();
    this->Despeckle(*this->Despeckled);
    this->FreeNodesOf(this->Given);
  }
  Important& important = smoothing == ImportanceSmoothing::Off ? this->Given : *this->Despeckled;
  if (!important.values)
  {
    this->Despeckle(important);
  }
  if (minimised && !important.derived.nodeImportance)
  {
    important.derived.nodeImportance = this->NodeImportanceOf(important);
    important.resident = std::make_shared<Resident>(); // cached fields lack the node importance
  }
  return important;
}

/// In a subdomain it stays: the occupancy is made from it.
void PreparedScene::FreeNodesOf(Important& important) const
{
  if (this->Piece().IsWhole())
  {
    important.derived.nodeImportance = nullptr;
  }
}

void PreparedScene::FreeNodeImportance()
{
  this->FreeNodesOf(this->Given);
  if (this->Despeckled)
  {
    this->FreeNodesOf(*this->Despeckled);
  }
}

void PreparedScene::FreeDerivedFields()
{
  this->FreeNodeImportance();
  if (this->Despeckled && this->Despeckled->derived.importance && this->Piece().IsWhole())
  {
    this->Despeckled->derived.importance = nullptr;
    this->Despeckled->values = nullptr;
  }
}

const float* PreparedScene::ImportanceFor(ImportanceSmoothing smoothing)
{
  return this->ImportantFor(smoothing, false).values;
}

NodeValues PreparedScene::LeastExtinction(const Settings& settings)
{
  const auto protect = static_cast<float>(settings.protectImportance);
  if (!(protect > 0))
  {
    return {};
  }
  const float* base = this->Fields.baseExtinction;
  const Index count = this->Fields.ValueCount();
  // A despeckled importance that was freed is not kept again for this.
  const bool isFreed = settings.importanceSmoothing != ImportanceSmoothing::Off &&
    this->Despeckled && !this->Despeckled->values;
  NodeValues least = isFreed ? DespeckledImportance(this->Fields) : NodeValues(count);
  float* values = least.Data();
  const float* importance = isFreed ? values : this->ImportanceFor(settings.importanceSmoothing);
  ParallelFor(
    count, 65536, [&](Index node) { values[node] = protect * importance[node] * base[node]; });
  return least;
}

/// Computes it again if it was freed.
std::shared_ptr<const NodeValues> PreparedScene::NodeImportanceOf(const Important& important) const
{
  return important.derived.nodeImportance
    ? important.derived.nodeImportance
    : Shared(Survey(this->Fields, mostExtinction, important.values).nodeImportance);
}

/// Returns null for a subdomain: its occupancy depends on the others.
std::shared_ptr<const Occupancy> PreparedScene::OccupancyOf(Important& important, bool skip) const
{
  if (!this->Piece().IsWhole())
  {
    return nullptr;
  }
  if (important.occupancy->Skips() != skip)
  {
    const SceneFields& scene = this->Fields;
    important.occupancy = std::make_shared<const Occupancy>(
      scene.grid, scene.baseExtinction, this->NodeImportanceOf(important)->Data(), skip);
  }
  return important.occupancy;
}

Problem PreparedScene::ProblemFor(
  const Camera& camera, const Light& light, const Settings& settings)
{
  return this->MakeProblem(camera, light, settings, true);
}

Problem PreparedScene::MakeProblem(
  const Camera& camera, const Light& light, const Settings& settings, bool minimised)
{
  const SceneFields& scene = this->Fields;
  Important& important = this->ImportantFor(settings.importanceSmoothing, minimised);
  Problem task;
  task.grid = scene.grid;
  task.baseExtinction = scene.baseExtinction;
  task.importance = important.values;
  task.derived = important.derived;
  task.nodeImportance = task.derived.nodeImportance ? task.derived.nodeImportance->Data() : nullptr;
  task.occupancy = this->OccupancyOf(important, settings.skipUnneeded);
  task.resident = important.resident;
  task.majorant = this->LargestExtinction;
  task.sources = SourcesOf(camera, light, settings, scene.grid);
  task.settings = settings;
  task.tellsScores = SeesWhatScoresAreOf(settings);
  return task;
}

Problem PreparedScene::ProblemForScoresOfIterates(
  const Camera& camera, const Light& light, const Settings& settings)
{
  Settings wanted = settings;
  wanted.importanceSmoothing = ImportanceSmoothing::Off;
  return this->MakeProblem(camera, light, wanted, false);
}

Problem PreparedScene::ProblemForScores(
  const Camera& camera, const Light& light, const Settings& settings)
{
  Problem task = this->ProblemForScoresOfIterates(camera, light, settings);
  task.settings.rayDensity = RayDensityOfScores(task);
  task.fine = task.MayHaveThickLayers();
  return task;
}

std::vector<PullWithReferences> PreparedScene::PullsFor(const CarriedChange& before,
  const Problem& problem, const Camera& camera, const Light& light,
  const FoundExtinctions& found) const
{
  std::vector<PullWithReferences> pulls;
  const auto add = [&](
                     double share, SummandOf summand, std::optional<CarriedExtinction>&& references)
  {
    if (references)
    {
      problem.TakeIntoBounds(references->extinction);
      problem.TakeIntoBounds(references->light);
      pulls.push_back({ references->Take(), share, summand });
    }
  };
  const Settings& settings = problem.settings;
  const double coherence = settings.temporalCoherence * before.NearnessTo(camera, light, settings);
  const SummandOf ofCoherence = [](Energy& energy) -> double& { return energy.coherence; };
  if (coherence > 0 && found.extinction)
  {
    pulls.push_back({ found, coherence, ofCoherence });
  }
  else if (coherence > 0)
  {
    add(coherence, ofCoherence, AppliedTo(this->Fields, this->LargestExtinction, before));
  }
  if (settings.referencePull > 0)
  {
    add(
      settings.referencePull, [](Energy& energy) -> double& { return energy.reference; },
      ReferenceOf(this->Fields, GivenReference::Near));
  }
  return pulls;
}
}
