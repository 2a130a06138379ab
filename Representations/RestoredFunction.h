// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_RestoredFunction_h
#define limpid_RestoredFunction_h

class vtkSMProxy;

namespace limpid
{
/// What becomes of a volume whose function is registered nowhere.
enum class MissingFunction
{
  Waits, ///< it may still be registered
  TakesDefault
};

/// Gives a volume its importance function again where it has none. When ParaView undoes that a
/// display was deleted, it brings back the functions that belong to it, but leaves the properties
/// of the volume in it empty. The function is the one of that name that is registered for the
/// display.
void RestoreImportanceFunction(vtkSMProxy* volume, vtkSMProxy* display, MissingFunction missing);
}

#endif
