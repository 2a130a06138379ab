# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Under pvbatch with two processes: they optimise an image together and each holds its piece, and
# search for viewpoints together, which the first one holds. Where none can have the whole image,
# they do the same with their pieces, or there is an error.

import os
import sys
import unittest

from paraview import simple
from paraview.modules.vtkRemotingCore import vtkProcessModule
from paraview.vtk.util.numpy_support import vtk_to_numpy

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())

RANKS = vtkProcessModule.GetProcessModule().GetNumberOfLocalPartitions()


def part_of_an_image():
    """A source of which each process has its half, whatever it is asked for."""
    return simple.ProgrammableSource(
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

    def test_the_first_process_holds_all_views(self):
        phantom = OcclusionPhantom(Resolution=24)
        for field in ("Base Extinction", "Optimize Per View"):
            search = ViewpointSearch(Input=phantom, Field=field, NumberOfDirections=12,
                                     NumberOfViewpoints=2)
            search.ExtinctionSource = "Array"
            search.UpdatePipeline()

            for port, points in ((0, 12), (1, 2)):
                information = simple.OutputPort(search, port).GetDataInformation()
                self.assertEqual(information.GetNumberOfPoints(), points)
            best = simple.servermanager.Fetch(search, idx=1).GetPointData()
            fields = search.FieldData
            self.assertEqual(fields["BestVisibilityScore"].GetRange(),
                             2 * (best.GetArray("VisibilityScore").GetValue(0),))
            self.assertGreater(fields["BestVisibilityScore"].GetRange()[0],
                               fields["WorstVisibilityScore"].GetRange()[0])

    def test_scores_of_views_are_those_of_the_optimizer(self):
        phantom = OcclusionPhantom(Resolution=24)
        search = ViewpointSearch(Input=phantom, Field="Base Extinction", NumberOfDirections=12)
        search.ExtinctionSource = "Array"
        search.UpdatePipeline()
        best = simple.servermanager.Fetch(search, idx=1).GetPointData()
        optimizer = ExtinctionOptimizer(Input=phantom)
        optimizer.ExtinctionSource = "Array"
        for name in ("CameraPosition", "CameraFocalPoint", "CameraViewUp"):
            setattr(optimizer, name, list(vtk_to_numpy(best.GetArray(name))[0]))
        optimizer.UpdatePipeline()

        score = best.GetArray("VisibilityScore").GetValue(0)
        base = optimizer.FieldData["BaseVisibilityScore"].GetRange()[0]
        # Both are quadratures of the same integral, with rays at different places.
        self.assertLess(abs(score / base - 1), 5e-3)

    def test_a_part_of_an_image_is_enough_but_to_optimize_per_view(self):
        part = part_of_an_image()
        optimizer = ExtinctionOptimizer(Input=part)
        optimizer.ExtinctionSource = "Array"
        optimizer.UpdatePipeline()
        self.assertEqual(optimizer.GetDataInformation().GetExtent(), (0, 7, 0, 7, 0, 7))
        for field, points in (("Base Extinction", 12), ("Attainable", 12), ("Optimize Per View", 0)):
            search = ViewpointSearch(Input=part, Field=field, NumberOfDirections=12)
            search.ExtinctionSource = "Array"
            search.UpdatePipeline()
            self.assertEqual(search.GetDataInformation().GetNumberOfPoints(), points)


if __name__ == "__main__":
    # Only a failure leaves by sys.exit: it keeps ParaView from closing its windows and processes.
    if not unittest.main(exit=False).result.wasSuccessful():
        sys.exit(1)
