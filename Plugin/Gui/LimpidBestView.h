// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Cameras of the active view.
 */

#ifndef LimpidBestView_h
#define LimpidBestView_h

#include "scene/RaySource.h"
#include "vtkSmartPointer.h"

class pqRenderView;
class vtkSMRenderViewProxy;
class vtkSMSourceProxy;
class QIcon;
class QString;
struct LimpidViewpoint;

/// The camera of a view as it is now, after the mouse has moved it.
limpid::Camera PresentCamera(vtkSMRenderViewProxy* view);

/// Gives a view a camera, and nobody notes it.
void SetCamera(vtkSMRenderViewProxy* view, const limpid::Camera& camera);

///@{
/// Gives a view a camera, or that of a viewpoint. To the view it is an interaction, so that "Camera
/// Undo" has it; the trace has it, too, with a comment. `centre`: what the mouse turns the data
/// about.
void LookFrom(const limpid::Camera& camera, const limpid::Vec3& centre, pqRenderView* view,
  const QString& comment);
void LookFrom(const LimpidViewpoint& viewpoint, pqRenderView* view, const QString& comment);
///@}

/// A ViewpointSearch of the optimised volume in the active view, the active one if there are
/// several, with the volume's own settings. It was executed, and no pipeline browser shows it.
/// Null: there is no such volume.
vtkSmartPointer<vtkSMSourceProxy> SearchActiveVolume();

/// Gives the active view the camera that shows most of the important structures in that volume.
void FindBestView();

/// What buttons for that look like, and say.
QIcon BestViewIcon();
QString BestViewToolTip();

#endif
