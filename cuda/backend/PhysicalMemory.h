// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_PhysicalMemory_h
#define limpid_backend_PhysicalMemory_h

namespace limpid
{
/// Main memory of this machine [bytes]; infinite where the system does not tell.
double PhysicalMemory();

/// Memory that this process can still take: the least of what the machine, the control groups of
/// the process and the limit of its address space leave [bytes]. Where the system tells none of
/// them, all physical memory.
double AvailableMemory();
}

#endif
