// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_PhysicalMemory_h
#define limpid_backend_PhysicalMemory_h

namespace limpid
{
/// Main memory of this machine [bytes]; infinite where the system does not tell.
double PhysicalMemory();
}

#endif
