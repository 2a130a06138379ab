# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Under pvbatch --symmetric: still pictures that processes make together in several frames.

import sys
import unittest

import numpy as np

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from ranks import RANK, slab_of, together
from volume_views import actor_of, phantom, sphere


def show_piece(**properties):
    """A view of this process's slab of the phantom, with the mapper, and both."""
    whole = phantom(40)
    return show(slab_of(whole), SharesImage=1, WholeExtent=whole.GetExtent(), **properties)


class TestStepsOnRanks(MapperTest):
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
        self.assert_becomes_sharp(view, mapper, lambda: together(view))
        self.assert_fine(view)


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=0 if RANK else 2).result
    if not result.wasSuccessful():
        sys.exit(1)
