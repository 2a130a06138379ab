// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkTransmittanceVolumeMapperInternals.h"

#include "ControllerRanks.h"
#include "InputArrays.h"
#include "Memory.h"
#include "StructureTable.h"

#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkVariant.h"
#include "vtkVolume.h"

#include "math/Require.h"

#include <algorithm>
#include <array>
#include <exception>

limpid::VolumeView& vtkTransmittanceVolumeMapper::Internals::ViewOf(
  vtkRenderer* renderer, vtkVolume* volume)
{
  const auto orphaned = [this](const auto& view)
  {
    if (view->IsOrphaned())
    {
      this->Log.Forget(view.get());
      this->Shown = this->Shown == view.get() ? nullptr : this->Shown;
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
  const auto goesOn = [this](double share)
  {
    this->Self->UpdateProgress(share);
    return this->Self->GetAbortExecute() == 0;
  };
  this->Views.push_back(
    std::make_unique<limpid::VolumeView>(renderer, volume, releaseUnused, goesOn));
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

// Frees the data, as soon as no drawing uses them.
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
// Returns the mapper of a volume if this class will draw it; else null.
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

// The renderer visits volumes in the order in which they were added. Volumes that this one hides
// are drawn now, before the renderer visits them.
void vtkTransmittanceVolumeMapper::Internals::DrawWhatIsBehind(
  vtkRenderer* renderer, vtkVolume* volume)
{
  this->ForVolumesBehind(renderer, volume,
    [renderer](vtkTransmittanceVolumeMapper* mapper, vtkVolume* other)
    {
      mapper->State->Render(renderer, other);
      mapper->State->ViewOf(renderer, other).InFrame = limpid::VolumeView::FrameStage::Ahead;
    });
}

// Calls action for the volumes with our mapper that a volume hides and that have not been drawn in
// this frame yet.
void vtkTransmittanceVolumeMapper::Internals::ForVolumesBehind(vtkRenderer* renderer,
  vtkVolume* volume, const std::function<void(vtkTransmittanceVolumeMapper*, vtkVolume*)>& action)
{
  const limpid::Box box = limpid::BoxOf(volume);
  for (const auto& other : VolumesOf(renderer))
  {
    vtkTransmittanceVolumeMapper* mapper = MapperOf(other);
    if (mapper && other != volume &&
      limpid::OrderOf(box, limpid::BoxOf(other), renderer) == limpid::Order::SecondFirst &&
      mapper->State->ViewOf(renderer, other).InFrame == limpid::VolumeView::FrameStage::NotYet)
    {
      other->Update();
      action(mapper, other);
    }
  }
}

// Runs an action of drawing. No exception leaves it: errors are reported here.
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
    vtkErrorWithObjectMacro(this->Self, << this->MessageOf(error));
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
  using FrameStage = limpid::VolumeView::FrameStage;
  limpid::VolumeView& view = this->ViewOf(renderer, volume);
  const bool ahead = view.InFrame == FrameStage::Ahead;
  view.InFrame = FrameStage::Over;
  if (ahead)
  {
    return;
  }
  this->DrawWhatIsBehind(renderer, volume);
  this->DrawFrame(view, renderer, volume, false);
}

// VTK visits each volume several times per frame and does not blend the segments of several
// volumes. The first volume that it visits draws the others as well.
void vtkTransmittanceVolumeMapper::Internals::RenderParts(vtkRenderer* renderer, vtkVolume* volume)
{
  using FrameStage = limpid::VolumeView::FrameStage;
  const vtkSmartPointer<vtkVolume> alive = volume; // an observer may remove it from the renderer
  limpid::VolumeView& view = this->ViewOf(renderer, volume);
  if (view.InFrame == FrameStage::Ahead)
  {
    return;
  }
  const bool outermost = view.InFrame == FrameStage::NotYet;
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
    view.InFrame = FrameStage::Over;
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
  if (view.InFrame != limpid::VolumeView::FrameStage::NotYet)
  {
    return;
  }
  view.InFrame = limpid::VolumeView::FrameStage::Ahead;
  this->ForVolumesBehind(renderer, volume,
    [&](vtkTransmittanceVolumeMapper* mapper, vtkVolume* other)
    { mapper->State->PrepareFromBack(renderer, other, leader); });
  this->WhileDrawing([&]() { this->DrawFrame(view, renderer, volume, true); });
  leader.Peeled.emplace_back(volume);
}

// Draws a frame and collects its messages. In segments, it only computes what they need. If one of
// several processes fails, all fail, and all start again.
void vtkTransmittanceVolumeMapper::Internals::DrawFrame(
  limpid::VolumeView& view, vtkRenderer* renderer, vtkVolume* volume, bool inParts)
{
  this->Log.Begin();
  this->Messages.clear();
  this->Self->SetAbortExecute(0);
  this->UpdateRanks();
  try
  {
    limpid::NotifyingOnFailure(*this->Ranks,
      [&]()
      {
        this->Draw(view, renderer, volume, inParts);
        this->AnyRank(false); // a barrier for all processes
      });
  }
  catch (const std::exception& error)
  {
    this->Error(this->MessageOf(error));
    this->Last = limpid::FrameResult();
    this->Disband();
  }
  this->Log.End(&view);
}

// Prepares the originals of all views. Errors are reported by the frame that shows an original.
bool vtkTransmittanceVolumeMapper::Internals::PrepareOriginals()
{
  bool isLeft = false;
  try
  {
    for (const auto& view : this->Views)
    {
      isLeft = view->PrepareOriginal(this->Data) || isLeft;
    }
  }
  catch (const std::exception&)
  {
    return false;
  }
  return isLeft;
}

// Returns whether the last frame was such that its camera's view of structures can be measured.
bool vtkTransmittanceVolumeMapper::Internals::CanMeasureStructures() const
{
  return this->Shown && this->Last.measured && this->Last.converged && this->Data.Labelled();
}

void vtkTransmittanceVolumeMapper::Internals::MeasureStructures()
{
  if (!this->CanMeasureStructures() || this->Drawing > 0)
  {
    return;
  }
  this->WhileDrawing(
    [this]()
    {
      try
      {
        limpid::NotifyingOnFailure(
          *this->Ranks, [this]() { this->Shown->MeasureStructures(this->Data); });
      }
      catch (...)
      {
        this->Disband();
        throw;
      }
    });
}

vtkTable* vtkTransmittanceVolumeMapper::Internals::KnownStructures()
{
  this->Structures->Initialize();
  if (const limpid::Structures* structures = this->Data.Labelled())
  {
    const std::vector<limpid::StructureShares>* shares =
      this->CanMeasureStructures() ? this->Shown->SharesOfStructures() : nullptr;
    const limpid::Structures* tried = this->Shown ? this->Shown->TriedStructures() : nullptr;
    limpid::TargetsFound found{ tried ? *tried : *structures, {}, {}, {} };
    found.shares = shares ? *shares : found.shares;
    limpid::FillStructures(*structures, found, this->Structures);
  }
  return this->Structures;
}

vtkTable* vtkTransmittanceVolumeMapper::Internals::LegendOfStructures()
{
  vtkTable* table = this->StructureLegend;
  table->Initialize();
  vtkNew<vtkStringArray> names;
  names->SetName("Name");
  table->AddColumn(names);
  for (const char* channel : { "Red", "Green", "Blue" })
  {
    vtkNew<vtkFloatArray> column;
    column->SetName(channel);
    table->AddColumn(column);
  }
  for (const limpid::LegendLine& line : this->Legend)
  {
    const vtkIdType row = table->InsertNextBlankRow();
    table->SetValue(row, 0, vtkVariant(line.name));
    for (vtkIdType channel = 0; channel < 3; ++channel)
    {
      table->SetValue(row, channel + 1, vtkVariant(line.color[channel]));
    }
  }
  return table;
}

bool vtkTransmittanceVolumeMapper::Internals::IsShared() const
{
  return this->Self->SharesImage && limpid::AreSeveral();
}

void vtkTransmittanceVolumeMapper::Internals::UpdateRanks()
{
  if (this->IsShared() == this->Ranks->IsAlone())
  {
    this->Disband();
    this->Ranks = this->IsShared() ? limpid::MakeRanks() : limpid::ThisProcess();
  }
  std::array<int, 6> whole;
  std::copy_n(this->Self->WholeExtent, whole.size(), whole.begin());
  this->Data.ShareAmong(this->Ranks, whole);
}

// Discards what was computed with other processes.
void vtkTransmittanceVolumeMapper::Internals::Disband()
{
  if (!this->Ranks->IsAlone())
  {
    this->Ranks = limpid::ThisProcess();
    this->ReleaseMemory();
  }
}

double* vtkTransmittanceVolumeMapper::Internals::FindWholeBounds(
  vtkImageData* image, double bounds[6]) const
{
  const int* extent = this->Self->WholeExtent;
  vtkBoundingBox box;
  for (int corner = 0; corner < 8; ++corner)
  {
    double point[3];
    image->TransformIndexToPhysicalPoint(
      extent[corner & 1], extent[2 + (corner >> 1 & 1)], extent[4 + (corner >> 2)], point);
    box.AddPoint(point);
  }
  box.GetBounds(bounds);
  return bounds;
}

// Detects values that were changed in place, in all arrays that are drawn.
void vtkTransmittanceVolumeMapper::Internals::NoticeChanges(
  vtkImageData* image, std::vector<vtkDataArray*> arrays)
{
  const char* ghosts = vtkDataSetAttributes::GhostArrayName();
  arrays.push_back(this->GivenImportance(image).array);
  arrays.push_back(image->GetPointData()->GetArray(ghosts));
  arrays.push_back(image->GetCellData()->GetArray(ghosts));
  this->Contents.Notice(image, arrays);
}

void vtkTransmittanceVolumeMapper::Internals::Draw(
  limpid::VolumeView& view, vtkRenderer* renderer, vtkVolume* volume, bool inParts)
{
  LIMPID_REQUIRE(!inParts || this->Ranks->IsAlone(),
    "Processes share the image, and the renderer peels volumes (this combination is not "
    "supported). Switch UseDepthPeelingForVolumes off.");
  vtkImageData* image = this->RequireImage();
  const bool isHere = image->GetNumberOfPoints() > 0;
  this->RequirePossibleNumbers();
  limpid::FrameSettings frame = this->MakeFrameSettings(renderer, volume);
  const limpid::FieldSource scalars =
    isHere ? this->ScalarSource(image, volume) : limpid::FieldSource();
  const limpid::FieldSource extinction =
    isHere ? this->ExtinctionSource(image) : limpid::FieldSource();
  const limpid::ImportanceChoice choice =
    isHere ? this->ChooseImportance(image, scalars) : limpid::ImportanceChoice();
  this->NoticeChanges(image, { scalars.array, extinction.array, choice.labels.array });
  this->Data.UpdateScalars(
    image, scalars, extinction, this->CropRegionOf(volume), volume->GetProperty());
  this->Data.UpdateFunctions(volume->GetProperty());
  this->Data.UpdateReferences(
    image, limpid::ReferenceSources(this->Self, isHere ? image : nullptr));
  this->UpdateImportance(image, choice, frame);
  this->ChooseColors(frame);
  if (inParts && frame.Composing() != limpid::Compositing::FrontToBack)
  {
    this->Warn(std::string("Method is ") + limpid::InfoOf(frame.solver.method).name +
      " and there are translucent surfaces (this method needs whole rays, but surfaces divide "
      "them): ordinary rendering is used. Make the surfaces opaque or hide them, or set Method to "
      "Optimized, Ordinary or Ament 2017.");
    frame.optimize = false;
  }
  if (!this->Data.Warning().empty())
  {
    this->Warn(this->Data.Warning());
  }
  this->ReportIgnored(volume);
  if (!this->Data.Whole().HasVolume())
  {
    const auto& nodes = this->Data.Whole().nodes;
    this->Warn("The image has " + std::to_string(nodes.x) + " x " + std::to_string(nodes.y) +
      " x " + std::to_string(nodes.z) +
      " points (it has no volume to draw). Give an image with at least two points per axis.");
    this->Last = limpid::FrameResult();
    return;
  }
  this->ReportNeighbours(renderer, volume, inParts);

  limpid::FrameMessages messages;
  this->Shown = &view;
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

std::string vtkTransmittanceVolumeMapper::Internals::MessageOf(const std::exception& error) const
{
  return limpid::MessageOf(
    error, vtkImageData::SafeDownCast(this->Self->GetDataObjectInput()), limpid::drawingNeed);
}

// Draws a pass of a hardware selection: ids instead of colours. A picture does not determine a
// point or a cell, so passes for these get the id of nothing.
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
    vtkErrorWithObjectMacro(this->Self, << this->MessageOf(error));
  }
  selector->EndRenderProp();
}
