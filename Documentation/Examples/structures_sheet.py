# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Draws organs of an abdomen: as it is, cleared, and with targets.

  pvpython structures_sheet.py --plugin Limpid.so --output SHEET.png IMAGE.vti LABELS.vti

LABELS are numbered as TotalSegmentator does. Prints a row per picture and organ: the shares of it that are
visible, and at most, in percent, and the target.
"""

import argparse
import os
import sys

from paraview import simple

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import sheet  # pylint: disable=wrong-import-position
import structures  # pylint: disable=wrong-import-position
from picture_grid import pyplot  # pylint: disable=wrong-import-position

SIZE = [620, 270]  # of a picture [pixels]
ZOOM = 2.25
ORGANS = ["2:right kidney:1", "3:left kidney:1", "4:gallbladder:1", "52:aorta:1",
          "64:portal vein:1", "7:pancreas:1"]
TARGETS = {"gallbladder": 0.3, "pancreas": 0.6}


def pictures(view, display):
    """Titles and pictures."""
    aimed = [organ + ":{}".format(TARGETS.get(organ.split(":")[1], "")) for organ in ORGANS]
    for name, method, tint, organs in (
            ("As it is", "Ordinary", 0, ORGANS),
            ("Six organs important", "Optimized", 0.5, ORGANS),
            ("With two targets", "Optimized", 0.5, aimed)):
        display.Method = method
        display.StructureColors = tint
        display.Structures = structures.rows_of(organs)
        picture = sheet.picture_of(view)
        display.MeasureStructures()
        display.UpdatePropertyInformation()
        shares = list(display.StructureShares)
        title = "{}: {:.1f} % visible".format(name, 100 * display.VisibleFraction)
        for organ, visible, most in zip(organs, shares[0::4], shares[3::4]):
            _, organ, _, target = (organ + ":").split(":")[:4]
            print("| {} | {} | {:.1f} | {:.1f} | {} |".format(
                name, organ, 100 * visible, 100 * most, target), flush=True)
            if organ in TARGETS:
                title += ", {} {:.0f} %".format(organ, 100 * visible)
        yield title, picture


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("files", nargs=2)
    arguments = parser.parse_args()
    simple.LoadPlugin(os.path.abspath(arguments.plugin), remote=False, ns=vars(structures))
    view, display = structures.show(
        *structures.read(*arguments.files), structures.rows_of(ORGANS), SIZE, ZOOM)
    simple.LoadPalette("WhiteBackground")
    figure, axes = pyplot.subplots(1, 3, facecolor="white", figsize=(10.8, 1.9))
    for axis, (title, picture) in zip(axes, pictures(view, display)):
        axis.set_axis_off()
        axis.imshow(picture)
        axis.set_title(title, pad=3, loc="left", fontsize=6)
    figure.tight_layout(pad=0.4)
    figure.savefig(arguments.output, dpi=1.5 * sheet.DOTS)


if __name__ == "__main__":
    main()
