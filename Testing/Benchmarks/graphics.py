# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Pictures drawn by OpenGL against those of the processor: differences, uploads and times.

  python3 Testing/Benchmarks/graphics.py [--size 1024] [--frames 40] [--parts stills,uploads,motion]
    [--output Documentation/Benchmarks/Graphics.json] [SCENE...]

Some parts alone are measured anew in the numbers that --output has. SCENE: as for steadiness.py. PYTHONPATH as for Testing/Python. It draws with whatever OpenGL there
is: run it as it is on a machine with a graphics card and a display (or a VTK that finds EGL); under
Testing/with-display.sh, OpenGL is software. Then, for the page:
  python3 Testing/Benchmarks/pages/make.py Documentation/Benchmarks --pages graphics
"""

import argparse
import json
import pathlib
import statistics
import sys
import time

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "Python"), str(HERE / "pages")]

import machine  # noqa: E402
import steadiness  # noqa: E402
import volume_views  # noqa: E402
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper  # noqa: E402

DEVICES = {"processor": Mapper.PROCESSOR, "opengl": Mapper.OPENGL}


def show(scene, device, size, **properties):
    image, volume_property, importance = scene
    mapper = Mapper()
    mapper.SetDrawOn(DEVICES[device])
    mapper.SetImportanceArray("Importance" if importance is None else "")
    if importance is not None:
        mapper.UseImportanceFunctionOn()
        mapper.SetImportanceFunction(importance)
    for name, value in properties.items():
        getattr(mapper, "Set" + name)(value)
    view = volume_views.View(size)
    view.add(image, volume_property, mapper)
    view.look()
    view.interact(False)
    return view, mapper


def seconds_of(action):
    start = time.perf_counter()
    action()
    return time.perf_counter() - start


def stills(scene, size):
    """By look: how far apart the pictures are, and their times [s] with everything else done."""
    results = {}
    for look, properties in volume_views.LOOKS.items():
        pictures, result = {}, {}
        for device in DEVICES:
            view, mapper = show(scene, device, (size, size), **properties)
            pictures[device] = view.picture()
            mapper.PauseOptimizationOn()
            times = []
            for _ in range(3):
                view.camera.Azimuth(1e-3)  # else the finished picture would be shown again
                times.append(seconds_of(view.window.Render))
            result[device + "_seconds"] = statistics.median(times)
            result[device] = mapper.GetDrawnBy()
        apart = np.abs(pictures["processor"] - pictures["opengl"])
        results[look] = {**result, "mean": float(apart.mean()), "largest": float(apart.max()),
                         "above_4": float((apart.max(axis=2) > 4).mean())}
    return results


def uploads(scene):
    """Bytes per node: of the first picture and of the largest step of an optimisation; bytes in
    all: of a picture at rest and after a turn, with a light that stays where it is."""
    bounds = scene[0].GetBounds()
    view, mapper = show(scene, "opengl", (200, 200), ProgressiveStill=1, LightSource=Mapper.OWN)
    mapper.SetLightPosition([3 * high - 2 * low for low, high in zip(bounds[::2], bounds[1::2])])

    def draw():
        view.window.Render()
        return mapper.GetUploadedBytes()

    nodes = scene[0].GetNumberOfPoints()
    steps = [draw()]
    while not mapper.GetConverged():
        steps.append(draw())
    rest = draw()
    mapper.PauseOptimizationOn()
    draw()  # what is shown still eases to what was found
    view.camera.Azimuth(10)
    turn = draw()
    largest = max(steps[1:]) if steps[1:] else 0
    return {"first": steps[0] / nodes, "rest": rest, "turn": turn, "step": largest / nodes}


def motion(scene, frames):
    """Times of frames of 1920 x 1080 pixels while the camera turns [s]."""
    results = {}
    for device in DEVICES:
        view, mapper = show(scene, device, (1920, 1080), ProgressiveStill=1)
        while not mapper.GetConverged():
            view.window.Render()
        view.interact(True)
        times = []
        for _ in range(frames + 10):
            view.camera.Azimuth(1)
            times.append(seconds_of(view.window.Render))
        settled = times[10:]
        results[device] = {"median": statistics.median(settled), "longest": max(settled)}
    return results


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--size", type=int, default=1024)
    parser.add_argument("--frames", type=int, default=40)
    parser.add_argument("--parts")
    parser.add_argument("--output")
    options = parser.parse_args()
    parts = {"stills": lambda scene: stills(scene, options.size), "uploads": uploads,
             "motion": lambda scene: motion(scene, options.frames)}
    if options.parts:
        measured = json.loads(pathlib.Path(options.output).read_text(encoding="utf-8"))
    else:
        measured = {"machine": machine.facts(), "size": options.size, "scenes": {}}
    for name in options.scenes or steadiness.all_scenes():
        scene = steadiness.load(name)
        results = measured["scenes"].setdefault(name, {})
        for part in options.parts.split(",") if options.parts else parts:
            results[part] = parts[part](scene)
        print(name, measured["scenes"][name], file=sys.stderr)
        machine.save(measured, options.output)


if __name__ == "__main__":
    main()
