// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidResults
 * @brief   what came of an optimised volume, as text
 *
 * For a group of information properties with panel_widget="LimpidResults". Where nobody knows that
 * widget each has a row that looks as if it could be edited.
 */

#ifndef LimpidResults_h
#define LimpidResults_h

#include "pqPropertyWidget.h"

#include <utility>
#include <vector>

class QLabel;
class vtkSMPropertyGroup;

class LimpidResults : public pqPropertyWidget
{
  Q_OBJECT

public:
  LimpidResults(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

private Q_SLOTS:
  void follow(); // the properties

private:
  std::vector<std::pair<vtkSMProperty*, QLabel*>> Rows;
};

#endif
