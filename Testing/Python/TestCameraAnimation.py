# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# ParaView's camera goes the way of a camera path, frame by frame.

import os
import sys
import unittest

import numpy as np
from paraview import servermanager, simple
from paraview.vtk.util.numpy_support import vtk_to_numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..",
                                "Documentation", "Examples"))

from camera_path import animate  # noqa: E402

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=vars(simple))


class TestCameraAnimation(unittest.TestCase):
    def setUp(self):
        source = simple.OcclusionPhantom(Resolution=16)
        search = simple.ViewpointSearch(
            Input=source, NumberOfDirections=162, CameraViewUp=[0, 0, 1],
            ImportanceArray=["POINTS", "Importance"], ExtinctionSource="Array",
            ExtinctionArray=["POINTS", "BaseExtinction"])
        self.path = simple.CameraPath(Input=search, NumberOfFrames=20)
        self.view = simple.CreateView("RenderView", ViewSize=[100, 100])

    def tearDown(self):
        simple.Delete(self.view)

    def go(self, frame):
        simple.GetAnimationScene().AnimationTime = frame / 20
        return np.array([self.view.CameraPosition, self.view.CameraFocalPoint,
                         self.view.CameraViewUp])

    def test_frames_are_those_of_the_path(self):
        animate(self.path, self.view)
        scene = simple.GetAnimationScene()
        self.assertEqual(scene.NumberOfFrames, 21)  # the last one is the first one
        values = servermanager.Fetch(self.path).GetPointData()
        expected = [vtk_to_numpy(values.GetArray(name))
                    for name in ("CameraPosition", "CameraFocalPoint", "CameraViewUp")]
        for frame in (0, 1, 7, 19, 20):
            np.testing.assert_allclose(
                self.go(frame), [array[frame % 20] for array in expected], atol=1e-6)
        self.assertEqual(self.view.CameraViewAngle, 30)

    def test_another_animation_takes_its_place(self):
        animate(self.path, self.view)
        before = self.go(5)
        self.path.NumberOfKeyViews = 2
        track = animate(self.path, self.view)
        self.assertEqual(len(track.KeyFrames), 21)
        self.go(0)
        self.assertGreater(np.abs(self.go(5) - before).max(), 1e-3)
        again = self.go(5)
        self.go(0)
        np.testing.assert_array_equal(self.go(5), again)


if __name__ == "__main__":
    unittest.main()
