# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Still pictures that are made in several frames, for programs with a window.

import unittest

import numpy as np

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import actor_of, colors_of, difference, sphere


class TestSteps(MapperTest):
    def frames_to_the_end(self, view, mapper):
        for frames in range(1, 400):
            view.window.Render()
            if mapper.GetConverged():
                return frames
        self.fail("it does not converge")

    def test_still_frames_in_steps_end_at_the_same_picture(self):
        expected = show()[0].picture()
        view, mapper = show(ProgressiveStill=1, InteractiveFrameTime=0.001)
        self.assertGreater(self.frames_to_the_end(view, mapper), 1)
        np.testing.assert_array_equal(view.picture(), expected)
        self.assertTrue(mapper.GetConverged())

    def test_a_still_picture_is_made_in_slices_that_add_up_to_it(self):
        settings = {"Method": Mapper.ORDINARY, "Jitter": 1}
        view, mapper = show(ProgressiveStill=1, InteractiveFrameTime=1e-6, **settings)
        whole, _ = show(**settings)
        self.assertGreater(self.frames_to_the_end(view, mapper), 10)
        np.testing.assert_array_equal(view.pixels(), whole.picture())
        # It is kept, and not made again.
        self.assertEqual(self.frames_to_the_end(view, mapper), 1)
        np.testing.assert_array_equal(view.pixels(), whole.pixels())

    def test_what_changes_between_slices_is_in_all_of_them(self):
        def turn(view, _):
            view.camera.Azimuth(10)

        def recolor(view, _):
            view.volume.GetProperty().SetColor(colors_of((0, 1, 0, 0), (1, 0, 1, 0)))

        def add_sphere(view, _):
            view.renderer.AddActor(actor_of(sphere((0, 0, 0), 0.5)))

        changes = (turn, recolor, add_sphere, lambda _, mapper: mapper.SetAmbient(1),
                   lambda _, mapper: mapper.SetMethod(Mapper.OPTIMIZED),
                   lambda _, mapper: mapper.SetShowMissed(1),
                   lambda _, mapper: mapper.SetMissedColor(0, 1, 0),
                   lambda _, mapper: mapper.SetSampleDistance(0.3),
                   lambda _, mapper: mapper.SetShadowStrength(0.1))
        view, mapper = show(ProgressiveStill=1, InteractiveFrameTime=1e-6, Method=Mapper.ORDINARY)
        whole, other = show(Method=Mapper.ORDINARY)
        before = whole.picture()
        self.frames_to_the_end(view, mapper)
        for number, change in enumerate(changes):
            with self.subTest(number):
                view.volume.RotateZ(5)  # begins a picture
                whole.volume.RotateZ(5)
                for _ in range(8):
                    view.window.Render()
                    self.assertFalse(mapper.GetConverged())
                change(view, mapper)
                change(whole, other)
                self.frames_to_the_end(view, mapper)
                after = whole.picture()
                np.testing.assert_array_equal(view.pixels(), after)
                self.assertGreater(difference(before, after), 0)
                before = after

    def test_a_still_picture_for_two_eyes_has_an_end(self):
        view, mapper = show(ProgressiveStill=1, InteractiveFrameTime=1e-6, Method=Mapper.ORDINARY)
        view.window.SetStereoTypeToRedBlue()
        view.window.StereoRenderOn()
        self.frames_to_the_end(view, mapper)

    def test_a_deferred_still_frame_is_like_a_moving_one(self):
        view, mapper = show(ProgressiveStill=1, InteractiveFrameTime=1e-6, DeferStill=1)
        deferred = view.picture()
        self.assertFalse(mapper.GetConverged())
        mapper.DeferStillOff()
        self.frames_to_the_end(view, mapper)
        self.assertGreater(difference(deferred, view.pixels()), 0.5)


if __name__ == "__main__":
    unittest.main()
