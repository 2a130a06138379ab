# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Peak memory of the filters, beyond their input and in bytes per point, of an image of 16-bit integers
# in which every point matters: the most that a filter can need, for the estimates of
# Filters/vtkExtinctionOptimizerInternals.cxx. One run, in a process of its own, with PYTHONPATH as for
# Testing/Python:
#   python3 Testing/Benchmarks/filter_memory.py 256 vtkExtinctionOptimizer Solver=1 Mode=1
# ResultArray=NAME leaves out all other results. The number of points may be the name of a scene in
# LIMPID_TEST_DATA instead, which is seen from where AutomaticPlacement puts the camera. An image that does
# not fit is refused with a message: put "ulimit -v <KiB>" before the command.

import pathlib
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction

from limpid import vtkLimpidFilters

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Python"))

import steadiness  # noqa: E402


def bytes_in(key):
    with open("/proc/self/status") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith(key))


def waves(points):
    """Shells and columns, thick and important everywhere, in the unit cube."""
    along = np.linspace(-1, 1, points, dtype=np.float32)
    columns = 8000 * np.sin(40 * along[:, None] + 30 * along[None, :])
    values = np.empty((points, points, points), np.uint16)
    for k, z in enumerate(along):
        radius = np.sqrt(z ** 2 + along[:, None] ** 2 + along[None, :] ** 2)
        values[k] = 20000 + 11000 * np.cos(9 * radius) + columns
    image = vtkImageData()
    image.SetDimensions(points, points, points)
    image.SetSpacing([1 / (points - 1)] * 3)
    array = numpy_to_vtk(values.ravel(), deep=1)
    array.SetName("Scalars")
    image.GetPointData().SetScalars(array)
    return image


def filter_named(name, settings):
    filter_ = getattr(vtkLimpidFilters, name)()
    opacity = vtkPiecewiseFunction()
    opacity.AddPoint(0, 0.02)
    opacity.AddPoint(43000, 0.6)
    filter_.SetScalarOpacityFunction(opacity)
    filter_.SetScalarOpacityUnitDistance(0.1)
    importance = vtkPiecewiseFunction()
    importance.AddPoint(0, 0.1)
    importance.AddPoint(43000, 1)
    filter_.SetImportanceFunction(importance)
    filter_.SetUseImportanceFunction(True)
    if name == "vtkViewpointSearch":
        filter_.SetNumberOfDirections(12)
    else:
        filter_.SetCameraPosition(0.5, 4, 0.5)
        filter_.SetCameraFocalPoint(0.5, 0.5, 0.5)
        filter_.SetCameraViewUp(0, 0, 1)
    filter_.SetMaximumIterations(3)
    filter_.SetIterationsPerLevel(1, 1, 2)
    return with_settings(filter_, settings)


def with_settings(filter_, settings):
    for setting in settings:
        key, value = setting.split("=")
        if key == "ResultArray":
            filter_.RemoveAllResultArrays()
            filter_.AddResultArray(value)
        else:
            getattr(filter_, "Set" + key)(float(value) if "." in value else int(value))
    return filter_


def main():
    scene, name, *settings = sys.argv[1:]
    filter_ = filter_named(name, settings)
    filter_.SetInputData(waves(8))
    filter_.Update()  # its threads are there
    if scene.isdigit():
        image = waves(int(scene))
    else:
        loaded = steadiness.load(scene)
        image = loaded[0]
        filter_ = with_settings(steadiness.optimizer_for(loaded), settings)
        filter_.AutomaticPlacementOn()
    filter_.SetInputData(image)
    points = image.GetNumberOfPoints()
    with open("/proc/self/clear_refs", "w") as file:
        file.write("5")  # forgets the peak so far
    before = bytes_in("VmRSS")
    start = time.perf_counter()
    filter_.Update()
    seconds = time.perf_counter() - start
    peak = bytes_in("VmHWM")
    score = filter_.GetOutput().GetFieldData().GetArray("VisibleFraction")
    print(f"{(peak - before) / points:.1f} bytes per point, {seconds:.1f} s, "
          f"peak of the process {peak / 1e9:.2f} GB"
          + (f", {100 * score.GetTuple1(0):.2f} % visible" if score else ""))


if __name__ == "__main__":
    main()
