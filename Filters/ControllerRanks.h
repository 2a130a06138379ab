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

/// Whether there are several processes of MPI, and each is asked for its own piece of an output:
/// then they can share the work.
VTKLIMPIDFILTERS_EXPORT bool AllAreAsked(vtkInformation* outInfo);

/// Whether there are several processes of MPI.
VTKLIMPIDFILTERS_EXPORT bool AreSeveral();

/// These processes, for one computation. All of them have to ask for it, in the same order.
VTKLIMPIDFILTERS_EXPORT std::shared_ptr<const Communicator> MakeRanks();
}

#endif
