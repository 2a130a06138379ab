// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Cameras of the active view.
 */

#ifndef LimpidBestView_h
#define LimpidBestView_h

class pqRenderView;
class QIcon;
class QString;
struct LimpidViewpoint;

/// Gives a view the camera of a viewpoint. To the view it is an interaction, so that "Camera Undo"
/// has it; the trace has it, too, with a comment.
void LookFrom(const LimpidViewpoint& viewpoint, pqRenderView* view, const QString& comment);

/// Gives the active view the camera that shows most of what is important in its optimised volume,
/// the active one if there are several: a ViewpointSearch with the volume's own settings, which
/// leaves nothing behind.
void FindBestView();

/// What buttons for that look like, and say.
QIcon BestViewIcon();
QString BestViewToolTip();

#endif
