// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidCapture
 * @brief   shows the progress of a picture that ParaView saves, and lets the user abort it
 *
 * Observes the mappers of a view's optimised volumes on the client while ParaView captures the
 * view. If a picture takes longer than half a second, a dialog shows the share of its rays that
 * have been cast, and has a button that aborts. While an animation is saved, ParaView's own dialog
 * is open: its button then aborts the frame, too. Where pixels come from a server, nothing is
 * observed, and nothing is shown.
 *
 * ParaView cannot be kept from writing the file of an aborted picture, which lacks parts of the
 * volume. A warning says so when the capture has ended.
 *
 * Within a frame, ParaView counts as busy while events are processed, and only the dialog is
 * painted: nothing else renders.
 */

#ifndef LimpidCapture_h
#define LimpidCapture_h

#include "vtkNew.h"

#include <QElapsedTimer>
#include <QObject>
#include <QPointer>
#include <QProgressDialog>
#include <QTimer>

class QProgressBar;
class vtkEventQtSlotConnect;
class vtkObject;
class vtkSMRenderViewProxy;

class LimpidCapture : public QObject
{
  Q_OBJECT

public:
  LimpidCapture(vtkSMRenderViewProxy* proxy, QObject* parent);
  ~LimpidCapture() override;

  /// Returns whether the present picture of the view is going to be saved.
  bool isActive() const;

  /// Observes the frames of a capture, until it has ended.
  void begin();

private Q_SLOTS:
  // Event of a mapper; `share` points to a double, the share of a frame's rays that have been cast.
  void advance(vtkObject* mapper, unsigned long, void*, void* share);
  void finish();

private:
  bool isAborted(int percent);
  QProgressDialog* openDialog();

  vtkSMRenderViewProxy* Proxy;
  vtkNew<vtkEventQtSlotConnect> Progress;
  QPointer<QProgressDialog> Dialog; // null unless one was needed
  QProgressBar* Bar = nullptr;      // of the dialog
  QElapsedTimer SinceBegin;
  QElapsedTimer SinceUpdate;
  QTimer End; // waits until ParaView handles events again
  bool Observing = false;
  bool Aborted = false;
};

#endif
