# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Scenes for the examples: a volume, what is important in it, and who looks at it."""

import dataclasses
import math

import numpy as np
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from paraview.vtk.vtkCommonCore import vtkObject
from paraview.vtk.vtkIOXML import vtkXMLImageDataReader

from scene_file import SceneFile

EXTINCTION = "SceneExtinction"
STEPS = 16  # of an opacity function between two nodes of an extinction function


@dataclasses.dataclass
class Scene:
    name: str
    title: str
    becomes_visible: str
    source: object  # a ParaView source of image data
    array: str  # the scalar field
    importance_array: str
    importance: list  # [value, importance], piecewise linear; empty: the array is importance
    extinction_array: str
    extinction: list  # [value, extinction per world unit] that it was made with, piecewise linear
    colors: list  # [value, r, g, b], piecewise linear
    position: list
    focal_point: list
    view_up: list
    view_angle: float
    light: list

    def unit_distance(self):
        """A distance for opacities that are neither tiny nor close to 1."""
        return 0.5 / max(extinction for _, extinction in self.extinction)

    def opacity(self):
        """[value, opacity] at the unit distance. Between nodes extinction is a straight line and
        opacity is not, so there are many."""
        nodes = []
        for (value, extinction), (end, extinction_at_end) in zip(self.extinction,
                                                                 self.extinction[1:]):
            for step in range(STEPS):
                way = step / STEPS
                nodes.append([value + way * (end - value),
                              extinction + way * (extinction_at_end - extinction)])
        nodes.append(self.extinction[-1])
        return [[value, -math.expm1(-extinction * self.unit_distance())]
                for value, extinction in nodes]


def phantom_scene(simple, resolution=128):
    """The head of the embedded phantom, seen from the front, slightly from above."""
    return Scene(
        name="phantom",
        title="Phantom of a head",
        becomes_visible="The skull under the skin, and the tumour inside it.",
        source=simple.OcclusionPhantom(Resolution=resolution, Scene="Head"),
        array="Scalars",
        importance_array="Importance",
        importance=[],
        extinction_array="BaseExtinction",
        extinction=[[0.0, 0.0], [0.15, 1.5], [0.25, 3.0], [0.4, 9.0], [0.65, 14.0], [0.85, 25.0],
                    [1.0, 25.0]],
        colors=[[0.0, 0.2, 0.15, 0.2], [0.15, 0.75, 0.5, 0.55], [0.25, 0.8, 0.45, 0.35],
                [0.4, 0.87, 0.66, 0.53], [0.55, 0.9, 0.85, 0.7], [0.65, 0.95, 0.92, 0.8],
                [0.75, 0.8, 0.2, 0.15], [0.85, 0.75, 0.05, 0.1], [0.93, 0.3, 0.7, 0.3],
                [1.0, 0.1, 0.8, 0.35]],
        position=[1.9, -4.7, 1.5],
        focal_point=[0.0, 0.0, 0.0],
        view_up=[0.0, 0.0, 1.0],
        view_angle=30.0,
        light=[-2.5, -4.5, 4.5])


def read_scene(simple, path):
    """A scene file: JSON beside an image file. Ends the program where it is broken."""
    file = SceneFile(path).check()
    description = file.description
    data = description["data"]
    reader = vtkXMLImageDataReader()
    reader.SetFileName(file.image_path())
    vtkObject.GlobalWarningDisplayOff()  # one line says it all
    reader.Update()
    vtkObject.GlobalWarningDisplayOn()
    image = reader.GetOutput()
    if reader.GetErrorCode() != 0 or image.GetNumberOfPoints() == 0:
        file.refuse("data.file", 'is "{}", which is damaged (it has no end that fits its '
                    "beginning)".format(data["file"]), "Copy it again")
    scalars = image.GetPointData().GetArray(data["array"])
    if scalars is None or scalars.GetNumberOfComponents() != 1:
        file.refuse("data.array", 'is "{}", which is no point array of numbers in {} (the scene is '
                    "made from it)".format(data["array"], data["file"]), "Name one of its arrays")

    # A scene's transfer function is linear in extinction, not in opacity, between its nodes.
    nodes, extinction = np.array(description["extinction_tf"], dtype=float).T
    field = np.interp(vtk_to_numpy(scalars).astype(float), nodes, extinction).astype(np.float32)
    array = numpy_to_vtk(field, deep=1)
    array.SetName(EXTINCTION)
    image.GetPointData().AddArray(array)
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(image)

    camera = description["camera"]
    return Scene(
        name=description["name"],
        title=description["title"],
        becomes_visible=description["becomes_visible"],
        source=source,
        array=data["array"],
        importance_array=data["array"],
        importance=description["importance_tf"],
        extinction_array=EXTINCTION,
        extinction=description["extinction_tf"],
        colors=description["color_tf"],
        position=camera["position"],
        focal_point=camera["focal_point"],
        view_up=camera["view_up"],
        view_angle=camera["view_angle"],
        light=description["light"]["position"])
