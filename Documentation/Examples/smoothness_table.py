# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Tells what despeckling and smoothing do to the change of the extinction: a row per scene.

  pvpython smoothness_table.py --plugin Limpid.so [--protect 1] [FILE.scene.json ...]

Without scenes: the embedded phantom. Three results each: neither of them; ImportanceSmoothing
Median; that and Smoothness 0.2. Of each, the score S of the importance as given, the share of it that
is visible in percent, the total variation of the change over its sum (of all differences between
neighbours along the axes, both in units of the extinction), and the iterations.
"""

import argparse
import os
import sys

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import optimize_scene  # pylint: disable=wrong-import-position
import scenes  # pylint: disable=wrong-import-position

SETTINGS = (("Off", 0), ("Median", 0), ("Median", 0.2))


def variation(image):
    """Total variation of the change over its sum."""
    shape = image.GetDimensions()[::-1]
    points = image.GetPointData()
    change = (vtk_to_numpy(points.GetArray("Extinction")).astype(float) -
              vtk_to_numpy(points.GetArray("BaseExtinction"))).reshape(shape)
    total = sum(np.abs(np.diff(change, axis=axis)).sum() for axis in range(3))
    return total / np.abs(change).sum()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--protect", type=float, default=1)
    parser.add_argument("scenes", nargs="*")
    arguments = parser.parse_args()
    simple.LoadPlugin(os.path.abspath(arguments.plugin), remote=False, ns=vars(simple))

    print("| scene |" + 3 * " S, visible, variation, iterations |")
    rows = [scenes.read_scene(simple, path) for path in arguments.scenes]
    for scene in rows or [scenes.phantom_scene(simple)]:
        scene.source.UpdatePipeline()
        optimizer = optimize_scene.optimize(scene)
        optimizer.ProtectImportance = arguments.protect
        cells = []
        for median, smoothness in SETTINGS:
            optimizer.ImportanceSmoothing = median
            optimizer.Smoothness = smoothness
            optimizer.UpdatePipeline()
            image = optimizer.GetClientSideObject().GetOutputDataObject(0)
            numbers = optimize_scene.results(optimizer)
            cells.append("{:.5g}, {:.1f}, {:.3f}, {:.0f}".format(
                numbers["VisibilityScore"], 100 * numbers["VisibleFraction"], variation(image),
                numbers["Iterations"]))
        print("| {} | {} |".format(scene.name, " | ".join(cells)), flush=True)
        simple.Delete(optimizer)
        simple.Delete(scene.source)


if __name__ == "__main__":
    main()
