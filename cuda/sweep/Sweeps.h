// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Selects how kernels are swept: row by row on the processor, launch by launch on a device.

#ifndef limpid_sweep_Sweeps_h
#define limpid_sweep_Sweeps_h

#include "sweep/SweepLaunches.h"
#include "sweep/SweepRows.h"
#include "sweep/SweepTiles.h"

#endif
