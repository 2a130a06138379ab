# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Draws scenes with their own opacity and with the one that ParaView begins with, which is opaque:
a row per scene.

  pvpython opaque_sheet.py --plugin Limpid.so --output SHEET.png [FILE.scene.json ...]

Ordinary and optimised; above each picture the share of the important structures that is visible, and how
much could be at most. Without scenes: the embedded phantom.
"""

import os
import sys

from paraview import simple

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import optimize_scene  # pylint: disable=wrong-import-position
import sheet  # pylint: disable=wrong-import-position

SIZE = 1.9  # of a picture [inches]


def take_default_opacity(scene, display):
    """A ramp of opacity over the range of the data and over one cell."""
    scalars = scene.source.PointData[scene.array]
    low, high = scalars.GetRange()
    opacity = simple.GetOpacityTransferFunction(scene.array)
    opacity.Points = optimize_scene.piecewise([[low, 0], [high, 1]])
    spacing = scene.source.GetClientSideObject().GetOutputDataObject(0).GetSpacing()
    display.ScalarOpacityUnitDistance = (spacing[0] * spacing[1] * spacing[2]) ** (1 / 3)


def pictures(scene):
    """Titles and pictures; prints S, and the shares that are visible, and at most, in percent."""
    view = optimize_scene.make_view(scene)
    display = optimize_scene.show(scene, view)
    for opacity in ("own opacity", "default opacity"):
        if opacity == "default opacity":
            take_default_opacity(scene, display)
        for method in ("Ordinary", "Optimized"):
            display.Method = method
            picture = sheet.picture_of(view)
            display.UpdatePropertyInformation()
            visible = 100 * display.VisibleFraction
            most = 100 * display.AttainableFraction
            print("| {} | {}, {} | {:.5g} | {:.1f} | {:.1f} |".format(
                scene.title, opacity, method, display.VisibilityScore, visible, most), flush=True)
            at_most = " of at most {:.1f}".format(most) if most > 0 else ""
            yield ("{}, {}: {:.1f}{} % visible".format(
                opacity, method.lower(), visible, at_most), picture)
    simple.Delete(view)


if __name__ == "__main__":
    sheet.draw(sheet.parser().parse_args(), 4, SIZE, pictures)
