// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidActiveCamera.h"

#include "pqActiveObjects.h"
#include "pqDoubleVectorPropertyWidget.h"
#include "pqRenderView.h"
#include "vtkCamera.h"
#include "vtkRenderer.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMRenderViewProxy.h"

#include <QPushButton>
#include <QVBoxLayout>

namespace
{
// Sets the unchecked value of a property, which its row shows and Apply accepts.
void FillIn(vtkSMProxy* proxy, const char* name, const double* values, unsigned int count)
{
  vtkSMPropertyHelper helper(proxy, name, /*quiet=*/true);
  helper.SetUseUnchecked(true);
  helper.Set(values, count);
}

void FillIn(vtkSMProxy* proxy, const char* name, double value)
{
  FillIn(proxy, name, &value, 1);
}

void FillIn(vtkSMProxy* proxy, const char* name, int value)
{
  vtkSMPropertyHelper helper(proxy, name, /*quiet=*/true);
  helper.SetUseUnchecked(true);
  helper.Set(value);
}
}

LimpidActiveCamera::LimpidActiveCamera(
  vtkSMProxy* proxy, vtkSMProperty* position, QWidget* parentWidget)
  : pqPropertyWidget(proxy, parentWidget)
  , Row(new pqDoubleVectorPropertyWidget(position, proxy, this))
  , Button(new QPushButton(tr("Use Camera of Active View"), this))
{
  this->Row->setProperty(position);
  this->Row->setObjectName("Row");
  this->Button->setObjectName("UseActiveCamera");
  this->Button->setToolTip(
    tr("Fill in position, focal point, view up, angle, projection and aspect "
       "ratio of the active render view. Apply then uses them."));

  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(this->Button);
  column->addWidget(this->Row);

  this->connect(
    this->Row, &pqPropertyWidget::changeAvailable, this, &pqPropertyWidget::changeAvailable);
  this->connect(
    this->Row, &pqPropertyWidget::changeFinished, this, &pqPropertyWidget::changeFinished);
  this->connect(this->Button, &QPushButton::clicked, this, &LimpidActiveCamera::fillIn);

  pqActiveObjects& active = pqActiveObjects::instance();
  this->connect(&active, &pqActiveObjects::viewChanged, this, &LimpidActiveCamera::enableFor);
  this->enableFor(active.activeView());
}

void LimpidActiveCamera::apply()
{
  this->Row->apply();
  this->pqPropertyWidget::apply();
}

void LimpidActiveCamera::reset()
{
  this->Row->reset();
  this->pqPropertyWidget::reset();
}

void LimpidActiveCamera::enableFor(pqView* view)
{
  this->Button->setEnabled(qobject_cast<pqRenderView*>(view) != nullptr);
}

void LimpidActiveCamera::fillIn()
{
  auto* view = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  if (!view)
  {
    return;
  }
  vtkSMRenderViewProxy* viewProxy = view->getRenderViewProxy();
  vtkCamera* camera = viewProxy->GetActiveCamera();
  vtkSMProxy* filter = this->proxy();

  FillIn(filter, "CameraPosition", camera->GetPosition(), 3);
  FillIn(filter, "CameraFocalPoint", camera->GetFocalPoint(), 3);
  FillIn(filter, "CameraViewUp", camera->GetViewUp(), 3);
  FillIn(filter, "CameraViewAngle", camera->GetViewAngle());
  FillIn(filter, "CameraParallelProjection", camera->GetParallelProjection());
  FillIn(filter, "CameraParallelScale", camera->GetParallelScale());
  FillIn(filter, "CameraAspectRatio", viewProxy->GetRenderer()->GetTiledAspectRatio());

  Q_EMIT this->changeAvailable();
  Q_EMIT this->changeFinished();
}
