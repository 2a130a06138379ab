// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidGoToView
 * @brief   the row of a viewpoint search's number of viewpoints, with buttons that go there
 *
 * For the property NumberOfViewpoints of ViewpointSearch, with panel_widget="LimpidGoToView". The
 * buttons give the active render view the camera of the best, the next or the worst viewpoint that
 * was found, or of a selected point of an output. As with a turn by the mouse, that can be undone
 * by "Camera Undo". The trace has it.
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
  pqRenderView* view() const; // the active one, if it has a camera
  double time() const;
  void goToRanked(const LimpidViewpoints& found, int rank); // rank from 0
  void goTo(const LimpidViewpoint& viewpoint, const QString& name);

  vtkSMSourceProxy* Search;
  pqPropertyWidget* Row; // the plain row of the property
  QPushButton* Best;
  QPushButton* Next;
  QPushButton* Worst;
  QPushButton* Selected;
  QLabel* Where;
  int Rank = -1; // of the ranked viewpoint that was gone to last, from 0
};

#endif
