# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Under pvbatch --symmetric: a simulation with Catalyst, whose image each process has a piece of.
#   simulation.py PIPELINE.py STEPS

import math
import sys

from paraview.catalyst import bridge
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController

HALF = 15  # of the cells along an axis


def piece_of(step):
    controller = vtkMultiProcessController.GetGlobalController()
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-HALF, HALF, -HALF, HALF, -HALF, HALF)
    source.SetXFreq(60 + 10 * math.sin(step))
    source.UpdatePiece(controller.GetLocalProcessId(), controller.GetNumberOfProcesses(), 0)
    return source.GetOutputDataObject(0), source.GetWholeExtent()


bridge.initialize()
bridge.add_pipeline(sys.argv[1])
for step in range(int(sys.argv[2])):
    image, whole = piece_of(step)
    bridge.coprocess(float(step), step, image, name="input", wholeExtent=whole)
bridge.finalize()
