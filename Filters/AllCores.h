// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_AllCores_h
#define limpid_AllCores_h

#include "vtkType.h"

#include "backend/Backend.h"
#include "backend/Interruption.h"

#include <algorithm>

namespace limpid
{
/**
 * Calls body(begin, end) for parts of [0, count) on all cores, with the threads of the core
 * library.
 *
 * vtkSMPTools uses one core in Debian's ParaView, and changing that is a setting of the whole
 * process, which would affect other threads. An exception in one of its threads ends the process.
 */
template <class Body>
void ForOnAllCores(vtkIdType count, const Body& body)
{
  constexpr vtkIdType mostParts = 256; // more than there are cores, so that parts of unequal effort
                                       // balance
  const vtkIdType parts = std::min(count, mostParts);
  ParallelFor(parts,
    [&](Index part)
    {
      Interruptible::Check();
      const vtkIdType length = count / parts;
      const vtkIdType rest = count % parts; // each of the first parts has one more
      const vtkIdType begin = part * length + std::min<vtkIdType>(part, rest);
      body(begin, begin + length + (part < rest ? 1 : 0));
    });
}
}

#endif
