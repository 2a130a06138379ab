// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "VolumeView.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include "backend/Interruption.h"
#include "math/Require.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace limpid
{
namespace
{
// Shares of a moving frame's time: the rays get what the optimisation and the shadows have left,
// but never less than this.
constexpr double LeastRayShare = 0.3;

// Alpha above which a pixel counts as hit by a selection.
constexpr double VisibleAlpha = 0.05;

// Whether a GPU has failed: the processor may do the same.
bool IsOfGpu(const std::exception& error)
{
  return dynamic_cast<const DeviceError*>(&error) != nullptr;
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

void VolumeView::ChoosePictures(BackendKind wish, const Grid& grid)
{
  if (!this->Backend.Suits(wish))
  {
    this->ReleaseNow();
    this->Caster = Renderer(this->Backend.Choose(wish, grid));
  }
}

void VolumeView::UpdateRenderer(const FrameSettings& frame, const VolumeData& data)
{
  this->ChoosePictures(frame.solver.backend, data.Nodes());
  if (this->ScalarsVersion != data.ScalarsVersion())
  {
    this->ScalarsVersion = 0;
    this->ImportanceVersion = 0; // new scalars end it
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
  lighting.shadows = lighting.shadows && frame.CastsShadows();
  lighting.light = frame.light.light;
  lighting.color = frame.light.color;
  this->Caster.SetLighting(lighting);
}

// Without room for the importance, the volume is drawn all the same.
void VolumeView::UseImportance(
  const FrameSettings& frame, const VolumeData& data, FrameMessages& messages)
{
  const bool needed = frame.showMissed || frame.Composing() != Compositing::FrontToBack;
  const bool used = needed && data.HasImportance();
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
    messages.errors.push_back(WordsOf(error, &points[0], drawingNeed) +
      " What the picture misses is not painted over it, and it is that of ordinary rendering if it "
      "needs importance.");
  }
  this->Caster.ShowMissed(frame.showMissed ? std::optional(frame.missedColor) : std::nullopt);
  this->Caster.ComposeBy(frame.Composing());
}

double VolumeView::PixelSize(const FrameSettings& frame, const ViewGeometry& geometry)
{
  const double pixels = double(geometry.covered[1] - geometry.covered[0]) *
    double(geometry.covered[3] - geometry.covered[2]);
  const double left =
    std::max(frame.frameTime - this->Clock.Seconds(), LeastRayShare * frame.frameTime);
  return this->Budget.PixelSize(pixels, left);
}

void VolumeView::PlacePicture(const FrameSettings& frame, const ViewGeometry& geometry,
  const std::vector<glm::dvec4>& planes, double pixelSize)
{
  this->Geometry = geometry;
  this->Frame = FrameOf(geometry, pixelSize);
  this->Rays = View();
  this->Rays.width = this->Frame.size[0];
  this->Rays.height = this->Frame.size[1];
  this->Rays.clipToWorld = ClipToData(geometry, this->Frame);
  this->Rays.planes = planes;
  this->Rays.sampleDistance = frame.sampleDistance;
  this->Rays.jitter = frame.jitter;
}

// Returns whether it was not aborted.
bool VolumeView::MakePicture(const View& view)
{
  const auto start = FrameClock::SteadyClock::now();
  try
  {
    const std::function<bool()> isAborted = this->AbortCheck();
    const Interruptible interruptible([&isAborted]() { return !isAborted(); });
    this->Caster.Render(view, this->Part);
  }
  catch (const Interrupted&)
  {
    this->Part = Picture(); // VTK does not show what was aborted
    return false;
  }
  this->CastSeconds += FrameClock::SecondsSince(start);
  return true;
}

// What is asked of the view by observers meanwhile is done afterwards. `again`: what the processor
// does where a GPU fails.
template <class Action, class Again>
void VolumeView::WhileDrawing(const Action& action, const Again& again)
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

template <class Action>
void VolumeView::WhileDrawing(const Action& action)
{
  this->WhileDrawing(action, action);
}

FrameResult VolumeView::Prepare(
  const FrameSettings& frame, const VolumeData& data, FrameMessages& messages)
{
  this->WhileDrawing([&]() { this->PrepareNow(frame, data, messages); });
  this->PrepareAgain = [this, frame, &data]()
  {
    FrameMessages told;
    this->PrepareNow(frame, data, told);
  };
  return this->LastResult;
}

FrameResult VolumeView::Draw(
  const FrameSettings& frame, const VolumeData& data, FrameMessages& messages)
{
  this->WhileDrawing(
    [&]()
    {
      this->PrepareNow(frame, data, messages);
      if (!this->Geometry)
      {
        return;
      }
      const std::vector<float> depth = ReadDepth(this->Target, *this->Geometry, this->Frame);
      View view = this->Rays;
      view.depth = depth.empty() ? nullptr : depth.data();
      if (this->MakePicture(view))
      {
        this->Image = std::move(this->Part);
        this->Quad.Draw(this->Target, this->Image, this->Frame, this->Geometry->nearest);
      }
      else
      {
        this->LastResult.converged = false;
      }
    });
  return this->LastResult;
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

// What is missed belongs in front of everything: the foremost part has it of the whole rays.
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
        return 2 * depthOf(parts.depths.data() + 4 * pixel) - 1;
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
    if (IsOfGpu(error) && frame.solver.backend == BackendKind::Auto)
    {
      throw; // of the one that makes pictures: the optimisation helps itself
    }
    const Int3& points = data.Nodes().nodes;
    messages.errors.push_back(
      WordsOf(error, &points[0], drawingNeed) + " The volume is drawn without optimization.");
    this->Optimization.Stop();
  }
}

std::function<bool()> VolumeView::AbortCheck() const
{
  return [this]() { return this->Target->GetRenderWindow()->CheckAbortStatus() != 0; };
}

// Leaves the result in LastResult.
void VolumeView::PrepareNow(
  const FrameSettings& frame, const VolumeData& data, FrameMessages& messages)
{
  messages = FrameMessages();
  this->Clock.Begin(this->GoesOn);
  if (this->CastSeconds > 0)
  {
    this->Budget.Record(double(this->Rays.width) * this->Rays.height, this->CastSeconds);
  }
  this->CastSeconds = 0;
  this->Geometry.reset();
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
    return;
  }
  if (!frame.light.found && (frame.lit || frame.optimize))
  {
    messages.warnings.emplace_back(
      "No light of the view is switched on (nothing can be lit, and nothing casts a shadow): the "
      "volume is drawn without light. Switch a light on, or set LightSource to Own.");
  }
  this->UpdateRenderer(frame, data);
  if (!this->Backend.Warning().empty())
  {
    messages.warnings.push_back(this->Backend.Warning());
  }
  this->UseImportance(frame, data, messages);

  FrameResult result;
  result.light = frame.light.description;
  const std::function<bool()> isAborted = this->AbortCheck();
  try
  {
    this->Optimize(frame, data, geometry.camera, isAborted, messages, result);
    // While there is something left to do, the next picture follows at once.
    this->GoesOn = frame.still && frame.stepwise && !result.converged;
    const bool fine = frame.still && !this->GoesOn;
    const Grid* shown = this->Optimization.ShownGrid();
    const Interruptible interruptible([&isAborted]() { return !isAborted(); });
    this->Shadows.Make(frame, shown ? *shown : data.Nodes(), fine);
    this->Caster.Prepare();
    this->PlacePicture(
      frame, geometry, data.Cropped().planes, fine ? 1 : this->PixelSize(frame, geometry));
  }
  catch (const Interrupted&)
  {
    result.converged = false;
  }
  this->LastResult = result;
}

void VolumeView::DrawMask(const float color[3])
{
  if (!this->Image.rgba.empty() && this->Target && this->Geometry)
  {
    this->Quad.DrawMask(
      this->Target, this->Image, this->Frame, this->Geometry->nearest, color, VisibleAlpha);
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
  this->Backend.Forget();
  this->ScalarsVersion = 0;
  this->FunctionsVersion = 0;
  this->ImportanceVersion = 0;
  this->Geometry.reset();
  this->Image = Picture();
  this->Part = Picture();
}

void VolumeView::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Quad.ReleaseGraphicsResources(window);
  this->Peeling.ReleaseGraphicsResources(window);
}
}
