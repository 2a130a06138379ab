// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ViewOptimization.h"

#include "PickedStructure.h"
#include "ViewGeometry.h"

#include "backend/Interruption.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limpid
{
namespace
{
// Largest share of the optimisation in the time of a frame during interaction.
constexpr double OptimizationShare = 0.4;

// A change is complete if less than this is left of it: half a step of an 8-bit picture during
// interaction. In still frames, the picture becomes sharp at the same moment, which hides more.
constexpr double LeastChange = 1.0 / 512;
constexpr double LeastChangeAtRest = 1.0 / 32;
}

// Creates an optimiser for the present data and functions, which starts from what was shown for the
// previous ones.
void ViewOptimization::TakeScene(const FrameSettings& frame, const VolumeData& data)
{
  CarriedChange shown =
    this->Optimizer && this->HasShownFound() ? this->Optimizer->Change() : CarriedChange();
  // After edits of data or settings, the result must not depend on what was shown before.
  shown.likeness = this->SceneTimeVersion != data.TimeVersion() ? likenessInTime : 0;
  this->Optimizer.reset();
  this->Most.reset();
  this->Front.reset();
  this->OfStructures = {};
  this->Fields = nullptr;
  this->Targets.TakeStructures(data);
  auto optimizer = std::make_unique<Progressive>(data.Scene(), frame.solver);
  optimizer->GoOnFrom(shown);
  this->Optimizer = std::move(optimizer);
  this->Fields = data.SceneOwner();
  this->Part = data.ScenePart();
  this->SceneVersion = data.SceneVersion();
  this->SceneTimeVersion = data.TimeVersion();
}

// Sets the cameras and the light of the optimiser. Returns whether these are known.
bool ViewOptimization::TakeView(const FrameSettings& frame, const Camera& camera)
{
  const bool once = frame.optimize && frame.once;
  const bool keeps = this->HasView && (frame.paused || (once && this->IsOnceView));
  if (!keeps && once && !frame.still)
  {
    return false; // the first still frame sets the view
  }
  const Light& light = frame.light.light;
  const std::vector<Camera> cameras = CamerasOf(frame.views, camera, OrbitStart::Fixed);
  // A light that moves with the camera would change the result of an orbit while the camera moves.
  const bool goesRound = frame.light.movesWithCamera && frame.views.kind == ViewKind::Orbit;
  const bool hasLight = frame.light.found && !goesRound;
  const bool same = this->HasView && AreSame(cameras, this->ViewCameras) &&
    (AreSame(light, this->ViewLight) || !hasLight);
  const bool isOther = !keeps && !same;
  if (isOther)
  {
    this->ViewCameras = cameras;
    this->ViewLight = light;
    this->HasView = true;
  }
  this->IsOnceView = once;
  this->IsBaseView = !frame.optimize;
  this->ViewSettings = frame.solver;
  Settings settings = ForCameras(frame.solver, this->ViewCameras);
  settings.weights.light = hasLight ? settings.weights.light : 0.0;
  if (this->IsBaseView)
  {
    settings.maximumIterations = 0;
    settings.iterationsPerLevel = { { 0, 0, 0 } };
  }
  else
  {
    settings = isOther ? this->Targets.TakeSettings(settings) : this->Targets.SettingsFor(settings);
  }
  this->Optimizer->SetView(this->ViewCameras.front(), this->ViewLight, settings);
  return true;
}

// Makes the next step, which is one iteration. The first step takes longer and can be interrupted.
// Returns whether the optimisation is complete.
bool ViewOptimization::Refine(const std::function<bool()>& isAborted)
{
  std::optional<Interruptible> beginning;
  if (!this->Optimizer->HasBegun())
  {
    beginning.emplace([&isAborted]() { return !isAborted(); });
  }
  return this->Optimizer->Refine();
}

// Returns whether a change of the picture may start at the result that was carried over from the
// previous scene. It may not if that result shows less of this scene than its base extinction does.
// Frames during interaction have no time to determine this.
bool ViewOptimization::EasesFromCarried(const FrameSettings& frame)
{
  if (!frame.still || !frame.stepwise || frame.easeTime == 0)
  {
    return false;
  }
  this->Optimizer->ShowNoLessThanBase();
  return this->Optimizer->ShowsFound();
}

// Returns whether nothing is left to do for the view.
bool ViewOptimization::IsComplete() const
{
  return this->Optimizer->Converged() && (this->IsBaseView || !this->Targets.AreOpen());
}

// Judges a complete result by the targets of structures, in the mean of all cameras. Opaque
// geometry counts for a single camera, that of the frame. Returns whether the optimisation begins
// again, with other importances; the result stays shown until there is a new one.
bool ViewOptimization::TriesOtherImportances(const VolumeData& data,
  const std::optional<OpaqueGeometry>& opaque, const std::function<bool()>& isAborted)
{
  const Interruptible interruptible([&isAborted]() { return !isAborted(); });
  const bool ends = opaque && this->ViewCameras.size() == 1;
  if (!this->Targets.Judge(this->Optimizer->SharesFrom(this->ViewCameras, *data.Labelled(),
        data.SceneRows(), this->Optimizer->Extinction(), ends ? &*opaque : nullptr)))
  {
    return false;
  }
  CarriedChange shown = this->Optimizer->Change();
  shown.likeness = 0;
  this->Optimizer.reset();
  const Settings settings = this->Targets.TriedSettings();
  this->Optimizer = std::make_unique<Progressive>(this->Targets.Scene(data), settings);
  this->Optimizer->GoOnFrom(shown);
  this->Optimizer->SetView(this->ViewCameras.front(), this->ViewLight, settings);
  this->Most.reset();
  this->Front.reset();
  this->Elsewhere.reset();
  return true;
}

// Runs the optimiser as long as the frame's time allows. Returns whether it did anything.
bool ViewOptimization::Work(const FrameSettings& frame, const VolumeData& data,
  const std::optional<OpaqueGeometry>& opaque, const FrameClock& clock,
  const std::function<bool()>& isAborted)
{
  if (this->IsComplete())
  {
    return false;
  }
  if (!frame.still)
  {
    this->Optimizer->Preview(OptimizationShare * frame.frameTime);
    return true;
  }
  const double until = clock.Seconds() + frame.frameTime;
  bool goOn = true;
  while (goOn)
  {
    const bool done = (this->Optimizer->Converged() || this->Refine(isAborted)) &&
      (this->IsComplete() || !this->TriesOtherImportances(data, opaque, isAborted));
    const bool outOfTime = frame.stepwise && frame.AnyRank(clock.Seconds() > until);
    goOn = !done && !outOfTime && !isAborted();
  }
  return true;
}

// Passes the optimiser's result to the picture, at once or gradually. `seconds`: time since the
// last frame.
void ViewOptimization::Show(const FrameSettings& frame, double seconds, bool changed, bool mayEase)
{
  if (!changed && !this->ShowsBase && this->Remaining == 0)
  {
    return;
  }
  const bool eases =
    mayEase && !this->HidesFound && frame.easeTime > 0 && (frame.stepwise || !frame.still);
  // At least a little, since a clock may return equal times for two frames.
  double share = eases ? std::max(1 - std::exp(-seconds / frame.easeTime), 0.01) : 1;
  this->Remaining = (1 - share) * (changed || this->ShowsBase ? 1 : this->Remaining);
  if (this->Remaining < (frame.still ? LeastChangeAtRest : LeastChange))
  {
    this->Remaining = 0;
    share = 1;
  }
  this->SetFound(share);
}

// Lets the picture begin the next change at the result of the optimiser instead of the base
// extinction.
void ViewOptimization::ShowFoundAgain()
{
  if (this->HidesFound)
  {
    this->SetFound(1);
  }
}

// Passes a share of the optimiser's result to the picture.
void ViewOptimization::SetFound(double share)
{
  const bool separate = HasLightExtinction(this->ViewSettings);
  const Grid& grid = this->Optimizer->ShownGrid();
  const ShownOnDevice there =
    this->Pictures.DrawsOnDevice() ? this->Optimizer->OnDevice() : ShownOnDevice();
  if (there.light)
  {
    this->Pictures.ShowThere(
      grid, there.fields.base, there.fields.extinction, share, separate ? there.light : nullptr);
  }
  else
  {
    this->Pictures.SetExtinction(this->Optimizer->ShowsPiece() ? this->Part : grid,
      this->Optimizer->BaseExtinction(), this->Optimizer->Extinction(), share,
      separate ? this->Optimizer->LightExtinction() : nullptr);
  }
  this->ShowsBase = false;
  this->HidesFound = false;
}

// Returns the scores for the frame's camera. It differs from the optimiser's camera if the
// extinction is kept or if there are several cameras. Frames during interaction have no time for
// this and repeat the last scores.
Scores ViewOptimization::Measure(const FrameSettings& frame, const Camera& camera, bool changed)
{
  if (AreSame(std::vector<Camera>{ camera }, this->ViewCameras))
  {
    this->Elsewhere.reset();
    return { this->Optimizer->BaseScore(), this->Optimizer->BestScore() };
  }
  const bool current = this->Elsewhere && !changed && AreSame(camera, this->ElsewhereCamera);
  if (!current && (frame.still || !this->Elsewhere))
  {
    this->Elsewhere = this->Optimizer->ScoresFrom(camera);
    this->ElsewhereCamera = camera;
  }
  return *this->Elsewhere;
}

// Returns the part of the scores `all` that is in front of opaque geometry. Frames during
// interaction repeat the last scores.
Scores ViewOptimization::InFront(const FrameSettings& frame, const Camera& camera,
  const std::optional<OpaqueGeometry>& opaque, const Scores& all, bool changed)
{
  if (!opaque)
  {
    this->Front.reset();
    return all;
  }
  const bool current = this->Front && !changed && AreSame(camera, this->Front->camera) &&
    *opaque == this->Front->opaque;
  if (!current && (frame.still || !this->Front))
  {
    this->Front = { camera, *opaque, this->Optimizer->ScoresFrom(camera, &*opaque) };
  }
  const Scores& front = this->Front->scores;
  return { OfAll(front.base, all.base), OfAll(front.best, all.best) };
}

// Returns the upper bound for the frame's camera, independent of the camera of the optimisation. It
// is computed once per camera, light, settings and scene.
Ceiling ViewOptimization::FindCeiling(const FrameSettings& frame, const Camera& camera,
  const std::optional<OpaqueGeometry>& opaque, const Score& found)
{
  const bool known = this->Most && AreSame(camera, this->Most->camera) &&
    opaque == this->Most->opaque && AreSame(this->ViewLight, this->Most->light) &&
    frame.solver == this->Most->settings;
  if (!known)
  {
    this->Most = { camera, opaque, this->ViewLight, frame.solver,
      this->Optimizer->CeilingFrom(camera, opaque ? &*opaque : nullptr) };
  }
  Ceiling ceiling = this->Most->value;
  ceiling.fraction *= opaque ? ShareInFront(this->Front->scores.base, found) : 1.0;
  if (ceiling.visibility > 0)
  {
    ceiling.visibility = std::max(ceiling.visibility, found.visibility);
    ceiling.fraction = std::max(ceiling.fraction, found.fraction);
  }
  return ceiling;
}

void ViewOptimization::Advance(const FrameSettings& frame, const VolumeData& data,
  const Camera& camera, const std::optional<OpaqueGeometry>& opaque, const FrameClock& clock,
  const std::function<bool()>& isAborted, FrameResult& result)
{
  if (this->DataVersion != data.DataVersion())
  {
    this->HasView = false;
    this->DataVersion = data.DataVersion();
  }
  if (!data.HasImportance() || !frame.measure || (!frame.ShowsExtinction() && !frame.still))
  {
    this->ShowBase(frame, data);
    return;
  }
  const bool isNew = !this->Optimizer || this->SceneVersion != data.SceneVersion();
  const bool carries = isNew && this->HasShownFound();
  if (isNew)
  {
    this->TakeScene(frame, data);
  }
  bool changed = isNew;
  // The result is kept for when optimization is switched on again.
  const bool found =
    this->HasView && !this->IsBaseView && !changed && frame.solver == this->ViewSettings;
  const bool pauses =
    frame.paused && !changed && (this->HasShownFound() || !frame.ShowsExtinction());
  const bool frozen = frame.optimize ? pauses && this->HasView : found;
  if (!frozen && !this->TakeView(frame, camera))
  {
    this->ShowBase(frame, data);
    result.converged = false;
    return;
  }
  const bool goesOn = !carries || this->EasesFromCarried(frame);
  if (!frozen)
  {
    changed = this->Work(frame, data, opaque, clock, isAborted) || changed;
    this->Optimizer->ShowNoLessThanBase();
  }
  this->Changes += changed ? 1 : 0;
  const bool eases = goesOn && this->Optimizer->ShowsFound();
  frame.ShowsExtinction()
    ? this->Show(frame, frame.Largest(clock.SecondsSinceLast()), changed, eases)
    : this->ShowBase(frame, data);

  const Scores scores =
    this->InFront(frame, camera, opaque, this->Measure(frame, camera, changed), changed);
  result.measured = true;
  result.optimized = frame.optimize;
  result.score = frame.optimize ? scores.best : scores.base;
  result.baseScore = scores.base;
  result.iterations = this->Optimizer->Iterations();
  result.settled = this->Optimizer->Settled();
  result.backend = this->Optimizer->BackendName();
  const ControlGrid& control = data.SceneResolution();
  result.optimizedAt = control.factor > 1 ? control.Text() : "";
  result.converged = frame.still && (frozen || this->IsComplete()) && this->Remaining == 0;
  result.warning = frame.optimize ? this->Targets.Warning() : "";
  if (frame.optimize && result.converged)
  {
    result.ceiling = this->FindCeiling(frame, camera, opaque, result.score);
  }
}

void ViewOptimization::MeasureStructures(
  const Look& look, const VolumeData& data, const std::function<bool()>& isAborted)
{
  const bool fits = this->Optimizer && this->SceneVersion == data.SceneVersion();
  if (!fits || !data.Labelled() || this->SharesOfStructures(look))
  {
    return;
  }
  const Interruptible interruptible([&isAborted]() { return !isAborted(); });
  const float* seen =
    look.optimized ? this->Optimizer->Extinction() : this->Optimizer->BaseExtinction();
  std::optional<KnownShares>& known = this->OfStructures[look.optimized ? 1 : 0];
  known = { look, this->Changes, {} }; // what is impossible is not tried again
  try
  {
    const Structures* tried = this->Targets.Tried();
    known->shares = this->Optimizer->SharesFrom({ look.camera }, tried ? *tried : *data.Labelled(),
      data.SceneRows(), seen, look.opaque ? &*look.opaque : nullptr);
    if (!this->IsBaseView && AreSame(std::vector<Camera>{ look.camera }, this->ViewCameras))
    {
      this->Targets.RaiseCeilings(known->shares);
    }
  }
  catch (const Interrupted&)
  {
    known.reset();
    throw;
  }
}

const std::vector<StructureShares>* ViewOptimization::SharesOfStructures(const Look& look) const
{
  const std::optional<KnownShares>& known = this->OfStructures[look.optimized ? 1 : 0];
  const bool isCurrent = known && AreSame(look.camera, known->look.camera) &&
    look.opaque == known->look.opaque && known->version == this->Changes;
  return isCurrent ? &known->shares : nullptr;
}

StructureRow ViewOptimization::PickStructure(
  const Vec3& begin, const Vec3& end, bool optimized, const VolumeData& data) const
{
  const bool fits = this->Optimizer && this->SceneVersion == data.SceneVersion() &&
    this->Optimizer->ShownGrid().nodes == this->Part.Whole().nodes;
  if (!fits || !data.Labelled())
  {
    return 0;
  }
  return PickedStructure(this->Part.Whole(), data.SceneRows(),
    optimized ? this->Optimizer->Extinction() : this->Optimizer->BaseExtinction(), begin, end);
}

void ViewOptimization::ShowBase(const FrameSettings& frame, const VolumeData& data)
{
  const float* caster = frame.lit ? data.ShadowCaster() : nullptr;
  const std::uint64_t version = caster ? data.FunctionsVersion() : 0;
  if (!this->ShowsBase || version != this->CasterVersion)
  {
    this->Pictures.SetExtinction(data.Drawn(), caster, caster);
    this->HidesFound = this->HasShownFound();
    this->ShowsBase = true;
    this->CasterVersion = version;
  }
  this->Remaining = 0;
}

void ViewOptimization::Release()
{
  this->Optimizer.reset();
  this->Most.reset();
  this->Front.reset();
  this->OfStructures = {};
  this->Fields = nullptr;
  this->ShowsBase = true;
  this->HidesFound = false;
  this->CasterVersion = 0;
  this->Remaining = 0;
}

void ViewOptimization::Stop()
{
  this->Pictures.SetExtinction(Grid(), nullptr, nullptr);
  this->Release();
  ++this->Changes;
}

void ViewOptimization::Reset()
{
  this->Stop();
  this->HasView = false;
}

bool ViewOptimization::ShowsPiece(const FrameSettings& frame) const
{
  return frame.IsOfSeveral() &&
    (this->ShowsBase ? this->CasterVersion != 0 : this->Optimizer->ShowsPiece());
}

const Grid* ViewOptimization::ShownGrid() const
{
  return this->ShowsBase ? nullptr : &this->Optimizer->ShownGrid();
}
}
