// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Computes the pictures of a volume and draws them into the view.

#include "VolumeView.h"

#include "EnlargedPicture.h"
#include "OpaqueDepth.h"

#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkVolumeCollection.h"

#include "backend/Backend.h"
#include "backend/Interruption.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace limpid
{
namespace
{
// Alpha above which a pixel counts as hit in a selection.
constexpr double VisibleAlpha = 0.05;

// Time that a frame may spend on a picture at full resolution, in units of the time limit during
// interaction: about that of one step of the optimisation.
constexpr double SliceShare = 3;

// Time constant of the transition to the sharp picture, in units of that of other changes; nothing
// else changes during it.
constexpr double SharpeningShare = 1.0 / 3;

// Each slice takes some time in addition to its rays.
constexpr double MostSlices = 16;
}

// Casts the rays of a picture. Returns false if aborted.
bool VolumeView::MakePicture(const View& view)
{
  const auto start = FrameClock::SteadyClock::now();
  try
  {
    const Interruptible interruptible([this](double share) { return !this->IsAborted(share); });
    this->Caster.Render(view, this->Part);
  }
  catch (const Interrupted&)
  {
    this->Part = Picture(); // VTK does not show aborted pictures
    return false;
  }
  this->CastSeconds += this->Backend.HasBegun() ? 0 : FrameClock::SecondsSince(start);
  return true;
}

// Runs an action of drawing. Requests of observers during it take effect afterwards. `again`:
// repeats the action on the processor if a GPU fails.
void VolumeView::WhileDrawing(const Action& action, const Action& again)
{
  this->IsDrawing = true;
  try
  {
    try
    {
      action();
    }
    catch (const DeviceError& error)
    {
      if (!this->Backend.GiveUpGpu(error.what()))
      {
        throw;
      }
      this->ReleaseNow();
      again();
    }
  }
  catch (...)
  {
    this->EndDrawing();
    throw;
  }
  this->EndDrawing();
}

FrameResult VolumeView::Prepare(
  const FrameSettings& settings, const VolumeData& data, FrameMessages& messages)
{
  const FrameSettings frame = this->InTime(settings);
  this->WhileDrawing([&]() { this->PrepareNow(frame, data, messages); });
  this->PrepareAgain = [this, frame, &data]()
  {
    FrameMessages told;
    this->PrepareNow(frame, data, told);
  };
  return this->LastResult;
}

FrameResult VolumeView::Draw(
  const FrameSettings& settings, const VolumeData& data, FrameMessages& messages)
{
  const FrameSettings frame = this->InTime(settings);
  this->WhileDrawing([&]() { this->DrawNow(frame, data, messages); });
  return this->LastResult;
}

void VolumeView::DrawNow(
  const FrameSettings& frame, const VolumeData& data, FrameMessages& messages)
{
  const std::optional<ViewGeometry> geometry = this->BeginFrame(frame, data, messages);
  if (!geometry)
  {
    return;
  }
  // The pictures of two eyes would restart each other.
  const bool stereo = this->Target->GetRenderWindow()->GetStereoRender() != 0;
  const bool inSteps = frame.still && frame.stepwise && !stereo;
  const bool isKept = inSteps || (frame.still && !frame.stepwise);
  PictureSubject subject = isKept ? this->SubjectOf(frame, data, *geometry) : PictureSubject();
  // What is known of structures is not kept.
  const bool measures = frame.measure && data.Labelled() && !this->Optimization.IsThere();
  if (isKept && !measures && this->ShowKept(frame, subject, messages))
  {
    return;
  }
  this->PrepareFrame(frame, data, *geometry, messages);
  if (!this->Geometry)
  {
    return;
  }
  const bool inSlices = inSteps && !this->GoesOn;
  if (!(inSlices ? this->DrawInSlices(frame) : this->DrawWhole(frame)))
  {
    this->LastResult.converged = false;
  }
  this->TellWhatDraws(messages);
  if (isKept)
  {
    this->Keep(std::move(subject), messages);
  }
}

OpaqueDepth VolumeView::OpaqueOf(const FrameSettings& frame, const ViewGeometry& geometry) const
{
  OpaqueDepth opaque(this->Target, geometry);
  if (frame.IsOfSeveral())
  {
    // A process may have opaque geometry that hides the pieces of others.
    opaque.TakeNearestOf(*frame.ranks);
  }
  return opaque;
}

// Draws the whole picture in one step. Returns false if aborted.
bool VolumeView::DrawWhole(const FrameSettings& frame)
{
  const OpaqueDepth& opaque = *this->Opaque;
  const ViewGeometry& geometry = *this->Geometry;
  const bool coarse = this->Frame.whole != geometry.size;
  const std::vector<DepthRange> ranges = coarse && !opaque.IsEmpty() && !frame.IsOfSeveral()
    ? opaque.RangesOf(this->Frame)
    : std::vector<DepthRange>();
  if (!ranges.empty())
  {
    this->Sharpening.Clear(); // the transition would mix two pictures
    return this->DrawBetween(ranges);
  }
  const std::vector<float> depth =
    opaque.IsEmpty() ? std::vector<float>() : opaque.InMiddles(this->Frame);
  View view = this->Rays;
  view.depth = depth.empty() ? nullptr : depth.data();
  if (!this->MakePicture(view))
  {
    return false;
  }
  this->Image = std::move(this->Part);
  this->Show(frame);
  if (frame.stepwise || !frame.still)
  {
    this->Sharpening.Begin(this->Image, this->Frame, geometry);
  }
  return true;
}

namespace
{
// When processes draw together, IceT blends their pictures in 8 bits without clamping: where a
// pixel's light exceeds its alpha, white would overflow to black. So opaque geometry behind is
// blended here.
void BlendOver(const std::uint8_t* behind, std::uint8_t* pixel)
{
  const int passed = 255 - pixel[3];
  for (int channel = 0; channel < 3; ++channel)
  {
    const int sum = pixel[channel] + (passed * behind[channel] + 127) / 255;
    pixel[channel] = static_cast<std::uint8_t>(std::min(sum, 255));
  }
  pixel[3] = 255;
}

// Raises alpha to the largest channel, for pixels whose background is unknown: less of it shines
// through, and the sum does not overflow.
void HideAsMuchAsIsAdded(std::uint8_t* pixel)
{
  pixel[3] = std::max({ pixel[0], pixel[1], pixel[2], pixel[3] });
}

bool HasSeveralVolumes(vtkRenderer* renderer)
{
  int count = 0;
  vtkVolumeCollection* volumes = renderer->GetVolumes();
  vtkCollectionSimpleIterator position;
  volumes->InitTraversal(position);
  while (vtkVolume* volume = volumes->GetNextVolume(position))
  {
    count += volume->GetVisibility() ? 1 : 0;
  }
  return count > 1;
}
}

// Draws the frame's picture into the view.
void VolumeView::Show(const FrameSettings& frame)
{
  frame.IsOfSeveral()
    ? this->ShowShared(*frame.ranks)
    : this->Quad.Draw(this->Target, this->Image, this->Frame, this->Geometry->nearest);
}

// Draws the pixels in which this process's piece is foremost.
void VolumeView::ShowShared(const Communicator& ranks)
{
  const PictureFrame view = FrameOf(*this->Geometry, 1);
  Picture own = this->Frame.whole == view.whole
    ? this->Image
    : EnlargedPicture(this->Image, this->Frame, view).Whole();
  const bool several = HasSeveralVolumes(this->Target);
  const int rank = ranks.Rank();
  constexpr Index rowsPerTask = 16;
  ParallelFor(own.height, rowsPerTask,
    [&](Index row)
    {
      for (int column = 0; column < own.width; ++column)
      {
        const std::size_t at = std::size_t(row) * std::size_t(own.width) + std::size_t(column);
        std::uint8_t* pixel = &own.rgba[4 * at];
        const std::uint8_t* behind = this->Opaque->ColorAt(view, column, static_cast<int>(row));
        if (own.foremost[at] != rank)
        {
          std::fill_n(pixel, 4, std::uint8_t(0));
        }
        else if (behind && pixel[3] > 0)
        {
          BlendOver(behind, pixel);
        }
        else if (several)
        {
          HideAsMuchAsIsAdded(pixel);
        }
      }
    });
  this->Quad.Draw(this->Target, own, view, this->Geometry->nearest);
}

// Draws a picture in slices over several frames. Until it is complete, a coarse one as during
// interaction is shown. Returns false if aborted.
bool VolumeView::DrawInSlices(const FrameSettings& frame)
{
  const OpaqueDepth& opaque = *this->Opaque;
  const ViewGeometry geometry = *this->Geometry;
  const double rays = double(this->Rays.width) * this->Rays.height;
  constexpr float end = 1; // end of the clipping range
  SlicedPicture::Wanted wanted{ this->Rays,
    opaque.IsEmpty() ? std::vector<float>(std::size_t(rays), end) : opaque.InMiddles(this->Frame),
    this->Caster.Changes() };
  const double seconds = SliceShare * frame.frameTime;
  if (frame.AnyRank(!this->Fine.Shows(wanted)))
  {
    const double slices = std::ceil(frame.Largest(this->Budget.SecondsOf(rays)) / seconds);
    this->Fine.Begin(std::move(wanted), static_cast<int>(std::clamp(slices, 1.0, MostSlices)));
  }
  const auto start = FrameClock::SteadyClock::now();
  const bool aborted =
    !this->Fine.Advance([&]() { return frame.AnyRank(FrameClock::SecondsSince(start) > seconds); },
      [this](const View& view) { return this->MakePicture(view) ? &this->Part : nullptr; });
  this->CastSeconds = 0; // it would not be the time of a whole picture
  if (aborted)
  {
    return false;
  }
  if (this->Fine.IsComplete())
  {
    this->Image = this->Sharpening.Advance(this->Fine.Whole(), this->Frame, geometry,
      frame.Largest(this->Clock.SecondsSinceLast()), SharpeningShare * frame.easeTime);
    this->Show(frame);
    this->GoesOn = !this->Sharpening.IsOver();
    this->LastResult.converged = this->LastResult.converged && !this->GoesOn;
    return true;
  }
  this->LastResult.converged = false;
  this->GoesOn = true;
  const std::vector<glm::dvec4> planes = this->Rays.planes;
  this->PlacePicture(frame, geometry, planes, this->Coarseness(frame, geometry));
  return this->DrawWhole(frame);
}

// If opaque geometry begins or ends within a coarse pixel, the pixel has two colours: that of the
// ray to the nearest depth, and that of the ray to the farthest.
bool VolumeView::DrawBetween(const std::vector<DepthRange>& ranges)
{
  std::vector<float> depth(ranges.size());
  View view = this->Rays;
  view.depth = depth.data();
  std::transform(ranges.begin(), ranges.end(), depth.begin(),
    [](const DepthRange& range) { return ToClip(range.farthest); });
  if (!this->MakePicture(view))
  {
    return false;
  }
  this->Image = std::exchange(this->Part, Picture());
  const auto differs = [](const DepthRange& range) { return range.nearest < range.farthest; };
  std::transform(ranges.begin(), ranges.end(), depth.begin(),
    [&](const DepthRange& range) { return differs(range) ? ToClip(range.nearest) : noRay; });
  if (!this->MakePicture(view))
  {
    return false;
  }
  for (std::size_t pixel = 0; pixel < ranges.size(); ++pixel)
  {
    if (!differs(ranges[pixel]))
    {
      std::copy_n(&this->Image.rgba[4 * pixel], 4, &this->Part.rgba[4 * pixel]);
    }
  }
  this->Quad.DrawBetween(
    this->Target, { this->Part, this->Image, ranges, *this->Opaque }, this->Frame, *this->Geometry);
  return true;
}

void VolumeView::DrawPart(const RayParts& parts, std::size_t part)
{
  if (this->Geometry)
  {
    const auto draw = [&]() { this->DrawPartNow(parts, part); };
    this->WhileDrawing(draw,
      [&]()
      {
        this->PrepareAgain();
        draw();
      });
  }
}

// The paint of missed structures belongs in front of everything, so the foremost segment has that
// of the whole rays.
void VolumeView::DrawPartNow(const RayParts& parts, std::size_t part)
{
  const std::array<int, 2>& size = this->Geometry->size;
  const auto clip = [&](const auto& depthOf)
  {
    return ValuesOf(*this->Geometry, this->Frame,
      [&](int column, int row)
      {
        const Index x = Index(column) * parts.size[0] / size[0];
        const Index y = Index(row) * parts.size[1] / size[1];
        const std::size_t pixel = std::size_t(y * parts.size[0] + x);
        return ToClip(depthOf(parts.depths.data() + 4 * pixel));
      });
  };
  const std::vector<float> nearDepth = clip([=](const float* of) { return of[2 * part]; });
  const std::vector<float> depth = clip([=](const float* of) { return of[2 * part + 1]; });
  std::vector<float> whole;
  View view = this->Rays;
  view.nearDepth = nearDepth.data();
  view.depth = depth.data();
  view.paintsMissed = this->ImportanceVersion != 0 && parts.outermost && part == 0;
  if (view.paintsMissed)
  {
    whole = clip([](const float* of) { return std::max(of[1], of[3]); });
    view.missedDepth = whole.data();
  }
  const auto isEmpty = [](float begin, float end) { return !(end > begin); };
  const bool empty =
    !view.paintsMissed && std::equal(nearDepth.begin(), nearDepth.end(), depth.begin(), isEmpty);
  if (empty || !this->MakePicture(view))
  {
    return;
  }
  this->Quad.Draw(this->Target, this->Part, this->Frame, this->Geometry->nearest);
  this->Image.width = this->Part.width;
  this->Image.height = this->Part.height;
  this->Image.rgba.resize(this->Part.rgba.size());
  for (std::size_t alpha = 3; alpha < this->Image.rgba.size(); alpha += 4)
  {
    const int both = this->Image.rgba[alpha] + this->Part.rgba[alpha];
    this->Image.rgba[alpha] = static_cast<std::uint8_t>(std::min(both, 255));
  }
}

void VolumeView::EndDrawing()
{
  this->IsDrawing = false;
  if (std::exchange(this->ResetAfter, false))
  {
    this->Reset();
  }
  if (std::exchange(this->ReleaseAfter, false))
  {
    this->Release();
  }
}

void VolumeView::DrawMask(const float color[3])
{
  if (!this->Image.rgba.empty() && this->Target && this->Geometry)
  {
    this->Quad.DrawMask(
      this->Target, this->Image, this->Frame, this->Geometry->nearest, color, VisibleAlpha);
  }
}
}
