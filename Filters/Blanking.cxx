// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Blanking.h"

#include "AllCores.h"
#include "CellsAround.h"
#include "Memory.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include "math/Require.h"

#include <algorithm>

namespace limpid
{
namespace
{
constexpr int BlankPoint = vtkDataSetAttributes::HIDDENPOINT | vtkDataSetAttributes::DUPLICATEPOINT;
constexpr int BlankCell = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::DUPLICATECELL |
  vtkDataSetAttributes::REFINEDCELL;

// Returns the flags of `count` points or cells; null if there are none.
vtkUnsignedCharArray* FlagsOf(vtkDataSetAttributes* data, vtkIdType count, const char* what)
{
  const char* name = vtkDataSetAttributes::GhostArrayName();
  vtkAbstractArray* array = data->GetAbstractArray(name);
  if (!array)
  {
    return nullptr;
  }
  vtkUnsignedCharArray* flags = vtkUnsignedCharArray::SafeDownCast(array);
  const int components = array->GetNumberOfComponents();
  LIMPID_REQUIRE(flags && components == 1 && array->GetNumberOfTuples() == count,
    "The array \"" << name << "\" has " << array->GetNumberOfTuples() << " tuples of " << components
                   << (components == 1 ? " component" : " components") << " of type "
                   << array->GetDataTypeAsString() << " for " << count << " " << what
                   << " (ghost flags need one unsigned char for each). Correct or remove it.");
  return flags;
}
}

Blanking::Blanking(vtkImageData* image)
  : Nodes{ { image->GetDimensions()[0], image->GetDimensions()[1], image->GetDimensions()[2] } }
  , PointFlags(FlagsOf(image->GetPointData(), image->GetNumberOfPoints(), "points"))
  , CellFlags(FlagsOf(image->GetCellData(), image->GetNumberOfCells(), "cells"))
{
}

vtkMTimeType Blanking::MTime() const
{
  vtkMTimeType time = 0;
  for (vtkUnsignedCharArray* flags : { this->PointFlags, this->CellFlags })
  {
    time = std::max(time, flags ? flags->GetMTime() : 0);
  }
  return time;
}

bool Blanking::IsBlanked(vtkIdType cell) const
{
  return (this->CellFlags->GetValue(cell) & BlankCell) != 0;
}

vtkSmartPointer<vtkUnsignedCharArray> Blanking::HiddenCells() const
{
  if (!this->CellFlags)
  {
    return nullptr;
  }
  const vtkIdType count = this->CellFlags->GetNumberOfTuples();
  auto hidden = NewArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), count);
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    hidden->SetValue(cell, this->IsBlanked(cell) ? vtkDataSetAttributes::HIDDENCELL : 0);
  }
  return hidden;
}

float Blanking::ShareOfPoint(int i, int j, int k, bool ofCells) const
{
  int count = 0;
  int blanked = 0;
  ForCellsAround(this->Nodes, { { i, j, k } },
    [&](vtkIdType cell)
    {
      blanked += this->IsBlanked(cell) ? 1 : 0;
      ++count;
    });
  return ofCells ? static_cast<float>(count - blanked) / static_cast<float>(count)
                 : (blanked > 0 ? 0.0F : 1.0F);
}

std::vector<float> Blanking::Shares(bool ofCells) const
{
  if (!this->PointFlags && !this->CellFlags)
  {
    return {};
  }
  const vtkIdType rows = vtkIdType(this->Nodes[1]) * this->Nodes[2];
  std::vector<float> shares(std::size_t(rows) * std::size_t(this->Nodes[0]));
  ForOnAllCores(rows,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        const int j = static_cast<int>(row % this->Nodes[1]);
        const int k = static_cast<int>(row / this->Nodes[1]);
        for (int i = 0; i < this->Nodes[0]; ++i)
        {
          const vtkIdType point = i + row * this->Nodes[0];
          const bool blanked =
            this->PointFlags && (this->PointFlags->GetValue(point) & BlankPoint) != 0;
          const float left = this->CellFlags ? this->ShareOfPoint(i, j, k, ofCells) : 1.0F;
          shares[std::size_t(point)] = blanked ? 0.0F : left;
        }
      }
    });
  return shares;
}
}
