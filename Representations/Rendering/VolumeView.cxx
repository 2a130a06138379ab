// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "VolumeView.h"

#include "Log.h"
#include "OpenGl.h"
#include "SharedView.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include "backend/Interruption.h"
#include "render/BrickDistances.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace limpid
{
namespace
{
// Shares of the time of a frame during interaction. Rays get what the optimisation and the shadows
// have left, but never less than the least share. The rest is for displaying the picture.
constexpr double ShareOfFrame = 0.9;
constexpr double LeastRayShare = 0.3;

// The longest frame during interaction if a graphics card draws [s]. What the rays leave of a
// longer one would only go into a finer optimisation.
constexpr double GraphicsFrameTime = 1.0 / 60;

// The first frame has full resolution [s].
constexpr double GraphicsRayTime = 5e-9;

// Returns whether a GPU has failed, so that the processor may do the same work.
bool IsOfGpu(const std::exception& error)
{
  return dynamic_cast<const DeviceError*>(&error) != nullptr;
}
}

VolumeView::VolumeView(vtkRenderer* renderer, vtkVolume* volume, std::function<void()> whenHidden,
  std::function<bool(double share)> goesOn)
  : Target(renderer)
  , Volume(volume)
  , WhenHidden(std::move(whenHidden))
  , GoesOnAfter(std::move(goesOn))
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
    view->InFrame = FrameStage::NotYet;
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

FrameSettings VolumeView::InTime(const FrameSettings& frame) const
{
  FrameSettings timed = frame;
  if (!frame.still && this->Backend.IsGraphicsCard())
  {
    timed.frameTime = std::min(timed.frameTime, GraphicsFrameTime);
  }
  return timed;
}

void VolumeView::ChoosePictures(const FrameSettings& frame, const Grid& grid)
{
  const PictureBackend::Wish wish{ frame.drawOn, frame.solver.backend };
  if (!this->Backend.Suits(wish))
  {
    this->ReleaseNow();
    this->Caster = Renderer(this->Backend.Choose(wish, grid, WindowOf(this->Target)));
    if (this->Backend.IsGraphicsCard())
    {
      this->Budget.Expect(GraphicsRayTime);
    }
  }
  this->Backend.DrawIn(WindowOf(this->Target));
}

void VolumeView::UpdateRenderer(const FrameSettings& frame, const VolumeData& data)
{
  this->ChoosePictures(frame, data.Nodes());
  if (this->ScalarsVersion != data.ScalarsVersion())
  {
    this->ScalarsVersion = 0;
    this->ImportanceVersion = 0; // new scalars invalidate it
    this->StructuresVersion = 0;
    this->Caster.SetScalars(data.Drawn(), data.Scalars(), data.Shares());
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
  lighting.shadows = lighting.shadows && frame.CastsShadows();
  lighting.light = frame.light.light;
  this->Caster.SetLighting(lighting);
}

// If there is no memory for the importance, the volume is drawn without it.
void VolumeView::UseImportance(
  const FrameSettings& frame, const VolumeData& data, FrameMessages& messages)
{
  const bool used = frame.DrawsImportance() && data.HasImportance();
  const std::uint64_t version = used ? data.ImportanceVersion() : 0;
  try
  {
    if (version != this->ImportanceVersion)
    {
      this->ImportanceVersion = 0;
      this->Caster.SetImportance(used ? data.Importance() : nullptr);
      this->ImportanceVersion = version;
    }
  }
  catch (const std::exception& error)
  {
    if (IsOfGpu(error))
    {
      throw;
    }
    const Int3& points = data.Nodes().nodes;
    messages.errors.push_back(MessageOf(error, &points[0], drawingNeed) +
      " Missed structures are not painted, and methods that need importance are replaced by "
      "ordinary rendering.");
  }
  this->Caster.ShowMissed(frame.showMissed ? std::optional(frame.missedColor) : std::nullopt);
  this->Caster.ComposeBy(frame.Composing());
}

void VolumeView::UseStructures(const FrameSettings& frame, const VolumeData& data)
{
  const bool used = frame.structureColors > 0 && data.Labelled();
  const std::uint64_t version = used ? data.ImportanceVersion() : 0;
  if (version != this->StructuresVersion)
  {
    this->StructuresVersion = 0;
    this->Caster.SetStructures(used ? data.StructureRows() : nullptr);
    this->StructuresVersion = version;
  }
  this->Caster.TintStructures(used ? frame.structureColors : 0, frame.colorsOfRows);
}

// See FrameBudget. Processes that share the image have points for its own distance of samples.
double VolumeView::Coarseness(const FrameSettings& frame, const ViewGeometry& geometry)
{
  const double farthest = frame.IsOfSeveral() ? 1 : BrickDistances::size / frame.sampleDistance;

  const double pixels = double(geometry.covered[1] - geometry.covered[0]) *
    double(geometry.covered[3] - geometry.covered[2]);
  const double left = std::max(
    ShareOfFrame * frame.frameTime - this->Clock.Seconds(), LeastRayShare * frame.frameTime);
  // All ranks must draw the same pixels.
  return frame.Largest(this->Budget.Coarseness(pixels, left, farthest));
}

View VolumeView::RaysOf(const FrameSettings& frame, const ViewGeometry& geometry,
  const std::vector<glm::dvec4>& planes, const PictureFrame& picture)
{
  View rays;
  rays.width = picture.size[0];
  rays.height = picture.size[1];
  rays.clipToWorld = ClipToData(geometry, picture);
  rays.planes = planes;
  rays.sampleDistance = frame.sampleDistance;
  rays.jitter = frame.jitter;
  return rays;
}

void VolumeView::PlacePicture(const FrameSettings& frame, const ViewGeometry& geometry,
  const std::vector<glm::dvec4>& planes, double coarseness)
{
  this->Geometry = geometry;
  this->Step = FrameBudget::StepOf(coarseness);
  this->Frame = FrameOf(geometry, FrameBudget::PixelSizeOf(coarseness));
  this->Rays = RaysOf(frame, geometry, planes, this->Frame);
  this->Rays.sampleDistance *= this->Step;
}

void VolumeView::Optimize(const FrameSettings& frame, const VolumeData& data,
  const ViewGeometry& geometry, const std::function<bool()>& isAborted, FrameMessages& messages,
  FrameResult& result)
{
  try
  {
    const bool scored = frame.measure && data.HasImportance();
    this->Optimization.Advance(frame, data, geometry.camera,
      scored ? this->Opaque->InBox() : std::nullopt, this->Clock, isAborted, result);
  }
  catch (const Interrupted&)
  {
    result = this->LastResult;
    throw;
  }
  catch (const std::exception& error)
  {
    if (frame.IsOfSeveral() || (IsOfGpu(error) && frame.solver.backend == BackendKind::Auto))
    {
      throw; // an error of all ranks or of the GPU of the pictures; the optimisation handles its
             // own
    }
    const Int3& points = data.Nodes().nodes;
    messages.errors.push_back(
      MessageOf(error, &points[0], drawingNeed) + " The volume is drawn without optimization.");
    this->Optimization.Stop();
  }
}

// Reports the share of a picture's rays that have been cast, and returns whether to abort. A frame
// may cast several pictures. Ranks draw a frame together to its end and never abort.
bool VolumeView::IsAborted(double share)
{
  const auto windowOf = [this]()
  { return this->Target ? this->Target->GetRenderWindow() : nullptr; };
  vtkRenderWindow* window = windowOf();
  if (!this->OnRanks && (!window || window->GetAbortRender()))
  {
    return true;
  }
  this->RaysDone = std::max(this->RaysDone, share);
  const bool goesOn = !this->Reports || this->GoesOnAfter(this->RaysDone);
  window = windowOf(); // an observer may have removed the renderer
  if (this->OnRanks || !window)
  {
    return !this->OnRanks;
  }
  if (!goesOn)
  {
    window->SetAbortRender(1); // so that the window keeps the picture that it shows
  }
  return window->CheckAbortStatus() != 0;
}

// Returns the geometry of the view and sets the depths in front of the volume; none if the volume
// is out of view.
std::optional<ViewGeometry> VolumeView::BeginFrame(
  const FrameSettings& frame, const VolumeData& data, FrameMessages& messages)
{
  messages = FrameMessages();
  this->OnRanks = frame.IsOfSeveral();
  this->Reports = frame.still && !frame.stepwise;
  this->RaysDone = 0;
  this->Clock.Begin(this->GoesOn);
  if (this->CastSeconds > 0)
  {
    const double rays = double(this->Rays.width) * this->Rays.height;
    this->Budget.Record(rays, this->Step, this->CastSeconds);
  }
  this->CastSeconds = 0;
  this->Geometry.reset();
  this->Opaque.reset();
  this->Image = Picture();
  ViewGeometry geometry = GeometryOf(this->Target, this->Volume, data.Whole());
  if (frame.IsOfSeveral())
  {
    TakeFirstOf(*frame.ranks, geometry);
  }
  if (geometry.size[0] < 1 || geometry.size[1] < 1)
  {
    messages.warnings.push_back("The view has " + std::to_string(geometry.size[0]) + " x " +
      std::to_string(geometry.size[1]) +
      " pixels (there is no room for a picture). Make it larger.");
  }
  if (!geometry.IsVisible())
  {
    this->RestsOptimized = false;
    this->LastResult.converged = true;
    return std::nullopt;
  }
  if (!frame.light.found && (frame.lit || frame.optimize))
  {
    messages.warnings.emplace_back(
      "No light of the view is switched on (nothing is lit, and there are no shadows): the volume "
      "is drawn without light. Switch a light on, or set LightSource to Own.");
  }
  this->Opaque = this->OpaqueOf(frame, geometry);
  return geometry;
}

// Computes everything that the frame's rays need. The results are in LastResult.
void VolumeView::PrepareFrame(const FrameSettings& frame, const VolumeData& data,
  const ViewGeometry& geometry, FrameMessages& messages)
{
  limpidLogScope("Optimized Volume: %s frame of %d x %d pixels", frame.still ? "still" : "moving",
    geometry.size[0], geometry.size[1]);
  if (std::exchange(this->RestsOptimized, false))
  {
    this->Optimization.ShowFoundAgain(); // kept pictures do not need what they show
  }
  this->UpdateRenderer(frame, data);
  this->UseImportance(frame, data, messages);
  this->UseStructures(frame, data);

  FrameResult result;
  result.light = frame.light.description;
  const std::function<bool()> isAborted = [this]() { return this->IsAborted(0); };
  try
  {
    this->Optimize(frame, data, geometry, isAborted, messages, result);
    if (!result.warning.empty())
    {
      messages.warnings.push_back(result.warning);
    }
    // While work is left, the next frame follows immediately.
    this->GoesOn = frame.still && frame.stepwise && !result.converged;
    const bool fine = frame.still && !this->GoesOn;
    const Grid* shown = this->Optimization.ShownGrid();
    const Interruptible interruptible([&isAborted]() { return !isAborted(); });
    fine || this->Optimization.ShowsPiece(frame)
      ? this->Shadows.MakeFine(fine)
      : this->Shadows.MakeInTime(frame, shown ? *shown : data.Whole(), data.Whole());
    this->Caster.Prepare();
    this->PlacePicture(
      frame, geometry, data.Cropped().planes, fine ? 1 : this->Coarseness(frame, geometry));
  }
  catch (const Interrupted&)
  {
    result.converged = false;
  }
  if (result.measured && result.optimized)
  {
    limpidLog("%s; %.1f %% of the important structures visible%s", result.backend.c_str(),
      100 * result.score.fraction, result.converged ? "" : " so far");
  }
  this->LastResult = result;
}

void VolumeView::PrepareNow(
  const FrameSettings& frame, const VolumeData& data, FrameMessages& messages)
{
  if (const std::optional<ViewGeometry> geometry = this->BeginFrame(frame, data, messages))
  {
    this->PrepareFrame(frame, data, *geometry, messages);
    this->TellWhatDraws(messages);
  }
}

void VolumeView::TellWhatDraws(FrameMessages& messages)
{
  this->LastResult.drawnBy = this->Backend.DrawnBy();
  this->LastResult.uploadedBytes = this->Backend.TakeUploadedBytes();
  const std::string warning = this->Backend.Warning();
  if (!warning.empty())
  {
    messages.warnings.push_back(warning);
  }
}

// Returns how the last frame looked at the data. Requires Geometry.
ViewOptimization::Look VolumeView::LastLook() const
{
  return { this->Geometry->camera, this->Opaque->InBox(), this->LastResult.optimized };
}

void VolumeView::MeasureStructures(const VolumeData& data)
{
  if (!this->Geometry)
  {
    return;
  }
  this->Reports = false;
  try
  {
    this->WhileDrawing(
      [&]()
      {
        this->Optimization.MeasureStructures(
          this->LastLook(), data, [this]() { return this->IsAborted(0); });
      });
  }
  catch (const Interrupted&)
  {
    return; // nothing is known
  }
}

const std::vector<StructureShares>* VolumeView::SharesOfStructures() const
{
  return this->Geometry ? this->Optimization.SharesOfStructures(this->LastLook()) : nullptr;
}

const Structures* VolumeView::TriedStructures() const
{
  return this->LastResult.optimized ? this->Optimization.TriedStructures() : nullptr;
}

StructureRow VolumeView::PickStructure(double x, double y, const VolumeData& data) const
{
  if (!this->Geometry || !this->LastResult.measured)
  {
    return 0;
  }
  const auto at = [&](double z)
  {
    const glm::dvec4 place = this->Geometry->clipToData * glm::dvec4(2 * x - 1, 2 * y - 1, z, 1);
    return Vec3(place) / place.w;
  };
  return this->Optimization.PickStructure(at(-1), at(1), this->LastResult.optimized, data);
}

void VolumeView::Reset()
{
  if (this->IsDrawing)
  {
    this->ResetAfter = true;
    return;
  }
  this->Optimization.Reset();
  this->Pictures.ClearTiles();
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

// Keeps finished pictures, which take little: what is shown again as it was is shown at once.
void VolumeView::ReleaseNow()
{
  this->Optimization.Release();
  this->Caster = Renderer();
  this->Backend.Forget();
  this->ScalarsVersion = 0;
  this->FunctionsVersion = 0;
  this->ImportanceVersion = 0;
  this->StructuresVersion = 0;
  this->Geometry.reset();
  this->Image = Picture();
  this->Part = Picture();
  this->Fine.Clear();
  this->Sharpening.Clear();
  this->Original.Clear();
}

void VolumeView::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Quad.ReleaseGraphicsResources(window);
  this->Peeling.ReleaseGraphicsResources(window);
  this->Backend.ReleaseGraphicsResources(window);
}
}
