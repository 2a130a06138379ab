# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""From where to look at a scene: scores views from all around it and draws the best and the worst.

  pvpython viewpoints.py --plugin Limpid.so --output FOLDER [--scene FILE.scene.json]
                         [--directions 642]

or, in a script, with any source of image data,

  from viewpoints import best_view, look_from
  simple.LoadPlugin("Limpid.so", remote=False, ns=vars(simple))
  look_from(view, best_view(source, ImportanceArray=["POINTS", "Importance"]))
"""

import argparse
import math
import os
import sys
import tempfile
from xml.etree import ElementTree

import numpy as np
from paraview import servermanager, simple
from paraview.modules import vtkRemotingMisc
from paraview.vtk.vtkIOXML import vtkXMLPolyDataWriter

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from hemispheres import Hemispheres  # pylint: disable=wrong-import-position
import optimize_scene  # pylint: disable=wrong-import-position
import scenes  # pylint: disable=wrong-import-position

CAMERA = ["CameraPosition", "CameraFocalPoint", "CameraViewUp", "CameraViewAngle",
          "CameraParallelProjection", "CameraParallelScale"]


def executed(search):
    search.UpdatePipeline()
    if search.FieldData["BestVisibilityScore"] is None:
        raise RuntimeError("The viewpoint search failed (there is nothing to look at). Read its "
                           "message, above.")
    return search


def viewpoints_of(search):
    """The ranked viewpoints, best first: cameras, by names of a view's properties, and scores."""
    points = servermanager.Fetch(search, idx=1)
    return [_viewpoint(points.GetFieldData(), points.GetPointData(), "", rank)
            for rank in range(points.GetNumberOfPoints())]


def worst_of(search):
    """The worst direction of the sphere, likewise."""
    fields = servermanager.Fetch(search, idx=1).GetFieldData()
    return _viewpoint(fields, fields, "Worst", 0)


def as_scored(viewpoint, worst):
    """A viewpoint's camera where it was scored, as far from the centre as that of the worst view, so
    that pictures of both compare."""
    centre = np.array(worst["CameraFocalPoint"])
    away = np.subtract(viewpoint["CameraPosition"], centre)
    distance = np.linalg.norm(worst["CameraPosition"] - centre)
    return dict(viewpoint, CameraFocalPoint=list(centre),
                CameraPosition=list(centre + distance / np.linalg.norm(away) * away))


def best_view(source, **properties):
    """The best viewpoint, likewise. Properties are those of ViewpointSearch, above all
    ImportanceArray."""
    source.UpdatePipeline()
    search = executed(simple.ViewpointSearch(Input=source, **properties))
    best = viewpoints_of(search)[0]
    simple.Delete(search)
    return best


def look_from(view, viewpoint):
    for name in CAMERA:
        setattr(view, name, viewpoint[name])
    view.CenterOfRotation = viewpoint["CameraFocalPoint"]


def _viewpoint(common, arrays, prefix, row):
    def numbers(data, name, at):
        return list(data.GetArray(name).GetTuple(at))

    return {
        "CameraPosition": numbers(arrays, prefix + "CameraPosition", row),
        "CameraFocalPoint": numbers(arrays, prefix + "CameraFocalPoint", row),
        "CameraViewUp": numbers(arrays, prefix + "CameraViewUp", row),
        "CameraViewAngle": numbers(common, "CameraViewAngle", 0)[0],
        "CameraParallelProjection": int(numbers(common, "CameraParallelProjection", 0)[0]),
        "CameraParallelScale": numbers(common, "CameraParallelScale", 0)[0],
        "VisibilityScore": numbers(arrays, prefix + "VisibilityScore", row)[0],
        "VisibleFraction": numbers(arrays, prefix + "VisibleFraction", row)[0]}


def write_polydata(search, path):
    """Inline binary: the appended mode cannot be read where ParaView 5.11 meets a recent expat."""
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(servermanager.Fetch(search))
    writer.SetDataModeToBinary()
    writer.SetFileName(path)
    writer.Write()


def write_custom_viewpoints(view, named, path):
    """A file for ParaView's Adjust Camera > Configure > Import: buttons in the camera toolbar."""
    root = ElementTree.Element("CustomViewpointsConfiguration", version="1.0")
    writer = vtkRemotingMisc.vtkSMCameraConfigurationWriter()
    writer.SetRenderViewProxy(view.SMProxy)
    with tempfile.TemporaryDirectory() as folder:
        camera = os.path.join(folder, "camera.pvcc")
        for number, (name, viewpoint) in enumerate(named):
            look_from(view, viewpoint)
            writer.WriteConfiguration(camera)
            button = ElementTree.SubElement(root, "CustomViewpointButton{}".format(number))
            ElementTree.SubElement(button, "ToolTip", value=name)
            configuration = ElementTree.SubElement(button, "Configuration", is_empty="0")
            configuration.append(ElementTree.parse(camera).getroot())
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def write_cameras(named, path):
    """The viewpoints as a Python module."""
    lines = ['"""Viewpoints of a search: look_from(GetActiveView(), "viewpoint 1")"""', "",
             "VIEWPOINTS = {"]
    for name, viewpoint in named:
        lines.append("    {!r}: {{".format(name))
        lines += ["        {!r}: {!r},".format(key, viewpoint[key]) for key in CAMERA]
        lines.append("    },")
    lines += ["}", "", "", "def look_from(view, name):",
              "    for key, value in VIEWPOINTS[name].items():",
              "        setattr(view, key, value)"]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def axes(position, focal_point, view_up):
    """Right, up and back of a camera, as columns."""
    back = np.subtract(position, focal_point)
    back = back / np.linalg.norm(back)
    right = np.cross(view_up, back)
    right /= np.linalg.norm(right)
    return np.column_stack([right, np.cross(back, right), back])


def light_for(scene, viewpoint):
    """The scene's light, carried along by the camera from the scene's own to a viewpoint."""
    scene_axes = axes(scene.position, scene.focal_point, scene.view_up)
    seen = scene_axes.T @ np.subtract(scene.light, scene.focal_point)
    new_axes = axes(*(viewpoint[name] for name in CAMERA[:3]))
    return list(viewpoint["CameraFocalPoint"] + new_axes @ seen)


def upright(viewpoint, view_up):
    """A viewpoint with another direction upwards, which scores do not depend on; as it is if it
    looks along that direction."""
    back = axes(*(viewpoint[name] for name in CAMERA[:3]))[:, 2]
    up = np.divide(view_up, np.linalg.norm(view_up))
    if abs(np.dot(back, up)) > 0.98:  # within 12 degrees
        return viewpoint
    return dict(viewpoint, CameraViewUp=list(up))


def draw_views(scene, named, output):
    """NAME-ordinary.png and NAME-optimized.png of every view; NAME is its first word."""
    view = optimize_scene.make_view(scene)
    display = optimize_scene.show(scene, view)
    for name, viewpoint in named:
        look_from(view, viewpoint)
        display.LightPosition = light_for(scene, viewpoint)
        for method in ("Ordinary", "Optimized"):
            display.Method = method
            simple.SaveScreenshot(output("{}-{}.png".format(name, method.lower())), view,
                                  ImageResolution=view.ViewSize)
    return view


def whole_angle(distance):
    """The view angle of a picture that shows the volume from every side; a distance in radii."""
    return math.degrees(2 * math.asin(1 / distance))


def search_scene(scene, directions):
    search = simple.ViewpointSearch(Input=scene.source, Field="Importance Proxy")
    search.ImportanceArray = ["POINTS", scene.importance_array]
    if scene.importance:
        search.UseImportanceFunction = 1
        search.ImportanceFunction.Points = optimize_scene.piecewise(scene.importance)
    search.ExtinctionSource = "Array"
    search.ExtinctionArray = ["POINTS", scene.extinction_array]
    search.CameraViewAngle = max(scene.view_angle, whole_angle(search.CameraDistance))
    search.NumberOfDirections = directions
    return executed(search)


def write_report(scene, named, path):
    rows = ["| {} | {:.6g} | {:.1f} % | {} |".format(
        name, view["VisibilityScore"], 100 * view["VisibleFraction"],
        ", ".join("{:.5g}".format(number) for number in view["CameraPosition"]))
        for name, view in named]
    text = """# {}: from where to look

![S-sphere](s-sphere.png)

*Both halves, z upwards, by the share of the important structures that can be seen: red is 10 %, blue 60 %,
lines are 2 % apart. White dots are the best views, the black one is the worst.*

| | ordinary | optimized |
| --- | --- | --- |
| best | ![](best-ordinary.png) | ![](best-optimized.png) |
| worst | ![](worst-ordinary.png) | ![](worst-optimized.png) |

| view | score S | visible, of what is important | camera |
| --- | --- | --- | --- |
{}

Scores are those of the importance proxy: what is important alone, as dense as the volume gets. The
light of the pictures goes with the camera. `s-sphere.vtp` has the score of every direction,
`viewpoints.pvcvbc` is for ParaView's Adjust Camera > Configure > Import, `cameras.py` for scripts.
""".format(scene.title, "\n".join(rows))
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def explore(scene, directions, folder):
    """Writes all that main writes. Returns the search and the viewpoints by their names, best first,
    the worst last."""
    os.makedirs(folder, exist_ok=True)

    def output(name):
        return os.path.join(folder, name)

    search = search_scene(scene, directions)
    worst = upright(worst_of(search), scene.view_up)
    ranked = [upright(as_scored(view, worst), scene.view_up) for view in viewpoints_of(search)]
    named = [("viewpoint {}".format(rank + 1), view) for rank, view in enumerate(ranked)]
    named.append(("worst view", worst))
    write_polydata(search, output("s-sphere.vtp"))
    Hemispheres(search).write(ranked, worst, output("s-sphere.png"))
    view = draw_views(scene, [("best", ranked[0]), ("worst", worst)], output)
    write_custom_viewpoints(view, named, output("viewpoints.pvcvbc"))
    write_cameras(named, output("cameras.py"))
    write_report(scene, named, output("viewpoints.md"))
    return search, dict(named)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--scene")
    parser.add_argument("--directions", type=int, default=642)
    arguments = parser.parse_args()
    simple.LoadPlugin(os.path.abspath(arguments.plugin), remote=False, ns=vars(simple))

    if arguments.scene:
        scene = scenes.read_scene(simple, arguments.scene)
    else:
        scene = scenes.phantom_scene(simple)
    scene.source.UpdatePipeline()
    search, named = explore(scene, arguments.directions, arguments.output)
    fields = search.FieldData
    print("{}:".format(scene.title))
    for text, name in (("best", "viewpoint 1"), ("worst", "worst view")):
        print("  {} view: S {:.6g}, {:.1f} % of the important structures is visible".format(
            text, named[name]["VisibilityScore"], 100 * named[name]["VisibleFraction"]))
    print("  {:.0f} evaluations in {:.2f} s".format(
        fields["Evaluations"].GetRange()[0], fields["Seconds"].GetRange()[0]))
    print("  written to {}".format(arguments.output))


if __name__ == "__main__":
    main()
