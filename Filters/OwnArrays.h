// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Arrays that were made here, and those of others that they take the place of.

#ifndef limpid_OwnArrays_h
#define limpid_OwnArrays_h

#include <vector>

class vtkAbstractArray;
class vtkFieldData;

namespace limpid
{
/// Marks an array as made by Limpid. Copies of it are marked, too, but files do not keep it.
void MarkAsOwn(vtkAbstractArray* array);

/// Marks all arrays of `output` that `input` does not have. Returns the arrays of `input` that have
/// gone for one of the same name and were not made by Limpid.
std::vector<vtkAbstractArray*> MarkResults(vtkFieldData* input, vtkFieldData* output);
}

#endif
