# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Puts the S-spheres of several demo folders on one sheet, each with its best and its worst view.

  python3 sphere_sheet.py SHEET.png FOLDER...
"""

import os
import re
import sys

import picture_grid
from picture_grid import pyplot

ACROSS = 2  # scenes in a row
HEAD = re.compile(r"^# (.*): from where to look$", re.MULTILINE)
SHARE = r"^\| {} \| [^|]* \| ([^|]*) \|"
SIZE = [5.5, 2.6]  # of a scene [inches]
DOTS = 130  # per inch


def share(report, view):
    return re.search(SHARE.format(view), report, re.MULTILINE).group(1)


def show(figure, place, folder, name, label):
    axis = figure.add_subplot(place)
    axis.set_axis_off()
    axis.imshow(pyplot.imread(os.path.join(folder, name)))
    axis.set_title(label, fontsize=7, pad=3)


def sheet_of(folders):
    """A figure."""
    across = min(len(folders), ACROSS)
    down = (len(folders) + across - 1) // across
    figure = pyplot.figure(figsize=(SIZE[0] * across, SIZE[1] * down), facecolor="white")
    blocks = figure.add_gridspec(down, across, wspace=0.04, hspace=0.12, left=0.01, right=0.99,
                                 bottom=0.01, top=1 - 0.25 / (SIZE[1] * down))
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
