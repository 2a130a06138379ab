// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Keeps finished pictures of a still view, and shows them again if nothing that they depend on has
// changed.

#include "OpaqueDepth.h"
#include "VolumeView.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limpid
{
namespace
{
constexpr float endOfRange = 1; // in clip coordinates

// Each slice takes some time in addition to its rays.
constexpr double MostSlicesOfOriginal = 64;
}

PictureSubject VolumeView::SubjectOf(
  const FrameSettings& frame, const VolumeData& data, const ViewGeometry& geometry) const
{
  PictureSubject subject;
  subject.frame = frame;
  subject.geometry = geometry;
  const PictureFrame whole = FrameOf(geometry, 1);
  subject.rays = RaysOf(frame, geometry, data.Cropped().planes, whole);
  subject.depth = this->Opaque->IsEmpty() ? std::vector<float>() : this->Opaque->InMiddles(whole);
  subject.data = { { data.ScalarsVersion(), data.FunctionsVersion(), data.SceneVersion() } };
  subject.found = frame.optimize ? this->Optimization.Version() : 0;
  return subject;
}

// Shows a kept picture if there is one. Returns whether this completes the frame.
bool VolumeView::ShowKept(
  const FrameSettings& frame, const PictureSubject& subject, FrameMessages& messages)
{
  const KeptPicture* kept = this->Pictures.Find(subject);
  if (frame.AnyRank(!kept))
  {
    return false;
  }
  this->Geometry = subject.geometry;
  this->Frame = FrameOf(subject.geometry, 1);
  this->Rays = subject.rays;
  this->Image = kept->picture;
  this->LastResult = kept->result;
  this->LastResult.uploadedBytes = 0;
  this->GoesOn = false;
  this->RestsOptimized = frame.stepwise && frame.optimize;
  messages = kept->messages;
  this->Show(frame);
  return true;
}

// Keeps the picture of a finished frame.
void VolumeView::Keep(PictureSubject subject, const FrameMessages& messages)
{
  if (!this->LastResult.converged || !messages.errors.empty())
  {
    return;
  }
  subject.found = subject.frame.optimize ? this->Optimization.Version() : 0;
  if (!subject.frame.stepwise)
  {
    this->Pictures.KeepTile({ std::move(subject), this->Image, this->LastResult, messages });
    return;
  }
  this->RestsOptimized = subject.frame.optimize;
  this->Pictures.Keep({ std::move(subject), this->Image, this->LastResult, messages });
  this->Fine.Clear();
}

bool VolumeView::PrepareOriginal(const VolumeData& data)
{
  bool goesOn = false;
  if (!this->IsDrawing && !this->IsHidden())
  {
    this->WhileDrawing([&]() { goesOn = this->MakeOriginal(data); });
  }
  return goesOn;
}

// Computes a part of the picture without optimisation. Returns whether work is left.
bool VolumeView::MakeOriginal(const VolumeData& data)
{
  this->Reports = false;
  const KeptPicture* optimized = this->Pictures.Optimized();
  if (!this->RestsOptimized || !optimized || optimized->subject.frame.IsOfSeveral())
  {
    return false;
  }
  const PictureSubject& shown = optimized->subject;
  const bool isCurrent = shown.data[0] == this->ScalarsVersion &&
    shown.data[0] == data.ScalarsVersion() && shown.data[1] == data.FunctionsVersion() &&
    shown.data[2] == data.SceneVersion() && shown.found == this->Optimization.Version();
  PictureSubject original = shown.WithoutOptimization();
  if (!isCurrent || this->Pictures.Find(original))
  {
    return false;
  }
  const FrameSettings& frame = original.frame;
  FrameMessages messages = optimized->messages;
  FrameResult result = optimized->result;
  result.optimized = false;
  result.score = result.baseScore;
  result.ceiling = Ceiling();
  this->UpdateRenderer(frame, data);
  this->UseImportance(frame, data, messages);
  this->UseStructures(frame, data);
  this->Optimization.ShowBase(frame, data);
  this->Shadows.MakeFine(true);
  this->Caster.Prepare();
  const double rays = double(original.rays.width) * original.rays.height;
  SlicedPicture::Wanted wanted{ original.rays,
    original.depth.empty() ? std::vector<float>(std::size_t(rays), endOfRange) : original.depth,
    this->Caster.Changes() };
  if (!this->Original.Shows(wanted))
  {
    const double slices = std::ceil(this->Budget.SecondsOf(rays) / frame.frameTime);
    this->Original.Begin(
      std::move(wanted), static_cast<int>(std::clamp(slices, 1.0, MostSlicesOfOriginal)));
    return true; // this step took its time
  }
  if (!messages.errors.empty() || !this->AdvanceOriginal(frame.frameTime))
  {
    return false;
  }
  if (!this->Original.IsComplete())
  {
    return true;
  }
  this->Pictures.Keep({ std::move(original), this->Original.Whole(), result, messages });
  this->Original.Clear();
  return false;
}

// Computes slices of the picture without optimisation. Returns false if aborted.
bool VolumeView::AdvanceOriginal(double seconds)
{
  const auto start = FrameClock::SteadyClock::now();
  const auto isOutOfTime = [&]() { return FrameClock::SecondsSince(start) > seconds; };
  const bool goesOn = this->Original.Advance(isOutOfTime,
    [this](const View& view) { return this->MakePicture(view) ? &this->Part : nullptr; });
  this->CastSeconds = 0; // it would not be the time of a whole picture
  return goesOn;
}
}
