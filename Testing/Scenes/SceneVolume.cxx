// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SceneVolume.h"
#include "SceneFile.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>

#include <algorithm>
#include <stdexcept>

namespace truth
{
void ReadVolume(const std::string& path, const std::string& array, SceneFile& scene)
{
  vtkNew<vtkXMLImageDataReader> reader;
  if (!reader->CanReadFile(path.c_str()))
  {
    throw std::runtime_error(path + " is missing or no VTK XML image data.");
  }
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  vtkDataArray* values = image->GetPointData()->GetArray(array.c_str());
  if (!values)
  {
    throw std::runtime_error(path + " has no point array \"" + array + "\".");
  }
  const int* extent = image->GetExtent();
  image->GetDimensions(scene.lattice.nodes.data());
  image->GetSpacing(scene.lattice.spacing.data());
  image->GetOrigin(scene.lattice.origin.data());
  std::copy_n(image->GetDirectionMatrix()->GetData(), 9, scene.lattice.direction.begin());
  scene.lattice.origin = scene.lattice.Position(extent[0], extent[2], extent[4]);
  scene.scalars.resize(scene.lattice.Count());
  for (vtkIdType node = 0; node < values->GetNumberOfTuples(); ++node)
  {
    scene.scalars[node] = values->GetComponent(node, 0);
  }
}
}
