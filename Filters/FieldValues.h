// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Adds single values as field data.

#ifndef limpid_FieldValues_h
#define limpid_FieldValues_h

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

#include "math/Vec.h"

#include <vector>

namespace limpid
{
/// Adds an array with one tuple.
template <class ArrayType, class Value>
void AddValue(const char* name, const Value& value, vtkFieldData* output)
{
  vtkNew<ArrayType> array;
  array->SetName(name);
  array->InsertNextValue(value);
  output->AddArray(array);
}

/// Adds an array with one tuple that has the components of all vectors.
inline void AddTuple(const char* name, const std::vector<Vec3>& vectors, vtkFieldData* output)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(3 * vectors.size()));
  array->InsertNextTuple(&vectors.front().x);
  output->AddArray(array);
}

/// Adds an array with one tuple of three components.
inline void AddVector(const char* name, const Vec3& vector, vtkFieldData* output)
{
  AddTuple(name, { vector }, output);
}
}

#endif
