// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * Displays of volumes that look like others.
 */

#ifndef LimpidDisplays_h
#define LimpidDisplays_h

class vtkSMProxy;

/// Gives a display all that another one of the same data has, but for being visible. Colors and
/// opacities they share, the importance function they do not.
void CopyDisplay(vtkSMProxy* display, vtkSMProxy* other);

/// Makes displays of images anew that are older than the plugin, so that they have the type
/// "Optimized Volume", too. They look as they did.
void RenewDisplays();

#endif
