# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Optimises a scene and draws it before and after, and as the paper would have it, as the
representation Optimized Volume does.

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


def flat(nodes):
    return [number for node in nodes for number in node]


def piecewise(nodes):
    """[value, y] as points of ParaView's functions."""
    return flat([value, y, 0.5, 0.0] for value, y in nodes)


def optimizer_of(scene):
    """The filter, set up for the scene; not executed."""
    optimizer = simple.ExtinctionOptimizer(Input=scene.source)
    optimizer.ImportanceArray = ["POINTS", scene.importance_array]
    if scene.importance:
        optimizer.UseImportanceFunction = 1
        optimizer.ImportanceFunction.Points = piecewise(scene.importance)
    optimizer.ExtinctionSource = "Array"
    optimizer.ExtinctionArray = ["POINTS", scene.extinction_array]
    optimizer.CameraPosition = scene.position
    optimizer.CameraFocalPoint = scene.focal_point
    optimizer.CameraViewUp = scene.view_up
    optimizer.CameraViewAngle = scene.view_angle
    optimizer.LightPosition = scene.light
    return optimizer


def optimize(scene):
    """The filter with its defaults, which are the display's, executed."""
    optimizer = optimizer_of(scene)
    optimizer.UpdatePipeline()
    if optimizer.PointData["Extinction"] is None:
        raise SystemExit("The optimisation failed; its message is above.")
    return optimizer


def results(optimizer):
    """The field data with one number each, by name."""
    fields = optimizer.FieldData
    return {name: fields[name].GetRange()[0]
            for name in ("VisibilityScore", "BaseVisibilityScore", "VisibleFraction",
                         "BaseVisibleFraction", "SacrificedFraction", "Energy", "Iterations",
                         "Seconds")}


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


def show(scene, view):
    """The scene's display: an optimized volume, lit by the scene's light."""
    display = simple.Show(scene.source, view)
    simple.ColorBy(display, ("POINTS", scene.array))
    colors = simple.GetColorTransferFunction(scene.array)
    colors.ColorSpace = "RGB"
    colors.RGBPoints = flat(scene.colors)
    simple.GetOpacityTransferFunction(scene.array).Points = piecewise(scene.opacity())
    display.ScalarOpacityUnitDistance = scene.unit_distance()
    display.SetScalarBarVisibility(view, False)
    display.ImportanceArray = ["POINTS", scene.importance_array]
    if scene.importance:
        display.UseImportanceFunction = 1
        display.ImportanceFunction.Points = piecewise(scene.importance)
    display.LightSource = "Own"
    display.LightPosition = scene.light
    display.ShowScore = 0
    display.SetRepresentationType("Optimized Volume")
    return display


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


def draw(display, view, path):
    """Draws the view. Returns the display's numbers in the picture."""
    simple.SaveScreenshot(path, view, ImageResolution=view.ViewSize)
    display.UpdatePropertyInformation()
    return {"paper_score": display.VisibilityScore, "paper": 100 * display.VisibleFraction,
            "paper_removed": 100 * display.SacrificedFraction}


def write_report(scene, numbers, backend, path):
    text = """# {title}

| before | as in the paper | after |
| --- | --- | --- |
| ![before](before.png) | ![paper](paper.png) | ![after](after.png) |

Becomes visible: {becomes_visible}

| | before | as in the paper | after |
| --- | --- | --- | --- |
| visibility score S | {BaseVisibilityScore:.6g} | {paper_score:.6g} | {VisibilityScore:.6g} |
| visible share of the important structures | {base:.1f} % | {paper:.1f} % | {best:.1f} % |
| removed share of the important structures | 0 % | {paper_removed:.1f} % | {removed:.1f} % |

{Iterations:.0f} iterations in {Seconds:.2f} s on {backend}.

`result.vti` has the arrays, `convergence.csv` a row per iteration. The pictures are drawn by the
representation Optimized Volume under the scene's light: before with the method Ordinary, the others
with Optimized and the presets Paper and Default.
""".format(title=scene.title, becomes_visible=scene.becomes_visible, backend=backend,
           base=100 * numbers["BaseVisibleFraction"], best=100 * numbers["VisibleFraction"],
           removed=100 * numbers["SacrificedFraction"], **numbers)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--scene")
    arguments = parser.parse_args()
    simple.LoadPlugin(os.path.abspath(arguments.plugin), remote=False, ns=vars(simple))
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
    print("  visible share of the important structures: {:.1f} % before, {:.1f} % after, {:.1f} % "
          "removed".format(100 * numbers["BaseVisibleFraction"], 100 * numbers["VisibleFraction"],
                           100 * numbers["SacrificedFraction"]))
    print("  {:.0f} iterations in {:.2f} s on {}".format(
        numbers["Iterations"], numbers["Seconds"], backend))

    view = make_view(scene)
    display = show(scene, view)
    draw(display, view, output("after.png"))
    display.Preset = "Paper"
    numbers.update(draw(display, view, output("paper.png")))
    display.Method = "Ordinary"
    draw(display, view, output("before.png"))
    write_image(scene, optimizer, output("result.vti"))
    write_table(optimizer, output("convergence.csv"))
    write_report(scene, numbers, backend, output("report.md"))
    print("  written to {}".format(arguments.output))


if __name__ == "__main__":
    main()
