// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Opens a segmentation of the active image.
 */

#ifndef LimpidSegmentation_h
#define LimpidSegmentation_h

class QIcon;
class QString;

/// Returns whether the active source has an image, to which a segmentation can be added.
bool CanOpenSegmentation();

/// Asks for a file, adds its labels to the active image, and shows the result in place of the image
/// as an optimized volume. Its table of structures is filled, with none of them important. All of
/// this is one undo step. Returns whether a volume is shown.
bool OpenSegmentation();

/// Scrolls the properties panel to the table of structures.
void ScrollToStructures();

QIcon SegmentationIcon();
QString SegmentationToolTip();

#endif
