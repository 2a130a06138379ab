# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What the figures share: scenes, cameras, pictures with their numbers, and the command line."""

import argparse
import dataclasses
import importlib
import json
import math
import os
import sys
import textwrap
import time

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from paraview.vtk.vtkCommonDataModel import vtkImageData

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", "..", ".."))
sys.path += [os.path.join(HERE, ".."), os.path.join(ROOT, "Testing", "Benchmarks", "pages")]

import machine  # pylint: disable=wrong-import-position
from markdown import significant  # pylint: disable=wrong-import-position
import optimize_scene  # pylint: disable=wrong-import-position
import picture_grid  # pylint: disable=wrong-import-position
import scenes  # pylint: disable=wrong-import-position
import sheet  # pylint: disable=wrong-import-position
import viewpoints  # pylint: disable=wrong-import-position

SCENES = ("visible_male", "engine", "carotid_mra", "isabel_wind", "vortex_rings", "thorax_ct",
          "skull_phantom")  # of shared/data
VIEWS = ("own", "right", "opposite", "left", "top", "bottom")
NUMBERS = ("VisibilityScore", "BaseVisibilityScore", "VisibleFraction", "BaseVisibleFraction",
           "SacrificedFraction")
FINER = 2  # pixels drawn per pixel shown, along both axes
IDLE = 0.5  # load average above which a caption says that times contain other work


@dataclasses.dataclass
class Run:
    """What figures are made of, how large and where to."""
    output: str
    files: dict  # scene files that are there, by names
    scale: float = 1  # of the pictures' size
    quick: bool = False  # a small phantom, few directions, few frames

    def pixels(self, across):
        return max(16, round(self.scale * across))

    def path(self, name):
        return os.path.join(self.output, name)

    def scenes(self, names=("phantom",) + SCENES):
        """Those of the scenes that are there, one after the other: each is gone at the next."""
        for name in names:
            if name == "phantom":
                scene = scenes.phantom_scene(simple, 24 if self.quick else 128)
            elif name in self.files:
                scene = scenes.read_scene(simple, self.files[name])
            else:
                continue
            scene.source.UpdatePipeline()
            yield scene
            simple.Delete(scene.source)

    def save(self, figure, name):
        """Returns name and size, for the numbers; says if it is too large."""
        size = picture_grid.save(figure, self.path(name))
        if size > picture_grid.LIMIT:
            print("{} has {} kB, more than {} kB (a repository keeps every version of a picture). "
                  "Show fewer or smaller pictures.".format(
                      name, size // 1000, picture_grid.LIMIT // 1000))
        return {"file": name, "bytes": size}


def image_of(source):
    return source.GetClientSideObject().GetOutputDataObject(0)


def copied(image, **arrays):
    """An image with these point arrays on the nodes of another."""
    result = vtkImageData()
    result.CopyStructure(image)
    for name, values in arrays.items():
        array = numpy_to_vtk(np.ascontiguousarray(values, dtype=np.float32), deep=1)
        array.SetName(name)
        result.GetPointData().AddArray(array)
    return result


def source_of(image):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(image)
    source.UpdatePipeline()
    return source


def delete_all_but(kept):
    """Views and sources that a script has left behind."""
    for proxy in list(simple.GetViews()) + list(simple.GetSources().values()):
        if proxy != kept:
            simple.Delete(proxy)


def importance_of(scene):
    """At the nodes, as it is given [0, 1]."""
    values = vtk_to_numpy(image_of(scene.source).GetPointData().GetArray(scene.importance_array))
    if not scene.importance:
        return values.astype(float)
    return np.interp(values.astype(float), *np.transpose(scene.importance))


def majorant_of(scene):
    return max(extinction for _, extinction in scene.extinction)


def importance_scene(scene):
    """The importance as an ordinary volume: the proxy of Section 3.4, majorant times importance."""
    name = "FigureImportance"
    image = copied(image_of(scene.source), **{name: importance_of(scene)})
    return dataclasses.replace(
        scene, source=source_of(image), array=name, importance_array=name, importance=[],
        extinction=[[0.0, 0.0], [1.0, majorant_of(scene)]],
        colors=[[0.0, 0.25, 0.3, 0.6], [0.5, 0.55, 0.6, 0.65], [1.0, 0.95, 0.75, 0.3]])


def turned(vector, axis, degrees):
    """A vector turned about an axis of length 1, counterclockwise if the axis points at you."""
    angle = math.radians(degrees)
    return (math.cos(angle) * vector + math.sin(angle) * np.cross(axis, vector)
            + (1 - math.cos(angle)) * np.dot(axis, vector) * axis)


def viewpoint_of(scene, view="own", azimuth=0):
    """One of VIEWS, or the scene's own turned about its direction upwards [degrees]: a camera by
    names of a view's properties."""
    up = np.divide(scene.view_up, np.linalg.norm(scene.view_up))
    away = np.subtract(scene.position, scene.focal_point)
    if view in ("top", "bottom"):
        level = away - np.dot(away, up) * up
        side = 1 if view == "top" else -1
        away, up = side * np.linalg.norm(away) * up, -side * level / np.linalg.norm(level)
    else:
        away = turned(away, up, azimuth + {"right": 90, "opposite": 180, "left": 270}.get(view, 0))
    return {"CameraPosition": list(scene.focal_point + away),
            "CameraFocalPoint": list(scene.focal_point), "CameraViewUp": list(up),
            "CameraViewAngle": scene.view_angle, "CameraParallelProjection": 0,
            "CameraParallelScale": 1.0}


class Stage:
    """A scene in a view of its own. The light goes with the camera."""

    def __init__(self, scene, pixels):
        self.scene = scene
        self.view = optimize_scene.make_view(scene)
        self.view.ViewSize = [FINER * pixels, FINER * pixels]
        self.display = optimize_scene.show(scene, self.view)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        simple.Delete(self.view)

    def look(self, viewpoint):
        viewpoints.look_from(self.view, viewpoint)
        self.display.LightPosition = viewpoints.light_for(self.scene, viewpoint)

    def numbers(self):
        self.display.UpdatePropertyInformation()
        return {name: getattr(self.display, name) for name in NUMBERS}

    def set(self, **settings):
        """Properties of the display."""
        for name, value in settings.items():
            setattr(self.display, name, value)

    def draw(self, **settings):
        """A picture with these properties of the display, and its numbers."""
        self.set(**settings)
        picture = sheet.picture_of(self.view)
        return smaller(picture, FINER), self.numbers()


def smaller(picture, factor):
    """Means of factor x factor pixels."""
    rows, columns = (size // factor for size in picture.shape[:2])
    picture = picture[:rows * factor, :columns * factor]
    return picture.reshape(rows, factor, columns, factor, -1).mean(axis=(1, 3))


def score_text(numbers):
    """What stands below a picture."""
    return "S {}, {:.1f} % visible".format(
        significant(numbers["VisibilityScore"], 4), 100 * numbers["VisibleFraction"])


def names_of(titles):
    """Titles in several lines, to stand beside pictures."""
    return [textwrap.fill(title, 26) for title in titles]


def filter_of(scene, **properties):
    """The filter for the scene, as the paper has it unless told otherwise; not executed."""
    optimizer = optimize_scene.optimizer_of(scene)
    optimizer.Preset = "Paper"
    for name, value in properties.items():
        setattr(optimizer, name, value)
    return optimizer


def visibility_of(scene, extinction, viewpoint=None):
    """Of a given extinction at the nodes: S, the visible share of the important structures in it, and F_q
    and F_r of Eqs. (23) and (24) with the paper's weights [length^2]."""
    image = copied(image_of(scene.source), Given=extinction, Importance=importance_of(scene))
    source = source_of(image)
    optimizer = simple.ExtinctionOptimizer(Input=source, ExtinctionSource="Array",
                                           MaximumIterations=0, Preset="Paper")
    optimizer.ImportanceArray = ["POINTS", "Importance"]
    optimizer.ExtinctionArray = ["POINTS", "Given"]
    look_through(optimizer, scene, viewpoint or viewpoint_of(scene))
    optimizer.UpdatePipeline()
    first = simple.servermanager.Fetch(optimizer, idx=1)
    found = {name: first.GetValueByName(0, name).ToDouble()
             for name in ("VisibilityScore", "VisibleFraction", "ViewEnergy", "LightEnergy")}
    simple.Delete(optimizer)
    simple.Delete(source)
    return found


def look_through(optimizer, scene, viewpoint):
    for name in ("CameraPosition", "CameraFocalPoint", "CameraViewUp", "CameraViewAngle"):
        setattr(optimizer, name, viewpoint[name])
    optimizer.LightPosition = viewpoints.light_for(scene, viewpoint)


def load_warning(measured):
    """A sentence for numbers that are times; empty on an idle machine."""
    if measured["load_before"] <= IDLE:
        return ""
    return ("**The machine had other work (load average {:.1f} before the start), which the "
            "times contain.** ".format(measured["load_before"]))


def parser(description):
    result = argparse.ArgumentParser(description=description)
    result.add_argument("--plugin", required=True, help="Limpid.so")
    result.add_argument("--output", required=True, help="folder for pictures and figures.json")
    result.add_argument("--scale", type=float, default=1, help="of the pictures' size")
    result.add_argument("--quick", action="store_true",
                        help="a small phantom, few directions, few frames")
    result.add_argument("scenes", nargs="*", help="FILE.scene.json; the phantom is always there")
    return result


def start(arguments):
    """Loads the plugin and finds out what is there; says what is not."""
    simple.LoadPlugin(os.path.abspath(arguments.plugin), remote=False, ns=vars(simple))
    os.makedirs(arguments.output, exist_ok=True)
    files = {os.path.basename(path).split(".")[0]: path for path in arguments.scenes}
    strange = sorted(set(files) - set(SCENES))
    if strange:
        raise SystemExit("There is no place for {} in the figures (their captions would say nothing "
                         "of it). Take some of: {}.".format(", ".join(strange), ", ".join(SCENES)))
    absent = [name for name in SCENES if name not in files]
    if absent:
        print("Absent: {}. The figures are made without.".format(", ".join(absent)), flush=True)
    return Run(arguments.output, files, arguments.scale, arguments.quick)


def rounded(value):
    """Numbers with seven digits, in lists and objects, too."""
    if isinstance(value, dict):
        return {key: rounded(part) for key, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(part) for part in value]
    return float("{:.7g}".format(value)) if isinstance(value, float) else value


def make(run, names):
    """Makes the figures of modules with these names, and keeps their numbers in figures.json,
    beside those of figures that were made before."""
    path = run.path("figures.json")
    kept = {}
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            kept = json.load(file)
    for name in names:
        before, begin, of_cores = machine.facts(), time.perf_counter(), time.process_time()
        numbers = importlib.import_module(name).make(run)
        seconds, of_cores = time.perf_counter() - begin, time.process_time() - of_cores
        kept[name] = {
            **{key: before[key] for key in ("processor", "cores", "date", "load_before")},
            "seconds": round(seconds, 1), "of_cores": round(of_cores, 1), "absent": [n for n in SCENES if n not in run.files],
            **rounded(numbers)}
        print("{}: {:.0f} s, {:.0f} s of all cores together {}".format(name, seconds, of_cores, ", ".join(
            "{} ({} kB)".format(picture["file"], picture["bytes"] // 1000)
            for picture in numbers.get("pictures", ()))), flush=True)
        machine.save(kept, path)
    return kept


def main(path, description):
    """The command line of a script that makes one figure."""
    name = os.path.splitext(os.path.basename(path))[0]
    print(importlib.import_module(name).caption(
        make(start(parser(description).parse_args()), [name])[name]))
