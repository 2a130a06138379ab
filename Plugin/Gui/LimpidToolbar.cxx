// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidToolbar.h"

#include "LimpidBestView.h"
#include "LimpidMovie.h"
#include "LimpidOptimizedVolumes.h"
#include "LimpidSegmentation.h"
#include "LimpidShowOriginal.h"
#include "pqActiveObjects.h"
#include "pqView.h"
#include "vtkSMRenderViewProxy.h"

#include <QTimer>

namespace
{
const int LAYOUT_TIME = 200; // after which the panel has laid out its rows [ms]
}

LimpidToolbar::LimpidToolbar(QWidget* parentWidget)
  : QToolBar(tr("Limpid"), parentWidget)
{
  this->setObjectName("LimpidToolbar");
  this->addWidget(new LimpidShowOriginal(this));
  QAction* best = this->addAction(BestViewIcon(), tr("Find Best View"), &FindBestView);
  best->setObjectName("FindBestView");
  best->setToolTip(BestViewToolTip());
  QAction* movie = this->addAction(MovieIcon(), tr("Make Movie"), &MakeMovie);
  movie->setObjectName("MakeMovie");
  movie->setToolTip(MovieToolTip());
  this->Segmentation = this->addAction(
    SegmentationIcon(), tr("Open Segmentation ..."), this, SLOT(openSegmentation()));
  this->Segmentation->setObjectName("OpenSegmentation");
  this->Segmentation->setToolTip(SegmentationToolTip());

  pqActiveObjects& active = pqActiveObjects::instance();
  this->connect(&active, &pqActiveObjects::viewChanged, this, &LimpidToolbar::watch);
  this->connect(&active, &pqActiveObjects::portChanged, this, &LimpidToolbar::enable);
  this->watch(active.activeView());
}

void LimpidToolbar::watch(pqView* view)
{
  if (view)
  {
    this->connect(view, &pqView::endRender, this, &LimpidToolbar::enable, Qt::UniqueConnection);
  }
  this->enable();
}

void LimpidToolbar::openSegmentation()
{
  if (OpenSegmentation())
  {
    QTimer::singleShot(LAYOUT_TIME, this, SLOT(scrollToStructures()));
  }
}

void LimpidToolbar::scrollToStructures()
{
  ScrollToStructures();
}

// The toolbar itself is always enabled, so that it can be moved.
void LimpidToolbar::enable()
{
  const bool isThere = !VisibleOptimizedVolumes(ActiveRenderView()).empty();
  for (QAction* action : this->actions())
  {
    action->setEnabled(action == this->Segmentation ? CanOpenSegmentation() : isThere);
  }
}
