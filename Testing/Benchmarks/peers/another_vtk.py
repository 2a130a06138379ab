# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The mappers of another VTK than the one that Limpid is built for, for the head of head.py. That VTK
is in another Python, so they draw in a process of it (serve_vtk.py)."""

import json
import os

import numpy as np
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

import programs
from head import STEP

MAPPERS = {"vtkFixedPointVolumeRayCastMapper": "fixed point", "vtkGPUVolumeRayCastMapper": "GPU"}


class AnotherVtk(programs.Program):
    """A process that draws the head as it was when this was made, from other cameras."""

    def __init__(self, python, head, folder):
        self.head, self.folder = head, folder
        path = os.path.join(folder, "another-vtk.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"size": head.size, "step": STEP * head.spacing, "colors": head.colors,
                       "opacity": head.scene.opacity(),
                       "unit_distance": head.scene.unit_distance(),
                       "focal_point": head.scene.focal_point, "view_up": head.scene.view_up,
                       "view_angle": head.scene.view_angle}, file)
        writer = vtkXMLImageDataWriter()
        writer.SetInputData(head.plain)
        writer.SetFileName(os.path.splitext(path)[0] + ".vti")
        writer.SetCompressorTypeToNone()
        writer.Write()
        here = os.path.dirname(os.path.abspath(__file__))
        super().__init__("another VTK", [python, "-B", os.path.join(here, "serve_vtk.py"), path])
        self.version = None

    def answer(self, command):
        found = super().answer(command)
        self.version = found.get("version", self.version)
        return found

    def kinds(self, angle):
        """What it draws, by name; `angle`: between one picture and the next [degrees]."""
        return {f"another VTK, {mapper}{', shaded' if shade else ''}":
                ByAnotherVtk(self, name, shade, angle)
                for shade in (False, True) for mapper, name in MAPPERS.items()}


class ByAnotherVtk:
    """A picture by a mapper of the other VTK."""

    def __init__(self, program, mapper, shade, angle):
        self.program, self.angle = program, angle
        self.asked = {"mapper": mapper, "shade": shade}

    def draw(self, number, _=None):
        head = self.program.head
        head.look(self.angle * number)
        return self.program.ask(json.dumps({
            **self.asked, "position": head.camera.GetPosition(),
            "light": head.light.GetPosition()}))

    def shown(self):
        path = os.path.join(self.program.folder, "another-vtk.npy")
        self.program.ask(json.dumps({**self.asked, "save": path}))
        return np.load(path)
