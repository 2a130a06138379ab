// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidActiveCamera
 * @brief   the row of a camera position, with a button that copies the active view's camera
 *
 * For a property with panel_widget="LimpidActiveCamera". The button fills in the rows of the
 * proxy's properties CameraPosition, CameraFocalPoint, CameraViewUp, CameraViewAngle,
 * CameraParallelProjection, CameraParallelScale and CameraAspectRatio, as if the user had typed the
 * values: Apply accepts them. Properties that the proxy does not have are skipped.
 */

#ifndef LimpidActiveCamera_h
#define LimpidActiveCamera_h

#include "pqPropertyWidget.h"

class pqView;
class QPushButton;

class LimpidActiveCamera : public pqPropertyWidget
{
  Q_OBJECT

public:
  LimpidActiveCamera(vtkSMProxy* proxy, vtkSMProperty* position, QWidget* parent = nullptr);

  void apply() override;
  void reset() override;

private Q_SLOTS:
  void fillIn();
  void enableFor(pqView* view);

private:
  pqPropertyWidget* Row; // the plain row of the property
  QPushButton* Button;
};

#endif
