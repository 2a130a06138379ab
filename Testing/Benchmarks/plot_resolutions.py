# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Puts the pictures of limpid_bench_resolutions, which lie beside its JSON file, on one sheet.

  python3 Testing/Benchmarks/plot_resolutions.py Resolutions.json --output FOLDER

Needs matplotlib (Debian: python3-matplotlib).
"""

import argparse
import json
import math
import os

import numpy as np

from plot_style import pyplot, save, set_style


def milliseconds(seconds):
    """Three digits, never in powers of ten."""
    return f"{1e3 * seconds:.{max(0, 2 - math.floor(math.log10(1e3 * seconds)))}f}"


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
        axis.set_xticks([])
        axis.set_yticks([])
        axis.grid(False)
        for side in axis.spines.values():
            side.set_visible(False)
        share = picture["F"] / best
        axis.set_xlabel(f"{milliseconds(picture['seconds'])} ms, F {100 * share:.1f} %, "
                        f"picture {picture['rms_difference']:.1f}", fontsize=8)
        if row == 0:
            name = "all nodes" if picture["coarsening"] == 1 else \
                f"1/{picture['coarsening']} of the nodes per axis"
            axis.set_title(name)
        if column == 0:
            axis.set_ylabel(f"ray density {picture['ray_density']:g}")
    figure.suptitle(scene["name"], fontsize=11)
    save(figure, folder, f"resolutions-{scene['name']}.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("resolutions", help="JSON of limpid_bench_resolutions")
    parser.add_argument("--output", required=True, help="folder of the pictures")
    options = parser.parse_args()
    with open(options.resolutions, encoding="utf-8") as file:
        measured = json.load(file)
    os.makedirs(options.output, exist_ok=True)
    set_style()
    for scene in measured["scenes"]:
        plot_resolutions(scene, os.path.dirname(options.resolutions), options.output)


if __name__ == "__main__":
    main()
