// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Progressive.h"

#include "backend/Backend.h"
#include "math/Require.h"
#include "optimize/Levels.h"
#include "optimize/PreparedScene.h"
#include "optimize/PreviewPass.h"

#include <algorithm>

namespace limpid
{
namespace
{
std::vector<float> RestrictImportance(
  const Grid& fineGrid, const float* importance, const Grid& grid)
{
  std::vector<float> coarse = Restrict(fineGrid, importance, grid);
  // A mean of numbers up to 1 may round above it.
  ParallelFor(grid.NodeCount(), 65536,
    [&coarse](Index node)
    {
      float& value = coarse[std::size_t(node)];
      value = std::min(value, 1.0f);
    });
  return coarse;
}

/// A coarser grid with fields of its own to preview on.
struct CoarseScene
{
  std::vector<float> base;
  std::vector<float> importance;
  std::vector<float> despeckled; ///< what is a speck shows on the fine grid only; empty: not needed

  CoarseScene(PreparedScene& fine, ImportanceSmoothing smoothing, const Grid& grid)
    : base(Restrict(fine.Nodes(), fine.Arrays().baseExtinction, grid))
    , importance(RestrictImportance(fine.Nodes(), fine.Arrays().importance, grid))
  {
    if (smoothing == ImportanceSmoothing::Median)
    {
      this->despeckled = RestrictImportance(fine.Nodes(), fine.ImportanceFor(smoothing), grid);
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

struct Level
{
  std::unique_ptr<CoarseScene> fields;  ///< null: those of the scene itself
  std::unique_ptr<PreviewPass> preview; ///< null: not needed yet
};

/// What is shown.
enum class Shown
{
  Nothing,
  Preview, ///< of the level that was chosen last
  Solver,  ///< what the solver has found for the present view
  Kept     ///< what a solver had found for the last view
};
}

struct Progressive::Internals
{
  std::shared_ptr<PreparedScene> scene;
  std::vector<Grid> grids; ///< finest first
  std::vector<Index> nodes;
  std::vector<Level> levels;
  PassTime time;
  Stopwatch stopwatch = TimePass;

  Camera camera;
  Light light;
  Settings settings;
  bool hasView = false;

  Shown shown = Shown::Nothing;
  std::size_t level = 0;          ///< of the last preview
  bool levelIsCurrent = false;    ///< whether it was made for the present view
  std::unique_ptr<Solver> solver; ///< of the present view; null: not begun
  std::array<FoundExtinction, 2> kept;
  bool keptForLight = false; ///< whether there is another one for the light
  Score keptBase;
  Score keptBest;

  void PlaceGrids()
  {
    const Grid& full = this->scene->Nodes();
    this->grids.push_back(full);
    for (const int factor : { 2, 3, 4, 6, 8, 12, 16, 24, 32 })
    {
      const Grid grid = CoarseGrid(full, factor);
      if (this->grids.back().NodeCount() > 4096 && grid.nodes != this->grids.back().nodes)
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
    Level& wanted = this->levels[number];
    const ImportanceSmoothing smoothing = this->settings.importanceSmoothing;
    if (!wanted.preview || (wanted.fields && !wanted.fields->Has(smoothing)))
    {
      std::shared_ptr<PreparedScene> prepared = this->scene;
      if (number > 0)
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

  /// The present view is over: keeps what is shown, and nothing else.
  void EndView()
  {
    if (this->shown == Shown::Solver)
    {
      this->keptBase = this->solver->BaseScore();
      this->keptBest = this->solver->BestScore();
      this->keptForLight = HasLightExtinction(this->settings);
      this->kept = this->solver->TakeExtinctions();
      this->shown = Shown::Kept;
    }
    this->solver.reset();
    this->levelIsCurrent = false;
  }

  void Show(Shown what)
  {
    this->shown = what;
    if (what != Shown::Kept)
    {
      this->kept = {};
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

void Progressive::SetStopwatch(Stopwatch stopwatch)
{
  this->State->stopwatch = std::move(stopwatch);
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
    return; // nothing is better for the present view
  }
  const std::size_t level = state.time.Choose(state.nodes, seconds, state.level);
  if (state.levelIsCurrent && level >= state.level)
  {
    return;
  }
  PreviewPass& preview = state.PreviewOn(level);
  const Index nodes = state.nodes[level];
  state.time.Learn(nodes,
    state.stopwatch(nodes, [&] { preview.Make(state.camera, state.light, state.settings); }));
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
    state.solver = std::make_unique<Solver>(state.scene, state.camera, state.light, state.settings);
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
  return state.shown == Shown::Preview ? state.LastPreview().Nodes() : state.scene->Nodes();
}

const float* Progressive::BaseExtinction() const
{
  const Internals& state = *this->State;
  return state.shown == Shown::Preview ? state.LastPreview().Base()
                                       : state.scene->Arrays().baseExtinction;
}

const float* Progressive::Extinction() const
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

const float* Progressive::LightExtinction() const
{
  const Internals& state = *this->State;
  switch (state.shown)
  {
    case Shown::Preview:
      return state.LastPreview().LightExtinction();
    case Shown::Solver:
      return HasLightExtinction(state.settings) ? state.solver->LightExtinction().data()
                                                : this->Extinction();
    case Shown::Kept:
      return state.keptForLight ? state.kept[1].OnHost().data() : this->Extinction();
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
      return state.keptBase;
    case Shown::Nothing:
      break;
  }
  return {};
}

Score Progressive::BestScore() const
{
  const Internals& state = *this->State;
  switch (state.shown)
  {
    case Shown::Preview:
      return state.LastPreview().BestScore();
    case Shown::Solver:
      return state.solver->BestScore();
    case Shown::Kept:
      return state.keptBest;
    case Shown::Nothing:
      break;
  }
  return {};
}

Scores Progressive::ScoresFrom(const Camera& camera) const
{
  const Internals& state = *this->State;
  PreparedScene& scene =
    state.shown == Shown::Preview ? state.LastPreview().Prepared() : *state.scene;
  const Problem problem = scene.ProblemFor(camera, state.light, ForScores(state.settings));
  ChosenBackend backend;
  backend.Choose(state.settings, problem.grid);
  const auto score = [&]() -> Scores
  {
    const std::unique_ptr<SourceSweeps> sweeps = backend->SweepsFrom(problem, problem.camera);
    return { sweeps->ScoreOf(this->BaseExtinction()), sweeps->ScoreOf(this->Extinction()) };
  };
  return backend.Do(score, [] {});
}

int Progressive::Iterations() const
{
  return this->State->solver ? this->State->solver->Iterations() : 0;
}

std::string Progressive::BackendName() const
{
  const Internals& state = *this->State;
  return state.solver ? state.solver->BackendName()
                      : ChooseBackend(state.settings.backend, {}).name;
}
}
