# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Under pvbatch with two processes: each optimises the whole image and holds its piece, so the
# result is that of one process. Where the whole image cannot be had, there is an error.

import os
import sys
import unittest

from paraview import simple
from paraview.modules.vtkRemotingCore import vtkProcessModule
from paraview.vtk.util.numpy_support import vtk_to_numpy

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())

RANKS = vtkProcessModule.GetProcessModule().GetNumberOfLocalPartitions()


class TestTwoProcesses(unittest.TestCase):
    def test_each_process_holds_its_piece_of_the_same_result(self):
        optimizer = ExtinctionOptimizer(Input=OcclusionPhantom(Resolution=24))
        optimizer.ExtinctionSource = "Array"
        optimizer.UpdatePipeline()
        information = optimizer.GetDataInformation()

        self.assertEqual(RANKS, 2)
        self.assertEqual(information.GetExtent(), (0, 23, 0, 23, 0, 23))
        # Both pieces have the layer of points where they meet.
        self.assertEqual(information.GetNumberOfPoints(), 24 * 24 * 25)
        scores = optimizer.FieldData["VisibilityScore"].GetRange()
        self.assertEqual(scores[0], scores[1])

    def test_part_of_an_image_is_an_error(self):
        part = simple.ProgrammableSource(
            OutputDataSetType="vtkImageData",
            ScriptRequestInformation="""
from paraview import vtk
keys = vtk.vtkStreamingDemandDrivenPipeline
self.GetOutputInformation(0).Set(keys.WHOLE_EXTENT(), 0, 7, 0, 7, 0, 7)
self.GetOutputInformation(0).Set(vtk.vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), 1)
""",
            Script="""
import numpy as np
from paraview import vtk
rank = vtk.vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
output.SetExtent(0, 7, 0, 7, 0 if rank == 0 else 4, 4 if rank == 0 else 7)
ones = np.ones(output.GetNumberOfPoints())
output.PointData.append(ones, 'Importance')
output.PointData.append(ones, 'BaseExtinction')
""")
        optimizer = ExtinctionOptimizer(Input=part)
        optimizer.ExtinctionSource = "Array"
        optimizer.UpdatePipeline()

        self.assertEqual(optimizer.GetDataInformation().GetNumberOfPoints(), 0)


if __name__ == "__main__":
    # Only a failure leaves by sys.exit: it keeps ParaView from closing its windows and processes.
    if not unittest.main(exit=False).result.wasSuccessful():
        sys.exit(1)
