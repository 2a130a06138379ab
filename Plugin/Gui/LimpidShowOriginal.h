// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidShowOriginal
 * @brief   a button that shows the original volume while it is pressed
 *
 * While the button is pressed, the optimised volumes of the active view have the method "Ordinary".
 * Then their own methods are restored, so there is nothing to undo.
 */

#ifndef LimpidShowOriginal_h
#define LimpidShowOriginal_h

#include "vtkWeakPointer.h"

#include <QToolButton>
#include <utility>
#include <vector>

class vtkSMProxy;

class LimpidShowOriginal : public QToolButton
{
  Q_OBJECT

public:
  explicit LimpidShowOriginal(QWidget* parent = nullptr);

private Q_SLOTS:
  void showOriginal();
  void showOptimized();

private:
  std::vector<std::pair<vtkWeakPointer<vtkSMProxy>, int>> Methods; // to be restored
};

#endif
