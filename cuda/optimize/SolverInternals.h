// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_SolverInternals_h
#define limpid_optimize_SolverInternals_h

#include "backend/Backend.h"
#include "energy/TransmittanceSweep.h"
#include "math/Require.h"
#include "optimize/DistributedBackend.h"
#include "optimize/ExtinctionBounds.h"
#include "optimize/PreparedScene.h"
#include "optimize/Smoothing.h"
#include "optimize/Solver.h"
#include "optimize/SolverBackend.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <sstream>
#include <utility>

namespace limpid
{
/// The runs of a solver and their results.
struct Solver::Internals
{
  std::shared_ptr<PreparedScene> prepared;
  ChosenBackend backend;
  SceneFields scene;
  Camera camera;
  Light light;
  Settings settings;
  StartingExtinction initial;
  StartingExtinction initialLight;       ///< of the light's own run
  std::vector<PullWithReferences> pulls; ///< beside the regularisation

  /// The current run of a minimiser: the joint field, or in separate mode first the camera's
  /// field, then the light's.
  Problem problem;
  std::unique_ptr<Minimizer> minimizer;
  int runIterations = 0;
  int runSmoothings = 0; ///< smoothing sweeps after the iterations
  bool runFound = false; ///< whether the iterations have converged
  bool lightRun = false;
  double runLowest = 0;   ///< energy of the best iterate at full resolution
  bool hasBetter = false; ///< whether this run has improved on its start

  FoundExtinction extinction; ///< result of a finished run
  FoundExtinction lightExtinction;
  std::vector<IterationRecord> history;
  Score base;
  mutable std::optional<Score> best; ///< empty if not known yet

  /// The rays of the cameras with the importance as given; null until requested.
  struct Judge
  {
    Problem problem;
    std::unique_ptr<SourceSweeps> sweeps;
  };
  mutable std::unique_ptr<Judge> judge;
  mutable std::unique_ptr<Judge> judgeOfIterates; ///< with fewer rays, if iterates have no scores
  mutable std::optional<Ceiling> ceiling;         ///< empty until requested

  Energy bestEnergy;
  int iterations = 0;
  double seconds = 0;
  bool done = false;
  bool stopped = false;
  bool settled = false;
  bool warm = false;
  bool onlyMeasures = false; ///< whether runs make no iterations
  bool ownsScene = false;    ///< whether nobody else uses the prepared scene

  /// `found`: see Solver.
  void Set(const Camera& eye, const Light& lamp, const Settings& wanted,
    const CarriedChange& before, const FoundExtinctions& found)
  {
    this->scene = this->prepared->Arrays();
    RequireAlike(*this->prepared, eye, lamp, wanted, before.NearnessTo(eye, lamp, wanted));
    this->pulls = this->prepared->PullsFor(
      before, this->prepared->ProblemForEnergy(eye, lamp, wanted), eye, lamp, found);
    this->camera = eye;
    this->light = lamp;
    this->settings = wanted;
    this->backend.Choose(wanted, *this->prepared);
  }

  /// Sets the first iterate, instead of the base extinction.
  void StartFrom(CarriedExtinction&& start)
  {
    LIMPID_REQUIRE(this->Minimizes(),
      "An initial extinction was given to "
        << InfoOf(this->settings.method).name
        << " (this method does not iterate). Use the method Optimized.");
    LIMPID_REQUIRE(start.hasLight || this->settings.mode == Mode::Joint,
      "An initial extinction was given in separate mode (this mode optimises two extinctions). Use "
      "the joint mode.");
    this->initial = std::move(start.extinction);
    if (start.hasLight)
    {
      this->initialLight = std::move(start.light);
    }
    this->warm = true;
  }

  /// Starts the first run.
  void Begin()
  {
    this->history.clear();
    this->iterations = 0;
    this->seconds = 0;
    this->done = false;
    this->stopped = false;
    this->settled = true;
    this->lightRun = false;
    this->base = Score();
    this->best = Score();
    this->judge.reset();
    this->judgeOfIterates.reset();
    this->ceiling.reset();
    this->bestEnergy = Energy();
    this->lightExtinction = {};
    if (HasLightExtinction(this->settings))
    {
      this->AssignBase(this->lightExtinction); // until the light's own run
    }
    const auto start = std::chrono::steady_clock::now();
    this->problem = this->MakeProblem();
    RequireReach(this->problem);
    this->MakeMinimizer(this->FirstIterate());
    this->seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  /// Runs `work` on the backend. If another backend replaces it, that one first repeats all
  /// iterations so far.
  template <class Work>
  decltype(auto) OnBackend(const Work& work)
  {
    const int made = this->iterations;
    const bool wasDone = this->done;
    const bool wasStopped = this->stopped;
    const auto restore = [&]
    {
      this->KeepPullsOnHost();
      this->Begin();
      while (!this->done && this->iterations < made)
      {
        this->Iterate(Progress());
      }
      if (wasDone && !this->done)
      {
        this->stopped = true;
        this->FinishRun();
      }
      this->stopped = wasStopped;
    };
    return this->prepared->Together(
      [&]() -> decltype(auto) { return this->backend.Do(work, restore); });
  }

  /// Brings references to the host after the device that has them failed. What it does not give
  /// any more is lost, and nothing is drawn to it.
  void KeepPullsOnHost()
  {
    const auto isLost = [](const PullWithReferences& pull)
    {
      try
      {
        pull.references.Of(false).OnHost();
        pull.references.Of(true).OnHost();
        return false;
      }
      catch (const DeviceError&)
      {
        return true;
      }
    };
    this->pulls.erase(
      std::remove_if(this->pulls.begin(), this->pulls.end(), isLost), this->pulls.end());
  }

  Problem MakeProblem() const
  {
    Settings wanted = this->settings;
    if (this->Minimizes() && wanted.mode == Mode::Separate)
    {
      (this->lightRun ? wanted.weights.view : wanted.weights.light) = 0;
    }
    Problem made = this->onlyMeasures
      ? this->prepared->ProblemForEnergy(this->camera, this->light, wanted)
      : this->prepared->ProblemFor(this->camera, this->light, wanted);
    made.forLight = this->lightRun;
    made.isMeasuredOnly = this->onlyMeasures;
    made.DrawTo(this->pulls, this->lightRun, this->backend.IsOnGpu());
    return made;
  }

  void AssignBase(FoundExtinction& field) const
  {
    const float* baseField = this->scene.baseExtinction;
    field = std::vector<float>(baseField, baseField + this->scene.ValueCount());
  }

  /// Returns the first iterate. A run that only measures it on the processor, which never starts
  /// again, does not keep another copy.
  StartingExtinction FirstIterate()
  {
    StartingExtinction& given = this->lightRun ? this->initialLight : this->initial;
    const bool isLastUse = this->onlyMeasures && !this->backend.IsOnGpu();
    StartingExtinction start = isLastUse ? std::exchange(given, {}) : given;
    if (start)
    {
      this->problem.TakeIntoBounds(*start);
    }
    return start;
  }

  void MakeMinimizer(StartingExtinction start)
  {
    const Weights& weights = this->problem.settings.weights;
    this->runIterations = 0;
    this->runSmoothings = 0;
    this->runFound = false;
    this->hasBetter = false;
    const bool weightless = this->Minimizes() && !(weights.view > 0 || weights.light > 0);
    const bool nothingAtStake = weightless || !this->prepared->SomethingToSee();
    if (nothingAtStake)
    {
      // Only the regularisation is left; its minimum is the base extinction.
      this->AssignBase(this->lightRun ? this->lightExtinction : this->extinction);
      this->minimizer.reset();
      if (!this->lightRun)
      {
        this->base = this->ScoreOf(this->scene.baseExtinction);
        this->best = this->base;
        this->bestEnergy.view = -weights.view * this->base.visibility;
        IterationRecord record;
        record.energy = this->bestEnergy;
        record.score = this->base;
        this->history.push_back(record);
      }
      return;
    }
    this->minimizer = this->backend->MakeMinimizer(this->problem, std::move(start), this->warm);
    this->FreeFieldsNotNeeded();
    IterationRecord record = this->minimizer->Start();
    if (this->onlyMeasures && !HasLightExtinction(this->settings))
    {
      this->problem.DropImportance();
      this->prepared->FreeDerivedFields();
    }
    record.iteration = this->iterations;
    this->runLowest = record.energy.Total();
    if (!this->lightRun)
    {
      const bool tells = this->SeesAlong() && this->SamplesAsScores();
      this->base = tells ? this->minimizer->BaseScore() : this->ScoreOf(this->scene.baseExtinction);
      this->best =
        tells ? record.score : (this->warm ? std::nullopt : std::optional<Score>(this->base));
      this->bestEnergy = record.energy;
      record.score = this->best.value_or(Score());
    }
    this->history.push_back(record);
  }

  /// Frees fields that the minimiser has copied. Another run would need them again.
  void FreeFieldsNotNeeded()
  {
    if (this->minimizer->HasOwnFields())
    {
      this->problem.DropImportance();
      if (this->ownsScene && !HasLightExtinction(this->settings))
      {
        this->prepared->FreeDerivedFields();
      }
    }
  }

  /// Whether iterations measure what scores measure.
  bool SeesAlong() const { return this->problem.tellsScores; }

  /// Whether iterations also sample it like scores. If not, scores of iterates are less exact than
  /// the first and the last score, which have their own sweep.
  bool SamplesAsScores() const { return IsSampledAsScores(this->problem); }

  /// Whether records have scores.
  bool KnowsScores() const
  {
    return !this->Minimizes() || SeesWhatScoresAreOf(this->settings) ||
      this->settings.scoreIterations;
  }

  /// Whether the method iterates to minimise Eq. (21); other methods have one iteration.
  bool Minimizes() const { return InfoOf(this->settings.method).iterates; }

  Score ScoreOf(const ExtinctionInPlace& field) const
  {
    return this->ScoreBy(this->judge, field,
      [this]
      { return this->prepared->ProblemForScores(this->camera, this->light, this->settings); });
  }

  /// ScoreOf with the sampling of iterations.
  Score ScoreOfIterate(const ExtinctionInPlace& field) const
  {
    if (this->SamplesAsScores())
    {
      return this->ScoreOf(field);
    }
    return this->ScoreBy(this->judgeOfIterates, field,
      [this] {
        return this->prepared->ProblemForScoresOfIterates(
          this->camera, this->light, this->settings);
      });
  }

  template <class MakeProblem>
  Score ScoreBy(
    std::unique_ptr<Judge>& by, const ExtinctionInPlace& field, const MakeProblem& make) const
  {
    if (!by)
    {
      auto made = std::make_unique<Judge>();
      made->problem = make();
      made->sweeps = this->backend->SweepsFromCameras(made->problem);
      by = std::move(made);
    }
    return by->sweeps->ScoreOf(field);
  }

  const std::vector<float>& Extinction() const
  {
    return this->minimizer && !this->lightRun ? this->minimizer->Best() : this->extinction.OnHost();
  }

  /// Values of Extinction() or LightExtinction(), possibly without a copy.
  const float* Values(bool ofLight) const
  {
    return this->minimizer && this->lightRun == ofLight
      ? this->minimizer->BestValues()
      : (ofLight ? this->lightExtinction : this->extinction).OnHost().data();
  }

  /// Extinction, where it can be read without a transfer.
  ExtinctionInPlace InPlace() const
  {
    return this->minimizer && !this->lightRun ? this->minimizer->BestInPlace()
                                              : this->extinction.InPlace();
  }

  void FindTransmittance(bool ofLight, float* transmittance) const
  {
    const bool other = ofLight && HasLightExtinction(this->settings);
    const std::vector<float>& field = other ? this->LightExtinction() : this->Extinction();
    this->backend->FindTransmittance(this->problem,
      ofLight ? this->problem.Light() : this->problem.Camera(),
      std::max(this->settings.rayDensity, transmittanceRayDensity), field.data(), transmittance);
  }

  ExtinctionOnDevice OnDevice(bool ofLight) const
  {
    if (this->minimizer && this->lightRun == ofLight)
    {
      return this->minimizer->BestOnDevice();
    }
    return (ofLight ? this->lightExtinction : this->extinction).OnDevice();
  }

  const std::vector<float>& LightExtinction() const
  {
    return this->minimizer && this->lightRun ? this->minimizer->Best()
                                             : this->lightExtinction.OnHost();
  }

  int SmoothingLimit() const
  {
    const bool smooths = this->Minimizes() && this->settings.smoothness > 0;
    return smooths && this->minimizer->IterationLimit() > 0 ? smoothingSweeps : 0;
  }

  /// Fraction of the work done. A separate extinction for the light takes a second run.
  double Share() const
  {
    const double limit = this->minimizer->IterationLimit() + this->SmoothingLimit();
    const double made = this->runIterations + this->runSmoothings;
    const double ofRun = this->RunIsOver() ? 1.0 : std::min(1.0, made / std::max(1.0, limit));
    return HasLightExtinction(this->settings) ? 0.5 * (ofRun + (this->lightRun ? 1 : 0)) : ofRun;
  }

  /// Whether the optimum is found, or nearly if smoothing follows, which continues to minimise.
  bool IsFound() const
  {
    return this->runFound || this->runIterations >= this->minimizer->IterationLimit();
  }

  bool RunIsOver() const
  {
    return this->IsFound() && this->runSmoothings >= this->SmoothingLimit();
  }

  IterationRecord NextRecord()
  {
    if (this->IsFound())
    {
      ++this->runSmoothings;
      return this->minimizer->Smooth();
    }
    ++this->runIterations;
    const IterationRecord record = this->minimizer->Iterate();
    this->runFound =
      this->SmoothingLimit() > 0 ? this->minimizer->IsNear() : this->minimizer->Converged();
    return record;
  }

  /// Performs the next iteration or ends the run.
  void Iterate(const Progress& progress)
  {
    if (!this->minimizer || this->RunIsOver())
    {
      this->FinishRun();
      return;
    }
    const auto start = std::chrono::steady_clock::now();
    IterationRecord record = this->NextRecord();
    const bool better =
      record.isResult || (record.level == 0 && record.energy.Total() < this->runLowest);
    this->SetScore(record, better);
    ++this->iterations;
    this->seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    record.iteration = this->iterations;
    record.seconds = this->seconds;
    this->history.push_back(record);
    if (better)
    {
      this->KeepAsBest(record);
    }
    this->stopped =
      this->prepared->AnyOf(progress && !progress(this->Share(), this->Describe(record)));
    const bool late = this->prepared->AnyOf(
      this->settings.maximumSeconds > 0 && this->seconds >= this->settings.maximumSeconds);
    if (this->stopped || late || this->RunIsOver())
    {
      this->FinishRun();
    }
  }

  /// Sets the score of an iterate whose iteration has not measured it. `better`: whether it is the
  /// best so far.
  void SetScore(IterationRecord& record, bool better) const
  {
    if (!this->Minimizes() && !this->lightRun)
    {
      this->Judged(record);
    }
    else if (this->KnowsScores() && !this->SeesAlong() && !this->lightRun)
    {
      const bool isKnown = record.level == 0 && !better;
      record.score =
        isKnown ? this->history.back().score : this->ScoreOfIterate(this->minimizer->BestInPlace());
    }
  }

  void KeepAsBest(const IterationRecord& record)
  {
    this->runLowest = record.energy.Total();
    this->hasBetter = true;
    if (!this->lightRun)
    {
      this->bestEnergy = record.energy;
      const bool tells = this->KnowsScores() && (!this->Minimizes() || this->SamplesAsScores());
      this->best = tells ? std::optional<Score>(record.score) : std::nullopt;
    }
  }

  /// Replaces the view term of the energy by the score of the method's own measure.
  void Judged(IterationRecord& record) const
  {
    record.score = this->ScoreOf(this->minimizer->BestInPlace());
    record.energy.view = -this->settings.weights.view * record.score.visibility; // Eq. (23)
  }

  std::string Describe(const IterationRecord& record) const
  {
    std::ostringstream text;
    text.precision(3);
    text << "Iteration " << record.iteration;
    if (record.level > 0)
    {
      text << " at 1/" << (1 << record.level) << " resolution";
    }
    if (!this->lightRun && this->KnowsScores())
    {
      text << ": " << 100 * record.score.fraction << " % of the important structures visible";
    }
    return text.str();
  }

  /// Whether a result that only removes extinction shows less than the base. An exact minimum
  /// never does, except for a gain of the light. Smoothing and the despeckled importance minimise
  /// something else and can do so in noise. A little less is accepted only if the light weighs more
  /// than the view.
  bool ShowsLessThanBase()
  {
    const Settings& of = this->problem.settings;
    if (!this->Minimizes() || of.emphasis > 0 || !(of.weights.view > 0))
    {
      return false;
    }
    constexpr double leastForLight = 0.98;
    const double least = of.weights.light > of.weights.view ? leastForLight : 1.0;
    return this->BestScore().fraction < least * this->base.fraction;
  }

  /// BestScore of Solver, after a run has finished.
  const Score& BestScore()
  {
    if (!this->best)
    {
      this->best = this->ScoreOf(this->extinction.InPlace());
    }
    return *this->best;
  }

  void FinishRun()
  {
    FoundExtinction& result = this->lightRun ? this->lightExtinction : this->extinction;
    if (this->minimizer)
    {
      this->settled = this->settled && this->runFound;
      result = this->minimizer->TakeResult();
      this->minimizer.reset();
      if (!this->lightRun && this->ShowsLessThanBase())
      {
        this->AssignBase(result);
        this->best = this->base;
        this->problem = this->MakeProblem();
        this->bestEnergy = this->backend->MakeMinimizer(this->problem, {}, false)->Start().energy;
      }
      if (!this->lightRun && this->KnowsScores())
      {
        this->history.back().score = this->BestScore();
      }
    }
    this->judge.reset();
    this->judgeOfIterates.reset();
    const bool lightFollows = HasLightExtinction(this->settings) && !this->lightRun;
    if (!lightFollows || this->stopped)
    {
      this->done = true;
      return;
    }
    this->lightRun = true;
    this->problem = this->MakeProblem();
    this->MakeMinimizer(this->FirstIterate());
    this->done = !this->minimizer;
  }
};
}

#endif
