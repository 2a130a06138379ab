# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Times vtkTransmittanceVolumeMapper against VTK's own volume mappers, and compares their pictures.

    bash Testing/with-display.sh /usr/bin/python3 Testing/Benchmarks/rendering_mappers.py \\
      [--size N] [--repeats N] [--frames N] [--output FILE] NAME.scene.json ...

Needs the Python package limpid on PYTHONPATH (Testing/run.sh makes it in build/vtk). All mappers
draw the same volume with the same functions at the same sample distance, in turns, in one process.
Every picture is of another camera, and unless said otherwise the light goes with it, so that
nothing can be reused. Writes Markdown.
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
    for other in others:
        scene.draw(other)  # the first picture is coarser
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


def still_rows(times):
    reference = [statistics.median(values) for values in zip(*times[FIXED_POINT_SHADED])]
    rows = []
    for name, pairs in times.items():
        seconds, cores = zip(*pairs)
        rows.append([name, milliseconds(seconds), f"{1000 * min(seconds):.0f}",
                     f"{1000 * max(seconds):.0f}", milliseconds(cores),
                     f"{statistics.median(seconds) / reference[0]:.2f}",
                     f"{statistics.median(cores) / reference[1]:.2f}"])
    return rows


def moving_rows(scene, frames):
    rows = []
    for name, optimization, still_before in (
            ("optimised", vtkTransmittanceVolumeMapper.CONTINUOUS, True),
            ("optimised, no still picture before", vtkTransmittanceVolumeMapper.CONTINUOUS, False),
            ("not optimised", vtkTransmittanceVolumeMapper.OFF, True)):
        times = moving_times(scene, frames, optimization, still_before)
        rows.append([name, f"{1000 * times[0]:.0f}", f"{1000 * max(times[1:LEARNING]):.0f}",
                     milliseconds(times[LEARNING:]), f"{1000 * max(times[LEARNING:]):.0f}"])
    return rows


def measure(path, arguments):
    """Name, tables and how far times of the same kind lay apart of one scene."""
    scene = Scene(path, arguments.size)
    print(scene.name, file=sys.stderr, flush=True)
    compared = differences(scene)
    times = still_times(scene, arguments.repeats)
    moving = moving_rows(scene, arguments.frames)
    apart = max(spread([seconds for seconds, _ in pairs]) for pairs in times.values())
    return scene.name, compared, still_rows(times), moving, apart


def write(stream, machine_text, arguments, results):
    stream.write("# Mappers\n\nWhat the tables mean is in [README.md](README.md).\n\n")
    stream.write(f"    {shown_command()}\n\n{machine_text}\n")
    noise = max(result[-1] for result in results)
    if noise > 0.2:
        stream.write(
            f"**Times of the same picture lay up to {100 * noise:.0f} % apart: the machine was "
            "busy, and the times are preliminary.**\n\n"
        )
    size = arguments.size
    for name, _, still, moving, _ in results:
        stream.write(f"## {name}, {size} x {size}\n\n")
        stream.write(table(["still pictures [ms]", "median", "shortest", "longest",
                            "all cores", "of fixed point, shaded", "all cores"], still) + "\n")
        stream.write(table(["moving, lit, shadows [ms]", "first frame", "longest of the next "
                            f"{LEARNING - 1}", "median after", "longest after"], moving) + "\n")
    stream.write("## Mean absolute difference of unlit pictures, of all (of covered) pixels "
                 "[1/255]\n\n")
    headings = ["scene"]
    for azimuth, elevation in CAMERAS:
        headings += [f"fixed point, {azimuth}°, {elevation}°", "GPU"]
    stream.write(table(headings, [result[1] for result in results]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--size", type=int, default=1024, help="width and height in pixels")
    parser.add_argument("--repeats", type=int, default=5, help="timed pictures of each kind")
    parser.add_argument("--frames", type=int, default=20, help="timed frames of the orbit")
    parser.add_argument("--output", help="file to write; default: standard output")
    parser.add_argument("scenes", nargs="+", help="NAME.scene.json")
    arguments = parser.parse_args()
    before = machine()
    results = [measure(path, arguments) for path in arguments.scenes]
    if arguments.output:
        with open(arguments.output, "w", encoding="utf-8") as file:
            write(file, before, arguments, results)
    else:
        write(sys.stdout, before, arguments, results)


if __name__ == "__main__":
    main()
