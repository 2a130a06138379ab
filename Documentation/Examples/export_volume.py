# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Writes the volume that was found for other renderers: its colors with the optimised opacities, and
the optimised extinction.

  pvpython export_volume.py Limpid.so FILE...

FILE.nrrd and FILE.mha have red, green, blue and opacity as bytes, opacities on the unit distance that
is printed. FILE.vdb (OpenVDB, for Blender or Houdini) has the extinction [1/length] as the grid
"density" and the colors as "Cd"; it needs OpenVDB's Python module. FILE.nvdb (NanoVDB) is made of it by
the program nanovdb_convert. Debian 12: python3-openvdb and libnanovdb-tools.
"""

import os
import subprocess
import sys
import tempfile

import numpy as np
from paraview.simple import *
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from paraview.vtk.vtkCommonDataModel import vtkImageData
from paraview.vtk.vtkIOImage import vtkMetaImageWriter

UNIT_DISTANCE = 0.1  # of exported opacities [length]
COLORS = [[0.0, 0.2, 0.15, 0.2], [0.15, 0.75, 0.5, 0.55], [0.4, 0.87, 0.66, 0.53], [0.65, 0.95, 0.92, 0.8],
          [0.75, 0.8, 0.2, 0.15], [0.85, 0.75, 0.05, 0.1], [0.93, 0.3, 0.7, 0.3], [1.0, 0.1, 0.8, 0.35]]


class Exported:
    """An image with the optimised extinction, and its colors."""

    def __init__(self, image, scalars, colors):
        self.image = image
        self.shape = image.GetDimensions()
        values = vtk_to_numpy(image.GetPointData().GetArray(scalars))
        nodes = np.transpose(colors)
        self.colors = np.stack([np.interp(values, nodes[0], channel) for channel in nodes[1:]], axis=-1)
        self.extinction = vtk_to_numpy(image.GetPointData().GetArray("Extinction"))

    def rgba(self):
        """Bytes, a row per point, x fastest."""
        opacity = -np.expm1(-self.extinction * UNIT_DISTANCE)
        return np.round(255 * np.column_stack([self.colors, opacity])).astype(np.uint8)

    def axes(self):
        """The steps from point to point along x, y and z, a row each [length]."""
        matrix = self.image.GetDirectionMatrix()
        directions = np.array([[matrix.GetElement(row, axis) for row in range(3)] for axis in range(3)])
        return directions * np.array(self.image.GetSpacing())[:, np.newaxis]

    def origin(self):
        return self.image.GetPoint(0)


def write_nrrd(exported, path):
    """VTK has no writer for it; the format is a short text before the numbers."""
    def vector(numbers):
        return "(" + ",".join(f"{number:.17g}" for number in numbers) + ")"

    header = ["NRRD0004", "type: uint8", "dimension: 4", "space dimension: 3",
              f"sizes: 4 {' '.join(map(str, exported.shape))}",
              "kinds: RGBA-color domain domain domain",
              f"space directions: none {' '.join(map(vector, exported.axes()))}",
              f"space origin: {vector(exported.origin())}", "encoding: raw", "", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode())
        file.write(exported.rgba().tobytes())


def write_meta_image(exported, path):
    image = vtkImageData()
    image.CopyStructure(exported.image)
    rgba = numpy_to_vtk(exported.rgba())
    rgba.SetName("RGBA")
    image.GetPointData().SetScalars(rgba)
    writer = vtkMetaImageWriter()
    writer.SetInputData(image)
    writer.SetFileName(path)
    writer.Write()


def write_vdb(exported, path):
    import pyopenvdb as openvdb  # what the other formats do not need

    matrix = np.identity(4)
    matrix[:3, :3], matrix[3, :3] = exported.axes(), exported.origin()
    density, color = openvdb.FloatGrid(), openvdb.Vec3SGrid()
    for grid, name, values in ((density, "density", exported.extinction), (color, "Cd", exported.colors)):
        grid.name = name
        grid.transform = openvdb.createLinearTransform(matrix.tolist())
        along_axes = values.reshape(*exported.shape[::-1], -1).transpose(2, 1, 0, 3).squeeze()
        grid.copyFromArray(np.ascontiguousarray(along_axes, dtype=np.float32))
    openvdb.write(path, grids=[density, color])


def write_nanovdb(exported, path):
    with tempfile.TemporaryDirectory() as folder:
        tree = os.path.join(folder, "volume.vdb")
        write_vdb(exported, tree)
        subprocess.run(["nanovdb_convert", "--force", tree, path], check=True)


WRITERS = {".nrrd": write_nrrd, ".mha": write_meta_image, ".vdb": write_vdb, ".nvdb": write_nanovdb}

plugin, *files = sys.argv[1:]
LoadPlugin(os.path.abspath(plugin), remote=False, ns=globals())
head = OcclusionPhantom(Scene="Head", Resolution=64)
optimizer = ExtinctionOptimizer(Input=head, ExtinctionSource="Array", CameraPosition=[1.9, -4.7, 1.5],
                                CameraFocalPoint=[0, 0, 0], CameraViewUp=[0, 0, 1])
optimizer.ExtinctionArray = ["POINTS", "BaseExtinction"]
volume = Exported(servermanager.Fetch(optimizer), "Scalars", COLORS)
for name in files:
    suffix = os.path.splitext(name)[1]
    if suffix not in WRITERS:
        sys.exit(f"{name} ends in \"{suffix}\" (which tells the format). Use {', '.join(WRITERS)}.")
    WRITERS[suffix](volume, name)
    print(f"Wrote {name}, {os.path.getsize(name)} bytes, opacities on a distance of {UNIT_DISTANCE}")
