// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Progressive.h"

#include "backend/Backend.h"
#include "distributed/FieldResampling.h"
#include "math/Require.h"
#include "optimize/PassTime.h"
#include "optimize/PreparedScene.h"
#include "optimize/PreviewPass.h"
#include "optimize/ProblemInFront.h"
#include "optimize/SceneCeiling.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace limpid
{
namespace
{
/// Restricts a field of a scene to a coarser grid that every rank gets.
std::vector<float> Restrict(const PreparedScene& scene, const float* field, const Grid& grid)
{
  return ResampledForAll(scene.Piece(), scene.Nodes(), field, grid);
}

std::vector<float> RestrictImportance(
  const PreparedScene& scene, const float* importance, const Grid& grid)
{
  std::vector<float> coarse = Restrict(scene, importance, grid);
  // Rounding may make a mean of numbers up to 1 exceed 1.
  ParallelFor(grid.NodeCount(), 65536,
    [&coarse](Index node)
    {
      float& value = coarse[std::size_t(node)];
      value = std::min(value, 1.0f);
    });
  return coarse;
}

/// A coarse grid with its own fields, for previews.
struct CoarseScene
{
  std::vector<float> base;
  std::vector<float> importance;
  std::vector<float> despeckled; ///< specks are identified at full resolution; empty if not needed

  CoarseScene(PreparedScene& fine, ImportanceSmoothing smoothing, const Grid& grid)
    : base(Restrict(fine, fine.Arrays().baseExtinction, grid))
    , importance(RestrictImportance(fine, fine.Arrays().importance, grid))
  {
    if (smoothing == ImportanceSmoothing::Median)
    {
      this->despeckled = RestrictImportance(fine, fine.ImportanceFor(smoothing), grid);
    }
  }

  bool Has(ImportanceSmoothing smoothing) const
  {
    return smoothing == ImportanceSmoothing::Off || !this->despeckled.empty();
  }

  SceneFields Fields(const Grid& grid, float majorant) const
  {
    return { grid, this->base.data(), this->importance.data(), majorant,
      this->despeckled.empty() ? nullptr : this->despeckled.data() };
  }
};

struct PreviewLevel
{
  std::unique_ptr<CoarseScene> fields;  ///< null if the level uses the scene's own fields
  std::unique_ptr<PreviewPass> preview; ///< created on first use
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
  std::vector<Grid> grids; ///< of previews, finest first; small enough for every rank
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
  std::array<FoundExtinction, 2> kept;
  bool keptForLight = false;        ///< whether `kept` has a separate extinction for the light
  std::optional<Scores> keptScores; ///< empty if not known yet

  const Communicator& Ranks() const { return this->scene->Ranks(); }

  /// Whether the arrays of the scene hold all nodes.
  bool IsWhole() const { return this->scene->Piece().IsWhole(); }

  /// The current settings, adapted to distributed runs.
  Settings Wanted() const { return this->scene->Adapted(this->settings); }

  void PlaceGrids()
  {
    const Grid& full = this->scene->Nodes();
    constexpr int coarsest = 32;
    const auto suits = [&](const Grid& grid, bool last)
    {
      return this->grids.empty()
        ? last || IsForAll(this->Ranks(), grid, full)
        : this->grids.back().NodeCount() > 4096 && grid.nodes != this->grids.back().nodes;
    };
    for (const int factor : { 1, 2, 3, 4, 6, 8, 12, 16, 24, coarsest })
    {
      const Grid grid = factor == 1 ? full : CoarseGrid(full, factor);
      if (suits(grid, factor == coarsest))
      {
        this->grids.push_back(grid);
      }
    }
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
    if (!wanted.preview || (wanted.fields && !wanted.fields->Has(smoothing)))
    {
      std::shared_ptr<PreparedScene> prepared = this->scene;
      if (number > 0 || !this->IsWhole())
      {
        const Grid& grid = this->grids[number];
        wanted.fields = std::make_unique<CoarseScene>(*this->scene, smoothing, grid);
        prepared = std::make_shared<PreparedScene>(
          wanted.fields->Fields(grid, this->scene->Arrays().majorant));
      }
      wanted.preview = std::make_unique<PreviewPass>(std::move(prepared));
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
      this->keptForLight = HasLightExtinction(this->settings);
      this->kept = this->solver->TakeExtinctions();
      this->shown = Shown::Kept;
    }
    this->solver.reset();
    this->levelIsCurrent = false;
  }

  bool KeepsLight() const
  {
    return this->shown == Shown::Kept ? this->keptForLight : HasLightExtinction(this->settings);
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
  this->State->settings = settings;
  this->State->PlaceGrids();
}

Progressive::~Progressive() = default;
Progressive::Progressive(Progressive&&) noexcept = default;
Progressive& Progressive::operator=(Progressive&&) noexcept = default;

void Progressive::GoOnFrom(const CarriedChange& change)
{
  Internals& state = *this->State;
  LIMPID_EXPECT(state.shown == Shown::Nothing);
  CarriedExtinction carried = AppliedTo(state.scene->Arrays(), state.scene->Majorant(), change);
  // The subdomain of a rank may be empty.
  if (state.Ranks().AnyOf(!carried.extinction.empty()))
  {
    state.keptForLight = state.Ranks().AnyOf(!carried.light.empty());
    state.kept = { { std::move(carried.extinction), std::move(carried.light) } };
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
  const Internals& state = *this->State;
  const bool isForAll = !state.IsWhole() && state.shown == Shown::Preview;
  return isForAll ? OnPiece(this->FoundChange(), state.scene->Nodes(), state.scene->Arrays().piece)
                  : this->FoundChange();
}

/// Returns the change on the grid on which it was found.
CarriedChange Progressive::FoundChange() const
{
  const Internals& state = *this->State;
  CarriedChange change;
  const bool isBeginning = state.shown == Shown::Solver && !state.solver->HasResult();
  if (state.shown == Shown::Nothing || isBeginning)
  {
    return change;
  }
  change.grid = state.ShownScene().Nodes();
  change.piece = state.ShownScene().Arrays().piece;
  change.camera = state.shownCamera;
  change.light = state.shownLight;
  change.settings = state.shownSettings;
  change.likeness = state.shownLikeness;
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

void Progressive::SetView(const Camera& camera, const Light& light, const Settings& settings)
{
  Internals& state = *this->State;
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
    state.time.Choose(state.nodes, state.Ranks().LargestOf(float(seconds)), state.level);
  if (state.levelIsCurrent && level >= state.level)
  {
    return;
  }
  PreviewPass& preview = state.PreviewOn(level);
  CarriedChange previous = this->StaysNear() ? this->FoundChange() : CarriedChange();
  if (previous.piece && !previous.piece->IsWhole())
  {
    previous = ForAllRanks(std::move(previous), state.grids[level]);
  }
  const double taken = SecondsPerNodeOf(
    state.nodes[level], [&] { preview.Make(state.camera, state.light, state.Wanted(), previous); });
  state.time.Learn(state.Ranks().LargestOf(float(taken)));
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
    state.solver = std::make_unique<Solver>(state.scene, state.camera, state.light, state.settings,
      this->StaysNear() ? this->Change() : CarriedChange());
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
  const Internals& state = *this->State;
  return this->ShowsPiece() ? state.scene->ArrayGrid() : state.ShownScene().Nodes();
}

bool Progressive::ShowsPiece() const
{
  const Internals& state = *this->State;
  return !state.IsWhole() && state.shown != Shown::Preview;
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
      return state.solver->Extinction().data();
    case Shown::Kept:
      return state.kept[0].OnHost().data();
    case Shown::Nothing:
      break;
  }
  return this->BaseExtinction();
}

const float* Progressive::FoundForLight() const
{
  const Internals& state = *this->State;
  switch (state.shown)
  {
    case Shown::Preview:
      return state.LastPreview().LightExtinction();
    case Shown::Solver:
      return HasLightExtinction(state.settings) ? state.solver->LightExtinction().data()
                                                : this->FoundForCamera();
    case Shown::Kept:
      return state.keptForLight ? state.kept[1].OnHost().data() : this->FoundForCamera();
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
    found = state.kept[0].OnDevice();
    ofLight = state.keptForLight ? state.kept[1].OnDevice() : found;
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
    state.keptScores = this->ScoresWith(state.camera, state.Wanted());
  }
  return *state.keptScores;
}

Scores Progressive::ScoresFrom(const Camera& camera, const OpaqueGeometry* opaque) const
{
  Settings settings = this->State->Wanted();
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
    return { sweeps->ScoreOf(this->BaseExtinction()), sweeps->ScoreOf(this->FoundForCamera()) };
  };
  return backend.Do(score, [] {});
}

Ceiling Progressive::CeilingFrom(const Camera& camera, const OpaqueGeometry* opaque) const
{
  const Internals& state = *this->State;
  Settings settings = state.Wanted();
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

int Progressive::Iterations() const
{
  return this->State->solver ? this->State->solver->Iterations() : 0;
}

std::string Progressive::BackendName() const
{
  const Internals& state = *this->State;
  return state.solver ? state.solver->BackendName()
                      : NameOnRanks(ChooseBackend(state.Wanted().backend, {}).name, state.Ranks());
}
}
