// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Copies the look of volume displays.
 */

#ifndef LimpidDisplays_h
#define LimpidDisplays_h

class vtkSMProxy;

/// Copies all properties of another display of the same data, except visibility. Both share colors
/// and opacities; the importance function is copied.
void CopyDisplay(vtkSMProxy* display, vtkSMProxy* other);

/// Recreates displays of images that are older than the plugin, so that they have the type
/// "Optimized Volume", too. Their look is unchanged.
void RenewDisplays();

#endif
