// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Every allocation of a field that the mapper's own code makes fails once: no exception leaves the
// renderer, there is one error at most, and the next frame is right.

#include "FailingAllocations.h"
#include "OneOf.h"

#include "vtkActor.h"
#include "vtkAutoInit.h"
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

#include <gtest/gtest.h>

#include <vector>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

using namespace limpid;

namespace
{
/// VTK's small objects may end up half made where their memory fails.
constexpr FailingAllocations::Scope ownFields{ "vtkLimpidRendering", 1024 };

/// A phantom in a small window.
struct Scene
{
  vtkNew<vtkOcclusionPhantom> source;
  vtkNew<vtkTransmittanceVolumeMapper> mapper;
  vtkNew<vtkVolume> volume;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  int errors = 0;

  Scene()
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
  }

  std::vector<unsigned char> Picture()
  {
    window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window->GetPixelData(0, 0, 47, 39, 0, pixels);
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }

  void ExpectToSurvive()
  {
    const std::vector<unsigned char> expected = Picture();
    ASSERT_GT(mapper->GetVisibilityScore(), 0);
    ASSERT_EQ(errors, 0);
    int failures = 0;
    bool failed = true;
    for (std::int64_t number = 1; failed; number += OneOf())
    {
      Forget();
      {
        const FailingAllocations failing(number, FailingAllocations::Which::One, ownFields);
        ASSERT_NO_THROW(window->Render());
        failed = failing.Failed();
      }
      ASSERT_LE(errors, failed ? 1 : 0) << "allocation " << number;
      failures += failed ? 1 : 0;
      Forget();
      ASSERT_EQ(Picture(), expected) << "after allocation " << number;
      ASSERT_EQ(errors, 0) << "after allocation " << number;
    }
    EXPECT_GT(failures * OneOf(), 20);
  }
};
}

TEST(MapperFaults, OfAFrame)
{
  Scene scene;
  scene.ExpectToSurvive();
}

TEST(MapperFaults, OfAFrameThatIsPeeled)
{
  Scene scene;
  scene.Peel();
  scene.ExpectToSurvive();
}
