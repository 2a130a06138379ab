// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The data sets of a collection, to be sampled.

#ifndef limpid_DataLeaves_h
#define limpid_DataLeaves_h

#include "vtkBoundingBox.h"
#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

#include <array>
#include <functional>
#include <set>
#include <string>
#include <vector>

class vtkDataObject;

namespace limpid
{
using Leaf = vtkSmartPointer<vtkDataSet>;

/// The name of the cell array that WithArrays adds.
constexpr const char* hiddenCells = "LimpidHidden";

/// Calls what(object) for data, or for each of those in a collection.
void ForObjectsOf(vtkDataObject* data, const std::function<void(vtkDataObject*)>& what);

/// Returns the data sets with cells, in the order in which they count: those of the finest level
/// first.
std::vector<Leaf> LeavesOf(vtkDataObject* data);

/// Returns those of the finest level; all, if there are no levels.
std::vector<Leaf> FinestOf(vtkDataObject* data);

/// Returns the box around all leaves; invalid if there are none.
vtkBoundingBox BoxOf(const std::vector<Leaf>& leaves);

/// Returns the number of cells.
vtkIdType CellsOf(const std::vector<Leaf>& leaves);

/// Returns the extents of every `step`th cell along the axes, of those with a volume.
std::vector<std::array<double, 3>> ExtentsOfCells(const std::vector<Leaf>& leaves, vtkIdType step);

/// Returns the names of arrays. `association`: vtkDataObject::POINT or CELL.
std::set<std::string> ArraysOf(const std::vector<Leaf>& leaves, int association);

/// Returns a leaf with some of its arrays and, if any cells are blanked, an array that is not 0
/// there. `points` and `cells`: names of the arrays.
Leaf WithArrays(
  vtkDataSet* leaf, const std::set<std::string>& points, const std::set<std::string>& cells);
}

#endif
