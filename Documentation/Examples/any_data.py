# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Draws data that are no image as Optimized Volume: a column per kind, without and with optimisation.

  pvpython any_data.py --plugin Limpid.so --output SHEET.jpg [--size 260]

All are made here: a bent structured grid, tetrahedra with a part cut out, a rectilinear grid with
stretched depths, blocks of hexahedra, and an AMR.
"""

import argparse
import os
import sys

from paraview import simple

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import picture_grid  # pylint: disable=wrong-import-position
import sheet  # pylint: disable=wrong-import-position

BENT = """
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
image = inputs[0].VTKObject
x, y, z = inputs[0].Points.T if hasattr(inputs[0], "Points") else np.array(
    [image.GetPoint(i) for i in range(image.GetNumberOfPoints())]).T
angle = 0.9 * x
bent = np.stack([(2 + z) * np.sin(angle), y, (2 + z) * np.cos(angle) - 2], axis=1)
points = vtkPoints()
points.SetData(numpy_to_vtk(np.ascontiguousarray(bent), deep=1))
output.VTKObject.SetDimensions(image.GetDimensions())
output.VTKObject.SetPoints(points)
output.VTKObject.GetPointData().ShallowCopy(image.GetPointData())
"""
OCEAN = """
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
n = (64, 48, 30)
x, y = np.linspace(0, 2, n[0]), np.linspace(0, 1.5, n[1])
z = -0.004 * np.expm1(np.linspace(0, np.log(200), n[2]))[::-1]  # thin layers at the surface
output.VTKObject.SetDimensions(n)
for axis, values in zip("XYZ", (x, y, z)):
    getattr(output.VTKObject, "Set" + axis + "Coordinates")(numpy_to_vtk(values, deep=1))
k, j, i = np.meshgrid(z, y, x, indexing="ij")
warm = np.exp(k / 0.15) * (0.75 + 0.25 * np.sin(5 * i) * np.cos(4 * j))
for cx, cy, cz in ((0.5, 0.5, -0.5), (1.4, 1.0, -0.35)):
    warm = np.maximum(warm, np.exp(-((i - cx) ** 2 + (j - cy) ** 2) / 0.02 - (k - cz) ** 2 / 0.02))
eddies = ((k < -0.2) & (warm > 0.4)).astype(float)
output.PointData.append(warm.ravel(), "Scalars")
output.PointData.append(eddies.ravel(), "Importance")
"""
EXTENT = "from paraview.util import SetOutputWholeExtent\nSetOutputWholeExtent(self, [0, {}, 0, {}, 0, {}])"


def sources():
    """Titles and sources, and how opaque they are over one tenth of their size."""
    head = simple.OcclusionPhantom(Resolution=64, Scene="Head")
    onion = simple.OcclusionPhantom(Resolution=65)
    cut = simple.Clip(Input=simple.Tetrahedralize(Input=onion), ClipType="Plane")
    cut.ClipType.Origin = [0, 0, 0.45]
    cut.ClipType.Normal = [0.3, 0.2, 1]
    yield "structured grid, bent", simple.ProgrammableFilter(
        Input=onion, OutputDataSetType="vtkStructuredGrid", Script=BENT,
        RequestInformationScript=EXTENT.format(64, 64, 64))
    yield "tetrahedra, cut", cut
    yield "rectilinear grid, stretched", simple.ProgrammableSource(
        OutputDataSetType="vtkRectilinearGrid", Script=OCEAN,
        ScriptRequestInformation=EXTENT.format(63, 47, 29))
    yield "blocks of hexahedra", simple.GroupDatasets(Input=[
        simple.AppendDatasets(Input=[simple.ExtractSubset(Input=head, VOI=[*along, 0, 63, 0, 63])])
        for along in ((0, 30), (30, 63))])
    yield "AMR of two levels", simple.ImageDataToAMR(Input=onion, Numberoflevels=2)


def pictures(size):
    """A title and two pictures with texts per kind of data."""
    for title, source in sources():
        source.UpdatePipeline()
        view = simple.CreateView("RenderView")
        view.ViewSize = [size, size]
        view.OrientationAxesVisibility = 0
        view.UseColorPaletteForBackground = 0
        view.Background = [1, 1, 1]
        ofCells = "Scalars" not in source.PointData.keys()
        display = simple.Show(source, view)
        display.SetRepresentationType("Optimized Volume")
        simple.ColorBy(display, ("CELLS" if ofCells else "POINTS", "Scalars"))
        display.ImportanceArray = ["CELLS" if ofCells else "POINTS", "Importance"]
        display.ScalarOpacityUnitDistance = 0.1
        display.ShowScore = 0
        display.SetScalarBarVisibility(view, False)
        view.CameraPosition = [1.5, -3.6, 1.4]
        view.CameraFocalPoint = [0, 0, 0]
        view.CameraViewUp = [0, 0, 1]
        simple.ResetCamera(view)
        view.GetActiveCamera().Zoom(1.15)
        cells = []
        for optimization in ("Off", "Continuous"):
            display.Optimization = optimization
            picture = sheet.picture_of(view)
            display.UpdatePropertyInformation()
            cells.append((picture, "{:.1f} % visible".format(100 * display.VisibleFraction)))
        print("| {} | {} | {} | {} |".format(
            title, display.SampledAt, *(text.split(" %")[0] for _, text in cells)), flush=True)
        if display.Messages:
            print(display.Messages)
        yield title, cells
        simple.Delete(view)


def main():
    """Draws the sheet."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--size", type=int, default=260)
    arguments = parser.parse_args()
    simple.LoadPlugin(os.path.abspath(arguments.plugin), remote=False, ns=vars(simple))
    columns = list(pictures(arguments.size))
    rows = [[cells[row] for _, cells in columns] for row in range(2)]
    figure = picture_grid.compose(rows, [title for title, _ in columns], ["ordinary", "optimized"])
    picture_grid.save(figure, arguments.output)


if __name__ == "__main__":
    main()
