# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Still pictures that are made in several frames, for programs with a window.

import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkDataObject

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from images import phantom
from volume_views import actor_of, colors_of, difference, sphere


class TestSteps(MapperTest):
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

    def test_a_coarse_picture_becomes_sharp_little_by_little(self):
        view, mapper = show(ProgressiveStill=1, InteractiveFrameTime=1e-6, EaseTime=0.05,
                            Method=Mapper.ORDINARY)
        self.assert_becomes_sharp(view, mapper, view.picture)
        # Another view has nothing of this one.
        view.camera.Azimuth(40)
        mapper.SetInteractiveFrameTime(10)  # sharp at once
        view.window.Render()
        other, _ = show(Method=Mapper.ORDINARY)
        other.camera.Azimuth(40)
        np.testing.assert_array_equal(view.pixels(), other.picture())

    def assert_never_the_original(self, view, mapper, change):
        """While a change comes in, no frame is nearer to the volume without optimization than to
        the pictures before and after."""
        before = view.pixels()
        change()
        frames = []
        for _ in range(4000):
            frames.append(view.picture())
            if mapper.GetConverged():
                break
        mapper.SetOptimization(Mapper.OFF)
        self.frames_to_the_end(view, mapper)
        original = view.pixels()
        mapper.SetOptimization(Mapper.CONTINUOUS)
        self.assertGreater(len(frames), 3)
        self.assertGreater(difference(original, before), 2)
        for frame in frames:
            optimized = min(difference(frame, before), difference(frame, frames[-1]))
            self.assertLess(optimized, difference(frame, original))

    def test_the_original_is_not_shown_again(self):
        def turn(view, _):
            view.camera.Azimuth(15)

        def edit(view, _):
            view.volume.GetProperty().SetScalarOpacityUnitDistance(0.1)

        def reveal(_, mapper):
            mapper.SetRegularizationWeight(0.01)

        def resize(view, _):
            view.window.SetSize(180, 260)

        for change in (turn, edit, reveal):
            with self.subTest(change.__name__):
                view, mapper = show(ProgressiveStill=1, InteractiveFrameTime=0.001, EaseTime=0.05)
                self.frames_to_the_end(view, mapper)
                self.assert_never_the_original(view, mapper, lambda: change(view, mapper))
        view, mapper = show(ProgressiveStill=1, InteractiveFrameTime=0.001, EaseTime=0.05)
        self.frames_to_the_end(view, mapper)
        optimized = mapper.GetVisibleFraction()
        resize(view, mapper)
        view.window.Render()
        self.assertGreater(mapper.GetVisibleFraction(), 0.8 * optimized)  # of another part

    def test_time_goes_on_steadily_and_edits_do_as_they_say(self):
        def score(coherence, timed):
            view, mapper = show(phantom(24), TemporalCoherence=coherence)
            for step, image in enumerate((phantom(24), phantom(24, 2))):
                image.GetPointData().SetActiveScalars("Scalars")
                if timed:
                    image.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), step)
                mapper.SetInputData(image)
                view.window.Render()
            return mapper.GetVisibilityScore()

        fresh = score(0, True)
        self.assertEqual(score(0.5, False), fresh)
        self.assertNotEqual(score(0.5, True), fresh)

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
