# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# pvpython write_phantom.py PLUGIN FILE.vti: the phantom of a head, as array "ct" with values as
# those of a CT in eight bits.

import sys

import numpy as np
from paraview import servermanager, simple
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from paraview.vtk.vtkIOXML import vtkXMLImageDataWriter

plugin, path = sys.argv[1:]
simple.LoadPlugin(plugin, ns=globals())
image = servermanager.Fetch(OcclusionPhantom(Resolution=96, Scene="Head"))
points = image.GetPointData()
ct = numpy_to_vtk((254 * vtk_to_numpy(points.GetArray("Scalars"))).astype(np.uint8), deep=1)
ct.SetName("ct")
points.Initialize()
points.SetScalars(ct)
writer = vtkXMLImageDataWriter()
writer.SetFileName(path)
writer.SetDataModeToBinary()  # some versions of expat cannot read appended data
writer.SetInputData(image)
writer.Write()
