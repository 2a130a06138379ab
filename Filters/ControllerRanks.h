// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The processes of VTK's global controller as the ranks of the core.

#ifndef limpid_ControllerRanks_h
#define limpid_ControllerRanks_h

#include "vtkLimpidFiltersModule.h" // for export macro

#include <memory>

class vtkInformation;

namespace limpid
{
class Communicator;

/// Returns whether there are several MPI processes, each of which is asked for its own piece of an
/// output, so that they can share the work.
VTKLIMPIDFILTERS_EXPORT bool AllRanksUpdate(vtkInformation* outInfo);

/// Returns whether there are several MPI processes.
VTKLIMPIDFILTERS_EXPORT bool AreSeveral();

/// Returns a communicator of these processes for one computation; that of this process if there are
/// no others. Collective: all processes must call it, in the same order.
VTKLIMPIDFILTERS_EXPORT std::shared_ptr<const Communicator> MakeRanks();

/// Returns those of MakeRanks if they share the work on an output (AllRanksUpdate), else this
/// process alone.
VTKLIMPIDFILTERS_EXPORT std::shared_ptr<const Communicator> RanksThatUpdate(
  vtkInformation* outInfo);
}

#endif
