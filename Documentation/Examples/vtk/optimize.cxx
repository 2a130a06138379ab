// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Finds the extinction that lets the important structures of a phantom be seen from one camera,
// says how much of them can be seen, and draws it: optimize PICTURE.png

#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkExtinctionOptimizer.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOcclusionPhantom.h"
#include "vtkPNGWriter.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTransmittanceVolumeMapper.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "vtkWindowToImageFilter.h"

#include <cstdlib>
#include <iomanip>
#include <iostream>

namespace
{
double Percent(vtkExtinctionOptimizer* optimizer, const char* name)
{
  return 100 * optimizer->GetOutput()->GetFieldData()->GetArray(name)->GetTuple1(0);
}

/// Values of the materials with their colours.
void SetColors(vtkColorTransferFunction* colors)
{
  colors->AddRGBPoint(0.15, 0.75, 0.5, 0.55); // soft tissue
  colors->AddRGBPoint(0.65, 0.95, 0.92, 0.8); // bone
  colors->AddRGBPoint(0.85, 0.75, 0.05, 0.1); // vessels
  colors->AddRGBPoint(1.0, 0.1, 0.8, 0.35);   // tumour
}
}

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::cerr << "Say where the picture goes: optimize PICTURE.png\n";
    return EXIT_FAILURE;
  }

  vtkNew<vtkCamera> camera;
  camera->SetPosition(1.5, -3.6, 1.2);
  camera->SetFocalPoint(0, 0, 0);
  camera->SetViewUp(0, 0, 1);

  // A head with arrays for colour, extinction and importance.
  vtkNew<vtkOcclusionPhantom> head;

  vtkNew<vtkExtinctionOptimizer> optimizer;
  optimizer->SetInputConnection(head->GetOutputPort());
  optimizer->SetExtinctionSource(vtkExtinctionOptimizer::ARRAY);
  optimizer->SetCameraPosition(camera->GetPosition());
  optimizer->SetCameraFocalPoint(camera->GetFocalPoint());
  optimizer->SetCameraViewUp(camera->GetViewUp());
  optimizer->Update();

  // As it was found: by default, the mapper would find an extinction for its own view.
  vtkNew<vtkTransmittanceVolumeMapper> mapper;
  mapper->SetInputConnection(optimizer->GetOutputPort());
  mapper->SetExtinctionSource(vtkTransmittanceVolumeMapper::ARRAY);
  mapper->SetMethod(vtkTransmittanceVolumeMapper::ORDINARY);
  vtkNew<vtkColorTransferFunction> colors;
  SetColors(colors);
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  volume->GetProperty()->SetColor(colors);
  volume->GetProperty()->SetInterpolationTypeToLinear();

  vtkNew<vtkRenderer> renderer;
  renderer->SetActiveCamera(camera);
  renderer->SetBackground(1, 1, 1);
  renderer->AddVolume(volume);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(true);
  window->SetSize(400, 400);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkWindowToImageFilter> capture;
  capture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(capture->GetOutputPort());
  writer->SetFileName(argv[1]);
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    return EXIT_FAILURE;
  }
  std::cout << std::fixed << std::setprecision(1)
            << "Visible: " << Percent(optimizer, "VisibleFraction")
            << " % of the important structures, " << Percent(optimizer, "BaseVisibleFraction")
            << " % before\n";
  return EXIT_SUCCESS;
}
