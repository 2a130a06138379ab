// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_SmallWindow_h
#define limpid_testing_SmallWindow_h

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkOcclusionPhantom.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTransmittanceVolumeMapper.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVisibilitySettings.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <string>
#include <vector>

namespace limpid
{
/// A phantom in a small window.
struct SmallWindow
{
  vtkNew<vtkOcclusionPhantom> source;
  vtkNew<vtkTransmittanceVolumeMapper> mapper;
  vtkNew<vtkVolume> volume;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  int errors = 0;
  std::vector<std::string> warnings;

  SmallWindow()
  {
    source->SetResolution(12);
    mapper->SetInputConnection(source->GetOutputPort());
    mapper->GetVisibilitySettings()->SetMaximumIterations(3);
    volume->SetMapper(mapper);
    volume->GetProperty()->GetRGBTransferFunction()->AddRGBPoint(0.5, 0.9, 0.5, 0.3);
    volume->GetProperty()->GetScalarOpacity()->AddPoint(0, 0);
    volume->GetProperty()->GetScalarOpacity()->AddPoint(1, 0.3);
    volume->GetProperty()->SetScalarOpacityUnitDistance(0.1);
    volume->GetProperty()->SetInterpolationTypeToLinear();
    renderer->AddVolume(volume);
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(48, 40);
    window->AddRenderer(renderer);
    renderer->ResetCamera();
    renderer->GetActiveCamera()->Azimuth(30);
    renderer->ResetCameraClippingRange();

    vtkNew<vtkCallbackCommand> counter;
    counter->SetClientData(&errors);
    counter->SetCallback(
      [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
    mapper->AddObserver(vtkCommand::ErrorEvent, counter);
    vtkNew<vtkCallbackCommand> reader;
    reader->SetClientData(&warnings);
    reader->SetCallback(
      [](vtkObject*, unsigned long, void* texts, void* text) {
        static_cast<std::vector<std::string>*>(texts)->emplace_back(static_cast<const char*>(text));
      });
    mapper->AddObserver(vtkCommand::WarningEvent, reader);
  }

  void Peel()
  {
    vtkNew<vtkSphereSource> sphere;
    vtkNew<vtkPolyDataMapper> surface;
    surface->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(surface);
    actor->GetProperty()->SetOpacity(0.5);
    renderer->AddActor(actor);
    renderer->UseDepthPeelingOn();
    renderer->UseDepthPeelingForVolumesOn();
  }

  /// All is made anew.
  void Forget()
  {
    mapper->ReleaseMemory();
    mapper->Modified();
    errors = 0;
    warnings.clear();
  }

  std::vector<unsigned char> Picture()
  {
    window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window->GetPixelData(0, 0, 47, 39, 0, pixels);
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }
};
}

#endif
