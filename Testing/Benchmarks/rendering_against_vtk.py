# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Times vtkTransmittanceVolumeMapper against VTK's own volume mappers, and compares their pictures.

    python3 rendering_against_vtk.py [--size N] [--repeats N] [--output FILE] NAME.scene.json ...

Needs the Python package limpid (the configuration without ParaView makes it) on PYTHONPATH, and a
display. All mappers draw the same volume with the same functions at the same sample distance, in
turns, in one process; every picture is of another camera, so that nothing can be reused. Writes
Markdown.
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
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper, vtkGPUVolumeRayCastMapper

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper

TURN = 0.37  # degrees between one timed picture and the next
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
        self.renderer.AddLight(self.make_light())
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
        """Draws a frame; returns the seconds that it took."""
        if self.volume.GetMapper() is not mapper:
            self.volume.SetMapper(mapper)
        self.volume.GetProperty().SetShade(shade)
        self.window.SetDesiredUpdateRate(10 if moving else 1e-4)
        start = time.perf_counter()
        self.window.Render()
        self.window.WaitForCompletion()
        return time.perf_counter() - start

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


def table(headings, rows):
    lines = ["| " + " | ".join(headings) + " |"]
    lines.append("| --- |" + " ---: |" * (len(headings) - 1))
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def milliseconds(values):
    return f"{1000 * statistics.median(values):.0f}"


def spread(values):
    return (max(values) - min(values)) / statistics.median(values)


def differences(scene):
    """Mean absolute differences [1/255] of unlit, unoptimised pictures from VTK's mappers."""
    mapper = scene.limpid(shadows=False)
    others = (scene.fixed_point(), scene.gpu())
    row = [scene.name]
    for azimuth, elevation in CAMERAS:
        scene.look(azimuth, elevation)
        ours = scene.picture(mapper)
        for other in others:
            theirs = scene.picture(other)
            covered = (ours.max(axis=1) > 0) | (theirs.max(axis=1) > 0)
            difference = np.abs(ours - theirs) * 255
            row.append(f"{difference.mean():.2f} ({difference[covered].mean():.2f})")
    return row


def still_times(scene, repeats):
    """Times of still pictures, in turns, each of a camera that was not seen before."""
    drawn = {
        "fixed point, shaded": (scene.fixed_point(), True),
        "unlit": (scene.limpid(shadows=False), False),
        "shaded": (scene.limpid(shadows=False), True),
        "shadows": (scene.limpid(), True),
        "optimised, shadows": (scene.limpid(vtkTransmittanceVolumeMapper.CONTINUOUS), True),
    }
    times = {name: [] for name in drawn}
    for repeat in range(-1, repeats):  # the first round warms up
        for name, (mapper, shade) in drawn.items():
            scene.look(azimuth=TURN * repeat)
            seconds = scene.draw(mapper, shade=shade)
            if repeat >= 0:
                times[name].append(seconds)
    return times


def moving_times(scene, frames):
    """Times of the frames of an orbit, optimised, with shadows and shading."""
    mapper = scene.limpid(vtkTransmittanceVolumeMapper.CONTINUOUS)
    scene.look()
    scene.draw(mapper, shade=True)
    times = []
    for frame in range(-10, frames):  # the first frames learn what a frame may cost
        scene.look(azimuth=2.0 * frame)
        seconds = scene.draw(mapper, shade=True, moving=True)
        if frame >= 0:
            times.append(seconds)
    return times


def machine():
    model = "unknown"
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                model = line.split(": ", 1)[1].strip()
                break
    return (
        f"* processor: {model}, {os.cpu_count()} cores visible, "
        f"{vtkMultiThreader.GetGlobalDefaultNumberOfThreads()} threads of VTK's mapper\n"
        f"* VTK {vtkVersion.GetVTKVersion()}\n"
        f"* date: {time.strftime('%Y-%m-%d')}\n"
        f"* load average before the start: {os.getloadavg()[0]:.2f}\n"
    )


def shown_command():
    return "python3 " + " ".join(
        os.path.basename(word) if word.startswith("/") else word for word in sys.argv
    )


def measure(scenes, arguments):
    compared, stills, moving = [], [], []
    noise = 0.0
    for path in scenes:
        scene = Scene(path, arguments.size)
        print(scene.name, file=sys.stderr, flush=True)
        compared.append(differences(scene))
        times = still_times(scene, arguments.repeats)
        noise = max(noise, max(spread(values) for values in times.values()))
        ratio = statistics.median(times["fixed point, shaded"]) / statistics.median(times["shadows"])
        stills.append(
            [scene.name] + [milliseconds(values) for values in times.values()] + [f"{ratio:.2f}"]
        )
        frames = moving_times(scene, arguments.frames)
        moving.append([scene.name, milliseconds(frames), f"{1000 * max(frames):.0f}"])
    return compared, stills, moving, noise


def write(stream, machine_text, arguments, compared, stills, moving, noise):
    stream.write("# Rendering against VTK\n\nWhat the tables mean is in [README.md](README.md).\n\n")
    stream.write(f"    {shown_command()}\n\n{machine_text}\n")
    if noise > 0.2:
        stream.write(
            f"**Times of the same picture lay up to {100 * noise:.0f} % apart: the machine was "
            "busy, and the times are preliminary.**\n\n"
        )
    size = arguments.size
    stream.write(f"## Still pictures of {size} x {size} [ms]\n\n")
    stream.write(
        table(
            [
                "scene",
                "vtkFixedPointVolumeRayCastMapper, shaded",
                "Limpid, unlit",
                "shaded",
                "shaded, shadows",
                "optimised, shaded, shadows",
                "fixed point / Limpid with shadows",
            ],
            stills,
        )
    )
    stream.write("\n## Frames of an orbit, optimised, shaded, shadows [ms]\n\n")
    stream.write(table(["scene", "median", "longest"], moving))
    stream.write("\n## Mean absolute difference of unlit pictures, of all (of covered) pixels [1/255]\n\n")
    headings = ["scene"]
    for azimuth, elevation in CAMERAS:
        headings += [f"fixed point, {azimuth}°, {elevation}°", "GPU"]
    stream.write(table(headings, compared))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--size", type=int, default=1024, help="width and height in pixels")
    parser.add_argument("--repeats", type=int, default=5, help="timed pictures of each kind")
    parser.add_argument("--frames", type=int, default=30, help="timed frames of the orbit")
    parser.add_argument("--output", help="file to write; default: standard output")
    parser.add_argument("scenes", nargs="+", help="NAME.scene.json")
    arguments = parser.parse_args()
    before = machine()
    results = measure(arguments.scenes, arguments)
    if arguments.output:
        with open(arguments.output, "w", encoding="utf-8") as file:
            write(file, before, arguments, *results)
    else:
        write(sys.stdout, before, arguments, *results)


if __name__ == "__main__":
    main()
