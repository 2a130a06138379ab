// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Solver.h"

#include "math/Require.h"
#include "optimize/SceneCeiling.h"
#include "optimize/SceneStructures.h"
#include "optimize/SolverInternals.h"

namespace limpid
{
Solver::Solver(const SceneFields& scene, const Camera& camera, const Light& light,
  const Settings& settings, const CarriedChange& previous)
  : State(std::make_unique<Internals>())
{
  RequireSettings(settings);
  this->State->prepared = PreparedScene::Make(scene);
  this->State->ownsScene = true;
  this->State->Set(camera, light, settings, previous, {});
  this->State->OnBackend([this] { this->State->Begin(); });
}

Solver::Solver(std::shared_ptr<PreparedScene> scene, const Camera& camera, const Light& light,
  const Settings& settings, const CarriedChange& previous, const FoundExtinctions& found)
  : State(std::make_unique<Internals>())
{
  RequireSettings(settings);
  this->State->prepared = std::move(scene);
  this->State->Set(camera, light, settings, previous, found);
  this->State->OnBackend([this] { this->State->Begin(); });
}

Solver::Solver(std::shared_ptr<PreparedScene> scene, const Camera& camera, const Light& light,
  const Settings& settings, CarriedExtinction&& measured)
  : State(std::make_unique<Internals>())
{
  Settings wanted = settings;
  wanted.maximumIterations = 0;
  wanted.iterationsPerLevel = { { 0, 0, 0 } };
  RequireSettings(wanted);
  this->State->prepared = std::move(scene);
  this->State->Set(camera, light, wanted, {}, {});
  this->State->onlyMeasures = true;
  this->State->StartFrom(std::move(measured));
  this->State->OnBackend([this] { this->State->Begin(); });
}

Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

void Solver::SetInitialExtinction(const float* extinction, const float* light)
{
  Internals& state = *this->State;
  const Index count = state.scene.ValueCount();
  CarriedExtinction start;
  start.extinction.assign(extinction, extinction + count);
  start.hasLight = light != nullptr;
  if (light)
  {
    start.light.assign(light, light + count);
  }
  state.StartFrom(std::move(start));
  state.OnBackend([&state] { state.Begin(); });
}

bool Solver::Step(int iterations, const Progress& progress)
{
  Internals& state = *this->State;
  state.stopped = false;
  for (int i = 0; i < iterations && !state.done; ++i)
  {
    state.OnBackend([&] { state.Iterate(progress); });
    if (state.stopped)
    {
      break;
    }
  }
  return state.done;
}

void Solver::Run(const Progress& progress)
{
  while (!this->Step(1, progress) && !this->State->stopped)
  {
  }
}

bool Solver::Done() const
{
  return this->State->done;
}

bool Solver::Stopped() const
{
  return this->State->stopped;
}

const std::vector<float>& Solver::Extinction() const
{
  Internals& state = *this->State;
  return state.OnBackend([&]() -> const std::vector<float>& { return state.Extinction(); });
}

const std::vector<float>& Solver::LightExtinction() const
{
  Internals& state = *this->State;
  return state.OnBackend([&]() -> const std::vector<float>& { return state.LightExtinction(); });
}

const float* Solver::ExtinctionValues() const
{
  Internals& state = *this->State;
  return state.OnBackend([&] { return state.Values(false); });
}

const float* Solver::LightExtinctionValues() const
{
  Internals& state = *this->State;
  return state.OnBackend([&] { return state.Values(true); });
}

CarriedChange Solver::Change() const
{
  const SceneFields& scene = this->State->scene;
  const auto changeOf = [&](const std::vector<float>& extinction)
  {
    return extinction.empty() ? std::vector<float>()
                              : ChangeOf(scene.ValueCount(), scene.baseExtinction,
                                  extinction.data(), this->State->prepared->Majorant());
  };
  return { scene.grid, changeOf(this->Extinction()), changeOf(this->LightExtinction()), scene.piece,
    this->State->camera, this->State->light, this->State->settings };
}

ExtinctionOnDevice Solver::OnDevice() const
{
  return this->State->OnDevice(false);
}

ExtinctionOnDevice Solver::LightOnDevice() const
{
  return this->State->OnDevice(true);
}

bool Solver::Settled() const
{
  return this->State->done && this->State->settled;
}

bool Solver::HasResult() const
{
  const Internals& state = *this->State;
  const bool lastRun = !HasLightExtinction(state.settings) || state.lightRun;
  return state.done || (lastRun && state.hasBetter);
}

std::array<FoundExtinction, 2> Solver::TakeExtinctions()
{
  Internals& state = *this->State;
  if (state.minimizer)
  {
    (state.lightRun ? state.lightExtinction : state.extinction) = state.minimizer->TakeResult();
    state.minimizer.reset();
  }
  state.done = true;
  return { { std::move(state.extinction), std::move(state.lightExtinction) } };
}

double Solver::Majorant() const
{
  return this->State->prepared->Majorant();
}

Score Solver::BaseScore() const
{
  return this->State->base;
}

Score Solver::BestScore() const
{
  Internals& state = *this->State;
  if (!state.best)
  {
    state.OnBackend([&] { state.best = state.ScoreOf(state.InPlace()); });
    if (state.done)
    {
      state.judge.reset();
    }
  }
  return *state.best;
}

Ceiling Solver::FindCeiling() const
{
  Internals& state = *this->State;
  if (!state.Minimizes())
  {
    return {};
  }
  if (!state.ceiling)
  {
    state.OnBackend(
      [&]
      {
        state.ceiling = CeilingOfScores(
          *state.prepared, state.backend, state.camera, state.light, state.settings);
      });
  }
  Ceiling ceiling = *state.ceiling;
  for (const Score& found : { state.base, this->BestScore() })
  {
    ceiling.visibility = std::max(ceiling.visibility, found.visibility);
    ceiling.fraction = std::max(ceiling.fraction, found.fraction);
  }
  return ceiling;
}

std::vector<StructureShares> Solver::SharesOf(
  const Structures& structures, const StructureRow* rows) const
{
  const Internals& state = *this->State;
  const float* extinction = this->Extinction().data();
  return state.prepared->Together(
    [&]
    {
      return SharesOfStructures(
        *state.prepared, state.camera, state.light, state.settings, structures, rows, extinction);
    });
}

Energy Solver::BestEnergy() const
{
  return this->State->bestEnergy;
}

int Solver::Iterations() const
{
  return this->State->iterations;
}

double Solver::Seconds() const
{
  return this->State->seconds;
}

const Camera& Solver::MainCamera() const
{
  return this->State->camera;
}

const Light& Solver::OnlyLight() const
{
  return this->State->light;
}

const Settings& Solver::Options() const
{
  return this->State->settings;
}

std::string Solver::BackendName() const
{
  return this->State->backend.Name();
}

const std::vector<IterationRecord>& Solver::History() const
{
  return this->State->history;
}

void Solver::Transmittance(float* transmittance) const
{
  Internals& state = *this->State;
  state.OnBackend([&] { state.FindTransmittance(false, transmittance); });
}

void Solver::LightTransmittance(float* transmittance) const
{
  Internals& state = *this->State;
  state.OnBackend([&] { state.FindTransmittance(true, transmittance); });
}
}
