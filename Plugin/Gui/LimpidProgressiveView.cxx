// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidProgressiveView.h"

#include "LimpidOptimizedVolumes.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkPVView.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSMProxy.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSession.h"

#include <algorithm>

namespace
{
// Milliseconds until a step is tried again while ParaView is at work on something else.
const int RETRY_INTERVAL = 50;

// Milliseconds after a notch and its pictures, after which the mouse wheel is at rest.
const int WHEEL_REST = 400;

// Milliseconds after the last picture of a view at rest until those without optimization are made.
const int REST = 1000;

// Reads a state that views keep protected; there is never an object of this type.
struct CaptureState : public vtkPVView
{
  static bool Of(vtkPVView* view) { return (view->*(&CaptureState::GetInCaptureScreenshot))(); }
};

bool IsSet(void* interactive)
{
  return *static_cast<int*>(interactive) != 0;
}
}

LimpidProgressiveView::LimpidProgressiveView(vtkSMRenderViewProxy* proxy, pqRenderView* view)
  : QObject(view)
  , View(view)
  , Proxy(proxy)
{
  this->NextStep.setSingleShot(true);
  this->connect(&this->NextStep, &QTimer::timeout, this, &LimpidProgressiveView::step);

  this->Preparation.setSingleShot(true);
  this->connect(
    &this->Preparation, &QTimer::timeout, this, &LimpidProgressiveView::prepareOriginals);

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
    constexpr float first = 1; // before ParaView renders for it
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
  const StillRenders how = this->isCapturing() ? StillRenders::Whole
    : this->WheelRest.isActive()               ? StillRenders::Deferred
                                               : StillRenders::Stepwise;
  for (vtkSMProxy* volume : VisibleOptimizedVolumes(this->Proxy))
  {
    SetStillRenders(volume, how);
  }
}

void LimpidProgressiveView::endRender(vtkObject*, unsigned long, void*, void* interactive)
{
  if (IsSet(interactive))
  {
    this->Unfinished = false; // ParaView makes a still render itself when the interaction ends
    return;
  }
  if (this->WheelRest.isActive())
  {
    this->WheelRest.start(WHEEL_REST); // pictures take their time
  }
  if (!this->isCapturing()) // else what was unfinished in the window still is
  {
    const std::vector<vtkSMProxy*> volumes = VisibleOptimizedVolumes(this->Proxy);
    this->Unfinished = !std::all_of(volumes.begin(), volumes.end(), IsConverged);
    if (!this->Unfinished)
    {
      for (vtkSMProxy* volume : volumes)
      {
        volume->UpdatePropertyInformation(); // the results in the properties panel
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

bool LimpidProgressiveView::isCapturing() const
{
  auto* view = vtkPVView::SafeDownCast(this->Proxy->GetClientSideObject());
  return view && CaptureState::Of(view);
}

void LimpidProgressiveView::scheduleStep()
{
  if (this->Unfinished && !this->Interacting && !this->Paused && !this->WheelRest.isActive())
  {
    this->NextStep.start(0); // no time, but after the events that wait
  }
  else
  {
    this->NextStep.stop();
  }
}

// Whether ParaView is at work on something else.
bool LimpidProgressiveView::isBusy() const
{
  return this->Proxy->GetSession()->GetPendingProgress() ||
    this->View->getServer()->isProcessingPending();
}

void LimpidProgressiveView::prepareOriginals()
{
  if (this->Interacting || this->Paused || this->WheelRest.isActive())
  {
    return;
  }
  if (this->isBusy())
  {
    this->Preparation.start(REST);
    return;
  }
  bool isLeft = false;
  for (vtkSMProxy* volume : VisibleOptimizedVolumes(this->Proxy))
  {
    isLeft = PrepareOriginal(volume) || isLeft;
  }
  if (isLeft)
  {
    this->Preparation.start(0); // no time, but after the events that wait
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
