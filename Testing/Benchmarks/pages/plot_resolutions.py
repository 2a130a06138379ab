# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The pictures of all resolutions on one sheet."""

import os

import numpy as np

from markdown import ms
from plot_style import pyplot, save


def read_picture(path):
    """A binary PPM."""
    with open(path, "rb") as file:
        data = file.read()
    head = data.split(maxsplit=4)[:4]
    width, height = int(head[1]), int(head[2])
    pixels = np.frombuffer(data[-3 * width * height:], dtype=np.uint8)
    return pixels.reshape(height, width, 3)


def plot_resolutions(scene, source, folder):
    pictures = scene["pictures"]
    densities = sorted({p["ray_density"] for p in pictures})
    coarsenings = sorted({p["coarsening"] for p in pictures}, reverse=True)
    best = min(p["F"] for p in pictures)
    size = 2.4
    figure, axes = pyplot.subplots(len(densities), len(coarsenings), layout="constrained",
                                   figsize=(size * len(coarsenings) + 0.4,
                                            (size + 0.28) * len(densities) + 0.5))
    for picture in pictures:
        row = densities.index(picture["ray_density"])
        column = coarsenings.index(picture["coarsening"])
        axis = axes[row, column]
        axis.imshow(read_picture(os.path.join(source, picture["file"])), interpolation="none")
        axis.set(xticks=[], yticks=[])
        axis.grid(False)
        for side in axis.spines.values():
            side.set_visible(False)
        share = picture["F"] / best
        axis.set_xlabel(f"{ms(picture['seconds'])} ms, F {100 * share:.1f} %, "
                        f"picture {picture['rms_difference']:.1f}", fontsize=8)
        if row == 0:
            name = "all nodes" if picture["coarsening"] == 1 else \
                f"1/{picture['coarsening']} of the nodes per axis"
            axis.set_title(name)
        if column == 0:
            axis.set_ylabel(f"ray density {picture['ray_density']:g}")
    figure.suptitle(scene["name"], fontsize=11)
    save(figure, folder, f"resolutions-{scene['name']}.png")


def plot(measured, folder, pictures):
    if pictures:
        for scene in measured["scenes"]:
            plot_resolutions(scene, pictures, folder)
