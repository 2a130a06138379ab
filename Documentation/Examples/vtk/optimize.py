# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Finds the extinction that lets the important structures of a phantom be seen from one camera, says
how much of them can be seen, and draws it.

  PYTHONPATH=PREFIX/lib/python3/dist-packages python3 optimize.py PICTURE.png

It is optimize.cxx in Python. Without a display: xvfb-run python3 ...
"""

import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (VTK's windows)
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (vtkCamera, vtkColorTransferFunction, vtkRenderer,
                                         vtkRenderWindow, vtkVolume, vtkWindowToImageFilter)

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer, vtkOcclusionPhantom
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper

picture, = sys.argv[1:]

camera = vtkCamera()
camera.SetPosition(1.5, -3.6, 1.2)
camera.SetFocalPoint(0, 0, 0)
camera.SetViewUp(0, 0, 1)

# A head with arrays for colour, extinction and importance.
head = vtkOcclusionPhantom()

optimizer = vtkExtinctionOptimizer()
optimizer.SetInputConnection(head.GetOutputPort())
optimizer.SetExtinctionSource(vtkExtinctionOptimizer.ARRAY)
optimizer.SetCameraPosition(camera.GetPosition())
optimizer.SetCameraFocalPoint(camera.GetFocalPoint())
optimizer.SetCameraViewUp(camera.GetViewUp())
optimizer.Update()

# As it was found: by default, the mapper would find an extinction for its own view.
mapper = vtkTransmittanceVolumeMapper()
mapper.SetInputConnection(optimizer.GetOutputPort())
mapper.SetExtinctionSource(vtkTransmittanceVolumeMapper.ARRAY)
mapper.SetMethod(vtkTransmittanceVolumeMapper.ORDINARY)

# Values of the materials with their colours.
colors = vtkColorTransferFunction()
colors.AddRGBPoint(0.15, 0.75, 0.5, 0.55)  # soft tissue
colors.AddRGBPoint(0.65, 0.95, 0.92, 0.8)  # bone
colors.AddRGBPoint(0.85, 0.75, 0.05, 0.1)  # vessels
colors.AddRGBPoint(1.0, 0.1, 0.8, 0.35)    # tumour
volume = vtkVolume()
volume.SetMapper(mapper)
volume.GetProperty().SetColor(colors)
volume.GetProperty().SetInterpolationTypeToLinear()

renderer = vtkRenderer()
renderer.SetActiveCamera(camera)
renderer.SetBackground(1, 1, 1)
renderer.AddVolume(volume)
window = vtkRenderWindow()
window.SetOffScreenRendering(True)
window.SetSize(400, 400)
window.AddRenderer(renderer)
window.Render()

capture = vtkWindowToImageFilter()
capture.SetInput(window)
writer = vtkPNGWriter()
writer.SetInputConnection(capture.GetOutputPort())
writer.SetFileName(picture)
writer.Write()

results = optimizer.GetOutput().GetFieldData()
print("Visible: {:.1f} % of the important structures, {:.1f} % before".format(
    100 * results.GetArray("VisibleFraction").GetTuple1(0),
    100 * results.GetArray("BaseVisibleFraction").GetTuple1(0)))
