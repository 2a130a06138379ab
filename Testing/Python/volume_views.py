# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What the tests of the volume mapper share: scenes, views, pictures, messages.

import json
import os

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the object factories)
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkRenderingCore import (vtkActor, vtkColorTransferFunction, vtkPolyDataMapper,
                                         vtkRenderer, vtkRenderWindow, vtkVolume,
                                         vtkVolumeProperty, vtkWindowToImageFilter)
from vtkmodules.vtkRenderingVolume import (vtkFixedPointVolumeRayCastMapper,
                                           vtkGPUVolumeRayCastMapper)

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper

import images
from images import caught, values  # noqa: F401 (for the tests)
from images import function_of as opacity_of

BACKGROUND = (0.1, 0.2, 0.3)

# What a picture may show, by the mapper's properties.
LOOKS = {"base": {"Method": vtkTransmittanceVolumeMapper.ORDINARY, "Shadows": 0},
         "shaded": {"Method": vtkTransmittanceVolumeMapper.ORDINARY, "Shadows": 1},
         "optimized": {"Shadows": 0},
         "shadows": {"Shadows": 1},
         "missed": {"Shadows": 1, "ShowMissed": 1}}

# What draws where a test does not choose, see vtkTransmittanceVolumeMapper::SetDrawOn.
DRAW_ON = os.environ.get("LIMPID_DRAW_ON", "")


def image_of(shape, spacing=(1, 1, 1), origin=(0, 0, 0), **arrays):
    """The same as images.image_of, with the first array active."""
    image = images.image_of(shape, spacing, origin, **arrays)
    if arrays:
        image.GetPointData().SetActiveScalars(next(iter(arrays)))
    return image


def phantom(resolution=32):
    image = images.phantom(resolution)
    image.GetPointData().SetActiveScalars("Scalars")
    return image


def colors_of(*nodes):
    function = vtkColorTransferFunction()
    for node in nodes:
        function.AddRGBPoint(*node)
    return function


def property_of(color, opacity, unit_distance):
    result = vtkVolumeProperty()
    result.SetColor(color)
    result.SetScalarOpacity(opacity)
    result.SetScalarOpacityUnitDistance(unit_distance)
    result.SetInterpolationTypeToLinear()
    result.ShadeOff()
    return result


def phantom_property():
    return property_of(
        colors_of((0, 0.2, 0.3, 0.9), (0.5, 0.9, 0.8, 0.6), (1, 0.9, 0.2, 0.1)),
        opacity_of((0, 0), (0.2, 0.02), (1, 0.2)), 0.05)


def sphere(center, radius, resolution=32):
    source = vtkSphereSource()
    source.SetCenter(*center)
    source.SetRadius(radius)
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    return source


def actor_of(source, color=(1, 1, 1), opacity=1):
    """A surface that has its colour without any light."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*color)
    actor.GetProperty().SetOpacity(opacity)
    actor.GetProperty().LightingOff()
    return actor


def gray_property(opacity=0.5, unit_distance=1.0, color=(0.9, 0.5, 0.1)):
    """The same colour and opacity for every value."""
    return property_of(colors_of((0, *color), (1, *color)), opacity_of((0, opacity), (1, opacity)),
                       unit_distance)


def scene(name):
    """Image, property and importance function of a test scene; None if it is not there."""
    folder = os.environ.get("LIMPID_TEST_DATA", "")
    path = os.path.join(folder, name + ".scene.json")
    if not folder or not os.path.exists(path):
        return None
    with open(path) as file:
        description = json.load(file)
    reader = vtkXMLImageDataReader()
    reader.SetFileName(os.path.join(folder, description["data"]["file"]))
    reader.Update()
    image = reader.GetOutput()
    image.GetPointData().SetActiveScalars(description["data"]["array"])

    unit = min(description["data"]["spacing"])
    nodes = np.array(description["extinction_tf"])
    # Straight lines of extinction are curves of opacity: enough of them.
    samples = np.linspace(*description["data"]["range"], 400)
    opacity = 1 - np.exp(-np.interp(samples, nodes[:, 0], nodes[:, 1]) * unit)
    volume_property = property_of(colors_of(*description["color_tf"]),
                                  opacity_of(*zip(samples, opacity)), unit)
    return image, volume_property, opacity_of(*description["importance_tf"])


def plain_mapper(sample_distance=1):
    """Without optimization and light."""
    mapper = vtkTransmittanceVolumeMapper()
    mapper.SetSampleDistance(sample_distance)
    mapper.SetOptimization(vtkTransmittanceVolumeMapper.OFF)
    mapper.ShadowsOff()
    return mapper


def fixed_point_mapper(step):
    """VTK's; `step`: distance of its samples."""
    mapper = vtkFixedPointVolumeRayCastMapper()
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetImageSampleDistance(1)
    mapper.SetSampleDistance(step)
    return mapper


def gpu_mapper(step):
    """VTK's; `step`: distance of its samples."""
    mapper = vtkGPUVolumeRayCastMapper()
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetImageSampleDistance(1)
    mapper.SetUseJittering(0)
    mapper.SetSampleDistance(step)
    return mapper


class View:
    """A window off the screen, with one renderer."""

    def __init__(self, size=(200, 200)):
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(*size)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(*BACKGROUND)
        self.window.AddRenderer(self.renderer)

    @property
    def camera(self):
        return self.renderer.GetActiveCamera()

    def add(self, image, volume_property, mapper):
        mapper.SetInputData(image)
        volume = vtkVolume()
        volume.SetMapper(mapper)
        volume.SetProperty(volume_property)
        self.renderer.AddVolume(volume)
        return volume

    def look(self, azimuth=35, elevation=20):
        """From a new camera's place, turned a little so that nothing lies along an axis."""
        self.camera.SetPosition(0, 0, 1)
        self.camera.SetFocalPoint(0, 0, 0)
        self.camera.SetViewUp(0, 1, 0)
        self.camera.SetViewAngle(30)
        self.renderer.ResetCamera()
        self.camera.Azimuth(azimuth)
        self.camera.Elevation(elevation)
        self.camera.Zoom(1.6)
        self.renderer.ResetCameraClippingRange()

    def interact(self, moving):
        self.window.SetDesiredUpdateRate(10 if moving else 0.001)

    def picture(self):
        """Renders; rows from the bottom, colours from 0 to 255."""
        self.window.Render()
        return self.pixels()

    def pixels(self):
        capture = vtkWindowToImageFilter()
        capture.SetInput(self.window)
        capture.SetInputBufferTypeToRGB()
        capture.ReadFrontBufferOff()
        capture.ShouldRerenderOff()
        capture.Update()
        columns, rows, _ = capture.GetOutput().GetDimensions()
        scalars = capture.GetOutput().GetPointData().GetScalars()
        return vtk_to_numpy(scalars).reshape(rows, columns, 3).astype(float)


def difference(a, b):
    return np.abs(a - b).mean()


def save(pixels, name):
    """Writes a picture into the folder LIMPID_TEST_OUTPUT, if there is one, to be looked at."""
    folder = os.environ.get("LIMPID_TEST_OUTPUT", "")
    if folder:
        from vtkmodules.vtkIOImage import vtkPNGWriter
        rows, columns, _ = pixels.shape
        image = image_of((columns, rows, 1), rgb=pixels.reshape(-1, 3).astype(np.uint8))
        writer = vtkPNGWriter()
        writer.SetInputData(image)
        writer.SetFileName(os.path.join(folder, name + ".png"))
        writer.Write()
