# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What structures cost: Extinction Optimizer with one importance array, and with as many labels as
# are asked for, a third of them important, whose shares it measures. Labels are blocks of the same
# size. With PYTHONPATH as for Testing/Python, for scenes such as those of Documentation/Examples:
#   python3 Testing/Benchmarks/structures.py LABELS FILE.scene.json...
# Prints a row of Markdown per scene: medians of interleaved runs, in seconds of all threads.

import pathlib
import resource
import statistics
import sys

import numpy as np

for folder in ("Python", "Scenes"):
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / folder))

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer  # noqa: E402

from images import filter_on, image_of  # noqa: E402
from scene_values import read_scene  # noqa: E402

RUNS = 5
BLOCKS = 5  # along each axis; labels are counted through them
LABELS = 3  # input array of the labels


def spent():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def read(path, labels):
    """Image and camera of a scene."""
    scene, image, values = read_scene(path)
    extinction = np.interp(values, *np.transpose(scene["extinction_tf"])).astype("float32")
    nodes = image.GetDimensions()
    x, y, z = np.unravel_index(np.arange(values.size), nodes, order="F")
    x, y, z = (BLOCKS * place // count for place, count in zip((x, y, z), nodes))
    block = 1 + (x + BLOCKS * (y + BLOCKS * z)) % labels
    block = np.where(extinction > 0, block, 0).astype("uint16")
    return image_of(nodes, image.GetSpacing(), image.GetOrigin(), BaseExtinction=extinction,
                    Labels=block, Importance=np.isin(block, important(labels)).astype("float32")
                    ), scene["camera"]


def important(labels):
    return range(1, labels + 1, 3)


def run(image, camera, labels):
    """Seconds of all threads; without labels: for the importance array."""
    filter_ = filter_on(image, vtkExtinctionOptimizer)
    if labels:
        filter_.SetInputArrayToProcess(LABELS, 0, 0, 0, "Labels")
        for label in range(1, labels + 1):
            filter_.AddStructure(label, str(label), float(label in important(labels)))
    filter_.SetCameraPosition(camera["position"])
    filter_.SetCameraFocalPoint(camera["focal_point"])
    filter_.SetCameraViewUp(camera["view_up"])
    before = spent()
    filter_.Update()
    assert not filter_.messages["ErrorEvent"], filter_.messages
    return spent() - before


def main():
    labels = int(sys.argv[1])
    print(f"| scene | points | one importance [s] | {labels} labels [s] | ratio |\n"
          "| --- | ---: | ---: | ---: | ---: |")
    for path in map(pathlib.Path, sys.argv[2:]):
        image, camera = read(path, labels)
        runs = [(run(image, camera, 0), run(image, camera, labels)) for _ in range(RUNS)]
        one, many = map(statistics.median, zip(*runs))
        print(f"| {path.name.split('.')[0]} | {' × '.join(map(str, image.GetDimensions()))} | "
              f"{one:.2f} | {many:.2f} | {many / one:.2f} |", flush=True)


if __name__ == "__main__":
    main()
