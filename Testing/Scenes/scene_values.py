# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Reads scenes such as those of Documentation/Examples with VTK alone."""

import json

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader


def read_scene(path):
    """The scene of a file, its image, and the values of its array, flat."""
    scene = json.loads(path.read_text())
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(path.parent / scene["data"]["file"]))
    reader.Update()
    image = reader.GetOutput()
    return scene, image, vtk_to_numpy(image.GetPointData().GetArray(scene["data"]["array"]))
