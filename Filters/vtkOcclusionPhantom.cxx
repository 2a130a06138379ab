// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkOcclusionPhantom.h"

#include "Abort.h"
#include "AllCores.h"
#include "Memory.h"
#include "OwnArrays.h"
#include "PhantomScenes.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include "backend/Interruption.h"

#include <array>
#include <exception>

vtkStandardNewMacro(vtkOcclusionPhantom);

namespace
{
const limpid::MemoryNeed NeedOfPhantom{ 3 * sizeof(float) + 1, "Set a smaller Resolution." };

template <class ArrayType = vtkFloatArray>
vtkSmartPointer<ArrayType> NewField(const char* name, vtkIdType count)
{
  vtkSmartPointer<ArrayType> field = limpid::NewArray<ArrayType>(name, count);
  limpid::MarkAsGenerated(field);
  return field;
}

void FillPoints(const limpid::PhantomScene& scene, vtkImageData* output)
{
  const vtkIdType count = output->GetNumberOfPoints();
  const vtkSmartPointer<vtkFloatArray> scalars = NewField("Scalars", count);
  const vtkSmartPointer<vtkFloatArray> importance = NewField("Importance", count);
  const vtkSmartPointer<vtkFloatArray> extinction = NewField("BaseExtinction", count);
  const auto structure = NewField<vtkUnsignedCharArray>("Structure", count);
  const double edge = limpid::PhantomEdge(output->GetSpacing()[0]);
  limpid::ForOnAllCores(count,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        limpid::PhantomPoint point;
        output->GetPoint(i, point.data());
        const limpid::Material material = scene(point, edge);
        scalars->SetValue(i, static_cast<float>(material.scalar));
        importance->SetValue(i, static_cast<float>(material.importance));
        extinction->SetValue(i, static_cast<float>(material.extinction));
        structure->SetValue(i, static_cast<unsigned char>(material.structure));
      }
    });
  output->GetPointData()->SetScalars(scalars);
  output->GetPointData()->AddArray(importance);
  output->GetPointData()->AddArray(extinction);
  output->GetPointData()->AddArray(structure);
}
}

vtkOcclusionPhantom::vtkOcclusionPhantom()
{
  this->SetNumberOfInputPorts(0);
}

vtkOcclusionPhantom::~vtkOcclusionPhantom() = default;

int vtkOcclusionPhantom::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  const int last = this->Resolution - 1;
  const double spacing = 2.0 / last;
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), 0, last, 0, last, 0, last);
  info->Set(vtkDataObject::ORIGIN(), -1.0, -1.0, -1.0);
  info->Set(vtkDataObject::SPACING(), spacing, spacing, spacing);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, 1);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  return 1;
}

int vtkOcclusionPhantom::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  constexpr std::array<limpid::PhantomScene, 5> scenes{ { limpid::HeadScene, limpid::FlameScene,
    limpid::ShellsScene, limpid::HomogeneousScene, limpid::VesselsScene } };
  const limpid::PhantomScene scene = scenes[static_cast<std::size_t>(this->Scene)];

  vtkInformation* info = outputVector->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  output->SetExtent(info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()));
  output->SetOrigin(info->Get(vtkDataObject::ORIGIN()));
  output->SetSpacing(info->Get(vtkDataObject::SPACING()));
  try
  {
    const limpid::Interruptible interruptible(limpid::GoOn(this));
    FillPoints(scene, output);
    return 1;
  }
  catch (const limpid::Interrupted&)
  {
    output->Initialize(); // no partial result
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< limpid::MessageOf(error, output, NeedOfPhantom));
    output->Initialize();
    return 1; // if 0, the executive would join this extent with that of the next request
  }
}

void vtkOcclusionPhantom::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Scene: " << this->Scene << "\n";
}
