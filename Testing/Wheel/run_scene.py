# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Optimises one scene in this process, with the package or with the filter, and prints what came of
it and the most memory that the process had, as JSON.

  python3 run_scene.py package|filter SCENE.json SCALARS.npy function|array

function: the extinction is an opacity function's; array: it is an array that is given, as scene
files have it. Both sides get the same scalars, in the order of VTK.
"""

import json
import sys

import numpy as np

STEPS = 16  # of the opacity function between two nodes


def memory(key):
    """VmRSS (now) or VmHWM (the most so far) of this process [bytes]."""
    with open("/proc/self/status", encoding="ascii") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith(key))


class Scene:
    """What both sides are given."""

    def __init__(self, description, scalars):
        self.description = description
        self.scalars = scalars
        nodes = np.array(description["extinction_tf"], dtype=float)
        #: [length], so that opacities are neither tiny nor close to 1
        self.unit_distance = 0.5 / nodes[:, 1].max()
        values = np.unique(np.concatenate(
            [np.linspace(*ends, STEPS + 1) for ends in zip(nodes[:-1, 0], nodes[1:, 0])]))
        extinction = np.interp(values, *nodes.T)
        self.opacity = np.column_stack([values, -np.expm1(-extinction * self.unit_distance)])

    def extinction(self):
        """The scene's own, at the points, made slice by slice [1/length]."""
        nodes = np.transpose(self.description["extinction_tf"])
        result = np.empty(self.scalars.shape, dtype=np.float32, order="F")
        for k in range(result.shape[2]):
            result[..., k] = np.interp(self.scalars[..., k], *nodes)
        return result


def run_package(scene, given):
    import limpid

    data = scene.description["data"]
    base = {"extinction": scene.extinction()} if given == "array" else {
        "opacity_function": scene.opacity, "unit_distance": scene.unit_distance}
    before = memory("VmRSS")
    result = limpid.optimize(scene.scalars, spacing=data["spacing"], origin=data["origin"],
                             importance_function=scene.description["importance_tf"],
                             camera=scene.description["camera"], light=scene.description["light"],
                             **base)
    names = ("visibility_score", "base_visibility_score", "visible_fraction",
             "base_visible_fraction", "sacrificed_fraction", "attainable_fraction",
             "attainable_score", "energy", "iterations", "seconds")
    return before, {name: getattr(result, name) for name in names}


def run_filter(scene, given):
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction
    from limpid.vtkLimpidFilters import vtkExtinctionOptimizer

    data, camera = scene.description["data"], scene.description["camera"]
    image = vtkImageData()
    image.SetDimensions(scene.scalars.shape)
    image.SetSpacing(data["spacing"])
    image.SetOrigin(data["origin"])

    def add(name, array):
        values = numpy_to_vtk(array.ravel(order="F"))  # not a copy
        values.SetName(name)
        image.GetPointData().AddArray(values)

    def function(nodes):
        result = vtkPiecewiseFunction()
        for value, y in nodes:
            result.AddPoint(value, y)
        return result
    add("values", scene.scalars)
    optimizer = vtkExtinctionOptimizer()
    if given == "array":
        add("BaseExtinction", scene.extinction())
        optimizer.SetExtinctionSource(vtkExtinctionOptimizer.ARRAY)
    else:
        optimizer.SetScalarOpacityFunction(function(scene.opacity))
        optimizer.SetScalarOpacityUnitDistance(scene.unit_distance)
    image.GetPointData().SetActiveScalars("values")
    optimizer.SetInputData(image)
    optimizer.SetInputArrayToProcess(1, 0, 0, 0, "values")
    optimizer.SetUseImportanceFunction(1)
    optimizer.SetImportanceFunction(function(scene.description["importance_tf"]))
    optimizer.SetCameraPosition(camera["position"])
    optimizer.SetCameraFocalPoint(camera["focal_point"])
    optimizer.SetCameraViewUp(camera["view_up"])
    optimizer.SetLightPosition(scene.description["light"]["position"])
    before = memory("VmRSS")
    optimizer.Update()
    fields = optimizer.GetOutput().GetFieldData()
    names = {"visibility_score": "VisibilityScore", "base_visibility_score": "BaseVisibilityScore",
             "visible_fraction": "VisibleFraction", "base_visible_fraction": "BaseVisibleFraction",
             "sacrificed_fraction": "SacrificedFraction",
             "attainable_fraction": "AttainableFraction", "attainable_score": "AttainableScore",
             "energy": "Energy",
             "iterations": "Iterations", "seconds": "Seconds"}
    return before, {name: fields.GetArray(key).GetTuple1(0) for name, key in names.items()}


def main():
    side, scene, scalars, given = sys.argv[1:]
    with open(scene, encoding="utf-8") as file:
        description = json.load(file)
    scene = Scene(description, np.load(scalars))
    before, results = {"package": run_package, "filter": run_filter}[side](scene, given)
    print(json.dumps({**results, "before": before, "peak": memory("VmHWM")}))


if __name__ == "__main__":
    main()
