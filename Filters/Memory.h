// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Allocation of arrays, and messages for insufficient memory.

#ifndef limpid_Memory_h
#define limpid_Memory_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <exception>
#include <memory>
#include <string>

class vtkImageData;

namespace limpid
{
/// The memory that the points of an image need.
struct MemoryNeed
{
  double bytesPerPoint = 0;
  std::string advice; ///< a sentence that says how to need less
};

/// The advice of filters of images.
constexpr const char* fewerPoints =
  "Give an image with fewer points, for instance from Resample To Image or Extract Subset, or use "
  "a machine with more memory.";

/// Returns an array of one component for `count` values, which are not initialised. Throws
/// std::bad_alloc if there is no memory; VTK's own allocation may end the process.
template <class ArrayType>
vtkSmartPointer<ArrayType> NewArray(const char* name, vtkIdType count)
{
  using Value = typename ArrayType::ValueType;
  std::unique_ptr<Value[]> values(new Value[static_cast<std::size_t>(count)]);
  auto array = vtkSmartPointer<ArrayType>::New();
  array->SetName(name);
  array->SetArray(values.release(), count, 0, ArrayType::VTK_DATA_ARRAY_DELETE);
  return array;
}

/// Returns the message for an exception: its own text, or, for a failed allocation, how much memory
/// an image with this number of points along each axis needs.
VTKLIMPIDFILTERS_EXPORT std::string MessageOf(
  const std::exception& error, const int points[3], const MemoryNeed& need);

/// Returns this message for an image, which may be null.
VTKLIMPIDFILTERS_EXPORT std::string MessageOf(
  const std::exception& error, vtkImageData* image, const MemoryNeed& need);
}

#endif
