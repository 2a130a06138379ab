# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""A picture of some structures of a segmentation, and what is seen of each.

  pvpython structures.py PLUGIN IMAGE.vti LABELS.vti PICTURE.png LABEL:NAME:IMPORTANCE[:TARGET] …

Both images have the same points. Prints a row per structure: shares of it that are visible, without
Limpid and with it, of at most how much from there, and what was removed of it. A target is the
share of it that should be visible, such as 0.9.
"""

import os
import sys

from paraview.simple import *

OPACITIES = [-1000, 0, -200, 0, 50, 0.35, 300, 0.6, 1500, 0.95]  # of a CT in Hounsfield units
COLORS = [-1000, 0, 0, 0, -100, 0.8, 0.6, 0.3, 60, 0.8, 0.3, 0.25, 300, 1, 0.9, 0.8, 1500, 1, 1, 1]
UNIT_DISTANCE = 6.0


def read(image, labels):
    """Both files as one image, and the names of its values and labels."""
    image, labels = (XMLImageDataReader(FileName=[file]) for file in (image, labels))
    both = AppendAttributes(Input=[image, labels])
    both.UpdatePipeline()
    return both, image.PointData.keys()[0], labels.PointData.keys()[0]


def rows_of(structures):
    """Texts for the property Structures, from LABEL:NAME:IMPORTANCE[:TARGET]."""
    return [text for structure in structures for text in (structure + ":").split(":")[:4]]


def show(both, scalars, labels, rows, size, zoom=1.0):
    """View and display of an image with labels, seen from one side."""
    view = CreateView("RenderView")
    view.ViewSize = size
    view.OrientationAxesVisibility = 0
    display = Show(both, view)
    ColorBy(display, ("POINTS", scalars))
    display.SetScalarBarVisibility(view, False)
    GetColorTransferFunction(scalars).RGBPoints = COLORS
    GetOpacityTransferFunction(scalars).Points = [
        number for value, share in zip(OPACITIES[::2], OPACITIES[1::2])
        for number in (value, share, 0.5, 0)]
    display.SetRepresentationType("Optimized Volume")
    display.ScalarOpacityUnitDistance = UNIT_DISTANCE
    display.StructureArray = ["POINTS", labels]
    display.Structures = rows
    ResetCamera(view)
    view.CameraPosition = [view.CameraFocalPoint[0], view.CameraFocalPoint[1] - 900,
                           view.CameraFocalPoint[2] + 200]
    view.CameraViewUp = [0, 0, 1]
    ResetCamera(view)
    view.GetActiveCamera().Zoom(zoom)
    return view, display


def main(plugin, image, labels, picture, *structures):
    LoadPlugin(os.path.abspath(plugin), remote=False, ns=globals())
    both, scalars, labels = read(image, labels)
    rows = rows_of(structures)
    view, display = show(both, scalars, labels, rows, [640, 480])
    display.StructureColors = 0.5
    SaveScreenshot(picture, view)
    if display.Messages:
        print(display.Messages)

    optimizer = ExtinctionOptimizer(Input=both, ScalarArray=["POINTS", scalars])
    optimizer.ScalarOpacityFunction = GetOpacityTransferFunction(scalars)
    optimizer.ScalarOpacityUnitDistance = UNIT_DISTANCE
    optimizer.StructureArray = ["POINTS", labels]
    optimizer.Structures = rows
    optimizer.CameraPosition = list(view.CameraPosition)
    optimizer.CameraFocalPoint = list(view.CameraFocalPoint)
    optimizer.CameraViewUp = list(view.CameraViewUp)
    optimizer.UpdatePipeline()
    table = optimizer.GetClientSideObject().GetOutputDataObject(2)
    print("structure  before  visible  at most  removed")
    for row in range(table.GetNumberOfRows()):
        before, visible, most, removed = (
            100 * table.GetColumnByName(name).GetTuple1(row)
            for name in ("BaseVisible", "Visible", "Attainable", "Removed"))
        print(f"{table.GetColumnByName('Name').GetValue(row)}  {before:.1f} %  {visible:.1f} %  "
              f"{most:.1f} %  {removed:.1f} %")


if __name__ == "__main__":
    main(*sys.argv[1:])
