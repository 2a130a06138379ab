# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Under pvbatch --symmetric: a camera path on several ranks is that of one, and what goes wrong at a
# time step ends it on all of them, with one message.

import sys
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from limpid.vtkLimpidFilters import vtkCameraPath

from images import phantom
from TestCameraPath import Moving, path_of, search, search_through_time

CONTROLLER = vtkMultiProcessController.GetGlobalController()
RANK = CONTROLLER.GetLocalProcessId()
RANKS = CONTROLLER.GetNumberOfProcesses()


def on_ranks(make):
    path = make()
    path.UpdatePiece(RANK, RANKS, 0)
    return path


def alone(make):
    """By every process for itself."""
    path = make()
    path.UpdatePiece(0, 1, 0)
    return path


def arrays_of(path):
    data = path.GetOutput().GetPointData()
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
            for i in range(data.GetNumberOfArrays())}


class TestCameraPathOnRanks(unittest.TestCase):
    def assert_same(self, make):
        expected, found = alone(make), on_ranks(make)
        self.assertEqual(found.messages["ErrorEvent"], [])
        if RANK > 0:
            self.assertEqual(found.GetOutput().GetNumberOfPoints(), 0)
            return
        self.assertGreater(expected.GetOutput().GetNumberOfPoints(), 0)
        for name, values in arrays_of(expected).items():
            np.testing.assert_allclose(arrays_of(found)[name], values, atol=1e-9, err_msg=name)

    def test_a_round_trip_is_that_of_one_process(self):
        self.assert_same(lambda: path_of(search(phantom(16)), NumberOfFrames=40))

    def test_through_time_it_is_that_of_one_process(self):
        self.assert_same(lambda: path_of(search_through_time(Moving(4)),
                                         Way=vtkCameraPath.THROUGH_TIME))

    def test_a_time_step_that_fails_ends_it_on_all_with_one_message(self):
        source = Moving(4, without=(2,))
        searched = search_through_time(source)
        path = path_of(searched, Way=vtkCameraPath.THROUGH_TIME)
        path.UpdatePiece(RANK, RANKS, 0)
        messages = path.messages["ErrorEvent"]
        self.assertEqual(len(messages), 1 if RANK == 0 else 0, messages)
        if messages:
            self.assertIn("time step 2 of 0..3", messages[0])
            self.assertIn('"Importance"', messages[0])
        self.assertEqual(source.asked, [0, 1, 2])
        self.assertEqual(path.GetOutput().GetNumberOfPoints(), 0)

    def test_an_abort_on_one_ends_it_on_all(self):
        source = Moving(4)
        path = path_of(search_through_time(source), Way=vtkCameraPath.THROUGH_TIME)
        path.AddObserver("ProgressEvent", lambda *_: path.SetAbortExecute(
            1 if RANK == RANKS - 1 and len(source.asked) == 2 else 0))
        path.UpdatePiece(RANK, RANKS, 0)
        self.assertEqual(source.asked, [0, 1])
        self.assertEqual(path.messages["ErrorEvent"], [])
        self.assertEqual(path.GetOutput().GetNumberOfPoints(), 0)

    def test_directions_that_change_end_it_on_all(self):
        source = Moving(3)
        searched = search_through_time(source)
        path = path_of(searched, Way=vtkCameraPath.THROUGH_TIME)
        path.AddObserver("ProgressEvent", lambda *_: searched.SetNumberOfDirections(42))
        path.UpdatePiece(RANK, RANKS, 0)
        messages = path.messages["ErrorEvent"]
        self.assertEqual(len(messages), 1 if RANK == 0 else 0, messages)
        self.assertEqual(source.asked, [0, 1])


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=0 if RANK else 2).result
    if not result.wasSuccessful():
        sys.exit(1)
