// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Gets and sets cameras of the active view.
 */

#ifndef LimpidBestView_h
#define LimpidBestView_h

#include "scene/RaySource.h"
#include "vtkSmartPointer.h"

#include <QVariantList>

class pqRenderView;
class vtkSMProxy;
class vtkSMRenderViewProxy;
class vtkSMSourceProxy;
class QIcon;
class QString;
struct LimpidViewpoint;

/// Returns the present camera of a view, including moves by the mouse.
limpid::Camera PresentCamera(vtkSMRenderViewProxy* view);

/// Sets the camera of a view, without trace and undo.
void SetCamera(vtkSMRenderViewProxy* view, const limpid::Camera& camera);

///@{
/// Gives a view a camera, or that of a viewpoint. To the view it is an interaction, so that "Camera
/// Undo" has it; the trace has it, too, with a comment. `centre`: what the mouse turns the data
/// about.
void LookFrom(const limpid::Camera& camera, const limpid::Vec3& centre, pqRenderView* view,
  const QString& comment);
void LookFrom(const LimpidViewpoint& viewpoint, pqRenderView* view, const QString& comment);
///@}

/// Returns a filter of an output of `input`. It is neither in the pipeline browser nor in the undo
/// stack.
vtkSmartPointer<vtkSMSourceProxy> NewHiddenFilter(
  const char* name, vtkSMProxy* input, unsigned int port);

/// Runs a ViewpointSearch for the optimised volume in the active view (for the active one if there
/// are several) with the volume's own settings. The search is not in the pipeline browser. Null:
/// there is no such volume.
vtkSmartPointer<vtkSMSourceProxy> SearchActiveVolume();

/// Sets the active view to the camera that shows most of the important structures in that volume.
void FindBestView();

/// Sets a view likewise to show most of some structures alone, rows of the property Structures, of
/// a display in it. The display stays the same.
void FindBestViewOf(vtkSMProxy* display, pqRenderView* view, const QVariantList& structures);

/// The icon and the text of buttons that call FindBestView.
QIcon BestViewIcon();
QString BestViewToolTip();

#endif
