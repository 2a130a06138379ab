// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "VolumeView.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include "backend/ComputeBackend.h"
#include "backend/Interruption.h"
#include "optimize/Levels.h"
#include "render/RenderBackend.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace limpid
{
namespace
{
// Shares of a moving frame's time: shadows get the first one at most, the rays what the
// optimisation and the shadows have left, but never less than the second one.
constexpr double ShadowShare = 0.25;
constexpr double LeastRayShare = 0.3;

// Rays of the shadow volume per voxel and axis.
constexpr double StillShadowDensity = 3;
constexpr double MovingShadowDensity = 1;

// How coarse the shadows of moving frames may be, see Renderer::SetShadowCoarseness.
constexpr std::array<int, 7> Coarsenesses{ { 1, 2, 3, 4, 6, 8, 12 } };

// Alpha above which a pixel counts as hit by a selection.
constexpr double VisibleAlpha = 0.05;
}

VolumeView::VolumeView(vtkRenderer* renderer, vtkVolume* volume, std::function<void()> whenHidden)
  : Target(renderer)
  , Volume(volume)
  , WhenHidden(std::move(whenHidden))
{
  this->Observer->SetClientData(this);
  this->Observer->SetCallback(&VolumeView::OnEvent);
  renderer->AddObserver(vtkCommand::StartEvent, this->Observer);
  renderer->AddObserver(vtkCommand::DeleteEvent, this->Observer);
  volume->AddObserver(vtkCommand::ModifiedEvent, this->Observer);
}

VolumeView::~VolumeView()
{
  if (this->Target)
  {
    this->Target->RemoveObserver(this->Observer);
  }
  if (this->Volume)
  {
    this->Volume->RemoveObserver(this->Observer);
  }
}

void VolumeView::OnEvent(vtkObject* caller, unsigned long event, void* self, void*)
{
  auto* view = static_cast<VolumeView*>(self);
  if (event == vtkCommand::DeleteEvent)
  {
    view->Release();
  }
  else if (caller == view->Target)
  {
    view->InFrame = Turn::NotYet;
  }
  else if (view->IsHidden())
  {
    view->Release();
    view->WhenHidden();
  }
}

bool VolumeView::IsOf(vtkRenderer* renderer, vtkVolume* volume) const
{
  return this->Target == renderer && this->Volume == volume;
}

bool VolumeView::IsOrphaned() const
{
  return !this->Target || !this->Volume;
}

bool VolumeView::IsHidden() const
{
  return this->IsOrphaned() || !this->Volume->GetVisibility();
}

bool VolumeView::IsIn(vtkWindow* window) const
{
  return this->Target && this->Target->GetVTKWindow() == window;
}

// Who asks for CUDA where there is none is told by the optimisation, and sees a picture.
void VolumeView::ChoosePictures(BackendKind wish, const Grid& grid)
{
  if (this->PicturesFor == wish)
  {
    return;
  }
  constexpr std::size_t bytesPerNode = 32;
  const std::size_t bytes = bytesPerNode * static_cast<std::size_t>(grid.NodeCount());
  const bool cuda = wish != BackendKind::Cpu && ChooseBackend(BackendKind::Auto, bytes).cuda;
  this->ReleaseNow();
  this->Caster = Renderer(BackendOf(cuda).MakeRenderBackend());
  this->PicturesFor = wish;
}

void VolumeView::UpdateRenderer(const FrameSettings& frame, const VolumeData& data)
{
  this->ChoosePictures(frame.solver.backend, data.Nodes());
  if (this->ScalarsVersion != data.ScalarsVersion())
  {
    this->ScalarsVersion = 0;
    this->Caster.SetScalars(data.Nodes(), data.Scalars(), data.Shares());
    this->ScalarsVersion = data.ScalarsVersion();
  }
  if (this->FunctionsVersion != data.FunctionsVersion())
  {
    this->FunctionsVersion = 0;
    this->Caster.SetTransferFunctions(data.Functions());
    this->FunctionsVersion = data.FunctionsVersion();
  }
  Lighting lighting = frame.lighting;
  lighting.enabled = frame.lit && frame.light.found;
  lighting.light = frame.light.light;
  lighting.color = frame.light.color;
  this->Caster.SetLighting(lighting);
}

void VolumeView::MakeShadows(const FrameSettings& frame, const Grid& grid, bool fine)
{
  if (fine)
  {
    this->Caster.SetShadowRayDensity(StillShadowDensity);
    this->Caster.SetShadowCoarseness(1);
    this->Caster.UpdateShadows();
    return;
  }
  std::vector<Index> nodes;
  nodes.reserve(Coarsenesses.size());
  for (const int factor : Coarsenesses)
  {
    nodes.push_back(CoarseGrid(grid, factor).NodeCount());
  }
  const std::size_t level =
    this->ShadowTime.Choose(nodes, ShadowShare * frame.frameTime, this->ShadowLevel);
  this->ShadowLevel = level;
  this->Caster.SetShadowRayDensity(MovingShadowDensity);
  this->Caster.SetShadowCoarseness(Coarsenesses[level]);
  const auto start = FrameClock::SteadyClock::now();
  const bool made = this->Caster.UpdateShadows();
  // The first time on a grid, something has to be prepared that will not be again.
  if (made && this->ShadowNodes == nodes[level])
  {
    this->ShadowTime.Learn(nodes[level], FrameClock::SecondsSince(start));
  }
  this->ShadowNodes = nodes[level];
}

double VolumeView::PixelSize(const FrameSettings& frame, const ViewGeometry& geometry)
{
  const double pixels = double(geometry.covered[1] - geometry.covered[0]) *
    double(geometry.covered[3] - geometry.covered[2]);
  const double left =
    std::max(frame.frameTime - this->Clock.Seconds(), LeastRayShare * frame.frameTime);
  return this->Budget.PixelSize(pixels, left);
}

void VolumeView::MakePicture(const FrameSettings& frame, const ViewGeometry& geometry,
  const std::vector<glm::dvec4>& planes, double pixelSize)
{
  this->Frame = FrameOf(geometry, pixelSize);
  this->Depth = geometry.nearest;
  const std::vector<float> depth = ReadDepth(this->Target, geometry, this->Frame);

  View view;
  view.width = this->Frame.size[0];
  view.height = this->Frame.size[1];
  view.clipToWorld = ClipToData(geometry, this->Frame);
  view.depth = depth.empty() ? nullptr : depth.data();
  view.planes = planes;
  view.sampleDistance = frame.sampleDistance;
  view.jitter = frame.jitter;
  const auto start = FrameClock::SteadyClock::now();
  this->Caster.Render(view, this->Image);
  this->Budget.Record(double(view.width) * view.height, FrameClock::SecondsSince(start));
}

FrameResult VolumeView::Draw(
  const FrameSettings& frame, const VolumeData& data, FrameMessages& messages)
{
  this->IsDrawing = true;
  FrameResult result;
  try
  {
    result = this->DrawNow(frame, data, messages);
  }
  catch (...)
  {
    this->EndDrawing();
    throw;
  }
  this->EndDrawing();
  return result;
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

void VolumeView::Optimize(const FrameSettings& frame, const VolumeData& data, const Camera& camera,
  const std::function<bool()>& isAborted, FrameMessages& messages, FrameResult& result)
{
  try
  {
    this->Optimization.Advance(frame, data, camera, this->Clock, isAborted, result);
  }
  catch (const Interrupted&)
  {
    result = this->LastResult;
    throw;
  }
  catch (const std::exception& error)
  {
    const Int3& points = data.Nodes().nodes;
    messages.errors.push_back(
      WordsOf(error, &points[0], drawingNeed) + " The volume is drawn without optimization.");
    this->Optimization.Stop();
  }
}

FrameResult VolumeView::DrawNow(
  const FrameSettings& frame, const VolumeData& data, FrameMessages& messages)
{
  this->Clock.Begin(this->GoesOn);
  this->Image = Picture();
  const ViewGeometry geometry = GeometryOf(this->Target, this->Volume, data.Nodes());
  if (geometry.size[0] < 1 || geometry.size[1] < 1)
  {
    messages.warnings.push_back("The view has " + std::to_string(geometry.size[0]) + " x " +
      std::to_string(geometry.size[1]) +
      " pixels (there is no room for a picture). Make it larger.");
  }
  if (!geometry.IsVisible())
  {
    this->LastResult.converged = true;
    return this->LastResult;
  }
  if (!frame.light.found && (frame.lit || frame.optimize))
  {
    messages.warnings.emplace_back(
      "No light of the view is switched on (nothing can be lit, and nothing casts a shadow): the "
      "volume is drawn without light. Switch a light on, or set LightSource to Own.");
  }
  this->UpdateRenderer(frame, data);

  FrameResult result;
  result.light = frame.light.description;
  const auto isAborted = [this]()
  { return this->Target->GetRenderWindow()->CheckAbortStatus() != 0; };
  try
  {
    this->Optimize(frame, data, geometry.camera, isAborted, messages, result);
    // While there is something left to do, the next picture follows at once.
    this->GoesOn = frame.still && frame.stepwise && !result.converged;
    const bool fine = frame.still && !this->GoesOn;
    const Grid* shown = this->Optimization.ShownGrid();
    const Interruptible interruptible([&isAborted]() { return !isAborted(); });
    this->MakeShadows(frame, shown ? *shown : data.Nodes(), fine);
    this->Caster.Prepare();
    this->MakePicture(
      frame, geometry, data.Cropped().planes, fine ? 1 : this->PixelSize(frame, geometry));
  }
  catch (const Interrupted&)
  {
    this->Image = Picture(); // VTK does not show what was aborted
    result.converged = false;
  }
  if (!this->Image.rgba.empty())
  {
    this->Quad.Draw(this->Target, this->Image, this->Frame, this->Depth);
  }
  this->LastResult = result;
  return result;
}

void VolumeView::DrawMask(const float color[3])
{
  if (!this->Image.rgba.empty() && this->Target)
  {
    this->Quad.DrawMask(this->Target, this->Image, this->Frame, this->Depth, color, VisibleAlpha);
  }
}

void VolumeView::Reset()
{
  if (this->IsDrawing)
  {
    this->ResetAfter = true;
    return;
  }
  this->Optimization.Reset();
}

void VolumeView::Release()
{
  if (this->IsDrawing)
  {
    this->ReleaseAfter = true;
    return;
  }
  this->ReleaseNow();
}

void VolumeView::ReleaseNow()
{
  this->Optimization.Release();
  this->Caster = Renderer();
  this->PicturesFor.reset();
  this->ScalarsVersion = 0;
  this->FunctionsVersion = 0;
  this->Image = Picture();
}

void VolumeView::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Quad.ReleaseGraphicsResources(window);
}
}
