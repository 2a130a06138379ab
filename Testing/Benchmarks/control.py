# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What it costs to optimise on a coarser grid than that of the data: ControlResolution.

  python3 Testing/Benchmarks/control.py [--size 300] [--repeats 3]
    [--output Documentation/Benchmarks/Control.json] [--sheet Documentation/Benchmarks/Plots/control.jpg]
    [SCENE...]

SCENE: as for steadiness.py. PYTHONPATH as for Testing/Python; it draws pictures:
Testing/with-display.sh lends a display. Then, for the page:
  python3 Testing/Benchmarks/pages/make.py Documentation/Benchmarks --pages control
"""

import argparse
import pathlib
import statistics
import sys
import time

import numpy as np
from vtkmodules.vtkIOImage import vtkJPEGWriter

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "Python"), str(HERE / "pages")]

import machine  # noqa: E402
import steadiness  # noqa: E402
import volume_views  # noqa: E402
from limpid.vtkLimpidFilters import vtkExtinctionOptimizer as Optimizer  # noqa: E402
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper  # noqa: E402

RESOLUTIONS = {"full": Optimizer.FULL, "half": Optimizer.HALF, "quarter": Optimizer.QUARTER}
MEASURED = {"score": "VisibilityScore", "before": "BaseVisibilityScore",
            "fraction": "VisibleFraction", "attainable": "AttainableFraction",
            "energy": "Energy"}


def seen(scene, size, resolution):
    """The display's picture of what it has found, and the camera."""
    image, volume_property, importance = scene
    mapper = Mapper()
    mapper.SetControlResolution(resolution)
    mapper.SetImportanceArray("Importance" if importance is None else "")
    if importance is not None:
        mapper.UseImportanceFunctionOn()
        mapper.SetImportanceFunction(importance)
    view = volume_views.View((size, size))
    view.add(image, volume_property, mapper)
    view.look()
    view.interact(False)
    return view.picture(), view.camera


def found(scene, camera, resolution, repeats):
    """What the filter finds for a camera, measured on the data, and the time of a run [s]."""
    times = []
    for _ in range(repeats):
        optimizer = steadiness.optimizer_for(scene)
        optimizer.SetControlResolution(resolution)
        optimizer.SetCameraPosition(camera.GetPosition())
        optimizer.SetCameraFocalPoint(camera.GetFocalPoint())
        optimizer.SetCameraViewUp(camera.GetViewUp())
        optimizer.SetCameraViewAngle(camera.GetViewAngle())
        start = time.perf_counter()
        optimizer.Update()
        times.append(time.perf_counter() - start)
    fields = optimizer.GetOutput().GetFieldData()
    return {**{key: fields.GetArray(name).GetValue(0) for key, name in MEASURED.items()},
            "factor": fields.GetArray("ControlFactor").GetValue(0),
            "seconds": statistics.median(times)}


def write(rows, path):
    """Pictures side by side in rows, of which the first is the uppermost."""
    sheet = np.concatenate([np.concatenate(row, axis=1) for row in reversed(rows)], axis=0)
    height, width, _ = sheet.shape
    writer = vtkJPEGWriter()
    writer.SetInputData(volume_views.image_of(
        (width, height, 1), rgb=sheet.reshape(-1, 3).astype(np.uint8)))
    writer.SetQuality(88)
    writer.SetFileName(path)
    writer.Write()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--size", type=int, default=300)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--output")
    parser.add_argument("--sheet")
    options = parser.parse_args()
    measured = {"machine": machine.facts(), "size": options.size, "scenes": {}}
    rows = []
    for name in options.scenes or steadiness.all_scenes():
        scene = steadiness.load(name)
        results, pictures = {}, []
        for key, resolution in RESOLUTIONS.items():
            picture, camera = seen(scene, options.size, resolution)
            pictures.append(picture)
            apart = np.abs(picture - pictures[0])
            results[key] = {**found(scene, camera, resolution, options.repeats),
                            "apart": float(apart.mean()),
                            "above_30": float((apart.max(axis=2) > 30).mean())}
        measured["scenes"][name] = {"points": scene[0].GetNumberOfPoints(), **results}
        rows.append(pictures)
        print(name, measured["scenes"][name], file=sys.stderr)
        machine.save(measured, options.output)
    if options.sheet:
        write(rows, options.sheet)


if __name__ == "__main__":
    main()
