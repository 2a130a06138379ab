// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidProgressiveView
 * @brief   refines the optimised volumes of a view while ParaView is idle
 *
 * Each still render of the view makes one step. While work is left, another one follows as soon as
 * no user event is pending; none follows if all is done, during interaction, or while an animation
 * plays. Between notches of the mouse wheel, ParaView's still renders are made like interactive
 * ones, and no step is made until the wheel is at rest. Captured pictures (screenshots, frames of a
 * saved animation) are completed in one render, whose progress LimpidCapture shows. When all is
 * done and ParaView has been idle for a second, it is measured what the picture shows of each
 * structure, which the next render tells; moving the mouse aborts this, and it is not done on
 * remote servers. Then the unoptimized pictures are computed, so that Show Original shows them at
 * once.
 */

#ifndef LimpidProgressiveView_h
#define LimpidProgressiveView_h

#include "vtkNew.h"

#include <QObject>
#include <QPoint>
#include <QTimer>

class LimpidCapture;
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

  /// While paused, no steps are made.
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
  void prepare();
  void checkAbort(); // an event of the view's window

private:
  void scheduleStep();
  bool measureStructures();
  void prepareOriginals();
  bool isBusy() const;

  pqRenderView* View; // the parent
  vtkSMRenderViewProxy* Proxy;
  LimpidCapture* Capture; // a child
  vtkNew<vtkEventQtSlotConnect> Events;
  QTimer NextStep;
  QTimer Preparation;      // active: all is done, and what may be asked for is computed next
  QTimer WheelRest;        // active: the wheel was turned recently
  bool Unfinished = false; // whether the last render left work
  bool Interacting = false;
  bool Measuring = false; // off as soon as it is aborted
  QPoint MouseBefore;     // position of the mouse when measuring began
  bool Paused = false;
};

#endif
