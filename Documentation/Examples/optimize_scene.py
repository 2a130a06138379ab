# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Optimises a scene and draws it before and after, with ParaView's stock volume rendering.

  pvpython optimize_scene.py --plugin Limpid.so --output FOLDER [--scene FILE.scene.json]
"""

import argparse
import csv
import os
import sys

from paraview import simple
from paraview.vtk.vtkIOXML import vtkXMLImageDataWriter

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import scenes  # pylint: disable=wrong-import-position


COLORED = "Colored"


def optimize(scene):
    """The filter, set up for the scene and executed."""
    optimizer = simple.ExtinctionOptimizer(Input=scene.source)
    optimizer.ImportanceArray = ["POINTS", scene.importance_array]
    if scene.importance:
        optimizer.UseImportanceFunction = 1
        optimizer.ImportanceFunction.Points = [
            number for value, importance in scene.importance
            for number in (value, importance, 0.5, 0.0)]
    optimizer.ExtinctionSource = "Array"
    optimizer.ExtinctionArray = ["POINTS", scene.extinction_array]
    optimizer.CameraPosition = scene.position
    optimizer.CameraFocalPoint = scene.focal_point
    optimizer.CameraViewUp = scene.view_up
    optimizer.CameraViewAngle = scene.view_angle
    optimizer.LightPosition = scene.light
    optimizer.UpdatePipeline()
    if optimizer.PointData["Extinction"] is None:
        raise SystemExit("The optimisation failed; its message is above.")
    return optimizer


def results(optimizer):
    """The field data with one number each, by name."""
    fields = optimizer.FieldData
    return {name: fields[name].GetRange()[0]
            for name in ("VisibilityScore", "BaseVisibilityScore", "VisibleFraction",
                         "BaseVisibleFraction", "Energy", "Iterations", "Seconds",
                         "ScalarOpacityUnitDistance")}


def make_view(scene):
    view = simple.CreateView("RenderView")
    view.ViewSize = [600, 600]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0.08, 0.08, 0.1]
    view.CameraPosition = scene.position
    view.CameraFocalPoint = scene.focal_point
    view.CameraViewUp = scene.view_up
    view.CameraViewAngle = scene.view_angle
    return view


def set_unit_distance_of_opacity_array(view, unit_distance):
    """ParaView 5.11 gives its unit distance to the first component of what it draws, but with a
    separate opacity array VTK asks for that of the second, which stays 1."""
    view.Update()
    volumes = view.GetRenderer().GetVolumes()
    for i in range(volumes.GetNumberOfItems()):
        volumes.GetItemAsObject(i).GetProperty().SetScalarOpacityUnitDistance(1, unit_distance)


def draw(scene, source, unit_distance, view, path):
    """Colors by the scalar field, opacity by the array Opacity, which holds for unit_distance."""
    # A copy in floating point: ParaView 5.11 makes opacities of the type of the colored array.
    colored = simple.Calculator(Input=source, ResultArrayName=COLORED, ResultArrayType="Float",
                                Function='"{}"'.format(scene.array))
    colored.UpdatePipeline()
    colors = simple.GetColorTransferFunction(COLORED)
    colors.ColorSpace = "RGB"
    colors.RGBPoints = [number for node in scene.colors for number in node]
    identity = simple.CreatePiecewiseFunction(Points=[0, 0, 0.5, 0, 1, 1, 0.5, 0])

    display = simple.Show(colored, view)
    simple.ColorBy(display, ("POINTS", COLORED))
    display.SetRepresentationType("Volume")
    display.LookupTable = colors
    display.UseSeparateOpacityArray = 1
    display.OpacityArrayName = ["POINTS", "Opacity"]
    display.ScalarOpacityFunction = identity
    display.ScalarOpacityUnitDistance = unit_distance
    display.SetScalarBarVisibility(view, False)
    set_unit_distance_of_opacity_array(view, unit_distance)
    simple.SaveScreenshot(path, view, ImageResolution=view.ViewSize)
    simple.Hide(colored, view)


def write_image(scene, optimizer, path):
    """Inline binary: the appended mode cannot be read where ParaView 5.11 meets a recent expat."""
    kept = simple.PassArrays(Input=optimizer)
    kept.PointDataArrays = [scene.array, "BaseExtinction", "Extinction", "Importance"]
    kept.FieldDataArrays = optimizer.FieldData.keys()
    kept.UpdatePipeline()
    writer = vtkXMLImageDataWriter()
    writer.SetInputData(simple.servermanager.Fetch(kept))
    writer.SetDataModeToBinary()
    writer.SetCompressionLevel(1)
    writer.SetFileName(path)
    writer.Write()


def write_table(optimizer, path):
    table = simple.servermanager.Fetch(optimizer, idx=1)
    columns = range(table.GetNumberOfColumns())
    with open(path, "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file)
        rows.writerow([table.GetColumnName(column) for column in columns])
        for row in range(table.GetNumberOfRows()):
            rows.writerow([table.GetValue(row, column).ToString() for column in columns])


def write_report(scene, numbers, backend, path):
    text = """# {title}

| before | after |
| --- | --- |
| ![before](before.png) | ![after](after.png) |

Becomes visible: {becomes_visible}

| | before | after |
| --- | --- | --- |
| visibility score S | {BaseVisibilityScore:.6g} | {VisibilityScore:.6g} |
| visible share of what is important | {base:.1f} % | {best:.1f} % |

{Iterations:.0f} iterations in {Seconds:.2f} s on {backend}.

`result.vti` has the arrays, `convergence.csv` a row per iteration. The pictures are drawn by
ParaView's stock volume rendering with a separate opacity array, unit distance
{ScalarOpacityUnitDistance:.6g}.
""".format(title=scene.title, becomes_visible=scene.becomes_visible, backend=backend,
           base=100 * numbers["BaseVisibleFraction"], best=100 * numbers["VisibleFraction"],
           **numbers)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--scene")
    arguments = parser.parse_args()
    simple.LoadPlugin(arguments.plugin, remote=False, ns=vars(simple))
    os.makedirs(arguments.output, exist_ok=True)

    def output(name):
        return os.path.join(arguments.output, name)

    if arguments.scene:
        scene = scenes.read_scene(simple, arguments.scene)
    else:
        scene = scenes.phantom_scene(simple)
    scene.source.UpdatePipeline()
    optimizer = optimize(scene)
    numbers = results(optimizer)
    image = optimizer.GetClientSideObject().GetOutputDataObject(0)
    backend = image.GetFieldData().GetAbstractArray("Backend").GetValue(0)
    print("{}: S {:.6g} before, {:.6g} after ({:+.1f} %)".format(
        scene.title, numbers["BaseVisibilityScore"], numbers["VisibilityScore"],
        100 * (numbers["VisibilityScore"] / numbers["BaseVisibilityScore"] - 1)))
    print("  visible share of what is important: {:.1f} % before, {:.1f} % after".format(
        100 * numbers["BaseVisibleFraction"], 100 * numbers["VisibleFraction"]))
    print("  {:.0f} iterations in {:.2f} s on {}".format(
        numbers["Iterations"], numbers["Seconds"], backend))

    distance = numbers["ScalarOpacityUnitDistance"]
    view = make_view(scene)
    before = simple.Calculator(Input=optimizer, ResultArrayName="Opacity",
                               Function="1-exp(-BaseExtinction*{!r})".format(distance))
    draw(scene, before, distance, view, output("before.png"))
    draw(scene, optimizer, distance, view, output("after.png"))
    write_image(scene, optimizer, output("result.vti"))
    write_table(optimizer, output("convergence.csv"))
    write_report(scene, numbers, backend, output("report.md"))
    print("  written to {}".format(arguments.output))


if __name__ == "__main__":
    main()
