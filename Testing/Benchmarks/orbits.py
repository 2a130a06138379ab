# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What one extinction for all views of an orbit shows, against one for each view.

  python3 Testing/Benchmarks/orbits.py [--views 8]
    [--output Documentation/Benchmarks/Orbits.json] [SCENE...]

SCENE: as for steadiness.py. PYTHONPATH as for Testing/Python. Then, for the page:
  python3 Testing/Benchmarks/pages/make.py Documentation/Benchmarks --pages orbits
"""

import argparse
import pathlib
import sys
import time

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "Python"), str(HERE / "pages")]

import machine  # noqa: E402
import steadiness  # noqa: E402
import volume_views  # noqa: E402
from limpid.vtkLimpidFilters import vtkExtinctionOptimizer  # noqa: E402

ELEVATION = np.radians(20)
DISTANCE = 3  # radii of the box


def optimizer_for(scene):
    optimizer = steadiness.optimizer_for(scene)
    optimizer.SetPreset("Paper")
    optimizer.SetCameraFocalPoint(scene[0].GetCenter())
    return optimizer


def camera_at(image, azimuth):
    """On an orbit about the y axis."""
    direction = (np.cos(ELEVATION) * np.sin(azimuth), np.sin(ELEVATION),
                 np.cos(ELEVATION) * np.cos(azimuth))
    return np.array(image.GetCenter()) + DISTANCE * image.GetLength() / 2 * np.array(direction)


def field(optimizer, name):
    return optimizer.GetOutput().GetFieldData().GetArray(name).GetValue(0)


def compare(scene, views):
    """Mean score over the views: of the base, of each view's own optimum, of one for all; and the
    time of both [s]."""
    image = scene[0]
    optimizer = optimizer_for(scene)
    optimizer.SetLightPosition(image.GetCenter() + (camera_at(image, 0.5) - image.GetCenter()) * 1.5)
    base, single, seconds = [], [], 0
    for azimuth in 2 * np.pi * np.arange(views) / views:
        optimizer.SetCameraPosition(camera_at(image, azimuth))
        start = time.perf_counter()
        optimizer.Update()
        seconds += time.perf_counter() - start
        base.append(field(optimizer, "BaseVisibilityScore"))
        single.append(field(optimizer, "VisibilityScore"))
    optimizer.SetCameraPosition(camera_at(image, 0))
    optimizer.SetViews(vtkExtinctionOptimizer.ORBIT)
    optimizer.SetNumberOfViews(views)
    start = time.perf_counter()
    optimizer.Update()
    return {"ordinary": float(np.mean(base)), "single": float(np.mean(single)),
            "joint": field(optimizer, "VisibilityScore"), "single_seconds": seconds,
            "joint_seconds": time.perf_counter() - start,
            "iterations": optimizer.GetOutputDataObject(1).GetNumberOfRows() - 1}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--views", type=int, default=8)
    parser.add_argument("--output")
    options = parser.parse_args()
    measured = {"machine": machine.facts(), "views": options.views, "scenes": {}}
    for name in options.scenes or steadiness.all_scenes():
        result = compare(steadiness.load(name), options.views)
        print(name, result, file=sys.stderr)
        measured["scenes"][name] = result
    machine.save(measured, options.output)


if __name__ == "__main__":
    main()
