// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The processes of VTK's controller as the ranks of the core.

#ifndef limpid_ControllerRanks_h
#define limpid_ControllerRanks_h

#include <memory>

class vtkMultiProcessController;

namespace limpid
{
class Communicator;

/// How many processes a controller has that ranks can be: with MPI; else 1. Null: 1.
int NumberOfRanks(vtkMultiProcessController* controller);

/// These, for one computation. All of them have to ask for it, in the same order.
std::shared_ptr<const Communicator> RanksOf(vtkMultiProcessController* controller);
}

#endif
