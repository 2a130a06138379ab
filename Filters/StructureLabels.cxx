// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "StructureLabels.h"

#include "AllCores.h"
#include "Blanking.h"
#include "CellsAround.h"
#include "Choices.h"
#include "InputArrays.h"
#include "Memory.h"
#include "vtkVisibilitySettings.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkUnsignedCharArray.h"

#include "math/Require.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace limpid
{
namespace
{
// Returns the row of the structure of each value. NaN is no label, and other than all structures.
vtkSmartPointer<vtkUnsignedShortArray> RowsOfValues(const FieldSource& source)
{
  constexpr float noLabel = -1;
  const vtkIdType count = source.array->GetNumberOfTuples();
  // Rows are exact in single precision.
  const auto found = NewArray<vtkFloatArray>("row", count);
  const Structures& structures = *source.structures;
  MapArray(
    source.array, 0,
    [&structures](double label)
    {
      const bool isWhole = label == std::floor(label) && std::abs(label) < 0x1p53;
      return isWhole ? double(structures.RowOf(static_cast<std::int64_t>(label))) : double(noLabel);
    },
    found->GetPointer(0));
  const float* values = found->GetPointer(0);
  const vtkIdType wrong = std::find(values, values + count, noLabel) - values;
  LIMPID_REQUIRE(wrong == count,
    "The structure array \""
      << NameOf(source.array) << "\" has the value " << source.array->GetComponent(wrong, 0)
      << " (labels are whole numbers; interpolation between them makes structures up). Choose an "
         "array of labels; resample it by nearest neighbour.");
  auto rows = NewArray<vtkUnsignedShortArray>("Structure", count);
  std::transform(values, values + count, rows->GetPointer(0),
    [](float row) { return static_cast<StructureRow>(std::isnan(row) ? 0 : row); });
  return rows;
}

// Returns the most frequent of the first `count` rows; of several, the lowest, if possible not 0.
StructureRow MostFrequent(const std::array<StructureRow, 8>& rows, std::size_t count)
{
  StructureRow best = 0;
  std::size_t most = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    std::size_t votes = 0;
    for (std::size_t j = 0; j < count; ++j)
    {
      votes += rows[j] == rows[i] ? 1 : 0;
    }
    const bool isFirst = best == 0 || (rows[i] > 0 && rows[i] < best);
    if (votes > most || (votes == most && isFirst))
    {
      best = rows[i];
      most = votes;
    }
  }
  return best;
}

vtkSmartPointer<vtkUnsignedShortArray> MajorityAtPoints(
  vtkImageData* image, vtkUnsignedShortArray* ofCells)
{
  std::array<int, 3> nodes;
  image->GetDimensions(nodes.data());
  auto atPoints = NewArray<vtkUnsignedShortArray>("Structure", image->GetNumberOfPoints());
  StructureRow* result = atPoints->GetPointer(0);
  const StructureRow* cells = ofCells->GetPointer(0);
  const vtkSmartPointer<vtkUnsignedCharArray> hidden = Blanking(image).HiddenCells();
  ForOnAllCores(vtkIdType(nodes[1]) * nodes[2],
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        std::array<int, 3> point{ { 0, static_cast<int>(row % nodes[1]),
          static_cast<int>(row / nodes[1]) } };
        for (point[0] = 0; point[0] < nodes[0]; ++point[0])
        {
          std::array<StructureRow, 8> around{};
          std::size_t count = 0;
          ForCellsAround(nodes, point,
            [&](vtkIdType cell)
            {
              if (!hidden || hidden->GetValue(cell) == 0)
              {
                around[count] = cells[cell];
                ++count;
              }
            });
          result[point[0] + row * nodes[0]] = MostFrequent(around, count);
        }
      }
    });
  return atPoints;
}
}

Structures StructuresOf(vtkVisibilitySettings* settings)
{
  std::vector<Structure> rows;
  for (int row = 0; row < settings->GetNumberOfStructures(); ++row)
  {
    const auto text = [settings, row](int column)
    { return std::string(settings->GetStructureText(row, column)); };
    rows.push_back(ParseStructure(text(0), text(1), text(2), text(3)));
  }
  return rows.empty() ? Structures::AnyLabel() : Structures(std::move(rows));
}

FieldSource StructureSource(
  vtkAlgorithm* owner, vtkVisibilitySettings* settings, vtkImageData* image)
{
  const std::string name = ChosenName(owner, structureArray);
  if (name.empty())
  {
    return {};
  }
  FieldSource source = FindField(image, name,
    owner->GetInputArrayInformation(structureArray)->Get(vtkDataObject::FIELD_ASSOCIATION()));
  LIMPID_REQUIRE(source.array,
    "The structure array \"" << name
                             << "\" is not among the input's numeric arrays (it says which points "
                                "belong to which structure). Choose one of these: "
                             << ArrayNames(image) << ".");
  LIMPID_REQUIRE(source.array->GetNumberOfComponents() == 1,
    "The structure array \"" << name << "\" has " << source.array->GetNumberOfComponents()
                             << " components (a point belongs to one structure). Choose an array "
                                "with one label for each.");
  source.structures = std::make_shared<const Structures>(StructuresOf(settings));
  return source;
}

std::string WarningOf(const FieldSource& structures)
{
  const bool isAssumed = structures.structures && structures.structures->HasAnyLabel();
  return isAssumed ? "The structure array \"" + NameOf(structures.array) +
      "\" is chosen, and Structures is empty: all labels but 0 are equally important. Add the "
      "structures that matter, each with its label, a name, and an importance from 0 to 1."
                   : "";
}

vtkSmartPointer<vtkUnsignedShortArray> RowsAtPoints(vtkImageData* image, const FieldSource& source)
{
  const vtkSmartPointer<vtkUnsignedShortArray> rows = RowsOfValues(source);
  return source.onCells ? MajorityAtPoints(image, rows) : rows;
}
}
