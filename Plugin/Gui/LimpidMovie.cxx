// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidMovie.h"

#include "LimpidBestView.h"
#include "LimpidCameraAnimation.h"
#include "LimpidDataArray.h"
#include "LimpidOptimizedVolumes.h"
#include "LimpidTuples.h"

#include "pqActiveObjects.h"
#include "pqCoreUtilities.h"
#include "pqRenderView.h"
#include "pqUndoStack.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"

#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QIcon>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>

namespace
{
const int FRAMES_PER_SECOND = 25;

// All have the axis that is upright in the path's pictures as their view-up, as ParaView's path of
// a camera has one: the preview and the first frame are then the animation's own cameras.
std::vector<limpid::Camera> CamerasOf(vtkPolyData* path)
{
  vtkFieldData* fields = path->GetFieldData();
  std::vector<limpid::Camera> cameras;
  for (vtkIdType i = 0; i < path->GetNumberOfPoints(); ++i)
  {
    limpid::Camera camera;
    camera.position = LimpidTuples(path->GetPointData(), "CameraPosition").Vector(i);
    camera.focalPoint = LimpidTuples(path->GetPointData(), "CameraFocalPoint").Vector(i);
    camera.viewUp = LimpidTuples(fields, "CameraUpAxis").Vector(0);
    camera.viewAngle = LimpidTuples(fields, "CameraViewAngle").Number(0);
    camera.parallel = LimpidTuples(fields, "CameraParallelProjection").Number(0) != 0;
    camera.parallelScale = LimpidTuples(fields, "CameraParallelScale").Number(0);
    cameras.push_back(camera);
  }
  return cameras;
}
}

LimpidMovie::LimpidMovie(vtkSMSourceProxy* search, pqRenderView* view, QWidget* parentWidget)
  : QDialog(parentWidget)
  , Path(NewHiddenFilter("CameraPath", search, 0))
  , View(view)
  , Before(PresentCamera(view->getRenderViewProxy()))
  , KeyViews(this->addNumber("KeyViews", 1, 20, 4))
  , FrameCount(this->addNumber("Frames", 2, 1000, 120))
  , Says(new QLabel(this))
{
  this->setObjectName("LimpidMovie");
  this->setWindowTitle(tr("Make Movie"));
  this->setAttribute(Qt::WA_DeleteOnClose);
  this->Says->setObjectName("Says");
  this->Says->setWordWrap(true);
  this->createPreview();

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  buttons->setObjectName("Buttons");
  buttons->button(QDialogButtonBox::Cancel)->setObjectName("Cancel");
  this->Make = buttons->addButton(tr("Make Movie"), QDialogButtonBox::AcceptRole);
  this->Make->setObjectName("Make");
  this->connect(buttons, &QDialogButtonBox::accepted, this, &LimpidMovie::accept);
  this->connect(buttons, &QDialogButtonBox::rejected, this, &LimpidMovie::reject);

  auto* preview = new QHBoxLayout();
  preview->addWidget(this->Play);
  preview->addWidget(this->Slider, 1);
  auto* rows = new QFormLayout(this);
  rows->addRow(tr("Best Views"), this->KeyViews);
  rows->addRow(tr("Frames"), this->FrameCount);
  rows->addRow(tr("Preview"), preview);
  rows->addRow(this->Says);
  rows->addRow(buttons);
  this->findPath();
}

LimpidMovie::~LimpidMovie() = default;

QSpinBox* LimpidMovie::addNumber(const char* name, int least, int most, int value)
{
  auto* box = new QSpinBox(this);
  box->setObjectName(name);
  box->setRange(least, most);
  box->setValue(value);
  this->connect(box, QOverload<int>::of(&QSpinBox::valueChanged), this, &LimpidMovie::findPath);
  return box;
}

void LimpidMovie::createPreview()
{
  this->Slider = new QSlider(Qt::Horizontal, this);
  this->Slider->setObjectName("Preview");
  this->Slider->setToolTip(tr("Shows a frame of the movie."));
  this->connect(this->Slider, &QSlider::valueChanged, this, &LimpidMovie::showFrame);
  this->Play = new QPushButton(tr("Play"), this);
  this->Play->setObjectName("Play");
  this->Play->setAutoDefault(false);
  this->connect(this->Play, &QPushButton::clicked, this, &LimpidMovie::playOrStop);
  this->Playing.setInterval(1000 / FRAMES_PER_SECOND);
  this->connect(&this->Playing, &QTimer::timeout, this, &LimpidMovie::playNext);
}

// The search has scored all directions; a path through them takes no time.
void LimpidMovie::findPath()
{
  if (!this->View)
  {
    return;
  }
  SCOPED_UNDO_EXCLUDE(); // the path is no part of the session
  vtkSMPropertyHelper(this->Path, "NumberOfKeyViews").Set(this->KeyViews->value());
  vtkSMPropertyHelper(this->Path, "NumberOfFrames").Set(this->FrameCount->value());
  this->Path->UpdateVTKObjects();
  const double time = vtkSMPropertyHelper(this->View->getProxy(), "ViewTime").GetAsDouble();
  const auto output = BringToClient(this->Path, 0, VTK_POLY_DATA, time);
  auto* path = vtkPolyData::SafeDownCast(output);
  this->Frames = path ? CamerasOf(path) : std::vector<limpid::Camera>();

  const int count = static_cast<int>(this->Frames.size());
  this->Says->setText(count > 0
      ? tr("%1 frames, %2 s at %3 per second, round the volume and back to the best view. File > "
           "Save Animation saves them when the movie is made.")
          .arg(count)
          .arg(double(count) / FRAMES_PER_SECOND, 0, 'f', 1)
          .arg(FRAMES_PER_SECOND)
      : tr("There is no path: see the messages."));
  this->Make->setEnabled(count > 0);
  this->Play->setEnabled(count > 0);
  this->Slider->setEnabled(count > 0);
  const QSignalBlocker blocker(this->Slider);
  this->Slider->setRange(0, count > 0 ? count - 1 : 0);
  this->showFrame(this->Slider->value());
}

// While it moves as quickly as while a person turns it.
void LimpidMovie::showFrame(int number)
{
  if (!this->View || number >= static_cast<int>(this->Frames.size()))
  {
    return;
  }
  SetCamera(this->View->getRenderViewProxy(), this->Frames[static_cast<std::size_t>(number)]);
  if (this->Playing.isActive() || this->Slider->isSliderDown())
  {
    this->View->getRenderViewProxy()->InteractiveRender();
  }
  else
  {
    this->View->render();
  }
}

void LimpidMovie::playOrStop()
{
  const bool plays = !this->Playing.isActive();
  this->Play->setText(plays ? tr("Stop") : tr("Play"));
  if (plays)
  {
    this->Playing.start();
    return;
  }
  this->Playing.stop();
  this->showFrame(this->Slider->value());
}

void LimpidMovie::playNext()
{
  this->Slider->setValue((this->Slider->value() + 1) % (this->Slider->maximum() + 1));
}

void LimpidMovie::close(const limpid::Camera& camera, int result)
{
  this->Playing.stop();
  if (this->View)
  {
    SetCamera(this->View->getRenderViewProxy(), camera);
    this->View->render();
  }
  this->QDialog::done(result);
}

void LimpidMovie::accept()
{
  const limpid::Camera first = this->Frames.empty() ? this->Before : this->Frames.front();
  if (this->View && !this->Frames.empty())
  {
    // "Camera Undo" leads to where the view was, and the animation has an undo of its own.
    SetCamera(this->View->getRenderViewProxy(), this->Before);
    LookFrom(first, first.focalPoint, this->View, tr(" first frame of the movie"));
    AnimateCamera(this->View->getRenderViewProxy(), this->Frames);
  }
  this->close(first, QDialog::Accepted);
}

void LimpidMovie::reject()
{
  this->close(this->Before, QDialog::Rejected);
}

void MakeMovie()
{
  auto* view = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  if (const vtkSmartPointer<vtkSMSourceProxy> search = SearchActiveVolume())
  {
    QWidget* window = pqCoreUtilities::mainWidget();
    // A dialog that was closed may wait for Qt to delete it, and answer to the same name meanwhile.
    delete window->findChild<LimpidMovie*>(QString(), Qt::FindDirectChildrenOnly);
    auto* dialog = new LimpidMovie(search, view, window);
    dialog->setModal(true);
    dialog->show();
    // Over the panels, not over what it previews.
    dialog->move(window->mapToGlobal(QPoint(0, window->height() - dialog->height())));
  }
}

QIcon MovieIcon()
{
  return QIcon(":/Limpid/Icons/MakeMovie.svg");
}

QString MovieToolTip()
{
  return QCoreApplication::translate("LimpidMovie",
    "Move the camera at constant speed through the best views, as an animation of the view.");
}
