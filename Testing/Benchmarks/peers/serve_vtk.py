# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Draws the head of head.py by the mappers of another VTK, in a process of the Python that has it:
  PYTHON serve_vtk.py HEAD.json
Answers each line of standard input, a dictionary, with a line of JSON. HEAD.json and the image beside it
are from another_vtk.py."""

import json
import os
import sys
import time

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the object factories)
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkRenderingCore import (vtkColorTransferFunction, vtkLight, vtkRenderer,
                                         vtkRenderWindow, vtkVolume, vtkWindowToImageFilter)
from vtkmodules.vtkRenderingVolume import (vtkFixedPointVolumeRayCastMapper,
                                           vtkGPUVolumeRayCastMapper)

MAPPERS = {"fixed point": vtkFixedPointVolumeRayCastMapper, "GPU": vtkGPUVolumeRayCastMapper}


class Drawing:
    """A window with the head in it, drawn by one mapper."""

    def __init__(self, head, image, mapper, shade):
        mapper.SetAutoAdjustSampleDistances(0)
        mapper.SetImageSampleDistance(1)
        mapper.SetSampleDistance(head["step"])
        if isinstance(mapper, vtkGPUVolumeRayCastMapper):
            mapper.SetUseJittering(0)
        mapper.SetInputData(image)
        volume = vtkVolume()
        volume.SetMapper(mapper)
        self.color(volume.GetProperty(), head, shade)
        self.light = vtkLight()
        self.light.SetLightTypeToSceneLight()
        self.light.SetPositional(True)
        self.light.SetConeAngle(180)
        self.light.SetFocalPoint(head["focal_point"])
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(0, 0, 0)
        self.renderer.AutomaticLightCreationOff()
        self.renderer.AddLight(self.light)
        self.renderer.AddVolume(volume)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(head["size"], head["size"])
        self.window.AddRenderer(self.renderer)
        self.window.SetDesiredUpdateRate(0.001)

    @staticmethod
    def color(volume_property, head, shade):
        colors, opacity = vtkColorTransferFunction(), vtkPiecewiseFunction()
        for node in head["colors"]:
            colors.AddRGBPoint(*node)
        for node in head["opacity"]:
            opacity.AddPoint(*node)
        volume_property.SetColor(colors)
        volume_property.SetScalarOpacity(opacity)
        volume_property.SetScalarOpacityUnitDistance(head["unit_distance"])
        volume_property.SetInterpolationTypeToLinear()
        volume_property.SetShade(shade)

    def draw(self, position, light, head):
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(position)
        camera.SetFocalPoint(head["focal_point"])
        camera.SetViewUp(head["view_up"])
        camera.SetViewAngle(head["view_angle"])
        self.light.SetPosition(light)
        self.renderer.ResetCameraClippingRange()
        start, cores = time.perf_counter(), time.process_time()
        self.window.Render()
        self.window.WaitForCompletion()
        return {"seconds": time.perf_counter() - start, "cpu": time.process_time() - cores}

    def save(self, path):
        """The last picture: rows from the top."""
        capture = vtkWindowToImageFilter()
        capture.SetInput(self.window)
        capture.SetInputBufferTypeToRGB()
        capture.ReadFrontBufferOff()
        capture.ShouldRerenderOff()
        capture.Update()
        columns, rows, _ = capture.GetOutput().GetDimensions()
        pixels = vtk_to_numpy(capture.GetOutput().GetPointData().GetScalars())
        np.save(path, pixels.reshape(rows, columns, 3)[::-1])
        return {"saved": path}


def main():
    path, = sys.argv[1:]
    with open(path, encoding="utf-8") as file:
        head = json.load(file)
    reader = vtkXMLImageDataReader()
    reader.SetFileName(os.path.splitext(path)[0] + ".vti")
    reader.Update()
    print(json.dumps({"version": vtkVersion.GetVTKVersion()}), flush=True)
    drawings = {}
    for line in sys.stdin:
        asked = json.loads(line)
        key = (asked["mapper"], asked["shade"])
        if key not in drawings:
            drawings[key] = Drawing(head, reader.GetOutput(), MAPPERS[key[0]](), key[1])
        drawing = drawings[key]
        answer = (drawing.save(asked["save"]) if "save" in asked else
                  drawing.draw(asked["position"], asked["light"], head))
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
