// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidToolbar
 * @brief   actions for the optimised volumes of the active view, and for the active image
 */

#ifndef LimpidToolbar_h
#define LimpidToolbar_h

#include <QToolBar>

class pqView;

class LimpidToolbar : public QToolBar
{
  Q_OBJECT

public:
  explicit LimpidToolbar(QWidget* parent = nullptr);

private Q_SLOTS:
  void watch(pqView* view);
  void enable();
  void openSegmentation();
  void scrollToStructures();

private:
  QAction* Segmentation;
};

#endif
