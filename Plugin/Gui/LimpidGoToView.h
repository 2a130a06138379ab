// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidGoToView
 * @brief   the row of a viewpoint search's number of viewpoints, with buttons that go there
 *
 * For the property NumberOfViewpoints of ViewpointSearch, with panel_widget="LimpidGoToView". The
 * buttons set the active render view to the camera of the best, the next or the worst viewpoint of
 * the search, or of a selected point of an output. "Camera Undo" reverts this like a rotation by
 * the mouse. The trace includes it.
 */

#ifndef LimpidGoToView_h
#define LimpidGoToView_h

#include "pqPropertyWidget.h"

class pqRenderView;
class QLabel;
class QPushButton;
class vtkSMSourceProxy;
struct LimpidViewpoint;
struct LimpidViewpoints;

class LimpidGoToView : public pqPropertyWidget
{
  Q_OBJECT

public:
  LimpidGoToView(vtkSMProxy* proxy, vtkSMProperty* number, QWidget* parent = nullptr);

  void apply() override;
  void reset() override;

private Q_SLOTS:
  void enable();
  void goToBest();
  void goToNext();
  void goToWorst();
  void goToSelected();

private:
  QPushButton* addButton(const char* name, const QString& text, const QString& toolTip);
  pqRenderView* view() const; // the active view; null if it has no camera
  double time() const;
  void goToRanked(const LimpidViewpoints& found, int rank); // rank counted from 0
  void goTo(const LimpidViewpoint& viewpoint, const QString& name);

  vtkSMSourceProxy* Search;
  pqPropertyWidget* Row; // the plain row of the property
  QPushButton* Best;
  QPushButton* Next;
  QPushButton* Worst;
  QPushButton* Selected;
  QLabel* Where;
  int Rank = -1; // rank, counted from 0, of the viewpoint shown last
};

#endif
