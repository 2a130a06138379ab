# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# pvpython write_volume.py PLUGIN VOLUME FILE.vti: the volume that ctest's stories open. It has every
# second point of VOLUME along each axis, which has a point array "ct": stories press buttons, and an
# eighth of the points is optimized in an eighth of the time. Where there is no VOLUME, it is the
# phantom of a head, with values as those of a CT in eight bits.

import os
import sys

import numpy as np
from paraview import servermanager, simple
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from paraview.vtk.vtkImagingCore import vtkExtractVOI
from paraview.vtk.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter


def every_fourth_point_of(volume):
    reader = vtkXMLImageDataReader()
    reader.SetFileName(volume)
    sampled = vtkExtractVOI()
    sampled.SetInputConnection(reader.GetOutputPort())
    sampled.SetSampleRate(4, 4, 4)
    sampled.Update()
    return sampled.GetOutput()


def phantom_of_a_head(plugin):
    simple.LoadPlugin(plugin, ns=globals())
    image = servermanager.Fetch(OcclusionPhantom(Resolution=96, Scene="Head"))
    points = image.GetPointData()
    ct = numpy_to_vtk((254 * vtk_to_numpy(points.GetArray("Scalars"))).astype(np.uint8), deep=1)
    ct.SetName("ct")
    points.Initialize()
    points.SetScalars(ct)
    return image


plugin, volume, path = sys.argv[1:]
if os.path.isfile(volume):
    image = every_fourth_point_of(volume)
else:
    print(f"{volume} is not there: stories are told of a phantom. Set LIMPID_TEST_DATA.")
    image = phantom_of_a_head(plugin)
writer = vtkXMLImageDataWriter()
writer.SetFileName(path)
writer.SetDataModeToBinary()  # some versions of expat cannot read appended data
writer.SetInputData(image)
writer.Write()
