# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Draws scenes with several values of a property of Optimized Volume: a row per scene.

  pvpython parameter_sheet.py --plugin Limpid.so --property NAME --values A B ... --output SHEET.png
    [--default-opacity] [FILE.scene.json ...]

Without scenes: the embedded phantom. With --default-opacity, opacities are ParaView's default: a
straight line from 0 to 1 over the range of the data, on a cell's length. Above each picture, the
shares of the important structures that are visible and removed.
"""

import os
import sys

from paraview import simple

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import optimize_scene  # pylint: disable=wrong-import-position
import sheet  # pylint: disable=wrong-import-position

SIZE = 2.6  # of a picture [inches]


def number_or_name(argument):
    try:
        return float(argument)
    except ValueError:
        return argument


def text(value):
    return value if isinstance(value, str) else "{:g}".format(value)


def take_default_opacity(scene, display):
    image = scene.source.GetClientSideObject().GetOutputDataObject(0)
    low, high = scene.source.PointData[scene.array].GetRange()
    simple.GetOpacityTransferFunction(scene.array).Points = optimize_scene.piecewise(
        [[low, 0], [high, 1]])
    display.ScalarOpacityUnitDistance = image.GetLength() / image.GetNumberOfCells() ** (1 / 3)


def pictures(scene, name, values, default_opacity):
    """Titles and pictures, one for every value; prints the display's numbers: S, and the shares of
    what is important that are visible before and after, and removed, in percent."""
    view = optimize_scene.make_view(scene)
    display = optimize_scene.show(scene, view)
    if default_opacity:
        take_default_opacity(scene, display)
    if name not in display.ListProperties():
        raise SystemExit("A display has no property {} (there is nothing to vary). There are: {}."
                         .format(name, ", ".join(display.ListProperties())))
    for value in values:
        setattr(display, name, value)
        picture = sheet.picture_of(view)
        display.UpdatePropertyInformation()
        visible = 100 * display.VisibleFraction
        removed = 100 * display.SacrificedFraction
        print("| {} | {} | {:.5g} | {:.1f} | {:.1f} | {:.1f} |".format(
            scene.title, text(value), display.VisibilityScore, 100 * display.BaseVisibleFraction,
            visible, removed), flush=True)
        yield ("{} {}: {:.1f} % visible, {:.1f} % removed".format(
            name, text(value), visible, removed), picture)
    simple.Delete(view)


def main():
    parser = sheet.parser()
    parser.add_argument("--property", required=True)
    parser.add_argument("--values", required=True, nargs="+", type=number_or_name)
    parser.add_argument("--default-opacity", action="store_true")
    arguments = parser.parse_args()
    sheet.draw(arguments, len(arguments.values), SIZE,
               lambda scene: pictures(scene, arguments.property, arguments.values,
                                      arguments.default_opacity))


if __name__ == "__main__":
    main()
