// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "VolumeView.h"

#include "ScenePlacement.h"

#include "render/RenderBackend.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace limpid
{
namespace
{
// What a moving frame's time is for: optimisation and shadows get these shares at most, the rays
// the rest, but never less than this one.
constexpr double OptimizationShare = 0.4;
constexpr double ShadowShare = 0.25;
constexpr double LeastRayShare = 0.3;

// What was not drawn for longer than this goes on easing as if it had been [s].
constexpr double LongestPause = 0.2;

// A change is over when less than this is left of it: half a step of an 8-bit picture in motion;
// at rest, the picture becomes sharp in the same moment and hides more.
constexpr double LeastChange = 1.0 / 512;
constexpr double LeastChangeAtRest = 1.0 / 32;

// Rays of the shadow volume per voxel and axis.
constexpr double StillShadowDensity = 3;
constexpr double MovingShadowDensity = 1;

// How coarse the shadows of moving frames may be, see Renderer::SetShadowCoarseness.
constexpr std::array<int, 7> Coarsenesses{ { 1, 2, 3, 4, 6, 8, 12 } };

// Alpha above which a pixel counts as hit by a selection.
constexpr double VisibleAlpha = 0.05;

double Seconds(std::chrono::steady_clock::duration duration)
{
  return std::chrono::duration<double>(duration).count();
}

Vec3 ToVec3(const double* vector)
{
  return { vector[0], vector[1], vector[2] };
}

Light ToData(const Light& light, vtkVolume* volume)
{
  const glm::dmat4 worldToData = glm::inverse(DataToWorld(volume));
  Light result = light;
  result.position = TransformPoint(worldToData, light.position);
  result.focalPoint = TransformPoint(worldToData, light.focalPoint);
  return result;
}

std::string DescribeOwn(const Light& light)
{
  std::ostringstream text;
  text << "own light: " << (light.type == LightType::Point ? "point" : "directional") << ", at ("
       << light.position.x << ", " << light.position.y << ", " << light.position.z << ")";
  return text.str();
}
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

double VolumeView::SecondsInFrame() const
{
  return Seconds(Clock::now() - this->FrameStart);
}

bool VolumeView::IsStill(const FrameSettings& frame) const
{
  return !frame.adaptive || this->Target->GetRenderWindow()->GetDesiredUpdateRate() < 1;
}

void VolumeView::ChoosePictures(const FrameSettings& frame, const Grid& grid)
{
  const BackendKind wish = frame.solver.backend;
  if (this->PicturesFor == wish)
  {
    return;
  }
  // Who asks for CUDA where there is none is told by the optimisation, and sees a picture.
  constexpr std::size_t bytesPerNode = 32;
  const std::size_t bytes = bytesPerNode * static_cast<std::size_t>(grid.NodeCount());
  const bool cuda = wish != BackendKind::Cpu && ChooseBackend(BackendKind::Auto, bytes).cuda;
  this->Release();
  this->Caster = Renderer(MakeRenderBackend(cuda));
  this->PicturesFor = wish;
}

void VolumeView::UpdateRenderer(const VolumeData& data)
{
  if (this->ScalarsVersion != data.ScalarsVersion())
  {
    this->ScalarsVersion = 0;
    this->Caster.SetScalars(data.Nodes(), data.Scalars());
    this->ScalarsVersion = data.ScalarsVersion();
  }
  if (this->FunctionsVersion != data.FunctionsVersion())
  {
    this->FunctionsVersion = 0;
    this->Caster.SetTransferFunctions(data.Functions());
    this->FunctionsVersion = data.FunctionsVersion();
  }
}

ChosenLight VolumeView::ChooseLight(const FrameSettings& frame) const
{
  ChosenLight chosen;
  if (!frame.hasOwnLight)
  {
    chosen = StrongestLight(this->Target);
  }
  else
  {
    vtkCamera* source = this->Target->GetActiveCamera();
    Camera camera;
    camera.position = ToVec3(source->GetPosition());
    camera.focalPoint = ToVec3(source->GetFocalPoint());
    camera.viewUp = ToVec3(source->GetViewUp());
    chosen.found = true;
    chosen.light = frame.ownLight;
    chosen.light.focalPoint = camera.focalPoint;
    if (IsUnplaced(chosen.light))
    {
      PlaceLight(camera, chosen.light);
    }
    chosen.description = DescribeOwn(chosen.light);
  }
  chosen.light = ToData(chosen.light, this->Volume);
  return chosen;
}

void VolumeView::SetLight(const FrameSettings& frame, const ChosenLight& light)
{
  Lighting lighting = frame.lighting;
  lighting.enabled = frame.lit && light.found;
  lighting.light = light.light;
  lighting.color = light.color;
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
  for (const int factor : Coarsenesses)
  {
    nodes.push_back(CoarseGrid(grid, factor).NodeCount());
  }
  const std::size_t level =
    this->ShadowTime.Choose(nodes, ShadowShare * frame.frameTime, this->ShadowLevel);
  this->ShadowLevel = level;
  this->Caster.SetShadowRayDensity(MovingShadowDensity);
  this->Caster.SetShadowCoarseness(Coarsenesses[level]);
  const Clock::time_point start = Clock::now();
  const bool made = this->Caster.UpdateShadows();
  // The first time on a grid, something has to be prepared that will not be again.
  if (made && this->ShadowNodes == nodes[level])
  {
    this->ShadowTime.Learn(nodes[level], Seconds(Clock::now() - start));
  }
  this->ShadowNodes = nodes[level];
}

// Tells the optimiser what it works for. Returns whether that is known at all.
bool VolumeView::TakeView(
  const FrameSettings& frame, const Camera& camera, const ChosenLight& light)
{
  const bool once = frame.optimize && frame.once;
  const bool keeps = this->HasView && (frame.paused || (once && this->IsOnceView));
  if (!keeps)
  {
    if (once && !this->IsStill(frame))
    {
      return false; // the first still frame decides
    }
    const bool same =
      this->HasView && AreSame(camera, this->ViewCamera) && AreSame(light.light, this->ViewLight);
    if (!same)
    {
      this->ViewCamera = camera;
      this->ViewLight = light.light;
      this->HasView = true;
    }
  }
  this->IsOnceView = once;
  this->IsBaseView = !frame.optimize;
  this->ViewSettings = frame.solver;
  Settings settings = frame.solver;
  settings.weights.light = light.found ? settings.weights.light : 0.0;
  if (this->IsBaseView)
  {
    settings.maximumIterations = 0;
    settings.iterationsPerLevel = { { 0, 0, 0 } };
  }
  this->Optimizer->SetView(this->ViewCamera, this->ViewLight, settings);
  return true;
}

// Lets the optimiser work for as long as the frame allows. Returns whether it has.
bool VolumeView::Advance(const FrameSettings& frame)
{
  if (this->Optimizer->Converged())
  {
    return false;
  }
  if (!this->IsStill(frame))
  {
    this->Optimizer->Preview(OptimizationShare * frame.frameTime);
    return true;
  }
  const double until = this->SecondsInFrame() + frame.frameTime;
  bool goOn = true;
  while (goOn)
  {
    const bool done = this->Optimizer->Refine();
    const bool outOfTime = frame.stepwise && this->SecondsInFrame() > until;
    goOn = !done && !outOfTime && this->Target->GetRenderWindow()->CheckAbortStatus() == 0;
  }
  return true;
}

// Brings what the optimiser has found into the picture, at once or bit by bit.
void VolumeView::Show(const FrameSettings& frame, bool changed)
{
  const bool eases = frame.easeTime > 0 && (frame.stepwise || !this->IsStill(frame));
  if (!changed && !this->ShowsBase && this->Remaining == 0)
  {
    return;
  }
  double share = 1;
  this->Remaining = changed || this->ShowsBase ? 1 : this->Remaining;
  if (eases)
  {
    // At least a little: a clock may stand still between two frames.
    share = std::max(1 - std::exp(-this->SecondsSinceLastFrame / frame.easeTime), 0.01);
  }
  this->Remaining *= 1 - share;
  if (this->Remaining < (this->IsStill(frame) ? LeastChangeAtRest : LeastChange))
  {
    this->Remaining = 0;
    share = 1;
  }
  const bool separate = frame.solver.mode == Mode::Separate;
  this->Caster.SetExtinction(this->Optimizer->ShownGrid(), this->Optimizer->BaseExtinction(),
    this->Optimizer->Extinction(), share, separate ? this->Optimizer->LightExtinction() : nullptr);
  this->ShowsBase = false;
}

// What the frame's camera sees, which is not the one that the optimiser works for while the
// extinction is kept. Moving frames have no time for that: they repeat what was measured last.
Scores VolumeView::Measure(const FrameSettings& frame, const Camera& camera, bool changed)
{
  if (AreSame(camera, this->ViewCamera))
  {
    this->Elsewhere.reset();
    return { this->Optimizer->BaseScore(), this->Optimizer->BestScore() };
  }
  const bool current = this->Elsewhere && !changed && AreSame(camera, this->ElsewhereCamera);
  if (!current && (this->IsStill(frame) || !this->Elsewhere))
  {
    this->Elsewhere = this->Optimizer->ScoresFrom(camera);
    this->ElsewhereCamera = camera;
  }
  return *this->Elsewhere;
}

void VolumeView::ShowBase()
{
  if (!this->ShowsBase)
  {
    this->Caster.SetExtinction(Grid(), nullptr, nullptr);
    this->ShowsBase = true;
  }
  this->Remaining = 0;
}

void VolumeView::Optimize(const FrameSettings& frame, const VolumeData& data, const Camera& camera,
  const ChosenLight& light, FrameResult& result)
{
  if (this->DataVersion != data.DataVersion())
  {
    this->HasView = false;
    this->DataVersion = data.DataVersion();
  }
  if (!data.HasImportance() || !frame.measure || (!frame.optimize && !this->IsStill(frame)))
  {
    this->ShowBase();
    return;
  }
  bool changed = false;
  if (!this->Optimizer || this->SceneVersion != data.SceneVersion())
  {
    this->Optimizer.reset();
    this->Optimizer = std::make_unique<Progressive>(data.Scene(), frame.solver);
    this->SceneVersion = data.SceneVersion();
    changed = true;
  }
  // What has been found stays, for when optimization is on again.
  const bool found =
    this->HasView && !this->IsBaseView && !changed && frame.solver == this->ViewSettings;
  const bool frozen = frame.optimize ? frame.paused && !changed && !this->ShowsBase : found;
  if (!frozen)
  {
    if (!this->TakeView(frame, camera, light))
    {
      this->ShowBase();
      result.converged = false;
      return;
    }
    changed = this->Advance(frame) || changed;
  }
  frame.optimize ? this->Show(frame, changed) : this->ShowBase();

  const bool moving = !this->IsStill(frame);
  const Scores scores = this->Measure(frame, camera, changed);
  result.score = frame.optimize ? scores.best : scores.base;
  result.baseScore = scores.base;
  result.iterations = this->Optimizer->Iterations();
  result.backend = this->Optimizer->BackendName();
  result.converged = !moving && (frozen || this->Optimizer->Converged()) && this->Remaining == 0;
}

double VolumeView::PixelSize(const FrameSettings& frame, const ViewGeometry& geometry)
{
  const double pixels = double(geometry.covered[1] - geometry.covered[0]) *
    double(geometry.covered[3] - geometry.covered[2]);
  const double left =
    std::max(frame.frameTime - this->SecondsInFrame(), LeastRayShare * frame.frameTime);
  return this->Budget.PixelSize(pixels, left);
}

void VolumeView::MakePicture(
  const FrameSettings& frame, const ViewGeometry& geometry, double pixelSize)
{
  this->Frame = FrameOf(geometry, pixelSize);
  this->Depth = geometry.nearest;
  const std::vector<float> depth = ReadDepth(this->Target, geometry, this->Frame);

  View view;
  view.width = this->Frame.size[0];
  view.height = this->Frame.size[1];
  view.clipToWorld = ClipToData(geometry, this->Frame);
  view.depth = depth.empty() ? nullptr : depth.data();
  view.sampleDistance = frame.sampleDistance;
  view.jitter = frame.jitter;
  const Clock::time_point start = Clock::now();
  this->Caster.Render(view, this->Image);
  this->Budget.Record(double(view.width) * view.height, Seconds(Clock::now() - start));
}

FrameResult VolumeView::Draw(const FrameSettings& frame, const VolumeData& data,
  std::vector<std::string>& errors, std::vector<std::string>& warnings)
{
  const Clock::time_point now = Clock::now();
  const double since = Seconds(now - this->FrameStart);
  this->SecondsSinceLastFrame = this->GoesOn ? since : std::min(since, LongestPause);
  this->FrameStart = now;
  this->Image = Picture();

  const ViewGeometry geometry = GeometryOf(this->Target, this->Volume, data.Nodes());
  if (!geometry.IsVisible())
  {
    if (geometry.size[0] < 1 || geometry.size[1] < 1)
    {
      warnings.push_back("The view has " + std::to_string(geometry.size[0]) + " x " +
        std::to_string(geometry.size[1]) +
        " pixels (there is no room for a picture). Make it larger.");
    }
    this->LastResult.converged = true;
    return this->LastResult;
  }
  this->ChoosePictures(frame, data.Nodes());
  this->UpdateRenderer(data);
  const ChosenLight light = this->ChooseLight(frame);
  if (!light.found && (frame.lit || frame.optimize))
  {
    warnings.push_back(
      "No light of the view is switched on (nothing can be lit, and nothing casts a shadow): the "
      "volume is drawn without light. Switch a light on, or set LightSource to Own.");
  }
  this->SetLight(frame, light);

  FrameResult result;
  result.light = light.description;
  try
  {
    this->Optimize(frame, data, geometry.camera, light, result);
  }
  catch (const std::exception& error)
  {
    errors.push_back(error.what() + std::string(" The volume is drawn without optimization."));
    this->Optimizer.reset();
    this->ShowBase();
  }
  // While there is something left to do, the next picture follows at once.
  this->GoesOn = this->IsStill(frame) && frame.stepwise && !result.converged;
  const bool fine = this->IsStill(frame) && !this->GoesOn;
  this->MakeShadows(frame, this->ShowsBase ? data.Nodes() : this->Optimizer->ShownGrid(), fine);
  this->Caster.Prepare();
  this->MakePicture(frame, geometry, fine ? 1 : this->PixelSize(frame, geometry));
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
  this->Optimizer.reset();
  this->HasView = false;
  this->ShowBase();
}

void VolumeView::Release()
{
  this->Optimizer.reset();
  this->Caster = Renderer();
  this->PicturesFor.reset();
  this->ScalarsVersion = 0;
  this->FunctionsVersion = 0;
  this->ShowsBase = true;
  this->Remaining = 0;
  this->Image = Picture();
}

void VolumeView::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Quad.ReleaseGraphicsResources(window);
}
}
