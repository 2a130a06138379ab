// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What to do and to say when there is not enough memory.

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
/// Memory that the points of an image need.
struct MemoryNeed
{
  double bytesPerPoint = 0;
  std::string advice; ///< how to need less: a sentence
};

/// What filters of images advise.
constexpr const char* fewerPoints =
  "Give an image with fewer points, for instance from Resample To Image or Extract Subset, or run "
  "it where there is more memory.";

/// An array of one component for `count` values, which are not set. Throws std::bad_alloc where
/// there is no memory; arrays of VTK that look for it themselves may end the process.
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

/// What to say of an exception: its own words, or, where memory ran out, how much an image of so
/// many points along each axis needs.
VTKLIMPIDFILTERS_EXPORT std::string WordsOf(
  const std::exception& error, const int points[3], const MemoryNeed& need);

/// Returns this message for an image, which may be null.
VTKLIMPIDFILTERS_EXPORT std::string WordsOf(
  const std::exception& error, vtkImageData* image, const MemoryNeed& need);
}

#endif
