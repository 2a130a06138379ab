# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Under pvbatch --symmetric: still pictures that processes make together in several frames.

import sys
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import BACKGROUND, actor_of, difference, phantom, sphere

CONTROLLER = vtkMultiProcessController.GetGlobalController()
RANK = CONTROLLER.GetLocalProcessId()
RANKS = CONTROLLER.GetNumberOfProcesses()


def show_piece(**properties):
    """A view of this process's slab of the phantom, with the mapper, and both."""
    whole = phantom(40)
    piece = vtkImageData()
    piece.ShallowCopy(whole)
    last = whole.GetDimensions()[2] - 1
    piece.Crop(whole.GetExtent()[:4] + (last * RANK // RANKS, last * (RANK + 1) // RANKS))
    return show(piece, SharesImage=1, WholeExtent=whole.GetExtent(), **properties)


def together(view):
    """What the windows of all processes show, each its own pixels over the background; rendered."""
    background = np.round(255 * np.array(BACKGROUND))
    own = view.picture() - background
    total = vtkDoubleArray()
    CONTROLLER.AllReduce(numpy_to_vtk(own.ravel(), deep=1), total, vtkCommunicator.SUM_OP)
    return vtk_to_numpy(total).reshape(own.shape) + background


class TestStepsOnRanks(MapperTest):
    def frames_to_the_end(self, view, mapper):
        for frames in range(1, 4000):
            view.window.Render()
            if mapper.GetConverged():
                return frames
        self.fail("it does not converge")

    def test_still_frames_in_steps_end_at_the_same_picture(self):
        at_once, _ = show_piece()
        expected = together(at_once)
        self.assertGreater(np.ptp(at_once.pixels()), 20)  # a part of it is this process's
        view, mapper = show_piece(ProgressiveStill=1, InteractiveFrameTime=0.001)
        self.assertGreater(self.frames_to_the_end(view, mapper), 1)
        np.testing.assert_array_equal(together(view), expected)
        self.assertTrue(mapper.GetConverged())
        self.assert_fine(view)

    def test_a_still_picture_is_made_in_slices_that_add_up_to_it(self):
        settings = {"Method": Mapper.ORDINARY, "Jitter": 1}
        view, mapper = show_piece(ProgressiveStill=1, InteractiveFrameTime=1e-6, **settings)
        whole, _ = show_piece(**settings)
        ball = actor_of(sphere((0, -0.5, 0), 0.4))
        for _ in range(2):
            self.assertGreater(self.frames_to_the_end(view, mapper), 10)
            np.testing.assert_array_equal(view.pixels(), whole.picture())
            self.assertEqual(self.frames_to_the_end(view, mapper), 1)  # it is kept
            if RANK == 0:  # changes in one process
                view.renderer.AddActor(ball)
                whole.renderer.AddActor(ball)
        self.assert_fine(view)

    def test_a_coarse_picture_becomes_sharp_little_by_little(self):
        view, mapper = show_piece(ProgressiveStill=1, InteractiveFrameTime=1e-6, EaseTime=0.05,
                                  Method=Mapper.ORDINARY)
        view.interact(True)
        for _ in range(5):  # until they know how coarse to be
            view.window.Render()
        view.interact(False)
        frames = []
        while not frames or not mapper.GetConverged():
            frames.append(together(view))
        left = [difference(frame, frames[-1]) for frame in frames[1:]]
        self.assertGreater(left[0], 0.5)
        self.assertGreaterEqual(sum(0 < share < left[0] for share in left), 4)
        for before, after in zip(left, left[1:]):
            self.assertLess(before - after, 0.3 * left[0])
        self.assert_fine(view)


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=0 if RANK else 2).result
    if not result.wasSuccessful():
        sys.exit(1)
