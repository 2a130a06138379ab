// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidCapture.h"

#include "CapturedView.h"
#include "pqAnimationScene.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqProgressManager.h"
#include "pqServerManagerModel.h"
#include "vtkAbstractVolumeMapper.h"
#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkSMProxy.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSession.h"
#include "vtkVolume.h"
#include "vtkVolumeCollection.h"

#include <QApplication>
#include <QEventLoop>
#include <QList>
#include <QProgressBar>

#include <cmath>

namespace
{
// Time that a capture may take until progress is shown [ms].
const int SHOW_AFTER = 500;

// Time between two updates of the dialog [ms].
const int UPDATE_INTERVAL = 200;

// Keeps the windows of ParaView, apart from a dialog, from being painted: OpenGL widgets would make
// other contexts current.
class WithoutPainting
{
public:
  explicit WithoutPainting(const QWidget* dialog)
  {
    for (QWidget* window : QApplication::topLevelWidgets())
    {
      if (window != dialog && window->updatesEnabled())
      {
        window->setUpdatesEnabled(false);
        this->Windows.append(window);
      }
    }
  }
  ~WithoutPainting()
  {
    for (QWidget* window : this->Windows)
    {
      if (window)
      {
        window->setUpdatesEnabled(true);
      }
    }
  }
  WithoutPainting(const WithoutPainting&) = delete;
  void operator=(const WithoutPainting&) = delete;

private:
  QList<QPointer<QWidget>> Windows;
};

// Makes ParaView count as busy, so that its timers and those of LimpidProgressiveView render
// nothing. The mouse and the keyboard, which ParaView ignores while it is busy, reach the modal
// dialog.
class Busy
{
public:
  explicit Busy(vtkSMSession* session)
    : Session(session)
    , Manager(pqApplicationCore::instance()->getProgressManager())
  {
    this->Session->PrepareProgress();
    this->WasUnblocked = this->Manager->unblockEvents(true);
  }
  ~Busy()
  {
    this->Manager->unblockEvents(this->WasUnblocked);
    this->Session->CleanupPendingProgress();
  }
  Busy(const Busy&) = delete;
  void operator=(const Busy&) = delete;

private:
  vtkSMSession* Session;
  pqProgressManager* Manager;
  bool WasUnblocked = false;
};

// Restores the context of a window and its framebuffers, as VTK assumes them to be.
class KeptContext
{
public:
  explicit KeptContext(vtkRenderWindow* window)
    : Window(vtkOpenGLRenderWindow::SafeDownCast(window))
  {
    if (this->Window)
    {
      this->Window->GetState()->PushFramebufferBindings();
    }
  }
  ~KeptContext()
  {
    if (this->Window)
    {
      this->Window->MakeCurrent();
      this->Window->GetState()->ResetFramebufferBindings(); // a widget binds its own
      this->Window->GetState()->PopFramebufferBindings();
    }
  }
  KeptContext(const KeptContext&) = delete;
  void operator=(const KeptContext&) = delete;

private:
  vtkOpenGLRenderWindow* Window;
};

// Keeps an animation that is being saved from going on to its next frame.
void StopAnimations()
{
  const pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  for (const pqAnimationScene* scene : model->findItems<pqAnimationScene*>())
  {
    scene->getProxy()->InvokeCommand("Stop"); // has no effect unless it plays
  }
}

// Returns the share of a picture that is done [%], whose tiles are rendered row by row. `share`:
// that of the present tile.
int PercentOf(vtkRenderWindow* window, double share)
{
  const int* tiles = window->GetTileScale();
  const double* corner = window->GetTileViewport();
  const double before =
    std::round(corner[1] * tiles[1]) * tiles[0] + std::round(corner[0] * tiles[0]);
  return static_cast<int>(100 * (before + share) / (tiles[0] * tiles[1]));
}
}

LimpidCapture::LimpidCapture(vtkSMRenderViewProxy* proxy, QObject* parentObject)
  : QObject(parentObject)
  , Proxy(proxy)
{
  this->End.setSingleShot(true);
  this->connect(&this->End, &QTimer::timeout, this, &LimpidCapture::finish);
}

LimpidCapture::~LimpidCapture()
{
  delete this->Dialog;
}

bool LimpidCapture::isActive() const
{
  auto* view = vtkPVView::SafeDownCast(this->Proxy->GetClientSideObject());
  return view && limpid::IsCaptured(view);
}

void LimpidCapture::begin()
{
  this->Progress->Disconnect(); // volumes may have come and gone
  vtkVolumeCollection* volumes = this->Proxy->GetRenderer()->GetVolumes();
  for (int i = 0; i < volumes->GetNumberOfItems(); ++i)
  {
    auto* volume = vtkVolume::SafeDownCast(volumes->GetItemAsObject(i));
    vtkAbstractVolumeMapper* mapper = volume ? volume->GetMapper() : nullptr;
    if (mapper && mapper->IsA("vtkTransmittanceVolumeMapper"))
    {
      this->Progress->Connect(mapper, vtkCommand::ProgressEvent, this,
        SLOT(advance(vtkObject*, unsigned long, void*, void*)));
    }
  }
  if (!this->Observing)
  {
    this->Observing = true;
    this->Aborted = false;
    this->SinceBegin.start();
    this->SinceUpdate.start();
  }
  this->End.start(0);
}

void LimpidCapture::advance(vtkObject* mapper, unsigned long, void*, void* share)
{
  if (!this->isActive())
  {
    return;
  }
  const int percent = PercentOf(this->Proxy->GetRenderWindow(), *static_cast<double*>(share));
  if (!this->Aborted && this->isAborted(percent))
  {
    this->Aborted = true;
    StopAnimations();
  }
  if (this->Aborted)
  {
    vtkAlgorithm::SafeDownCast(mapper)->SetAbortExecute(1);
  }
}

// Updates the dialog if it is time to, and returns whether its button was pressed.
bool LimpidCapture::isAborted(int percent)
{
  if (this->SinceBegin.elapsed() < SHOW_AFTER || this->SinceUpdate.elapsed() < UPDATE_INTERVAL)
  {
    return false;
  }
  auto* shown = qobject_cast<QProgressDialog*>(QApplication::activeModalWidget());
  if (!shown) // else ParaView's, or that of this object
  {
    shown = this->openDialog();
  }
  if (shown == this->Dialog)
  {
    this->Bar->setValue(percent);
  }
  {
    const WithoutPainting others(shown);
    const KeptContext context(this->Proxy->GetRenderWindow());
    const Busy busy(this->Proxy->GetSession());
    QCoreApplication::processEvents(QEventLoop::ExcludeSocketNotifiers); // no data of a server
  }
  this->SinceUpdate.start();
  return shown->wasCanceled();
}

QProgressDialog* LimpidCapture::openDialog()
{
  if (!this->Dialog)
  {
    this->Dialog = new QProgressDialog(tr("Rendering the picture to be saved ..."), tr("Abort"), 0,
      100, pqCoreUtilities::mainWidget());
    this->Dialog->setObjectName("LimpidCapture");
    this->Dialog->setWindowTitle(tr("Optimized Volume"));
    this->Dialog->setModal(true);
    // The dialog's own setValue would process events.
    this->Bar = new QProgressBar();
    this->Dialog->setBar(this->Bar);
  }
  this->Dialog->show();
  return this->Dialog;
}

// Ends the observation when the capture is over.
void LimpidCapture::finish()
{
  if (this->isActive())
  {
    this->End.start(UPDATE_INTERVAL);
    return;
  }
  this->Observing = false;
  this->Progress->Disconnect();
  delete this->Dialog;
  if (this->Aborted)
  {
    this->Proxy->StillRender(); // the window's buffers hold an unfinished tile
    vtkGenericWarningMacro(
      << "What was just saved is incomplete (rendering was aborted, so parts of "
         "the optimized volume are missing). Save it again, with fewer pixels if "
         "that takes too long.");
  }
}
