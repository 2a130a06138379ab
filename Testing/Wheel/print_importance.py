# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Prints what the package or the filter takes for important of scalars where nobody has said what
is: the importance of all points as JSON, x fastest.

  python3 print_importance.py package|filter SCALARS.npy
"""

import json
import sys
import warnings

import numpy as np


def of_package(scalars):
    from limpid.scene import scene_of

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that nobody has said it
        return scene_of(scalars).importance.ravel(order="F")


def of_filter(scalars):
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkObject
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from limpid.vtkLimpidFilters import vtkExtinctionOptimizer

    vtkObject.GlobalWarningDisplayOff()
    image = vtkImageData()
    image.SetDimensions(scalars.shape)
    values = numpy_to_vtk(scalars.ravel(order="F"))
    values.SetName("values")
    image.GetPointData().SetScalars(values)
    optimizer = vtkExtinctionOptimizer()
    optimizer.SetInputData(image)
    optimizer.SetImportanceSmoothing(vtkExtinctionOptimizer.AS_GIVEN)
    optimizer.SetMaximumIterations(1)
    optimizer.Update()
    return vtk_to_numpy(optimizer.GetOutput().GetPointData().GetArray("Importance"))


print(json.dumps({"package": of_package, "filter": of_filter}[sys.argv[1]](
    np.load(sys.argv[2])).tolist()))
