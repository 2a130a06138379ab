// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "StructureTable.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cstddef>
#include <string>

namespace limpid
{
namespace
{
// Adds a column of valueOf(row), for the rows of structures from 1 on.
template <class ArrayType, class ValueOf>
void AddColumn(const std::string& name, std::size_t count, const ValueOf& valueOf, vtkTable* table)
{
  vtkNew<ArrayType> column;
  column->SetName(name.c_str());
  for (std::size_t row = 1; row <= count; ++row)
  {
    column->InsertNextValue(valueOf(row));
  }
  table->AddColumn(column);
}
}

std::string StructuresWithoutMatter(
  const Structures& structures, const std::vector<StructureShares>& shares)
{
  std::string names;
  for (std::size_t row = 1; row <= shares.size(); ++row)
  {
    if (!(shares[row - 1].important > 0))
    {
      const Structure& structure = structures.At(static_cast<StructureRow>(row));
      names += (names.empty() ? "" : ", ") + structure.NameOrLabel();
    }
  }
  return names;
}

void FillStructures(const Structures& given, const TargetsFound& found, vtkTable* table)
{
  const std::vector<StructureShares>& shares = found.shares;
  const std::size_t count = given.Count();
  const auto of = [&given](std::size_t row) -> const Structure&
  { return given.At(static_cast<StructureRow>(row)); };
  const auto addShares = [&](const std::string& name, const auto& shareOf)
  {
    if (!shares.empty())
    {
      AddColumn<vtkDoubleArray>(
        name, count, [&](std::size_t row) { return shareOf(shares[row - 1]); }, table);
    }
  };
  AddColumn<vtkIdTypeArray>(
    "Label", count, [&](std::size_t row) { return static_cast<vtkIdType>(of(row).label); }, table);
  AddColumn<vtkStringArray>(
    "Name", count, [&](std::size_t row) { return of(row).NameOrLabel(); }, table);
  AddColumn<vtkDoubleArray>(
    "Importance", count, [&](std::size_t row) { return of(row).importance; }, table);
  AddColumn<vtkDoubleArray>(
    "Target", count, [&](std::size_t row) { return of(row).target.value_or(-1); }, table);
  addShares("Visible", [](const StructureShares& here) { return here.visible; });
  addShares("BaseVisible", [](const StructureShares& here) { return here.baseVisible; });
  addShares("Removed", [](const StructureShares& here) { return here.removed; });
  addShares("Attainable", [](const StructureShares& here) { return here.attainable; });
  const std::size_t hiders = shares.empty() ? 0 : shares.front().hiddenBy.size();
  for (std::size_t by = 0; by < hiders; ++by)
  {
    const std::string name = by == 0 ? "Other" : of(by).NameOrLabel();
    const bool isAmbiguous = by > 0 && name == "Other"; // a structure is called so
    addShares("HiddenBy" + name + (isAmbiguous ? " " + std::to_string(of(by).label) : ""),
      [by](const StructureShares& here) { return here.hiddenBy[by]; });
  }
  AddColumn<vtkDoubleArray>(
    "Weight", count,
    [&](std::size_t row) { return found.structures.ImportanceOf(static_cast<StructureRow>(row)); },
    table);
}
}
