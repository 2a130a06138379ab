# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The pictures of all renderers on one sheet."""

import os

import numpy as np

from markdown import significant
from peers_pictures import ANOTHER_VTK, GROUPS
from plot_style import pyplot, save

MIDDLE = slice(0.1, 0.9)  # of a picture's rows and columns: the rest is empty
WRAPPED = {"vtkFixedPointVolumeRayCastMapper": "VTK, fixed point",
           "vtkGPUVolumeRayCastMapper": "VTK, GPU mapper",
           "optimised for this picture": "optimised", ", shaded": "", ", shadows": "", ", small": "",
           "vdb_render, no shadow samples": "vdb_render", "its own cutoff": "cutoff 0.005"}
LEFT_OUT = ("an empty window", "Limpid, shadows, light at rest", *ANOTHER_VTK,
            *(f"{name}, shaded" for name in ANOTHER_VTK))


def short(name):
    for text, shorter in WRAPPED.items():
        name = name.replace(text, shorter)
    return name


def plot(measured, folder, pictures):
    if not pictures:
        return
    still = measured["pictures"]["still"]
    numbers = {name: number for number, name in enumerate(still)}
    groups = {heading: [name for name in names if name in still and name not in LEFT_OUT]
              for heading, names in GROUPS.items()}
    columns = max(map(len, groups.values()))
    figure, axes = pyplot.subplots(len(groups), columns, layout="constrained", squeeze=False,
                                   figsize=(1.75 * columns, 2.0 * len(groups)))
    for axis in axes.flat:
        axis.set_axis_off()
    for row, (heading, names) in zip(axes, groups.items()):
        for axis, name in zip(row, names):
            pixels = np.load(os.path.join(pictures, f"{numbers[name]}.npy"))
            rows = slice(*(int(end * len(pixels)) for end in (MIDDLE.start, MIDDLE.stop)))
            axis.imshow(pixels[rows, rows])
            axis.set_title(f"{short(name)}\n{significant(still[name]['cpu'], 2)} CPU s", fontsize=7)
        row[0].text(-0.06, 0.5, heading, rotation=90, ha="right", va="center", fontsize=8,
                    transform=row[0].transAxes)
    save(figure, folder, "peers-pictures.png")
