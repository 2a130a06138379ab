// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidShowOriginal.h"

#include "LimpidOptimizedVolumes.h"
#include "pqActiveObjects.h"
#include "pqRenderView.h"
#include "pqUndoStack.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMViewProxy.h"

#include <QToolButton>

namespace
{
const int ORDINARY = 1; // of the enumeration Method in LimpidRepresentations.xml

std::vector<vtkSMProxy*> VolumesOfTheActiveView()
{
  auto* view = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  return view ? VisibleOptimizedVolumes(view->getViewProxy()) : std::vector<vtkSMProxy*>();
}

void SetMethod(vtkSMProxy* volume, int method)
{
  vtkSMPropertyHelper(volume, "Method").Set(method);
  volume->UpdateVTKObjects();
}

void RenderTheActiveView()
{
  if (pqView* view = pqActiveObjects::instance().activeView())
  {
    view->render();
  }
}
}

LimpidShowOriginal::LimpidShowOriginal(QWidget* parentWidget)
  : QToolBar(tr("Limpid"), parentWidget)
  , Button(new QToolButton(this))
{
  this->setObjectName("LimpidToolbar");
  this->Button->setObjectName("ShowOriginal");
  this->Button->setText(tr("Show Original"));
  this->Button->setToolTip(tr("Hold down to see the volume without optimization."));
  this->addWidget(this->Button);

  this->connect(this->Button, &QToolButton::pressed, this, &LimpidShowOriginal::showOriginal);
  this->connect(this->Button, &QToolButton::released, this, &LimpidShowOriginal::showOptimized);

  pqActiveObjects& active = pqActiveObjects::instance();
  this->connect(&active, &pqActiveObjects::viewChanged, this, &LimpidShowOriginal::watch);
  this->watch(active.activeView());
}

void LimpidShowOriginal::watch(pqView* view)
{
  if (view)
  {
    this->connect(
      view, &pqView::endRender, this, &LimpidShowOriginal::enable, Qt::UniqueConnection);
  }
  this->enable();
}

void LimpidShowOriginal::enable()
{
  this->Button->setEnabled(!VolumesOfTheActiveView().empty());
}

void LimpidShowOriginal::showOriginal()
{
  SCOPED_UNDO_EXCLUDE();
  for (vtkSMProxy* volume : VolumesOfTheActiveView())
  {
    this->Methods.emplace_back(volume, vtkSMPropertyHelper(volume, "Method").GetAsInt());
    SetMethod(volume, ORDINARY);
  }
  RenderTheActiveView();
}

void LimpidShowOriginal::showOptimized()
{
  SCOPED_UNDO_EXCLUDE();
  for (const auto& [volume, method] : this->Methods)
  {
    if (volume)
    {
      SetMethod(volume, method);
    }
  }
  this->Methods.clear();
  RenderTheActiveView();
}
