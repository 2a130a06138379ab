// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_RestoredFunction_h
#define limpid_RestoredFunction_h

class vtkSMProxy;

namespace limpid
{
/// What to do for a volume whose function is not registered.
enum class MissingFunction
{
  Waits, ///< wait: it may still be registered
  TakesDefault
};

/// Sets the importance function of a volume again if it has none. When ParaView undoes the deletion
/// of a display, it restores the display's functions, but not the volume's properties that refer to
/// them. The function is the one that is registered for the display by that name.
void RestoreImportanceFunction(vtkSMProxy* volume, vtkSMProxy* display, MissingFunction missing);
}

#endif
