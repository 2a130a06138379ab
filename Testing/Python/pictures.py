# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Pictures of ParaView's views as arrays, and how far two of them are apart.

A picture is compared by two numbers, in steps of the 256 that a channel has:

  mean   mean absolute difference over all pixels and channels: an error of brightness or colour,
         or of a larger part of the picture, moves it;
  p99    99th percentile over the pixels of the largest difference of a channel: a small part that
         is wrong moves it, a few pixels at edges do not.
"""

import os
import tempfile

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from paraview.vtk.vtkCommonDataModel import vtkImageData
from paraview.vtk.vtkIOImage import vtkPNGReader, vtkPNGWriter


def read(path, channels=3):
    """Rows from the bottom, columns, red green blue, and alpha if four channels; 0 to 255."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[:, :, :channels].astype(float)


def write(path, picture):
    image = vtkImageData()
    image.SetDimensions(picture.shape[1], picture.shape[0], 1)
    pixels = numpy_to_vtk(picture.reshape(-1, 3).astype(np.uint8), deep=1)
    image.GetPointData().SetScalars(pixels)
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


def take(view, resolution=None, **settings):
    """A screenshot of a view or a layout, with settings of simple.SaveScreenshot."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.png")
        simple.SaveScreenshot(path, view, ImageResolution=resolution or view.ViewSize,
                              **settings)
        return read(path, 4 if settings.get("TransparentBackground") else 3)


def difference(first, second):
    """(mean, p99) of two pictures of the same size."""
    apart = np.abs(first - second)
    return apart.mean(), np.percentile(apart.max(axis=2), 99)
