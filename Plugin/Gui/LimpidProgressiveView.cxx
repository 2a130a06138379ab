// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidProgressiveView.h"

#include "LimpidCapture.h"
#include "LimpidOptimizedVolumes.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSMProxy.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSession.h"

#include <QCursor>

#include <algorithm>
#include <utility>

namespace
{
// Time until a step is tried again while ParaView is busy [ms].
const int RETRY_INTERVAL = 50;

// Time after a notch of the mouse wheel and its pictures until the wheel counts as at rest [ms].
const int WHEEL_REST = 400;

// Time after the last picture of a still view until the unoptimized pictures are computed [ms].
const int REST = 1000;

bool IsSet(void* interactive)
{
  return *static_cast<int*>(interactive) != 0;
}
}

LimpidProgressiveView::LimpidProgressiveView(vtkSMRenderViewProxy* proxy, pqRenderView* view)
  : QObject(view)
  , View(view)
  , Proxy(proxy)
  , Capture(new LimpidCapture(proxy, this))
{
  this->NextStep.setSingleShot(true);
  this->connect(&this->NextStep, &QTimer::timeout, this, &LimpidProgressiveView::step);

  this->Preparation.setSingleShot(true);
  this->connect(&this->Preparation, &QTimer::timeout, this, &LimpidProgressiveView::prepare);

  this->WheelRest.setSingleShot(true);
  this->connect(&this->WheelRest, &QTimer::timeout, this, &LimpidProgressiveView::scheduleStep);

  this->Events->Connect(proxy, vtkCommand::StartEvent, this,
    SLOT(beginRender(vtkObject*, unsigned long, void*, void*)));
  this->Events->Connect(
    proxy, vtkCommand::EndEvent, this, SLOT(endRender(vtkObject*, unsigned long, void*, void*)));
  if (vtkRenderWindowInteractor* interactor = proxy->GetInteractor())
  {
    this->Events->Connect(
      interactor, vtkCommand::StartInteractionEvent, this, SLOT(beginInteraction()));
    this->Events->Connect(
      interactor, vtkCommand::EndInteractionEvent, this, SLOT(endInteraction()));
    this->Events->Connect(
      proxy->GetRenderWindow(), vtkCommand::AbortCheckEvent, this, SLOT(checkAbort()));
    constexpr float first = 1; // a priority above that of ParaView's own observer
    for (const auto event :
      { vtkCommand::MouseWheelForwardEvent, vtkCommand::MouseWheelBackwardEvent })
    {
      this->Events->Connect(interactor, event, this, SLOT(wheelTurned()), nullptr, first);
    }
  }
}

LimpidProgressiveView::~LimpidProgressiveView() = default;

void LimpidProgressiveView::setPaused(bool paused)
{
  this->Paused = paused;
  this->scheduleStep();
}

void LimpidProgressiveView::beginRender(vtkObject*, unsigned long, void*, void* interactive)
{
  this->NextStep.stop();
  this->Preparation.stop();
  if (IsSet(interactive))
  {
    return;
  }
  const bool capturing = this->Capture->isActive();
  const StillRenders how = capturing ? StillRenders::Whole
    : this->WheelRest.isActive()     ? StillRenders::Deferred
                                     : StillRenders::Stepwise;
  if (capturing)
  {
    this->Capture->begin();
  }
  for (vtkSMProxy* volume : VisibleOptimizedVolumes(this->Proxy))
  {
    SetStillRenders(volume, how);
  }
}

void LimpidProgressiveView::endRender(vtkObject*, unsigned long, void*, void* interactive)
{
  if (IsSet(interactive))
  {
    this->Unfinished = false; // ParaView makes a still render when the interaction ends
    return;
  }
  if (this->WheelRest.isActive())
  {
    this->WheelRest.start(WHEEL_REST); // again, since pictures take time
  }
  if (!this->Capture->isActive()) // if capturing, the work left in the window is unchanged
  {
    const std::vector<vtkSMProxy*> volumes = VisibleOptimizedVolumes(this->Proxy);
    this->Unfinished = !std::all_of(volumes.begin(), volumes.end(), IsConverged);
    if (!this->Unfinished)
    {
      for (vtkSMProxy* volume : volumes)
      {
        volume->UpdatePropertyInformation(); // updates the results in the properties panel
      }
      this->Preparation.start(REST);
    }
  }
  this->scheduleStep();
}

void LimpidProgressiveView::beginInteraction()
{
  this->Interacting = true;
  this->NextStep.stop();
  this->Preparation.stop();
}

void LimpidProgressiveView::endInteraction()
{
  this->Interacting = false;
  this->scheduleStep();
}

void LimpidProgressiveView::wheelTurned()
{
  this->WheelRest.start(WHEEL_REST);
  this->NextStep.stop();
}

void LimpidProgressiveView::scheduleStep()
{
  if (this->Unfinished && !this->Interacting && !this->Paused && !this->WheelRest.isActive())
  {
    this->NextStep.start(0); // at once, but after pending events
  }
  else
  {
    this->NextStep.stop();
  }
}

// Returns whether ParaView is busy with something else.
bool LimpidProgressiveView::isBusy() const
{
  return this->Proxy->GetSession()->GetPendingProgress() ||
    this->View->getServer()->isProcessingPending();
}

void LimpidProgressiveView::prepare()
{
  if (this->Interacting || this->Paused || this->WheelRest.isActive())
  {
    return;
  }
  if (this->isBusy())
  {
    this->Preparation.start(REST);
  }
  else if (!this->measureStructures())
  {
    this->prepareOriginals();
  }
}

// Measures what the picture shows of structures, and renders to tell it. Returns whether there was
// anything to measure. A server could not be interrupted, so there it is left to LimpidStructures.
bool LimpidProgressiveView::measureStructures()
{
  if (this->View->getServer()->isRemote())
  {
    return false;
  }
  std::vector<vtkSMProxy*> volumes = VisibleOptimizedVolumes(this->Proxy);
  volumes.erase(
    std::remove_if(volumes.begin(), volumes.end(), AreStructuresMeasured), volumes.end());
  if (volumes.empty())
  {
    return false;
  }
  this->MouseBefore = QCursor::pos();
  this->Measuring = true;
  for (vtkSMProxy* volume : volumes)
  {
    MeasureStructures(volume);
  }
  if (std::exchange(this->Measuring, false))
  {
    this->View->render();
  }
  else
  {
    this->Preparation.start(REST); // aborted
  }
  return true;
}

// Qt tells where the mouse is at once, but not what it does, until the events that wait are
// handled.
void LimpidProgressiveView::checkAbort()
{
  if (this->Measuring && QCursor::pos() != this->MouseBefore)
  {
    this->Measuring = false;
    this->Proxy->GetRenderWindow()->SetAbortRender(1);
  }
}

void LimpidProgressiveView::prepareOriginals()
{
  bool isLeft = false;
  for (vtkSMProxy* volume : VisibleOptimizedVolumes(this->Proxy))
  {
    isLeft = PrepareOriginal(volume) || isLeft;
  }
  if (isLeft)
  {
    this->Preparation.start(0); // at once, but after pending events
  }
}

void LimpidProgressiveView::step()
{
  if (this->isBusy())
  {
    this->NextStep.start(RETRY_INTERVAL);
    return;
  }
  this->View->forceRender();
}
