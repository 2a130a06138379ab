// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidProgressiveViews.h"

#include "LimpidProgressiveView.h"
#include "pqAnimationScene.h"
#include "pqApplicationCore.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"
#include "vtkSMRenderViewProxy.h"

LimpidProgressiveViews::LimpidProgressiveViews(QObject* parentObject)
  : QObject(parentObject)
{
}

void LimpidProgressiveViews::onStartup()
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::viewAdded, this, &LimpidProgressiveViews::addView);
  this->connect(model, &pqServerManagerModel::proxyAdded, this, &LimpidProgressiveViews::addScene);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->addView(view);
  }
  for (pqAnimationScene* scene : model->findItems<pqAnimationScene*>())
  {
    this->addScene(scene);
  }
}

void LimpidProgressiveViews::onShutdown()
{
  for (LimpidProgressiveView* view : this->Views)
  {
    delete view;
  }
  this->Views.clear();
}

void LimpidProgressiveViews::addView(pqView* view)
{
  // A comparative view is a pqRenderView too, but its proxy is not a render view. It completes its
  // parts in one render.
  auto* renderView = qobject_cast<pqRenderView*>(view);
  auto* proxy = vtkSMRenderViewProxy::SafeDownCast(view->getViewProxy());
  if (renderView && proxy)
  {
    this->Views.removeAll(nullptr);
    this->Views.append(new LimpidProgressiveView(proxy, renderView));
  }
}

void LimpidProgressiveViews::addScene(pqProxy* proxy)
{
  if (auto* scene = qobject_cast<pqAnimationScene*>(proxy))
  {
    this->connect(scene, SIGNAL(beginPlay(vtkObject*, unsigned long, void*, void*)), SLOT(pause()));
    this->connect(scene, SIGNAL(endPlay(vtkObject*, unsigned long, void*, void*)), SLOT(resume()));
  }
}

void LimpidProgressiveViews::pause()
{
  this->setPaused(true);
}

void LimpidProgressiveViews::resume()
{
  this->setPaused(false);
}

void LimpidProgressiveViews::setPaused(bool paused)
{
  for (LimpidProgressiveView* view : this->Views)
  {
    if (view)
    {
      view->setPaused(paused);
    }
  }
}
