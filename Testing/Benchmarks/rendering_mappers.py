# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Times vtkTransmittanceVolumeMapper against VTK's own volume mappers, and compares their pictures.

    bash Testing/with-display.sh /usr/bin/python3 Testing/Benchmarks/rendering_mappers.py \\
      [--size N] [--repeats N] [--frames N] [--output FILE.json] NAME.scene.json ...

Needs the Python package limpid on PYTHONPATH (Testing/run.sh makes it in build/vtk). All mappers
draw the same volume with the same functions at the same sample distance, in turns, in one process.
Every picture is of another camera, and unless said otherwise the light goes with it, so that
nothing can be reused. Testing/Benchmarks/pages makes Mappers.md of the numbers.
"""

import argparse
import json
import os
import statistics
import sys
import time

import numpy as np
from vtkmodules.vtkCommonCore import vtkMultiThreader, vtkVersion
from vtkmodules.vtkRenderingCore import vtkLight

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path += [os.path.join(HERE, "pages"), os.path.join(HERE, "..", "Python")]
import machine  # noqa: E402 pylint: disable=wrong-import-position
import volume_views  # noqa: E402 pylint: disable=wrong-import-position

TURN = 0.37  # degrees between one timed picture and the next
LEARNING = 5  # frames after which a mapper knows what a frame may cost
CAMERAS = ((0, 0), (70, 20), (200, -35))  # azimuth and elevation of the compared pictures [degrees]


class Scene:
    """A scene file in a window of its own, drawn by one mapper at a time."""

    def __init__(self, path, size):
        os.environ["LIMPID_TEST_DATA"] = os.path.dirname(os.path.abspath(path))
        self.name = os.path.basename(path).split(".")[0]
        with open(path, encoding="utf-8") as file:
            self.json = json.load(file)
        self.image, volume_property, self.importance = volume_views.scene(self.name)
        self.step = min(self.image.GetSpacing())
        self.view = volume_views.View((size, size))
        self.view.renderer.SetBackground(0, 0, 0)
        self.view.renderer.AutomaticLightCreationOff()
        self.volume = self.view.add(self.image, volume_property, self.fixed_point())
        self.headlight, self.fixed_light = vtkLight(), vtkLight()
        self.headlight.SetLightTypeToHeadlight()
        self.fixed_light.SetLightTypeToSceneLight()
        self.fixed_light.SetPositional(True)
        self.fixed_light.SetConeAngle(180)
        self.fixed_light.SetPosition(self.json["light"]["position"])
        self.fixed_light.SetFocalPoint(self.json["camera"]["focal_point"])
        for light in (self.headlight, self.fixed_light):
            self.view.renderer.AddLight(light)
        self.shine(self.headlight)
        self.look()

    def shine(self, light):
        """Switches this light on and all others off."""
        for other in (self.headlight, self.fixed_light):
            other.SetSwitch(other is light)

    def look(self, azimuth=0.0, elevation=0.0):
        camera, of_file = self.view.camera, self.json["camera"]
        camera.SetPosition(of_file["position"])
        camera.SetFocalPoint(of_file["focal_point"])
        camera.SetViewUp(of_file["view_up"])
        camera.SetViewAngle(of_file["view_angle"])
        camera.Azimuth(azimuth)
        camera.Elevation(elevation)
        camera.OrthogonalizeViewUp()
        self.view.renderer.ResetCameraClippingRange()

    def draw(self, mapper, shade=False, moving=False):
        """Draws a frame; returns the seconds that it took, and those of all cores together."""
        self.volume.SetMapper(mapper)
        self.volume.GetProperty().SetShade(shade)
        self.view.interact(moving)
        start, cores = time.perf_counter(), time.process_time()
        self.view.window.Render()
        self.view.window.WaitForCompletion()
        return time.perf_counter() - start, time.process_time() - cores

    def picture(self, mapper):
        self.draw(mapper)
        return self.view.pixels().reshape(-1, 3)

    def limpid(self, optimization=Mapper.OFF, shadows=True):
        mapper = volume_views.plain_mapper()
        mapper.SetInputData(self.image)
        mapper.SetOptimization(optimization)
        mapper.SetShadows(shadows)
        mapper.SetUseImportanceFunction(True)
        mapper.SetImportanceFunction(self.importance)
        return mapper

    def fixed_point(self):
        mapper = volume_views.fixed_point_mapper(self.step)
        mapper.SetInteractiveSampleDistance(self.step)
        mapper.SetInputData(self.image)
        return mapper

    def gpu(self):
        mapper = volume_views.gpu_mapper(self.step)
        mapper.SetInputData(self.image)
        return mapper


def differences(scene):
    """Mean absolute differences [1/255] of unlit, unoptimised pictures from VTK's mappers."""
    mapper = scene.limpid(shadows=False)
    others = {"fixed point": scene.fixed_point(), "GPU": scene.gpu()}
    for other in others.values():
        scene.draw(other)  # the first picture is coarser
    found = []
    for azimuth, elevation in CAMERAS:
        scene.look(azimuth, elevation)
        ours = scene.picture(mapper)
        for name, other in others.items():
            theirs = scene.picture(other)
            covered = (ours.max(axis=1) > 0) | (theirs.max(axis=1) > 0)
            difference = np.abs(ours - theirs)
            found.append({"mapper": name, "azimuth": azimuth, "elevation": elevation,
                          "all": difference.mean(), "covered": difference[covered].mean()})
    return found


def still_times(scene, repeats):
    """Times of still pictures by their kind, all kinds in turns."""
    optimized = scene.limpid(Mapper.CONTINUOUS)
    # Mapper, shade, whether the light stays where it is, whether it is the picture of a new camera.
    kinds = {
        "vtkFixedPointVolumeRayCastMapper": (scene.fixed_point(), False, False, True),
        "vtkFixedPointVolumeRayCastMapper, shaded": (scene.fixed_point(), True, False, True),
        "Limpid, unlit": (scene.limpid(shadows=False), False, False, True),
        "Limpid, lit": (scene.limpid(shadows=False), True, False, True),
        "Limpid, lit, shadows, light at rest": (scene.limpid(), True, True, True),
        "Limpid, lit, shadows": (scene.limpid(), True, False, True),
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
    return {name: summary(*zip(*pairs)) for name, pairs in times.items()}


def summary(seconds, cores):
    median = statistics.median(seconds)
    return {"median": median, "shortest": min(seconds), "longest": max(seconds),
            "spread": (max(seconds) - min(seconds)) / median, "cores": statistics.median(cores)}


def moving_times(scene, frames, optimization, still_before=True):
    """Of the frames of an orbit with shadows and shading, turning by two degrees."""
    mapper = scene.limpid(optimization)
    scene.look()
    if still_before:
        scene.draw(mapper, shade=True)
    times = []
    for frame in range(frames + LEARNING):
        scene.look(azimuth=2.0 * (frame + 1))
        times.append(scene.draw(mapper, shade=True, moving=True)[0])
    after = times[LEARNING:]
    return {"first": times[0], "learning": max(times[1:LEARNING]),
            "median": statistics.median(after), "longest": max(after)}


def measure(path, arguments):
    scene = Scene(path, arguments.size)
    print(scene.name, file=sys.stderr, flush=True)
    frames = arguments.frames
    return {"scene": scene.name, "differences": differences(scene),
            "still": still_times(scene, arguments.repeats),
            "moving": {
                "optimised": moving_times(scene, frames, Mapper.CONTINUOUS),
                "optimised, no still picture before":
                    moving_times(scene, frames, Mapper.CONTINUOUS, still_before=False),
                "not optimised": moving_times(scene, frames, Mapper.OFF)}}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--size", type=int, default=1024, help="width and height in pixels")
    parser.add_argument("--repeats", type=int, default=5, help="timed pictures of each kind")
    parser.add_argument("--frames", type=int, default=20, help="timed frames of the orbit")
    parser.add_argument("--output", help="file to write; default: standard output")
    parser.add_argument("scenes", nargs="+", help="NAME.scene.json")
    arguments = parser.parse_args()
    threads = vtkMultiThreader.GetGlobalDefaultNumberOfThreads()
    facts = [f"{threads} threads of VTK's mapper", f"VTK {vtkVersion.GetVTKVersion()}"]
    machine.save({"machine": {**machine.facts(), "facts": facts}, "size": arguments.size,
                  "learning": LEARNING,
                  "scenes": [measure(path, arguments) for path in arguments.scenes]},
                 arguments.output)


if __name__ == "__main__":
    main()
