// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidProgressiveView
 * @brief   refines the optimised volumes of one view while nothing else happens
 *
 * Still renders of the view make one step each. As long as the last one left something to do,
 * another follows as soon as no event of the user waits. None follows when all is done, while the
 * user interacts, or while an animation plays. Between notches of the mouse wheel, ParaView's still
 * renders are made like interactive ones, and no step is made until the wheel has rested. Pictures
 * that are captured (screenshots, frames of a saved animation) are made whole in one render.
 * When all is done and nothing has happened for a second, the pictures without optimisation are
 * made, so that Show Original shows them at once.
 */

#ifndef LimpidProgressiveView_h
#define LimpidProgressiveView_h

#include "vtkNew.h"

#include <QObject>
#include <QTimer>

class pqRenderView;
class vtkEventQtSlotConnect;
class vtkObject;
class vtkSMRenderViewProxy;

class LimpidProgressiveView : public QObject
{
  Q_OBJECT

public:
  LimpidProgressiveView(vtkSMRenderViewProxy* proxy, pqRenderView* view);
  ~LimpidProgressiveView() override;

  /// While paused no steps are taken.
  void setPaused(bool paused);

private Q_SLOTS:
  // Events of the view's proxy; `interactive` points to an int.
  void beginRender(vtkObject*, unsigned long, void*, void* interactive);
  void endRender(vtkObject*, unsigned long, void*, void* interactive);
  // Events of the view's interactor.
  void beginInteraction();
  void endInteraction();
  void wheelTurned();
  void step();
  void prepareOriginals();

private:
  bool isCapturing() const;
  void scheduleStep();
  bool isBusy() const;

  pqRenderView* View; // the parent
  vtkSMRenderViewProxy* Proxy;
  vtkNew<vtkEventQtSlotConnect> Events;
  QTimer NextStep;
  QTimer Preparation;      // active: all is done, and what Show Original shows is made next
  QTimer WheelRest;        // active: the wheel has just been turned
  bool Unfinished = false; // the last render left something to do
  bool Interacting = false;
  bool Paused = false;
};

#endif
