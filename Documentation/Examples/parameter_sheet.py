# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Draws scenes with several values of a property of Optimized Volume: a row per scene.

  pvpython parameter_sheet.py --plugin Limpid.so --property NAME --values A B ... --output SHEET.png
    [FILE.scene.json ...]

Without scenes: the embedded phantom. Above each picture, the shares of what is important that are
visible and removed.
"""

import argparse
import os
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot  # pylint: disable=wrong-import-position
from paraview import simple  # pylint: disable=wrong-import-position

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import optimize_scene  # pylint: disable=wrong-import-position
import scenes  # pylint: disable=wrong-import-position

SIZE = 2.6  # of a picture [inches]
DOTS = 130  # per inch


def pictures(scene, name, values):
    """A picture for every value, and the display that made it; prints its numbers: S, and the shares
    of what is important that are visible before and after, and removed, in percent."""
    view = optimize_scene.make_view(scene)
    display = optimize_scene.show(scene, view)
    if name not in display.ListProperties():
        raise SystemExit("A display has no property {} (there is nothing to vary). There are: {}."
                         .format(name, ", ".join(display.ListProperties())))
    with tempfile.TemporaryDirectory() as folder:
        for value in values:
            path = os.path.join(folder, "picture.png")
            setattr(display, name, value)
            simple.SaveScreenshot(path, view, ImageResolution=view.ViewSize)
            display.UpdatePropertyInformation()
            print("| {} | {:g} | {:.5g} | {:.1f} | {:.1f} | {:.1f} |".format(
                scene.title, value, display.VisibilityScore, 100 * display.BaseVisibleFraction,
                100 * display.VisibleFraction, 100 * display.SacrificedFraction), flush=True)
            yield pyplot.imread(path), display
    simple.Delete(view)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--property", required=True)
    parser.add_argument("--values", required=True, nargs="+", type=float)
    parser.add_argument("--output", required=True)
    parser.add_argument("scenes", nargs="*")
    arguments = parser.parse_args()
    simple.LoadPlugin(arguments.plugin, remote=False, ns=vars(simple))

    rows = [scenes.read_scene(simple, path) for path in arguments.scenes]
    rows = rows or [scenes.phantom_scene(simple)]
    across = len(arguments.values)
    figure, axes = pyplot.subplots(len(rows), across, squeeze=False, facecolor="white",
                                   figsize=(SIZE * across, (SIZE + 0.35) * len(rows)))
    for scene, row in zip(rows, axes):
        scene.source.UpdatePipeline()
        shown = pictures(scene, arguments.property, arguments.values)
        for axis, value, (picture, display) in zip(row, arguments.values, shown):
            axis.set_axis_off()
            axis.imshow(picture)
            title = "{}\n".format(scene.title) if axis is row[0] else "\n"
            axis.set_title("{}{} {:g}: {:.1f} % visible, {:.1f} % removed".format(
                title, arguments.property, value, 100 * display.VisibleFraction,
                100 * display.SacrificedFraction), fontsize=6, pad=3, loc="left")
        simple.Delete(scene.source)
    figure.tight_layout(pad=0.4)
    figure.savefig(arguments.output, dpi=DOTS)


if __name__ == "__main__":
    main()
