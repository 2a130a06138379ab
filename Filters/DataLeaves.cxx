// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "DataLeaves.h"

#include "Memory.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridToUnstructuredGrid.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace limpid
{
namespace
{
vtkSmartPointer<vtkDataSet> AsDataSet(vtkDataObject* object)
{
  if (auto* trees = vtkHyperTreeGrid::SafeDownCast(object))
  {
    vtkNew<vtkHyperTreeGridToUnstructuredGrid> cells;
    cells->SetInputData(trees);
    cells->Update();
    return vtkDataSet::SafeDownCast(cells->GetOutput());
  }
  return vtkDataSet::SafeDownCast(object);
}

bool IsFilled(vtkDataSet* leaf)
{
  return leaf && leaf->GetNumberOfPoints() > 0 && leaf->GetNumberOfCells() > 0;
}

// Returns the length of the first cell of a leaf.
double CellLengthOf(const Leaf& leaf)
{
  double bounds[6];
  leaf->GetCellBounds(0, bounds);
  return vtkBoundingBox(bounds).GetDiagonalLength();
}

// Returns whether data have levels, each with cells of one size.
bool HasLevels(vtkDataObject* data)
{
  return data && (data->IsA("vtkOverlappingAMR") || data->IsA("vtkNonOverlappingAMR"));
}
}

void ForObjectsOf(vtkDataObject* data, const std::function<void(vtkDataObject*)>& what)
{
  auto* blocks = vtkCompositeDataSet::SafeDownCast(data);
  if (!blocks)
  {
    what(data);
    return;
  }
  vtkSmartPointer<vtkCompositeDataIterator> block;
  block.TakeReference(blocks->NewIterator());
  for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    what(block->GetCurrentDataObject());
  }
}

std::vector<Leaf> LeavesOf(vtkDataObject* data)
{
  std::vector<Leaf> leaves;
  ForObjectsOf(data,
    [&leaves](vtkDataObject* object)
    {
      const Leaf leaf = AsDataSet(object);
      if (IsFilled(leaf))
      {
        leaves.push_back(leaf);
      }
    });
  if (HasLevels(data))
  {
    std::stable_sort(leaves.begin(), leaves.end(),
      [](const Leaf& one, const Leaf& other)
      { return CellLengthOf(one) < 0.75 * CellLengthOf(other); });
  }
  return leaves;
}

std::vector<Leaf> FinestOf(vtkDataObject* data)
{
  std::vector<Leaf> leaves = LeavesOf(data);
  if (HasLevels(data) && !leaves.empty())
  {
    const double most = CellLengthOf(leaves.front()) / 0.75;
    leaves.erase(std::remove_if(leaves.begin(), leaves.end(),
                   [most](const Leaf& leaf) { return CellLengthOf(leaf) > most; }),
      leaves.end());
  }
  return leaves;
}

vtkBoundingBox BoxOf(const std::vector<Leaf>& leaves)
{
  vtkBoundingBox box;
  for (const Leaf& leaf : leaves)
  {
    box.AddBounds(leaf->GetBounds());
  }
  return box;
}

vtkIdType CellsOf(const std::vector<Leaf>& leaves)
{
  vtkIdType all = 0;
  for (const Leaf& leaf : leaves)
  {
    all += leaf->GetNumberOfCells();
  }
  return all;
}

std::vector<std::array<double, 3>> ExtentsOfCells(const std::vector<Leaf>& leaves, vtkIdType step)
{
  std::vector<std::array<double, 3>> extents;
  vtkIdType number = 0;
  for (const Leaf& leaf : leaves)
  {
    for (vtkIdType cell = 0; cell < leaf->GetNumberOfCells(); ++cell, ++number)
    {
      if (number % step == 0 && leaf->GetCell(cell)->GetCellDimension() == 3)
      {
        double b[6];
        leaf->GetCellBounds(cell, b);
        extents.push_back({ { b[1] - b[0], b[3] - b[2], b[5] - b[4] } });
      }
    }
  }
  return extents;
}

std::set<std::string> ArraysOf(const std::vector<Leaf>& leaves, int association)
{
  std::set<std::string> names;
  for (const Leaf& leaf : leaves)
  {
    vtkDataSetAttributes* attributes = leaf->GetAttributes(association);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = attributes->GetArray(i);
      const std::string name = array && array->GetName() ? array->GetName() : "";
      if (!name.empty() && name != vtkDataSetAttributes::GhostArrayName())
      {
        names.insert(name);
      }
    }
  }
  return names;
}

Leaf WithArrays(
  vtkDataSet* leaf, const std::set<std::string>& points, const std::set<std::string>& cells)
{
  Leaf with;
  with.TakeReference(leaf->NewInstance());
  with->CopyStructure(leaf);
  const auto pass =
    [](vtkDataSetAttributes* from, vtkDataSetAttributes* to, const std::set<std::string>& names)
  {
    for (const std::string& name : names)
    {
      if (vtkDataArray* array = from->GetArray(name.c_str()))
      {
        to->AddArray(array);
      }
    }
  };
  pass(leaf->GetPointData(), with->GetPointData(), points);
  pass(leaf->GetCellData(), with->GetCellData(), cells);

  vtkUnsignedCharArray* ofCells = leaf->GetCellGhostArray();
  vtkUnsignedCharArray* ofPoints = leaf->GetPointGhostArray();
  if (!ofCells && !ofPoints)
  {
    return with;
  }
  constexpr int blanked = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;
  const vtkIdType count = leaf->GetNumberOfCells();
  const auto hidden = NewArray<vtkUnsignedCharArray>(hiddenCells, count);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    bool isHidden = ofCells && (ofCells->GetValue(cell) & blanked) != 0;
    if (ofPoints && !isHidden)
    {
      leaf->GetCellPoints(cell, ids);
      for (vtkIdType i = 0; i < ids->GetNumberOfIds() && !isHidden; ++i)
      {
        isHidden = (ofPoints->GetValue(ids->GetId(i)) & vtkDataSetAttributes::HIDDENPOINT) != 0;
      }
    }
    hidden->SetValue(cell, isHidden ? 1 : 0);
  }
  with->GetCellData()->AddArray(hidden);
  return with;
}
}
