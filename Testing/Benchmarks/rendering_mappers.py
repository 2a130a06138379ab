# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Times vtkTransmittanceVolumeMapper against VTK's own volume mappers, and compares their pictures.

    bash Testing/with-display.sh /usr/bin/python3 Testing/Benchmarks/rendering_mappers.py \\
      [--size N] [--repeats N] [--frames N] [--output FILE.json] NAME.scene.json ...

Needs the Python package limpid on PYTHONPATH (Testing/run.sh makes it in build/vtk). All mappers
draw the same volume with the same functions at the same sample distance, in turns, in one process.
Every picture is of another camera, and unless said otherwise the light goes with it, so that
nothing can be reused. Writes numbers as JSON, of which Testing/Benchmarks/pages makes Mappers.md.
"""

import argparse
import json
import math
import os
import statistics
import sys
import time

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (registers the window)
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401 (registers the drawing of pictures)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkMultiThreader, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkLight,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
    vtkVolumeProperty,
    vtkWindowToImageFilter,
)
from vtkmodules.vtkRenderingVolume import (
    vtkFixedPointVolumeRayCastMapper,
    vtkGPUVolumeRayCastMapper,
)

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "pages"))
import machine  # noqa: E402 pylint: disable=wrong-import-position

TURN = 0.37  # degrees between one timed picture and the next
LEARNING = 5  # frames after which a mapper knows what a frame may cost
FIXED_POINT = "vtkFixedPointVolumeRayCastMapper"
FIXED_POINT_SHADED = "vtkFixedPointVolumeRayCastMapper, shaded"
LIMPID_SHADOWS = "Limpid, lit, shadows"
CAMERAS = ((0, 0), (70, 20), (200, -35))  # azimuth and elevation of the compared pictures [degrees]


class Scene:
    """A scene file in a window of its own, drawn by one mapper at a time."""

    def __init__(self, path, size):
        with open(path, encoding="utf-8") as file:
            self.json = json.load(file)
        self.name = self.json["name"]
        reader = vtkXMLImageDataReader()
        reader.SetFileName(os.path.join(os.path.dirname(path), self.json["data"]["file"]))
        reader.Update()
        self.image = reader.GetOutput()
        self.image.GetPointData().SetActiveScalars(self.json["data"]["array"])
        self.step = min(self.image.GetSpacing())
        self.importance = piecewise(self.json["importance_tf"])

        self.volume = vtkVolume()
        self.volume.SetProperty(self.make_property())
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(0, 0, 0)
        self.renderer.AddVolume(self.volume)
        self.renderer.AutomaticLightCreationOff()
        self.headlight = vtkLight()
        self.headlight.SetLightTypeToHeadlight()
        self.fixed_light = self.make_light()
        self.renderer.AddLight(self.headlight)
        self.renderer.AddLight(self.fixed_light)
        self.shine(self.headlight)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(size, size)
        self.window.AddRenderer(self.renderer)
        self.look()

    def make_property(self):
        made = vtkVolumeProperty()
        colors = vtkColorTransferFunction()
        for value, red, green, blue in self.json["color_tf"]:
            colors.AddRGBPoint(value, red, green, blue)
        # Opacity is linear between its points, extinction was: so many points.
        extinction = piecewise(self.json["extinction_tf"])
        opacity = vtkPiecewiseFunction()
        low, high = extinction.GetRange()
        for value in np.linspace(low, high, 1025):
            opacity.AddPoint(value, 1 - math.exp(-extinction.GetValue(value) * self.step))
        made.SetColor(colors)
        made.SetScalarOpacity(opacity)
        made.SetScalarOpacityUnitDistance(self.step)
        made.SetInterpolationTypeToLinear()
        return made

    def make_light(self):
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPositional(True)
        light.SetConeAngle(180)
        light.SetPosition(self.json["light"]["position"])
        light.SetFocalPoint(self.json["camera"]["focal_point"])
        return light

    def shine(self, light):
        """Switches this light on and all others off."""
        for other in (self.headlight, self.fixed_light):
            other.SetSwitch(other is light)

    def look(self, azimuth=0.0, elevation=0.0):
        camera = self.renderer.GetActiveCamera()
        of_file = self.json["camera"]
        camera.SetPosition(of_file["position"])
        camera.SetFocalPoint(of_file["focal_point"])
        camera.SetViewUp(of_file["view_up"])
        camera.SetViewAngle(of_file["view_angle"])
        camera.Azimuth(azimuth)
        camera.Elevation(elevation)
        camera.OrthogonalizeViewUp()
        self.renderer.ResetCameraClippingRange()

    def draw(self, mapper, shade=False, moving=False):
        """Draws a frame; returns the seconds that it took, and those of all cores together."""
        if self.volume.GetMapper() is not mapper:
            self.volume.SetMapper(mapper)
        self.volume.GetProperty().SetShade(shade)
        self.window.SetDesiredUpdateRate(10 if moving else 1e-4)
        start, cores = time.perf_counter(), time.process_time()
        self.window.Render()
        self.window.WaitForCompletion()
        return time.perf_counter() - start, time.process_time() - cores

    def picture(self, mapper, **how):
        """Colours over black, as doubles in [0, 1]."""
        self.draw(mapper, **how)
        grabber = vtkWindowToImageFilter()
        grabber.SetInput(self.window)
        grabber.ReadFrontBufferOff()
        grabber.ShouldRerenderOff()
        grabber.Update()
        return vtk_to_numpy(grabber.GetOutput().GetPointData().GetScalars()) / 255.0

    def limpid(self, optimization=vtkTransmittanceVolumeMapper.OFF, shadows=True):
        mapper = vtkTransmittanceVolumeMapper()
        mapper.SetInputData(self.image)
        mapper.SetOptimization(optimization)
        mapper.SetShadows(shadows)
        mapper.SetUseImportanceFunction(True)
        mapper.SetImportanceFunction(self.importance)
        return mapper

    def fixed_point(self):
        mapper = vtkFixedPointVolumeRayCastMapper()
        mapper.SetInputData(self.image)
        mapper.LockSampleDistanceToInputSpacingOff()
        mapper.AutoAdjustSampleDistancesOff()
        mapper.SetSampleDistance(self.step)
        mapper.SetInteractiveSampleDistance(self.step)
        mapper.SetImageSampleDistance(1)
        mapper.IntermixIntersectingGeometryOff()
        return mapper

    def gpu(self):
        mapper = vtkGPUVolumeRayCastMapper()
        mapper.SetInputData(self.image)
        mapper.LockSampleDistanceToInputSpacingOff()
        mapper.AutoAdjustSampleDistancesOff()
        mapper.SetSampleDistance(self.step)
        mapper.UseJitteringOff()
        return mapper


def piecewise(points):
    function = vtkPiecewiseFunction()
    for value, result in points:
        function.AddPoint(value, result)
    return function


def spread(values):
    return (max(values) - min(values)) / statistics.median(values)


def differences(scene):
    """Mean absolute differences [1/255] of unlit, unoptimised pictures from VTK's mappers."""
    mapper = scene.limpid(shadows=False)
    others = (scene.fixed_point(), scene.gpu())
    for other in others:
        scene.draw(other)  # the first picture is coarser
    found = []
    for azimuth, elevation in CAMERAS:
        scene.look(azimuth, elevation)
        ours = scene.picture(mapper)
        for name, other in zip(("fixed point", "GPU"), others):
            theirs = scene.picture(other)
            covered = (ours.max(axis=1) > 0) | (theirs.max(axis=1) > 0)
            difference = np.abs(ours - theirs) * 255
            found.append({"mapper": name, "azimuth": azimuth, "elevation": elevation,
                          "all": difference.mean(), "covered": difference[covered].mean()})
    return found


def still_times(scene, repeats):
    """Seconds, and those of all cores, of still pictures by their kind, all kinds in turns."""
    optimized = scene.limpid(vtkTransmittanceVolumeMapper.CONTINUOUS)
    # Mapper, shade, whether the light stays where it is, whether it is the picture of a new camera.
    kinds = {
        FIXED_POINT: (scene.fixed_point(), False, False, True),
        FIXED_POINT_SHADED: (scene.fixed_point(), True, False, True),
        "Limpid, unlit": (scene.limpid(shadows=False), False, False, True),
        "Limpid, lit": (scene.limpid(shadows=False), True, False, True),
        "Limpid, lit, shadows, light at rest": (scene.limpid(), True, True, True),
        LIMPID_SHADOWS: (scene.limpid(), True, False, True),
        "the same, optimised for this picture": (optimized, True, False, True),
        "the same once more, nothing to be computed": (optimized, True, False, False),
    }
    times = {name: [] for name in kinds}
    for repeat in range(-1, repeats):  # the first round warms up
        for name, (mapper, shade, rests, new_camera) in kinds.items():
            scene.shine(scene.fixed_light if rests else scene.headlight)
            if new_camera:
                scene.look(azimuth=TURN * repeat)
            taken = scene.draw(mapper, shade=shade)
            if repeat >= 0:
                times[name].append(taken)
    scene.shine(scene.headlight)
    return times


def moving_times(scene, frames, optimization, still_before):
    """Seconds of the frames of an orbit with shadows and shading, turning by two degrees."""
    mapper = scene.limpid(optimization)
    scene.look()
    if still_before:
        scene.draw(mapper, shade=True)
    times = []
    for frame in range(frames + LEARNING):
        scene.look(azimuth=2.0 * (frame + 1))
        times.append(scene.draw(mapper, shade=True, moving=True)[0])
    return times


def summary(times):
    """Of pairs of seconds and those of all cores."""
    seconds, cores = zip(*times)
    return {"median": statistics.median(seconds), "shortest": min(seconds),
            "longest": max(seconds), "spread": spread(seconds), "cores": statistics.median(cores)}


def moving_summaries(scene, frames):
    found = {}
    for name, optimization, still_before in (
            ("optimised", vtkTransmittanceVolumeMapper.CONTINUOUS, True),
            ("optimised, no still picture before", vtkTransmittanceVolumeMapper.CONTINUOUS, False),
            ("not optimised", vtkTransmittanceVolumeMapper.OFF, True)):
        times = moving_times(scene, frames, optimization, still_before)
        after = times[LEARNING:]
        found[name] = {"first": times[0], "learning": max(times[1:LEARNING]),
                       "median": statistics.median(after), "longest": max(after)}
    return found


def measure(path, arguments):
    scene = Scene(path, arguments.size)
    print(scene.name, file=sys.stderr, flush=True)
    compared = differences(scene)
    times = still_times(scene, arguments.repeats)
    return {"scene": scene.name, "differences": compared,
            "still": {name: summary(pairs) for name, pairs in times.items()},
            "moving": moving_summaries(scene, arguments.frames)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--size", type=int, default=1024, help="width and height in pixels")
    parser.add_argument("--repeats", type=int, default=5, help="timed pictures of each kind")
    parser.add_argument("--frames", type=int, default=20, help="timed frames of the orbit")
    parser.add_argument("--output", help="file to write; default: standard output")
    parser.add_argument("scenes", nargs="+", help="NAME.scene.json")
    arguments = parser.parse_args()
    threads = vtkMultiThreader.GetGlobalDefaultNumberOfThreads()
    facts = {**machine.facts(), "facts": [f"{threads} threads of VTK's mapper",
                                          f"VTK {vtkVersion.GetVTKVersion()}"]}
    machine.save({"machine": facts, "size": arguments.size, "learning": LEARNING,
                  "scenes": [measure(path, arguments) for path in arguments.scenes]},
                 arguments.output)


if __name__ == "__main__":
    main()
