# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What the presets show in thin and in dense data.

  python3 Testing/Benchmarks/presets.py [--output Documentation/Benchmarks/Presets.json] [SCENE...]

SCENE: of the folder LIMPID_TEST_DATA. Each by its own functions and by ParaView's default opacity, a
straight line from 0 to 1 over the range of the data on a cell's length, both on three unit distances.
PYTHONPATH as for Testing/Python. Then, for the page:
  python3 Testing/Benchmarks/pages/make.py Documentation/Benchmarks --pages presets
"""

import argparse
import json
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "Python"), str(HERE / "pages")]

import machine  # noqa: E402
import volume_views  # noqa: E402
from limpid.vtkLimpidFilters import vtkExtinctionOptimizer, vtkVisibilitySettings  # noqa: E402

SCENES = ("carotid_mra", "engine", "isabel_wind", "skull_phantom", "thorax_ct", "visible_male",
          "vortex_rings")
DISTANCES = (3, 1, 1 / 3)  # of opacities, in those of the scene: thin, as it is, dense
FOUND = ("BaseVisibleFraction", "VisibleFraction", "SacrificedFraction", "VisibilityScore",
         "Iterations", "Seconds")


def optimizer_for(name):
    """The filter, set up for a scene by its own functions, its unit distance, and that of a cell."""
    image, volume_property, importance = volume_views.scene(name) or sys.exit(
        f"{name} is not in LIMPID_TEST_DATA.")
    with open(os.path.join(os.environ["LIMPID_TEST_DATA"], name + ".scene.json"),
              encoding="utf-8") as file:
        description = json.load(file)
    optimizer = vtkExtinctionOptimizer()
    optimizer.SetInputData(image)
    optimizer.SetInputArrayToProcess(0, 0, 0, 0, description["data"]["array"])
    optimizer.SetInputArrayToProcess(1, 0, 0, 0, description["data"]["array"])
    optimizer.UseImportanceFunctionOn()
    optimizer.SetImportanceFunction(importance)
    camera = description["camera"]
    optimizer.SetCameraPosition(camera["position"])
    optimizer.SetCameraFocalPoint(camera["focal_point"])
    optimizer.SetCameraViewUp(camera["view_up"])
    optimizer.SetLightPosition(description["light"]["position"])
    cell = image.GetLength() / image.GetNumberOfCells() ** (1 / 3)
    functions = {"own": (volume_property.GetScalarOpacity(),
                         volume_property.GetScalarOpacityUnitDistance()), "ramp": (None, cell)}
    return optimizer, functions


def compare(name):
    """By functions, unit distances and presets."""
    optimizer, functions = optimizer_for(name)
    measured = {}
    for kind, (function, unit) in functions.items():
        optimizer.SetScalarOpacityFunction(function)
        measured[kind] = []
        for distance in DISTANCES:
            optimizer.SetScalarOpacityUnitDistance(distance * unit)
            rows = {}
            for index in range(vtkVisibilitySettings.GetNumberOfPresets()):
                preset = vtkVisibilitySettings.GetPresetName(index)
                optimizer.SetPreset(preset)
                optimizer.Update()
                fields = optimizer.GetOutput().GetFieldData()
                rows[preset] = {key: fields.GetArray(key).GetValue(0) for key in FOUND}
                print(name, kind, distance, preset, rows[preset], file=sys.stderr)
            measured[kind].append({"distance": distance, "presets": rows})
    return measured


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", default=SCENES)
    parser.add_argument("--output")
    options = parser.parse_args()
    measured = {"machine": machine.facts(),
                "scenes": {name: compare(name) for name in options.scenes}}
    machine.save(measured, options.output)


if __name__ == "__main__":
    main()
