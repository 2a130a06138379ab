// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidResults
 * @brief   shows the results of an optimised volume as text
 *
 * For a group of information properties with panel_widget="LimpidResults". Without this widget,
 * each of them would have a row that looks editable.
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
  void follow(); // shows changes of the properties

private:
  std::vector<std::pair<vtkSMProperty*, QLabel*>> Rows;
};

#endif
