# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Time to the first picture of tetrahedra, beside ParaView's own volume rendering of them. LIMPID_PLUGIN:
# Limpid.so. Makes the tetrahedra of a phantom of POINTS along each axis, with ARRAYS more arrays:
#   bash Testing/with-display.sh pvpython Testing/Benchmarks/meshes.py POINTS [ARRAYS] [REPEATS]
# Prints a row of Documentation/Benchmarks/Meshes.md, with medians.

import os
import statistics
import sys
import time

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk

KINDS = ("Optimized Volume", "Volume")


def meshes(points, arrays):
    tetrahedra = simple.Tetrahedralize(Input=simple.OcclusionPhantom(Resolution=points))
    tetrahedra.UpdatePipeline()
    data = simple.servermanager.Fetch(tetrahedra)
    random = np.random.default_rng(1)
    for number in range(arrays):
        array = numpy_to_vtk(random.random((data.GetNumberOfPoints(), 1 if number % 4 else 3)), deep=1)
        array.SetName(f"array{number}")
        data.GetPointData().AddArray(array)
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source, data.GetNumberOfCells()


def first_picture(source, kind):
    """Seconds until it is there."""
    view = simple.CreateView("RenderView")
    view.ViewSize = [800, 800]
    display = simple.Show(source, view)
    start = time.perf_counter()
    display.SetRepresentationType(kind)
    simple.ColorBy(display, ("POINTS", "Scalars"))
    simple.ResetCamera(view)
    simple.Render(view)
    seconds = time.perf_counter() - start
    simple.Delete(display)
    simple.Delete(view)
    return seconds


def main():
    points, arrays, repeats = [int(given) for given in sys.argv[1:]] + [0, 3][len(sys.argv) - 2:]
    simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=vars(simple))
    source, cells = meshes(points, arrays)
    runs = [[first_picture(source, kind) for kind in KINDS] for _ in range(repeats)]
    ours, theirs = (statistics.median(run[kind] for run in runs) for kind in range(2))
    print(f"| {cells / 1e6:.2f} | {arrays} | {ours:.1f} | {theirs:.1f} | {ours / theirs:.2f} |")


if __name__ == "__main__":
    main()
