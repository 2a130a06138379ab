// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ViewOptimization.h"

#include "ViewGeometry.h"

#include "backend/Interruption.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limpid
{
namespace
{
// Share of a moving frame's time that the optimisation gets at most.
constexpr double OptimizationShare = 0.4;

// A change is over when less than this is left of it: half a step of an 8-bit picture in motion;
// at rest, the picture becomes sharp in the same moment and hides more.
constexpr double LeastChange = 1.0 / 512;
constexpr double LeastChangeAtRest = 1.0 / 32;
}

// Makes an optimiser for the present data and functions, which goes on from what was shown of the
// last ones.
void ViewOptimization::TakeScene(const FrameSettings& frame, const VolumeData& data)
{
  CarriedChange shown =
    this->Optimizer && this->HasShownFound() ? this->Optimizer->Change() : CarriedChange();
  // Who edits anything gets what it makes, as if nothing else had been shown.
  shown.likeness = this->SceneTimeVersion != data.TimeVersion() ? likenessInTime : 0;
  this->Optimizer.reset();
  this->Most.reset();
  this->Front.reset();
  this->Base = nullptr;
  auto optimizer = std::make_unique<Progressive>(data.Scene(), frame.solver);
  optimizer->GoOnFrom(shown);
  this->Optimizer = std::move(optimizer);
  this->Base = data.BaseExtinction();
  this->SceneVersion = data.SceneVersion();
  this->SceneTimeVersion = data.TimeVersion();
}

// Tells the optimiser what it works for. Returns whether that is known at all.
bool ViewOptimization::TakeView(const FrameSettings& frame, const Camera& camera)
{
  const bool once = frame.optimize && frame.once;
  const bool keeps = this->HasView && (frame.paused || (once && this->IsOnceView));
  if (!keeps && once && !frame.still)
  {
    return false; // the first still frame decides
  }
  const Light& light = frame.light.light;
  const std::vector<Camera> cameras = CamerasOf(frame.views, camera, OrbitStart::Fixed);
  // What goes round with the camera would change what is to stay while it does.
  const bool goesRound = frame.light.movesWithCamera && frame.views.kind == ViewKind::Orbit;
  const bool hasLight = frame.light.found && !goesRound;
  const bool same = this->HasView && AreSame(cameras, this->ViewCameras) &&
    (AreSame(light, this->ViewLight) || !hasLight);
  if (!keeps && !same)
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
  this->Optimizer->SetView(this->ViewCameras.front(), this->ViewLight, settings);
  return true;
}

// The next step, which is an iteration but for the first one: that takes longer, and may be stopped
// in its midst. Returns whether there is nothing left to do.
bool ViewOptimization::Refine(const std::function<bool()>& isAborted)
{
  std::optional<Interruptible> beginning;
  if (!this->Optimizer->HasBegun())
  {
    beginning.emplace([&isAborted]() { return !isAborted(); });
  }
  return this->Optimizer->Refine();
}

// Whether a change of the picture may begin at what was carried over from the last scene: not if
// that shows less of this one than its base extinction does. Moving frames have no time to find
// out.
bool ViewOptimization::EasesFromCarried(const FrameSettings& frame)
{
  if (!frame.still || !frame.stepwise || frame.easeTime == 0)
  {
    return false;
  }
  this->Optimizer->ShowNoLessThanBase();
  return this->Optimizer->ShowsFound();
}

// Lets the optimiser work for as long as the frame allows. Returns whether it has.
bool ViewOptimization::Work(
  const FrameSettings& frame, const FrameClock& clock, const std::function<bool()>& isAborted)
{
  if (this->Optimizer->Converged())
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
    const bool done = this->Refine(isAborted);
    const bool outOfTime = frame.stepwise && frame.AnyRank(clock.Seconds() > until);
    goOn = !done && !outOfTime && !isAborted();
  }
  return true;
}

// Brings what the optimiser shows into the picture, at once or bit by bit. `seconds`: since the
// last frame.
void ViewOptimization::Show(const FrameSettings& frame, double seconds, bool changed, bool mayEase)
{
  if (!changed && !this->ShowsBase && this->Remaining == 0)
  {
    return;
  }
  const bool eases =
    mayEase && !this->HidesFound && frame.easeTime > 0 && (frame.stepwise || !frame.still);
  // At least a little: a clock may stand still between two frames.
  double share = eases ? std::max(1 - std::exp(-seconds / frame.easeTime), 0.01) : 1;
  this->Remaining = (1 - share) * (changed || this->ShowsBase ? 1 : this->Remaining);
  if (this->Remaining < (frame.still ? LeastChangeAtRest : LeastChange))
  {
    this->Remaining = 0;
    share = 1;
  }
  const bool separate = HasLightExtinction(frame.solver);
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
    const auto set = frame.ranks && !this->Optimizer->ShowsPiece() ? &Renderer::SetExtinctionOfAll
                                                                   : &Renderer::SetExtinction;
    (this->Pictures.*set)(grid, this->Optimizer->BaseExtinction(), this->Optimizer->Extinction(),
      share, separate ? this->Optimizer->LightExtinction() : nullptr);
  }
  this->ShowsBase = false;
  this->HidesFound = false;
}

// What the frame's camera sees, which is not the one that the optimiser works for while the
// extinction is kept, or not the only one. Moving frames have no time for that: they repeat what
// was measured last.
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

// What of `all` the frame's camera sees in front of opaque geometry. Moving frames repeat what was
// measured last, likewise.
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

// What the frame's camera could see at most, whatever the extinction was optimised for. It is found
// once for a camera, a light and settings of a scene.
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
  // What has been found stays, for when optimization is on again.
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
    changed = this->Work(frame, clock, isAborted) || changed;
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
  result.score = frame.optimize ? scores.best : scores.base;
  result.baseScore = scores.base;
  result.iterations = this->Optimizer->Iterations();
  result.settled = this->Optimizer->Settled();
  result.backend = this->Optimizer->BackendName();
  result.converged =
    frame.still && (frozen || this->Optimizer->Converged()) && this->Remaining == 0;
  if (frame.optimize && result.converged)
  {
    result.ceiling = this->FindCeiling(frame, camera, opaque, result.score);
  }
}

void ViewOptimization::ShowBase(const FrameSettings& frame, const VolumeData& data)
{
  const float* caster = frame.lit ? data.ShadowCaster() : nullptr;
  const std::uint64_t version = caster ? data.FunctionsVersion() : 0;
  if (!this->ShowsBase || version != this->CasterVersion)
  {
    this->Pictures.SetExtinction(caster ? data.Nodes() : Grid(), caster, caster);
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
  this->Base = nullptr;
  this->ShowsBase = true;
  this->HidesFound = false;
  ++this->Changes;
  this->CasterVersion = 0;
  this->Remaining = 0;
}

void ViewOptimization::Stop()
{
  this->Pictures.SetExtinction(Grid(), nullptr, nullptr);
  this->Release();
}

void ViewOptimization::Reset()
{
  this->Stop();
  this->HasView = false;
}

bool ViewOptimization::ShowsPiece(const FrameSettings& frame) const
{
  return frame.ranks &&
    (this->ShowsBase ? this->CasterVersion != 0 : this->Optimizer->ShowsPiece());
}

const Grid* ViewOptimization::ShownGrid() const
{
  return this->ShowsBase ? nullptr : &this->Optimizer->ShownGrid();
}
}
