# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Under pvbatch with several processes: what is wrong with the piece of one of them is told once, all
# of them go on, and one without any piece draws with the others.

import os
import sys
import unittest

import numpy as np
from paraview import simple

import displays
import pictures

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())

WHOLE = """
from paraview import vtk
keys = vtk.vtkStreamingDemandDrivenPipeline
self.GetOutputInformation(0).Set(keys.WHOLE_EXTENT(), 0, 15, 0, 15, 0, 15)
self.GetOutputInformation(0).Set(vtk.vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), 1)
"""
PIECE = """
import numpy as np
from paraview import vtk
controller = vtk.vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
parts = ranks - 1 if TROUBLE == 'empty' else ranks
isLast = rank == ranks - 1
if rank >= parts:
    output.SetExtent(0, -1, 0, -1, 0, -1)
else:
    first, last = 15 * rank // parts, 15 * (rank + 1) // parts
    output.SetExtent(0, 15, 0, 15, first, last)
    z, y, x = np.meshgrid(np.arange(first, last + 1), np.arange(16), np.arange(16), indexing='ij')
    ball = np.exp(-((x - 7.) ** 2 + (y - 7) ** 2 + (z - 7) ** 2) / 20).ravel()
    importance = (ball > 0.6).astype(float)
    if TROUBLE == 'nan' and isLast:
        ball[-1] = np.nan
    if TROUBLE == 'much' and isLast:
        importance[-1] = 7
    output.PointData.append(ball, 'Ball')
    output.PointData.append((ball > 0.6).astype(np.uint8) + (ball > 0.2), 'Labels')
    if not (TROUBLE == 'missing' and isLast):
        output.PointData.append(importance, 'Importance')
    output.PointData.SetActiveScalars('Ball')
"""


class TestDisplayOnRanks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.source = simple.ProgrammableSource(OutputDataSetType="vtkImageData",
                                               ScriptRequestInformation=WHOLE)
        cls.view = displays.new_view()
        cls.view.UseFXAA = 0
        cls.update("")
        cls.display = simple.Show(cls.source, cls.view)
        cls.display.SetRepresentationType("Optimized Volume")
        simple.ColorBy(cls.display, ("POINTS", "Ball"))
        cls.display.RescaleTransferFunctionToDataRange()
        cls.display.ImportanceArray = ["POINTS", "Importance"]
        cls.display.ShowScore = 0
        simple.ResetCamera(cls.view)
        cls.good = pictures.take(cls.view)
        cls.score = cls.display.VisibilityScore

    @classmethod
    def update(cls, trouble):
        cls.source.Script = f"TROUBLE = '{trouble}'\n" + PIECE
        cls.source.UpdatePipeline()

    def drawn(self, trouble):
        self.update(trouble)
        return pictures.take(self.view)

    def tearDown(self):
        """After any trouble, all is well again."""
        picture = self.drawn("")
        np.testing.assert_array_equal(picture, self.good)
        self.assertEqual(self.display.VisibilityScore, self.score)
        self.assertEqual(self.display.Messages, "")

    def test_is_optimized(self):
        self.assertGreater(self.display.VisibleFraction, self.display.BaseVisibleFraction)

    def test_what_one_of_them_cannot_use_is_counted(self):
        self.drawn("nan")
        self.assertIn("1 of 4096 points have a NaN", self.display.Messages)
        self.drawn("much")
        self.assertIn("1 of 4096 points have an importance outside [0, 1]", self.display.Messages)

    def test_without_the_importance_of_one_the_volume_is_ordinary(self):
        picture = self.drawn("missing")

        self.assertIn("Another process has no importance", self.display.Messages)
        self.assertEqual(self.display.VisibleFraction, 0)
        self.assertGreater(np.abs(picture - self.good).max(), 20)

    def test_structures_are_measured_for_the_text(self):
        self.display.StructureArray = ["POINTS", "Labels"]
        self.display.Structures = ["1", "shell", "0.2", "", "2", "core", "1", ""]
        self.display.ShowScore = 1
        try:
            shares = []
            for trouble in ("", "empty"):
                self.drawn(trouble)
                self.display.UpdatePropertyInformation()
                shares.append(list(self.display.StructureShares))
                self.assertEqual(self.display.Messages, "")
            self.assertEqual(len(shares[0]), 8)
            self.assertGreater(np.min(shares[0]), 0)
            self.assertEqual(*shares)
        finally:
            self.display.ShowScore = 0
            self.display.StructureArray = ["POINTS", ""]
            self.display.Structures = []

    def test_opengl_draws_the_parts(self):
        try:
            for shadows in (0, 1):
                self.display.Shadows = shadows
                self.display.DrawOn = "Processor"
                expected = pictures.take(self.view)
                self.display.DrawOn = "OpenGL"
                picture = pictures.take(self.view)
                self.display.UpdatePropertyInformation()
                self.assertIn("OpenGL", self.display.DrawnBy)
                self.assertEqual(self.display.Messages, "")
                self.assertLessEqual(np.abs(picture - expected).max(), 1)
        finally:
            self.display.DrawOn = "Auto"
            self.display.Shadows = 1

    def test_says_that_it_optimises_at_full_resolution(self):
        self.display.ControlResolution = "Half"
        try:
            np.testing.assert_array_equal(self.drawn(""), self.good)
            self.assertIn("processes share the image", self.display.Messages)
            self.assertIn("ControlResolution", self.display.Messages)
        finally:
            self.display.ControlResolution = "Auto"

    def test_one_may_have_nothing(self):
        picture = self.drawn("empty")

        self.assertLessEqual(np.abs(picture - self.good).max(), 1)
        self.assertEqual(self.display.VisibilityScore, self.score)


if __name__ == "__main__":
    # Only a failure leaves by sys.exit: it keeps ParaView from closing its windows and processes.
    if not unittest.main(exit=False).result.wasSuccessful():
        sys.exit(1)
