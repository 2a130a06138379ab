// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Progressive.h"

#include "backend/ComputeBackend.h"
#include "math/Require.h"
#include "optimize/CoarseScene.h"
#include "optimize/DistributedBackend.h"
#include "optimize/PassTime.h"
#include "optimize/PreparedScene.h"
#include "optimize/PreviewPass.h"
#include "optimize/ProblemInFront.h"
#include "optimize/SceneCeiling.h"
#include "optimize/SceneStructures.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace limpid
{
namespace
{
struct PreviewLevel
{
  std::unique_ptr<CoarseScene> fields;  ///< null before the first use
  std::unique_ptr<PreviewPass> preview; ///< null before the first use
};

/// Which result is shown.
enum class Shown
{
  Nothing,
  Preview, ///< of the level chosen last
  Solver,  ///< the solver's result for the current view
  Kept     ///< the result of the previous view or scene
};
}

struct Progressive::Internals
{
  std::shared_ptr<PreparedScene> scene;
  std::vector<Grid> grids; ///< of previews, finest first
  std::vector<Index> nodes;
  std::vector<PreviewLevel> levels;
  PassTime time;

  Camera camera;
  Light light;
  Settings settings;
  bool hasView = false;

  Shown shown = Shown::Nothing;
  bool showsBase = false; ///< because the result shows less than the base extinction
  Camera shownCamera;     ///< the camera for which the result was found
  Light shownLight;
  Settings shownSettings;
  double shownLikeness = 1;
  bool shownOfOther = false;      ///< whether the result is of another scene
  std::size_t level = 0;          ///< of the last preview
  bool levelIsCurrent = false;    ///< whether the last preview is of the current view
  std::unique_ptr<Solver> solver; ///< of the current view; null before Refine
  FoundExtinctions kept;
  std::optional<Scores> keptScores; ///< empty if not known yet

  void PlaceGrids()
  {
    this->grids = GridsForPreviews(*this->scene);
    for (const Grid& grid : this->grids)
    {
      this->nodes.push_back(grid.NodeCount());
    }
    this->levels.resize(this->grids.size());
    this->level = this->levels.size() - 1;
  }

  PreviewPass& PreviewOn(std::size_t number)
  {
    PreviewLevel& wanted = this->levels[number];
    const ImportanceSmoothing smoothing = this->settings.importanceSmoothing;
    if (!wanted.fields || !wanted.fields->Supports(smoothing))
    {
      wanted.fields = std::make_unique<CoarseScene>(this->scene, smoothing, this->grids[number]);
      wanted.preview = std::make_unique<PreviewPass>(wanted.fields->Prepared());
    }
    return *wanted.preview;
  }

  PreviewPass& LastPreview() const { return *this->levels[this->level].preview; }

  /// Ends the current view and keeps only the shown result.
  void EndView()
  {
    if (this->shown == Shown::Solver)
    {
      this->keptScores = { this->solver->BaseScore(), this->solver->BestScore() };
      std::array<FoundExtinction, 2> found = this->solver->TakeExtinctions();
      this->kept.extinction = std::make_shared<FoundExtinction>(std::move(found[0]));
      this->kept.light = HasLightExtinction(this->settings)
        ? std::make_shared<FoundExtinction>(std::move(found[1]))
        : nullptr;
      this->shown = Shown::Kept;
    }
    this->solver.reset();
    this->levelIsCurrent = false;
  }

  bool KeepsLight() const
  {
    return this->shown == Shown::Kept ? this->kept.light != nullptr
                                      : HasLightExtinction(this->settings);
  }

  /// Whether the current view has the same eye and light, apart from the field of view.
  bool IsSeenFrom(const Camera& eye, const Light& lamp) const
  {
    const double rounding = 1e-6 * glm::length(eye.position - this->scene->Nodes().Centre());
    const auto same = [rounding](const Vec3& one, const Vec3& other)
    { return glm::length(one - other) <= rounding; };
    const bool sameEye = eye.parallel
      ? same(eye.position - eye.focalPoint, this->camera.position - this->camera.focalPoint)
      : same(eye.position, this->camera.position);
    return sameEye && eye.parallel == this->camera.parallel && lamp.type == this->light.type &&
      same(lamp.position, this->light.position) && same(lamp.focalPoint, this->light.focalPoint);
  }

  /// The scene on whose grid the shown extinction is given.
  PreparedScene& ShownScene() const
  {
    return this->shown == Shown::Preview ? this->LastPreview().Prepared() : *this->scene;
  }

  void Show(Shown what)
  {
    this->shown = what;
    this->showsBase = false;
    if (what != Shown::Kept)
    {
      this->kept = {};
      this->shownCamera = this->camera;
      this->shownLight = this->light;
      this->shownSettings = this->settings;
      this->shownLikeness = 1;
      this->shownOfOther = false;
    }
    if (what == Shown::Solver && this->levels[0].preview)
    {
      this->levels[0].preview->Forget();
    }
  }
};

Progressive::Progressive(const SceneFields& scene, const Settings& settings)
  : State(std::make_unique<Internals>())
{
  RequireSettings(settings);
  this->State->scene = std::make_shared<PreparedScene>(scene);
  this->State->settings = AdaptedTo(*this->State->scene, settings);
  this->State->PlaceGrids();
}

Progressive::~Progressive() = default;
Progressive::Progressive(Progressive&&) noexcept = default;
Progressive& Progressive::operator=(Progressive&&) noexcept = default;

void Progressive::GoOnFrom(const CarriedChange& change)
{
  Internals& state = *this->State;
  LIMPID_EXPECT(state.shown == Shown::Nothing);
  if (auto carried = AppliedTo(state.scene->Arrays(), state.scene->Majorant(), change))
  {
    state.kept = carried->Take();
    state.keptScores.reset();
    state.Show(Shown::Kept);
    state.shownCamera = change.camera;
    state.shownLight = change.light;
    state.shownSettings = change.settings;
    state.shownLikeness = change.likeness;
    state.shownOfOther = true;
  }
}

CarriedChange Progressive::Change() const
{
  return DistributedAs(this->State->scene->Arrays(), this->FoundChange());
}

/// Returns what is known of the change beside its values.
CarriedChange Progressive::ChangeWithoutValues() const
{
  const Internals& state = *this->State;
  CarriedChange change;
  change.grid = state.ShownScene().Nodes();
  change.piece = state.ShownScene().Arrays().piece;
  change.camera = state.shownCamera;
  change.light = state.shownLight;
  change.settings = state.shownSettings;
  change.likeness = state.shownLikeness;
  return change;
}

/// Returns the change on the grid on which it was found.
CarriedChange Progressive::FoundChange() const
{
  const Internals& state = *this->State;
  const bool isBeginning = state.shown == Shown::Solver && !state.solver->HasResult();
  if (state.shown == Shown::Nothing || isBeginning)
  {
    return {};
  }
  CarriedChange change = this->ChangeWithoutValues();
  const float majorant = state.ShownScene().Majorant();
  const auto changeOf = [&](const float* extinction)
  { return ChangeOf(change.ValueCount(), this->BaseExtinction(), extinction, majorant); };
  change.ofExtinction = changeOf(this->FoundForCamera());
  if (state.KeepsLight())
  {
    change.ofLight = changeOf(this->FoundForLight());
  }
  return change;
}

void Progressive::SetView(const Camera& camera, const Light& light, const Settings& wanted)
{
  Internals& state = *this->State;
  const Settings settings = AdaptedTo(*state.scene, wanted);
  if (state.hasView && camera == state.camera && light == state.light && settings == state.settings)
  {
    return;
  }
  RequireSettings(settings);
  RequireView(camera, light, settings, state.scene->Nodes());
  state.EndView();
  const bool sameView =
    state.hasView && camera == state.camera && settings.otherCameras == state.settings.otherCameras;
  if (!sameView)
  {
    state.keptScores.reset(); // they were what another camera saw
  }
  state.showsBase = false;
  state.camera = camera;
  state.light = light;
  state.settings = settings;
  state.hasView = true;
}

void Progressive::Preview(double seconds)
{
  Internals& state = *this->State;
  LIMPID_EXPECT(state.hasView);
  if (state.shown == Shown::Solver)
  {
    return; // the shown result cannot be improved for the current view
  }
  const std::size_t level =
    state.time.Choose(state.nodes, state.scene->LargestOf(float(seconds)), state.level);
  if (state.levelIsCurrent && level >= state.level)
  {
    return;
  }
  PreviewPass& preview = state.PreviewOn(level);
  const CarriedChange previous =
    this->StaysNear() ? Gathered(this->FoundChange(), state.grids[level]) : CarriedChange();
  const double taken = SecondsPerNodeOf(
    state.nodes[level], [&] { preview.Make(state.camera, state.light, state.settings, previous); });
  state.time.Learn(state.scene->LargestOf(float(taken)));
  state.level = level;
  state.levelIsCurrent = true;
  state.Show(Shown::Preview);
}

bool Progressive::Refine()
{
  Internals& state = *this->State;
  LIMPID_EXPECT(state.hasView);
  if (!state.solver)
  {
    // What was found in this scene is a reference as it is; else the change is carried over.
    const bool isHere = state.shown == Shown::Kept && !state.shownOfOther;
    const CarriedChange previous = !this->StaysNear() ? CarriedChange()
      : isHere                                        ? this->ChangeWithoutValues()
                                                      : this->Change();
    state.solver = std::make_unique<Solver>(state.scene, state.camera, state.light, state.settings,
      previous, isHere ? state.kept : FoundExtinctions());
  }
  else
  {
    state.solver->Step(1);
  }
  if (state.solver->HasResult() || state.shown == Shown::Nothing)
  {
    state.Show(Shown::Solver);
  }
  return this->Converged();
}

/// Returns whether the shown result, of another view or time, is the reference of the next one. It
/// is while the view or the data change; in still frames, only the current view counts.
bool Progressive::StaysNear() const
{
  const Internals& state = *this->State;
  const bool moves = state.shownOfOther || !state.IsSeenFrom(state.shownCamera, state.shownLight);
  return moves && state.settings.temporalCoherence > 0;
}

bool Progressive::HasBegun() const
{
  return this->State->solver != nullptr;
}

bool Progressive::Converged() const
{
  return this->State->solver && this->State->solver->Done();
}

bool Progressive::Settled() const
{
  return !this->State->solver || this->State->solver->Settled();
}

const Grid& Progressive::ShownGrid() const
{
  return this->State->ShownScene().ArrayGrid();
}

bool Progressive::ShowsPiece() const
{
  return !this->State->ShownScene().Piece().IsWhole();
}

const float* Progressive::BaseExtinction() const
{
  return this->State->ShownScene().Arrays().baseExtinction;
}

void Progressive::ShowNoLessThanBase()
{
  Internals& state = *this->State;
  state.showsBase = this->IsJudged() && this->FoundScore().fraction < this->BaseScore().fraction;
}

/// Returns whether the shown result must not show less than the base extinction. Exempt are
/// converged results, results for the light alone or of other methods, and results that may add
/// extinction, unless they are of another scene.
bool Progressive::IsJudged() const
{
  const Internals& state = *this->State;
  const Settings& of = state.settings;
  const bool isForView = InfoOf(of.method).iterates && of.weights.view > 0;
  const bool isAdded = of.emphasis > 0 && !state.shownOfOther;
  return state.shown != Shown::Nothing && isForView && !isAdded && !this->Converged();
}

bool Progressive::ShowsFound() const
{
  return this->State->shown != Shown::Nothing && !this->State->showsBase;
}

const float* Progressive::Extinction() const
{
  return this->State->showsBase ? this->BaseExtinction() : this->FoundForCamera();
}

const float* Progressive::LightExtinction() const
{
  return this->State->showsBase ? this->BaseExtinction() : this->FoundForLight();
}

const float* Progressive::FoundForCamera() const
{
  const Internals& state = *this->State;
  switch (state.shown)
  {
    case Shown::Preview:
      return state.LastPreview().Extinction();
    case Shown::Solver:
      return state.solver->ExtinctionValues();
    case Shown::Kept:
      return state.kept.Of(false).OnHost().data();
    case Shown::Nothing:
      break;
  }
  return this->BaseExtinction();
}

/// Returns the extinction found for the camera. `onGpu`: whether it can be read on the device.
ExtinctionInPlace Progressive::FoundInPlace(bool onGpu) const
{
  const Internals& state = *this->State;
  const ExtinctionOnDevice there = !onGpu ? ExtinctionOnDevice()
    : state.shown == Shown::Solver        ? state.solver->OnDevice()
    : state.shown == Shown::Kept          ? state.kept.Of(false).OnDevice()
                                          : ExtinctionOnDevice();
  return there.extinction ? ExtinctionInPlace(there) : this->FoundForCamera();
}

const float* Progressive::FoundForLight() const
{
  const Internals& state = *this->State;
  switch (state.shown)
  {
    case Shown::Preview:
      return state.LastPreview().LightExtinction();
    case Shown::Solver:
      return HasLightExtinction(state.settings) ? state.solver->LightExtinctionValues()
                                                : this->FoundForCamera();
    case Shown::Kept:
      return state.kept.Of(true).OnHost().data();
    case Shown::Nothing:
      break;
  }
  return this->BaseExtinction();
}

ShownOnDevice Progressive::OnDevice() const
{
  const Internals& state = *this->State;
  const bool forLight = HasLightExtinction(state.settings);
  ExtinctionOnDevice found;
  ExtinctionOnDevice ofLight;
  if (state.showsBase)
  {
    return {};
  }
  if (state.shown == Shown::Solver)
  {
    found = state.solver->OnDevice();
    ofLight = forLight ? state.solver->LightOnDevice() : found;
  }
  else if (state.shown == Shown::Kept)
  {
    found = state.kept.Of(false).OnDevice();
    ofLight = state.kept.Of(true).OnDevice();
  }
  return ofLight.extinction ? ShownOnDevice{ found, ofLight.extinction } : ShownOnDevice();
}

Score Progressive::BaseScore() const
{
  const Internals& state = *this->State;
  switch (state.shown)
  {
    case Shown::Preview:
      return state.LastPreview().BaseScore();
    case Shown::Solver:
      return state.solver->BaseScore();
    case Shown::Kept:
      return this->KeptScores().base;
    case Shown::Nothing:
      break;
  }
  return {};
}

Score Progressive::BestScore() const
{
  return this->State->showsBase ? this->BaseScore() : this->FoundScore();
}

Score Progressive::FoundScore() const
{
  const Internals& state = *this->State;
  switch (state.shown)
  {
    case Shown::Preview:
      return state.LastPreview().BestScore();
    case Shown::Solver:
      return state.solver->BestScore();
    case Shown::Kept:
      return this->KeptScores().best;
    case Shown::Nothing:
      break;
  }
  return {};
}

/// Returns the scores of the extinction that was kept, seen by all cameras of the present view.
const Scores& Progressive::KeptScores() const
{
  Internals& state = *this->State;
  if (!state.keptScores)
  {
    state.keptScores = this->ScoresWith(state.camera, state.settings);
  }
  return *state.keptScores;
}

Scores Progressive::ScoresFrom(const Camera& camera, const OpaqueGeometry* opaque) const
{
  Settings settings = this->State->settings;
  settings.otherCameras.clear();
  Scores scores = this->ScoresWith(camera, settings, opaque);
  scores.best = this->State->showsBase ? scores.base : scores.best;
  return scores;
}

/// What all cameras of some settings see of the base extinction and of what was found.
Scores Progressive::ScoresWith(
  const Camera& camera, const Settings& settings, const OpaqueGeometry* opaque) const
{
  const Internals& state = *this->State;
  PreparedScene& scene = state.ShownScene();
  const ProblemInFront seen(
    scene.ProblemForScores(camera, state.light, settings), scene.ArrayGrid(), opaque);
  const Problem& problem = seen.Get();
  ChosenBackend backend;
  backend.Choose(settings, scene);
  const auto score = [&]() -> Scores
  {
    const std::unique_ptr<SourceSweeps> sweeps = backend->SweepsFromCameras(problem);
    return { sweeps->ScoreOf(this->BaseExtinction()),
      sweeps->ScoreOf(this->FoundInPlace(backend.IsOnGpu())) };
  };
  return backend.Do(score, [] {});
}

Ceiling Progressive::CeilingFrom(const Camera& camera, const OpaqueGeometry* opaque) const
{
  const Internals& state = *this->State;
  Settings settings = state.settings;
  if (!InfoOf(settings.method).iterates)
  {
    return {};
  }
  settings.otherCameras.clear();
  ChosenBackend backend;
  backend.Choose(settings, *state.scene);
  return backend.Do([&]
    { return CeilingOfScores(*state.scene, backend, camera, state.light, settings, opaque); },
    [] {});
}

namespace
{
/// Returns the rows of the nodes in front of opaque geometry, and 0 behind it.
std::vector<StructureRow> RowsInFront(
  const Grid& grid, const StructureRow* rows, const OpaqueGeometry& opaque)
{
  const std::vector<float> all(static_cast<std::size_t>(grid.NodeCount()), 1.0f);
  const std::vector<float> shares = opaque.InFront(grid, all.data());
  std::vector<StructureRow> inFront(shares.size());
  std::transform(shares.begin(), shares.end(), rows, inFront.begin(),
    [](float share, StructureRow row) { return share >= 0.5f ? row : StructureRow(0); });
  return inFront;
}

/// Returns what is seen in front of opaque geometry, as shares of all that the data have. What is
/// behind it is hidden by something else than structures, unless it was removed.
StructureShares AsSharesOfAll(const StructureShares& inFront, const StructureShares& all)
{
  const double share = all.important > 0 ? inFront.important / all.important : 0.0;
  StructureShares result = all;
  result.visible = inFront.visible * share;
  result.baseVisible = inFront.baseVisible * share;
  result.attainable = inFront.attainable * share;
  double others = 1 - result.visible - result.removed;
  for (std::size_t by = 1; by < result.hiddenBy.size(); ++by)
  {
    result.hiddenBy[by] = inFront.hiddenBy[by] * share;
    others -= result.hiddenBy[by];
  }
  if (!result.hiddenBy.empty())
  {
    result.hiddenBy[0] = all.important > 0 ? std::max(others, 0.0) : 0.0;
  }
  return result;
}
}

std::vector<StructureShares> Progressive::SharesFrom(const std::vector<Camera>& cameras,
  const Structures& structures, const StructureRow* rows, const float* extinction,
  const OpaqueGeometry* opaque) const
{
  const Internals& state = *this->State;
  if (state.shown == Shown::Preview)
  {
    return {};
  }
  const Settings settings = ForCameras(state.settings, cameras);
  const auto sharesOf = [&](const StructureRow* present)
  {
    return SharesOfStructures(
      *state.scene, cameras.front(), state.light, settings, structures, present, extinction);
  };
  std::vector<StructureShares> shares = sharesOf(rows);
  if (opaque)
  {
    const std::vector<StructureShares> inFront =
      sharesOf(RowsInFront(state.scene->ArrayGrid(), rows, *opaque).data());
    std::transform(inFront.begin(), inFront.end(), shares.begin(), shares.begin(), AsSharesOfAll);
  }
  return shares;
}

int Progressive::Iterations() const
{
  return this->State->solver ? this->State->solver->Iterations() : 0;
}

std::string Progressive::BackendName() const
{
  const Internals& state = *this->State;
  if (state.solver)
  {
    return state.solver->BackendName();
  }
  const BackendChoice choice = ChooseBackend(state.settings.backend, {});
  return BackendFor(*state.scene, BackendOf(choice.cuda).MakeSolverBackend())
    ->Describe(choice.name);
}
}
