// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkSegmentationReader.h"

#include "ImageFile.h"
#include "Memory.h"
#include "PropertyPrinter.h"
#include "StructureLooks.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "math/Require.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <string>

vtkStandardNewMacro(vtkSegmentationReader);

namespace
{
const limpid::MemoryNeed NeedOfReading{ 2 * sizeof(double), limpid::fewerPoints };

using Pipeline = vtkStreamingDemandDrivenPipeline;

void Announce(const limpid::Grid& grid, int type, vtkInformation* info)
{
  info->Set(
    Pipeline::WHOLE_EXTENT(), 0, grid.nodes.x - 1, 0, grid.nodes.y - 1, 0, grid.nodes.z - 1);
  info->Set(vtkDataObject::ORIGIN(), &grid.origin.x, 3);
  info->Set(vtkDataObject::SPACING(), &grid.spacing.x, 3);
  std::array<double, 9> direction{}; // row by row
  for (int row = 0; row < 3; ++row)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      direction[3 * std::size_t(row) + std::size_t(axis)] = grid.direction[axis][row];
    }
  }
  info->Set(vtkDataObject::DIRECTION(), direction.data(), 9);
  vtkDataObject::SetPointDataActiveScalarInfo(info, type, 1);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
}

bool IsScaled(const limpid::ImageFile& file)
{
  return file.slope != 1 || file.intercept != 0;
}

// Returns the names and colours of the labels in a layer.
limpid::StructureLooks LooksOf(const limpid::ImageFile& file, int layer)
{
  limpid::StructureLooks looks;
  for (const limpid::Segment& segment : file.segments)
  {
    if (segment.layer == layer)
    {
      looks[segment.label] = segment.look;
    }
  }
  return looks;
}

// Returns the names of the segments in other layers, for a message.
std::string NamesElsewhere(const limpid::ImageFile& file, int layer)
{
  std::string names;
  for (const limpid::Segment& segment : file.segments)
  {
    if (segment.layer != layer)
    {
      names += (names.empty() ? "" : ", ") + segment.look.name + " (" +
        std::to_string(segment.layer) + ")";
    }
  }
  return names;
}
}

vtkSegmentationReader::vtkSegmentationReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkSegmentationReader::~vtkSegmentationReader() = default;

int vtkSegmentationReader::CanReadFile(const char* path)
{
  try
  {
    limpid::ReadImageHeader(path);
    return 1;
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

// Reports an exception of an action, which is a request.
template <class Action>
int vtkSegmentationReader::Try(const Action& action)
{
  limpid::ImageFile file;
  try
  {
    LIMPID_REQUIRE(!this->FileName.empty(), "It has no name (FileName is empty). Set FileName.");
    file = limpid::ReadImageHeader(this->FileName);
    action(file);
    return 1;
  }
  catch (const std::exception& error)
  {
    const limpid::Int3& nodes = file.grid.nodes;
    const std::array<int, 3> points{ nodes.x, nodes.y, nodes.z };
    vtkErrorMacro(<< "The file \"" << this->FileName << "\" cannot be read. "
                  << limpid::MessageOf(error, points.data(), NeedOfReading));
    return 0;
  }
}

int vtkSegmentationReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  return this->Try(
    [&](const limpid::ImageFile& file)
    {
      const int type = IsScaled(file) ? VTK_FLOAT : file.type;
      const limpid::Grid grid = limpid::InOrder(file.grid, limpid::AxisOrder(file.grid));
      Announce(grid, type, outputVector->GetInformationObject(0));
    });
}

int vtkSegmentationReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  const int done = this->Try(
    [&](const limpid::ImageFile& file)
    {
      LIMPID_REQUIRE(this->Layer < file.layers,
        "There is no layer " << this->Layer << " (the file has " << file.layers
                             << ", from 0 on). Choose another one.");
      output->SetExtent(info->Get(Pipeline::WHOLE_EXTENT()));
      output->GetPointData()->SetScalars(
        limpid::ReadValues(file, this->Layer, limpid::AxisOrder(file.grid)));
      output->Crop(info->Get(Pipeline::UPDATE_EXTENT()));
      limpid::SetStructureLooks(LooksOf(file, this->Layer), output);
      const std::string others = NamesElsewhere(file, this->Layer);
      if (!others.empty())
      {
        vtkWarningMacro("The file \""
          << this->FileName << "\" has segments in other layers than " << this->Layer << ": "
          << others
          << " (one layer is read, within which segments do not overlap). Choose theirs, or export "
             "them to one layer.");
      }
    });
  if (!done)
  {
    output->Initialize(); // no partial result
  }
  return done;
}

void vtkSegmentationReader::PrintSelf(ostream& os, vtkIndent indent)
{
  const limpid::PropertyPrinter print{ os, indent };

  this->Superclass::PrintSelf(os, indent);
  print("FileName", this->FileName);
  print("Layer", this->Layer);
}
