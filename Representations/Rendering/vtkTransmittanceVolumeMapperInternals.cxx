// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkTransmittanceVolumeMapperInternals.h"

#include "Memory.h"

#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkPiecewiseFunction.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <exception>

limpid::VolumeView& vtkTransmittanceVolumeMapper::Internals::ViewOf(
  vtkRenderer* renderer, vtkVolume* volume)
{
  const auto orphaned = [this](const auto& view)
  {
    if (view->IsOrphaned())
    {
      this->Log.Forget(view.get());
    }
    return view->IsOrphaned();
  };
  this->Views.erase(
    std::remove_if(this->Views.begin(), this->Views.end(), orphaned), this->Views.end());

  for (const auto& view : this->Views)
  {
    if (view->IsOf(renderer, volume))
    {
      return *view;
    }
  }
  const auto releaseUnused = [this]()
  {
    const bool unused = std::all_of(
      this->Views.begin(), this->Views.end(), [](const auto& view) { return view->IsHidden(); });
    if (unused)
    {
      this->ReleaseData();
    }
  };
  this->Views.push_back(std::make_unique<limpid::VolumeView>(renderer, volume, releaseUnused));
  return *this->Views.back();
}

void vtkTransmittanceVolumeMapper::Internals::ReleaseMemory()
{
  for (const auto& view : this->Views)
  {
    view->Release();
  }
  this->ReleaseData();
}

// As soon as nothing is drawn from them.
void vtkTransmittanceVolumeMapper::Internals::ReleaseData()
{
  this->ReleaseAfter = this->Drawing > 0;
  if (!this->ReleaseAfter)
  {
    this->Data.Release();
  }
}

namespace
{
// The mapper of a volume that is to be drawn by this class; null: it is not.
vtkTransmittanceVolumeMapper* MapperOf(vtkVolume* volume)
{
  auto* mapper = volume && volume->GetVisibility()
    ? vtkTransmittanceVolumeMapper::SafeDownCast(volume->GetMapper())
    : nullptr;
  return mapper && mapper->GetDataObjectInput() ? mapper : nullptr;
}

std::vector<vtkSmartPointer<vtkVolume>> VolumesOf(vtkRenderer* renderer)
{
  std::vector<vtkSmartPointer<vtkVolume>> volumes;
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  while (vtkProp* prop = props->GetNextProp(position))
  {
    vtkVolume* volume = vtkVolume::SafeDownCast(prop);
    if (MapperOf(volume))
    {
      volumes.emplace_back(volume);
    }
  }
  return volumes;
}
}

// The renderer visits volumes in the order in which they were added: the ones that this one hides
// are drawn now, and not when it comes to them.
void vtkTransmittanceVolumeMapper::Internals::DrawWhatIsBehind(
  vtkRenderer* renderer, vtkVolume* volume)
{
  this->ForThoseBehind(renderer, volume,
    [renderer](vtkTransmittanceVolumeMapper* mapper, vtkVolume* other)
    {
      mapper->State->Render(renderer, other);
      mapper->State->ViewOf(renderer, other).InFrame = limpid::VolumeView::Turn::Ahead;
    });
}

// Of our volumes, those that a volume hides and that have not been drawn in the frame yet.
void vtkTransmittanceVolumeMapper::Internals::ForThoseBehind(vtkRenderer* renderer,
  vtkVolume* volume, const std::function<void(vtkTransmittanceVolumeMapper*, vtkVolume*)>& action)
{
  const limpid::Box box = limpid::BoxOf(volume);
  for (const auto& other : VolumesOf(renderer))
  {
    vtkTransmittanceVolumeMapper* mapper = MapperOf(other);
    if (mapper && other != volume &&
      limpid::OrderOf(box, limpid::BoxOf(other), renderer) == limpid::Order::SecondFirst &&
      mapper->State->ViewOf(renderer, other).InFrame == limpid::VolumeView::Turn::NotYet)
    {
      other->Update();
      action(mapper, other);
    }
  }
}

// Whatever goes wrong ends here.
template <class Action>
void vtkTransmittanceVolumeMapper::Internals::WhileDrawing(const Action& action)
{
  ++this->Drawing;
  try
  {
    action();
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(this->Self, << this->WordsOf(error));
  }
  --this->Drawing;
  if (this->ReleaseAfter)
  {
    this->ReleaseData();
  }
}

void vtkTransmittanceVolumeMapper::Internals::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  this->WhileDrawing(
    [&]()
    {
      limpid::DepthPeeling::IsUnderWay(volume) ? this->RenderParts(renderer, volume)
                                               : this->RenderInTurn(renderer, volume);
    });
}

void vtkTransmittanceVolumeMapper::Internals::RenderInTurn(vtkRenderer* renderer, vtkVolume* volume)
{
  using Turn = limpid::VolumeView::Turn;
  limpid::VolumeView& view = this->ViewOf(renderer, volume);
  const bool ahead = view.InFrame == Turn::Ahead;
  view.InFrame = Turn::Over;
  if (ahead)
  {
    return;
  }
  this->DrawWhatIsBehind(renderer, volume);
  this->DrawFrame(view, renderer, volume, false);
}

// VTK comes to each volume several times per frame and does not mix what several of them give it:
// the first one that it comes to takes the others along.
void vtkTransmittanceVolumeMapper::Internals::RenderParts(vtkRenderer* renderer, vtkVolume* volume)
{
  using Turn = limpid::VolumeView::Turn;
  const vtkSmartPointer<vtkVolume> alive = volume; // an observer may take it off the renderer
  limpid::VolumeView& view = this->ViewOf(renderer, volume);
  if (view.InFrame == Turn::Ahead)
  {
    return;
  }
  const bool outermost = view.InFrame == Turn::NotYet;
  if (outermost)
  {
    view.Peeled.clear();
    this->PrepareFromBack(renderer, volume, view);
    for (const auto& other : VolumesOf(renderer))
    {
      if (vtkTransmittanceVolumeMapper* mapper = MapperOf(other))
      {
        mapper->State->PrepareFromBack(renderer, other, view);
      }
    }
    view.InFrame = Turn::Over;
  }
  limpid::RayParts parts = view.Peeling.Ask(renderer, volume, this->Self);
  parts.outermost = outermost;
  for (std::size_t part = 0; part < 2; ++part)
  {
    view.Peeling.DrawPart(renderer, part,
      [&]()
      {
        for (vtkVolume* peeled : view.Peeled)
        {
          if (vtkTransmittanceVolumeMapper* mapper = MapperOf(peeled))
          {
            mapper->State->ViewOf(renderer, peeled).DrawPart(parts, part);
          }
        }
      });
  }
  view.Peeling.Answer(renderer, volume, this->Self);
}

void vtkTransmittanceVolumeMapper::Internals::PrepareFromBack(
  vtkRenderer* renderer, vtkVolume* volume, limpid::VolumeView& leader)
{
  limpid::VolumeView& view = this->ViewOf(renderer, volume);
  if (view.InFrame != limpid::VolumeView::Turn::NotYet)
  {
    return;
  }
  view.InFrame = limpid::VolumeView::Turn::Ahead;
  this->ForThoseBehind(renderer, volume,
    [&](vtkTransmittanceVolumeMapper* mapper, vtkVolume* other)
    { mapper->State->PrepareFromBack(renderer, other, leader); });
  this->WhileDrawing([&]() { this->DrawFrame(view, renderer, volume, true); });
  leader.Peeled.emplace_back(volume);
}

// With the messages of a frame. In parts: only makes what they need.
void vtkTransmittanceVolumeMapper::Internals::DrawFrame(
  limpid::VolumeView& view, vtkRenderer* renderer, vtkVolume* volume, bool inParts)
{
  this->Log.Begin();
  this->Messages.clear();
  try
  {
    this->Draw(view, renderer, volume, inParts);
  }
  catch (const std::exception& error)
  {
    this->Error(this->WordsOf(error));
    this->Last = limpid::FrameResult();
  }
  this->Log.End(&view);
}

void vtkTransmittanceVolumeMapper::Internals::Draw(
  limpid::VolumeView& view, vtkRenderer* renderer, vtkVolume* volume, bool inParts)
{
  vtkImageData* image = this->RequireImage();
  this->RequireAvailableChoices();
  limpid::FrameSettings frame = this->MakeFrameSettings(renderer, volume);
  const limpid::FieldSource scalars = this->ScalarSource(image, volume);
  this->Data.UpdateScalars(
    image, scalars, this->ExtinctionSource(image), this->CropRegionOf(volume));
  this->Data.UpdateFunctions(volume->GetProperty());
  try
  {
    const Importance importance = this->ImportanceOf(image, scalars);
    this->Data.UpdateImportance(image, importance.source, importance.functionTime);
  }
  catch (const std::exception& error)
  {
    // Without optimisation, importance is for the score only, and for what is missed.
    if (frame.optimize || frame.showMissed)
    {
      this->Error(this->WordsOf(error) +
        (frame.optimize ? " The volume is drawn without optimization."
                        : " What the picture misses is not painted over it."));
    }
    this->Data.UpdateImportance(image, limpid::FieldSource(), 0);
    frame.optimize = false;
    frame.showMissed = false;
  }
  if (inParts && frame.Composing() != limpid::Compositing::FrontToBack)
  {
    this->Warn(std::string("Method is ") + limpid::InfoOf(frame.solver.method).name +
      " and there are translucent surfaces (it looks at whole rays, which these divide): the "
      "volume "
      "is drawn in the ordinary way. Make the surfaces opaque or hide them, or set Method to "
      "Optimized, Ordinary or Ament 2017.");
    frame.optimize = false;
  }
  if (!this->Data.Warning().empty())
  {
    this->Warn(this->Data.Warning());
  }
  this->ReportIgnored(volume);
  if (!this->Data.Nodes().HasVolume())
  {
    const auto& nodes = this->Data.Nodes().nodes;
    this->Warn("The image has " + std::to_string(nodes.x) + " x " + std::to_string(nodes.y) +
      " x " + std::to_string(nodes.z) +
      " points (without a volume nothing can be seen of it). Give an image with at least two "
      "points per axis.");
    this->Last = limpid::FrameResult();
    return;
  }
  this->ReportNeighbours(renderer, volume, inParts);

  limpid::FrameMessages messages;
  this->Last =
    inParts ? view.Prepare(frame, this->Data, messages) : view.Draw(frame, this->Data, messages);
  for (const std::string& text : messages.errors)
  {
    this->Error(text);
  }
  for (const std::string& text : messages.warnings)
  {
    this->Warn(text);
  }
}

std::string vtkTransmittanceVolumeMapper::Internals::WordsOf(const std::exception& error) const
{
  return limpid::WordsOf(
    error, vtkImageData::SafeDownCast(this->Self->GetDataObjectInput()), limpid::drawingNeed);
}

// A pass of a hardware selection: ids instead of colours. Which point or cell it is cannot be told
// from a picture, so these passes get the id of nothing.
void vtkTransmittanceVolumeMapper::Internals::RenderSelection(
  vtkRenderer* renderer, vtkVolume* volume, vtkHardwareSelector* selector)
{
  const int pass = selector->GetCurrentPass();
  float color[3] = { 0, 0, 0 };
  selector->BeginRenderProp();
  if (pass == vtkHardwareSelector::ACTOR_PASS || pass == vtkHardwareSelector::PROCESS_PASS)
  {
    selector->GetPropColorValue(color);
  }
  try
  {
    this->ViewOf(renderer, volume).DrawMask(color);
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(this->Self, << this->WordsOf(error));
  }
  selector->EndRenderProp();
}
