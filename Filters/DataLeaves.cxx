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
#include "vtkUniformGrid.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnsignedCharArray.h"

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

}

std::vector<Leaf> LeavesOf(vtkDataObject* data)
{
  std::vector<Leaf> leaves;
  const auto add = [&leaves](vtkDataObject* object)
  {
    const Leaf leaf = AsDataSet(object);
    if (IsFilled(leaf))
    {
      leaves.push_back(leaf);
    }
  };
  if (auto* levels = vtkUniformGridAMR::SafeDownCast(data))
  {
    for (unsigned level = levels->GetNumberOfLevels(); level-- > 0;)
    {
      for (unsigned block = 0; block < levels->GetNumberOfDataSets(level); ++block)
      {
        add(levels->GetDataSet(level, block));
      }
    }
    return leaves;
  }
  auto* blocks = vtkCompositeDataSet::SafeDownCast(data);
  if (!blocks)
  {
    add(data);
    return leaves;
  }
  vtkSmartPointer<vtkCompositeDataIterator> block;
  block.TakeReference(blocks->NewIterator());
  block->SkipEmptyNodesOn();
  for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    add(block->GetCurrentDataObject());
  }
  return leaves;
}

std::vector<Leaf> FinestOf(vtkDataObject* data, const std::vector<Leaf>& leaves)
{
  auto* levels = vtkUniformGridAMR::SafeDownCast(data);
  if (!levels)
  {
    return leaves;
  }
  for (unsigned level = levels->GetNumberOfLevels(); level-- > 0;)
  {
    std::vector<Leaf> finest;
    for (unsigned block = 0; block < levels->GetNumberOfDataSets(level); ++block)
    {
      if (IsFilled(levels->GetDataSet(level, block)))
      {
        finest.emplace_back(levels->GetDataSet(level, block));
      }
    }
    if (!finest.empty())
    {
      return finest;
    }
  }
  return leaves;
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

Leaf WithArrays(vtkDataSet* leaf, const std::set<std::string>& points, bool cells)
{
  Leaf with;
  with.TakeReference(leaf->NewInstance());
  with->CopyStructure(leaf);
  const auto pass = [](vtkDataSetAttributes* from, vtkDataSetAttributes* to, const auto& wanted)
  {
    for (int i = 0; i < from->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = from->GetArray(i);
      if (array && array->GetName() && wanted(std::string(array->GetName())))
      {
        to->AddArray(array);
      }
    }
  };
  const auto isGhosts = [](const std::string& name)
  { return name == vtkDataSetAttributes::GhostArrayName(); };
  pass(leaf->GetPointData(), with->GetPointData(),
    [&](const std::string& name) { return points.count(name) > 0; });
  pass(leaf->GetCellData(), with->GetCellData(),
    [&](const std::string& name) { return cells && !isGhosts(name); });

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
