// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How kernels are swept: on the processor row by row, on a device launch by launch.

#ifndef limpid_sweep_Sweeps_h
#define limpid_sweep_Sweeps_h

#include "sweep/SweepLaunches.h"
#include "sweep/SweepRows.h"
#include "sweep/SweepTiles.h"

#endif
