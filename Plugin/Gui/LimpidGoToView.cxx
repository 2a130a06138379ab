// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidGoToView.h"

#include "LimpidBestView.h"
#include "LimpidViewpoints.h"
#include "pqActiveObjects.h"
#include "pqCoreUtilities.h"
#include "pqIntVectorPropertyWidget.h"
#include "pqRenderView.h"
#include "vtkCommand.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace
{
const unsigned int VIEWPOINTS = 1; // output port

// Returns the rank, counted from 0, of the viewpoint that a view looks from, or -1.
int RankOf(vtkSMRenderViewProxy* view, const std::vector<LimpidViewpoint>& ranked)
{
  limpid::Vec3 position;
  limpid::Vec3 focalPoint;
  vtkSMPropertyHelper(view, "CameraPosition").Get(&position.x, 3);
  vtkSMPropertyHelper(view, "CameraFocalPoint").Get(&focalPoint.x, 3);
  for (std::size_t rank = 0; rank < ranked.size(); ++rank)
  {
    const limpid::Camera camera = CameraOf(ranked[rank], view);
    if (camera.position == position && camera.focalPoint == focalPoint)
    {
      return static_cast<int>(rank);
    }
  }
  return -1;
}
}

LimpidGoToView::LimpidGoToView(vtkSMProxy* proxy, vtkSMProperty* number, QWidget* parentWidget)
  : pqPropertyWidget(proxy, parentWidget)
  , Search(vtkSMSourceProxy::SafeDownCast(proxy))
  , Row(new pqIntVectorPropertyWidget(number, proxy, this))
  , Best(this->addButton("GoToBest", tr("Go to Best View"),
      tr("Look from the viewpoint that shows the most of the important structures.")))
  , Next(this->addButton("GoToNext", tr("Next"), tr("Look from the next best viewpoint.")))
  , Worst(this->addButton("GoToWorst", tr("Worst"),
      tr("Look from the direction that shows the least of the important structures.")))
  , Selected(this->addButton("LookFromSelected", tr("Look from Selected Point"),
      tr("Look from the selected point of the sphere, or from the best of several. Select points "
         "with Select Points On or the key D.")))
  , Where(new QLabel(this))
{
  this->Row->setProperty(number);
  this->Row->setObjectName("Row");
  this->Where->setObjectName("Where");

  auto* buttons = new QGridLayout();
  buttons->addWidget(this->Best, 0, 0, 1, 2);
  buttons->addWidget(this->Next, 1, 0);
  buttons->addWidget(this->Worst, 1, 1);
  buttons->addWidget(this->Selected, 2, 0, 1, 2);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(this->Row);
  column->addLayout(buttons);
  column->addWidget(this->Where);

  this->connect(
    this->Row, &pqPropertyWidget::changeAvailable, this, &pqPropertyWidget::changeAvailable);
  this->connect(
    this->Row, &pqPropertyWidget::changeFinished, this, &pqPropertyWidget::changeFinished);
  this->connect(this->Best, &QPushButton::clicked, this, &LimpidGoToView::goToBest);
  this->connect(this->Next, &QPushButton::clicked, this, &LimpidGoToView::goToNext);
  this->connect(this->Worst, &QPushButton::clicked, this, &LimpidGoToView::goToWorst);
  this->connect(this->Selected, &QPushButton::clicked, this, &LimpidGoToView::goToSelected);

  this->connect(
    &pqActiveObjects::instance(), &pqActiveObjects::viewChanged, this, &LimpidGoToView::enable);
  pqCoreUtilities::connect(proxy, vtkCommand::UpdateDataEvent, this, SLOT(enable()));
  pqCoreUtilities::connect(proxy, vtkCommand::SelectionChangedEvent, this, SLOT(enable()));
  this->enable();
}

QPushButton* LimpidGoToView::addButton(
  const char* name, const QString& text, const QString& toolTip)
{
  auto* button = new QPushButton(text, this);
  button->setObjectName(name);
  button->setToolTip(toolTip);
  return button;
}

void LimpidGoToView::apply()
{
  this->Row->apply();
  this->pqPropertyWidget::apply();
}

void LimpidGoToView::reset()
{
  this->Row->reset();
  this->pqPropertyWidget::reset();
}

pqRenderView* LimpidGoToView::view() const
{
  // A comparative view is a pqRenderView too, but its proxy is not a render view.
  auto* active = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  return active && active->getRenderViewProxy() ? active : nullptr;
}

double LimpidGoToView::time() const
{
  return vtkSMPropertyHelper(this->view()->getProxy(), "ViewTime").GetAsDouble();
}

void LimpidGoToView::enable()
{
  const bool isFound =
    this->view() && this->Search->GetDataInformation(VIEWPOINTS)->GetNumberOfPoints() > 0;
  this->Best->setEnabled(isFound);
  this->Next->setEnabled(isFound);
  this->Worst->setEnabled(isFound);
  this->Selected->setEnabled(isFound && HasSelection(this->Search));
}

void LimpidGoToView::goToBest()
{
  const LimpidViewpoints found = FindViewpoints(this->Search, this->time());
  this->goToRanked(found, 0);
}

void LimpidGoToView::goToNext()
{
  const LimpidViewpoints found = FindViewpoints(this->Search, this->time());
  if (!found.Ranked.empty())
  {
    // The view may have reached this camera in another way, for instance by "Camera Undo".
    const int here = RankOf(this->view()->getRenderViewProxy(), found.Ranked);
    const int last = here < 0 ? this->Rank : here;
    this->goToRanked(found, (last + 1) % static_cast<int>(found.Ranked.size()));
  }
}

void LimpidGoToView::goToRanked(const LimpidViewpoints& found, int rank)
{
  if (rank < static_cast<int>(found.Ranked.size()))
  {
    this->Rank = rank;
    this->goTo(found.Ranked[rank],
      rank == 0 ? tr("Best viewpoint")
                : tr("Viewpoint %1 of %2").arg(rank + 1).arg(found.Ranked.size()));
  }
}

void LimpidGoToView::goToWorst()
{
  const LimpidViewpoints found = FindViewpoints(this->Search, this->time());
  if (found.Worst)
  {
    this->goTo(*found.Worst, tr("Worst view"));
  }
}

void LimpidGoToView::goToSelected()
{
  if (const auto viewpoint = FindBestSelected(this->Search, this->time()))
  {
    this->goTo(*viewpoint, tr("Selected point"));
  }
}

void LimpidGoToView::goTo(const LimpidViewpoint& viewpoint, const QString& name)
{
  LookFrom(viewpoint, this->view(), " " + name.toLower());
  this->Where->setText(
    tr("%1: %2 % visible").arg(name).arg(100 * viewpoint.VisibleFraction, 0, 'f', 1));
}
