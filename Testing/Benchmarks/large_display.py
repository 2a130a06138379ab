# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# A dense volume of 16 bits in the display: memory beyond its input, time to the first picture, and
# frames while the camera turns. With PYTHONPATH as for Testing/Python:
#   bash Testing/with-display.sh python3 Testing/Benchmarks/large_display.py 1024 [PICTURE] [NAME=VALUE]...
# NAME: a property of vtkTransmittanceVolumeMapper; PICTURE: into the folder LIMPID_TEST_OUTPUT. Prints a
# line of JSON.

import json
import pathlib
import statistics
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Python"))

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper  # noqa: E402

from volume_views import View, colors_of, opacity_of, property_of, save  # noqa: E402


def bytes_in(key):
    with open("/proc/self/status") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith(key))


def dense(points):
    """Shells with noise in them round a dense core, in [0, 65535], nowhere empty."""
    values = np.empty((points, points, points), np.uint16)
    along = np.linspace(-1, 1, points, dtype=np.float32)
    random = np.random.default_rng(1)
    noise = random.random((points, points), dtype=np.float32)
    for layer, z in enumerate(along):
        radius = np.sqrt(along[None, :] ** 2 + along[:, None] ** 2 + z ** 2)
        shells = 0.5 + 0.5 * np.cos(24 * radius + 2 * np.sin(5 * along)[None, :])
        value = 0.15 + 0.45 * shells * (radius > 0.35) + 0.8 * (radius <= 0.35)
        values[layer] = 65535 * np.clip(value + 0.05 * np.roll(noise, 37 * layer), 0, 1)
    image = vtkImageData()
    image.SetDimensions(points, points, points)
    image.SetSpacing(*3 * (2 / (points - 1),))
    array = numpy_to_vtk(values.ravel())
    array.SetName("Values")
    image.GetPointData().SetScalars(array)
    image.values = values
    return image


def mapper_and_look():
    """The core is important; the picture becomes finished step by step."""
    mapper = vtkTransmittanceVolumeMapper()
    mapper.SetUseImportanceFunction(1)
    mapper.SetImportanceFunction(opacity_of((0, 0), (55000, 0), (60000, 1), (65535, 1)))
    mapper.SetImportanceArray("Values")
    mapper.SetProgressiveStill(1)
    look = property_of(colors_of((0, 0.2, 0.3, 0.6), (30000, 0.9, 0.8, 0.6), (65535, 0.9, 0.2, 0.1)),
                       opacity_of((0, 0.02), (20000, 0.05), (45000, 0.6), (65535, 0.9)), 0.1)
    return mapper, look


def main():
    points, *rest = sys.argv[1:]
    image = dense(int(points))
    mapper, look = mapper_and_look()
    for setting in (text for text in rest if "=" in text):
        key, value = setting.split("=")
        getattr(mapper, "Set" + key)(float(value) if "." in value else int(value))
    before = bytes_in("VmRSS")
    with open("/proc/self/clear_refs", "w") as file:
        file.write("5")  # forgets the peak so far
    view = View((1024, 1024))
    messages = []
    mapper.AddObserver("WarningEvent", lambda *_: messages.append("warning"))
    mapper.AddObserver("ErrorEvent", lambda *_: messages.append("error"))
    view.add(image, look, mapper)
    view.look()
    start = time.perf_counter()
    view.window.Render()
    first = time.perf_counter() - start
    while not mapper.GetConverged():
        view.window.Render()
    optimised = time.perf_counter() - start
    view.interact(True)
    frames = []
    for step in range(20):
        view.camera.Azimuth(2)
        start = time.perf_counter()
        view.window.Render()
        frames.append(time.perf_counter() - start)
    view.interact(False)
    while True:
        view.window.Render()
        if mapper.GetConverged():
            break
    for picture in (text for text in rest if "=" not in text):
        save(view.pixels(), picture)
    print(json.dumps({
        "points": int(points), "bytes a point": round((bytes_in("VmHWM") - before) / int(points) ** 3, 2),
        "peak [GB]": round(bytes_in("VmHWM") / 1e9, 2), "first picture [s]": round(first, 1),
        "optimised [s]": round(optimised, 1), "frame, median [s]": round(statistics.median(frames), 3),
        "frame, longest [s]": round(max(frames), 3), "resolution": mapper.GetOptimizedAt(),
        "visible": round(mapper.GetVisibleFraction(), 4),
        "before": round(mapper.GetBaseVisibleFraction(), 4), "messages": messages}))


if __name__ == "__main__":
    main()
