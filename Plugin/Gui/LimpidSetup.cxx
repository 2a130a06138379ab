// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidSetup.h"

#include "LimpidDisplays.h"
#include "LimpidOptimizedVolumes.h"
#include "LimpidTakeOver.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqDataRepresentation.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "pqView.h"
#include "vtkSMPluginManager.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"

#include <QTimer>

#include <string>

namespace
{
bool IsLoadingState(vtkSMProxy* proxy)
{
  return proxy->GetSessionProxyManager()->GetInLoadXMLState();
}

bool IsOfLimpid(vtkSMProxy* filter)
{
  const std::string name = filter->GetXMLName();
  return name == "ExtinctionOptimizer" || name == "ViewpointSearch";
}
}

LimpidSetup::LimpidSetup(QObject* parentObject)
  : QObject(parentObject)
{
}

void LimpidSetup::onStartup()
{
  pqApplicationCore* core = pqApplicationCore::instance();
  this->connect(
    core->getObjectBuilder(), &pqObjectBuilder::filterCreated, this, &LimpidSetup::setUpFilter);
  pqCoreUtilities::connect(vtkSMProxyManager::GetProxyManager()->GetPluginManager(),
    vtkSMPluginManager::PluginLoadedEvent, this, SLOT(renewDisplays()));
  pqServerManagerModel* model = core->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::viewAdded, this, &LimpidSetup::addView);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->addView(view);
  }
  this->renewDisplays();
}

// Called when ParaView knows the definitions of a plugin that was just loaded.
void LimpidSetup::renewDisplays()
{
  QTimer::singleShot(0, this, SLOT(renewNow()));
}

void LimpidSetup::renewNow()
{
  RenewDisplays();
}

void LimpidSetup::setUpFilter(pqPipelineSource* filter)
{
  if (!IsOfLimpid(filter->getProxy()))
  {
    return;
  }
  vtkSMPropertyHelper input(filter->getProxy(), "Input");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  vtkSMRenderViewProxy* view = ActiveRenderView();
  vtkSMProxy* display = source && view
    ? view->FindRepresentation(source, static_cast<int>(input.GetOutputPort()))
    : nullptr;
  if (display && display->GetProperty("ScalarOpacityUnitDistance") &&
    vtkSMPropertyHelper(display, "Visibility").GetAsInt() != 0)
  {
    TakeOverDisplay(filter->getProxy(), display, view);
  }
}

void LimpidSetup::addView(pqView* view)
{
  this->connect(view, &pqView::representationAdded, this, &LimpidSetup::setUpDisplay);
}

void LimpidSetup::setUpDisplay(pqRepresentation* representation)
{
  auto* display = qobject_cast<pqDataRepresentation*>(representation);
  pqOutputPort* port = display ? display->getOutputPortFromInput() : nullptr;
  if (!port || IsLoadingState(display->getProxy()) ||
    !display->getProxy()->GetProperty("ImportanceArray"))
  {
    return;
  }
  vtkSMProxy* last = nullptr;
  for (pqDataRepresentation* other : port->getRepresentations(nullptr))
  {
    const bool isOther = other != display && other->getProxy() != display->getProxy();
    last = isOther && IsOptimizedVolume(other->getProxy()) ? other->getProxy() : last;
  }
  if (last)
  {
    CopyDisplay(display->getProxy(), last);
  }
}
