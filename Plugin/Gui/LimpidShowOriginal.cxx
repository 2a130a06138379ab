// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidShowOriginal.h"

#include "LimpidOptimizedVolumes.h"
#include "pqActiveObjects.h"
#include "pqUndoStack.h"
#include "pqView.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMRenderViewProxy.h"

namespace
{
const int ORDINARY = 1; // of the enumeration Method in LimpidRepresentations.xml

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
  : QToolButton(parentWidget)
{
  this->setObjectName("ShowOriginal");
  this->setText(tr("Show Original"));
  this->setIcon(QIcon(":/Limpid/Icons/ShowOriginal.svg"));
  this->setToolTip(tr("Hold down to see the volume without optimization."));
  this->connect(this, &QToolButton::pressed, this, &LimpidShowOriginal::showOriginal);
  this->connect(this, &QToolButton::released, this, &LimpidShowOriginal::showOptimized);
}

void LimpidShowOriginal::showOriginal()
{
  SCOPED_UNDO_EXCLUDE();
  for (vtkSMProxy* volume : VisibleOptimizedVolumes(ActiveRenderView()))
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
