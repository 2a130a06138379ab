# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Puts the S-spheres of several demo folders on one sheet, each with its best and its worst view.

  python3 sphere_sheet.py SHEET.png FOLDER...
"""

import json
import os
import re
import sys

import picture_grid
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from picture_grid import pyplot

COLORS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Plugin", "Presets",
                      "LimpidViewpointScore.json")
VISIBLE = 10, 60  # of hemispheres.py [per cent]

ACROSS = 2  # scenes in a row
HEAD = re.compile(r"^# (.*): from where to look$", re.MULTILINE)
SHARE = r"^\| {} \| [^|]* \| ([^|]*) \|"
SIZE = [5.5, 2.6]  # of a scene [inches]
LEGEND = 0.7  # [inches]
DOTS = 130  # per inch


def share(report, view):
    return re.search(SHARE.format(view), report, re.MULTILINE).group(1)


def show(figure, place, folder, name, label):
    axis = figure.add_subplot(place)
    axis.set_axis_off()
    axis.imshow(pyplot.imread(os.path.join(folder, name)))
    axis.set_title(label, fontsize=9, pad=3)


def explain(figure, place):
    """What colors and dots mean."""
    with open(COLORS, encoding="utf-8") as file:
        points = json.load(file)[0]["RGBPoints"]
    least, most = VISIBLE
    nodes = [((least * (most / least) ** points[at] - least) / (most - least),
              points[at + 1:at + 4]) for at in range(0, len(points), 4)]
    colors = ScalarMappable(Normalize(*VISIBLE),
                            LinearSegmentedColormap.from_list("visible", nodes))
    bar = figure.colorbar(colors, cax=figure.add_axes(place), orientation="horizontal")
    bar.set_label("of the important structures can be seen [%]; white: best views, black: worst",
                  fontsize=9)
    bar.ax.tick_params(labelsize=8)


def sheet_of(folders):
    """A figure."""
    across = min(len(folders), ACROSS)
    down = (len(folders) + across - 1) // across
    height = SIZE[1] * down + LEGEND
    figure = pyplot.figure(figsize=(SIZE[0] * across, height), facecolor="white")
    blocks = figure.add_gridspec(down, across, wspace=0.04, hspace=0.12, left=0.01, right=0.99,
                                 bottom=LEGEND / height, top=1 - 0.25 / height)
    explain(figure, [0.3, 0.7 * LEGEND / height, 0.4, 0.15 / height])
    for number, folder in enumerate(folders):
        with open(os.path.join(folder, "viewpoints.md"), encoding="utf-8") as file:
            report = file.read()
        block = blocks[number // across, number % across].subgridspec(
            2, 2, width_ratios=[3.7, 1], wspace=0.01, hspace=0.18)
        show(figure, block[:, 0], folder, "s-sphere.png", HEAD.search(report).group(1))
        show(figure, block[0, 1], folder, "best-optimized.png",
             "best: {} visible".format(share(report, "viewpoint 1")))
        show(figure, block[1, 1], folder, "worst-optimized.png",
             "worst: {} visible".format(share(report, "worst view")))
    figure.set_dpi(DOTS)
    return figure


def main(sheet, folders):
    if not folders:
        raise SystemExit("No folders are given (there is nothing to show). "
                         "Use: sphere_sheet.py SHEET.png FOLDER...")
    picture_grid.save(sheet_of(folders), sheet)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
