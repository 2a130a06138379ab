// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Marks arrays that Limpid created, and finds arrays of users that they replace.

#ifndef limpid_OwnArrays_h
#define limpid_OwnArrays_h

#include <vector>

class vtkAbstractArray;
class vtkFieldData;

namespace limpid
{
/// Marks an array as created by Limpid. Copies of it are marked as well, but files do not keep the
/// mark.
void MarkAsGenerated(vtkAbstractArray* array);

/// Marks all arrays of `output` that `input` does not have. Returns the arrays of `input` that were
/// replaced by one of the same name and were not created by Limpid.
std::vector<vtkAbstractArray*> MarkResults(vtkFieldData* input, vtkFieldData* output);
}

#endif
