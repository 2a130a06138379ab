# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What tests share that run in several processes at once.

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

from volume_views import BACKGROUND

CONTROLLER = vtkMultiProcessController.GetGlobalController()
RANK = CONTROLLER.GetLocalProcessId()
RANKS = CONTROLLER.GetNumberOfProcesses()


def slab_of(image, first=0):
    """This process's slab of an image; without points in processes before the first."""
    slab = vtkImageData()
    part, parts = RANK - first, RANKS - first
    if part >= 0:
        last = image.GetDimensions()[2] - 1
        slab.ShallowCopy(image)
        slab.Crop(image.GetExtent()[:4] + (last * part // parts, last * (part + 1) // parts))
    return slab


def sum_of_all(values):
    total = vtkDoubleArray()
    CONTROLLER.AllReduce(numpy_to_vtk(values.ravel(), deep=1), total, vtkCommunicator.SUM_OP)
    return vtk_to_numpy(total).reshape(values.shape)


def together(view):
    """What the windows of all processes show, each its own pixels over the background; rendered."""
    background = np.round(255 * np.array(BACKGROUND))
    return sum_of_all(view.picture() - background) + background
