# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Large still pictures: their progress, and aborts by its observers.

import unittest

import numpy as np

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import actor_of, sphere

# Takes much longer than the time between two reports.
LARGE = {"size": (600, 600), "SampleDistance": 0.02}


class Progress:
    """The shares of its rays that a mapper reports; aborts at the call of this number, from 1."""

    def __init__(self, mapper, abort_at=0):
        self.mapper, self.abort_at, self.told = mapper, abort_at, []
        self.tag = mapper.AddObserver("ProgressEvent", self.note)

    def note(self, *_):
        self.told.append(self.mapper.GetProgress())
        if len(self.told) == self.abort_at:
            self.mapper.SetAbortExecute(1)

    def stop(self):
        self.mapper.RemoveObserver(self.tag)
        return self.told


def during(mapper, act):
    progress = Progress(mapper)
    result = act()
    return progress.stop(), result


class TestProgress(MapperTest):
    def test_a_still_picture_tells_the_share_of_its_rays(self):
        view, mapper = show(Method=Mapper.ORDINARY, **LARGE)
        told, _ = during(mapper, view.window.Render)
        self.assertEqual(told, sorted(told))
        self.assertEqual(told[0], 0)
        self.assertGreater(told[-1], 0.1)
        self.assertLessEqual(told[-1], 1)

    def test_frames_that_are_short_tell_nothing(self):
        for settings in ({}, {"ProgressiveStill": 1, "InteractiveFrameTime": 1e-6}):
            with self.subTest(**settings):
                view, mapper = show(**settings)
                view.interact(not settings)
                self.assertEqual(during(mapper, view.window.Render)[0], [])

    def test_several_pictures_of_a_frame_do_not_begin_again(self):
        view, mapper = show(ShowMissed=1, **LARGE)
        view.renderer.AddActor(actor_of(sphere((0, 0, 0), 0.3)))
        told, _ = during(mapper, view.window.Render)
        self.assertEqual(told, sorted(told))


class TestAbort(MapperTest):
    def test_the_first_report_aborts_and_the_window_keeps_its_picture(self):
        view, mapper = show(Method=Mapper.ORDINARY)
        view.picture()
        view.camera.Azimuth(10)
        progress = Progress(mapper, abort_at=1)
        view.window.Render()
        self.assertEqual(len(progress.stop()), 1)
        self.assertTrue(view.window.GetAbortRender())
        self.assertFalse(mapper.GetConverged())
        turned, _ = show(Method=Mapper.ORDINARY)
        turned.camera.Azimuth(10)
        np.testing.assert_array_equal(view.picture(), turned.picture())
        self.assertTrue(mapper.GetConverged())
        self.assert_fine(view)

    def test_an_abort_at_any_report_leaves_nothing_behind(self):
        for method in (Mapper.ORDINARY, Mapper.OPTIMIZED):
            view, mapper = show(Method=method, size=(200, 200), SampleDistance=0.1)
            expected = view.picture()
            for number in range(1, 8):
                mapper.Reset()
                progress = Progress(mapper, abort_at=number)
                view.window.Render()
                told = progress.stop()
                self.assertLessEqual(len(told), number)
                self.assertEqual(mapper.GetConverged(), len(told) < number)
                np.testing.assert_array_equal(view.picture(), expected)
            self.assert_fine(view)

    def test_an_abort_is_over_with_its_frame(self):
        view, mapper = show(Method=Mapper.ORDINARY)
        mapper.SetAbortExecute(1)  # before a frame, it says nothing of it
        told, _ = during(mapper, view.window.Render)
        self.assertGreater(len(told), 0)
        self.assertTrue(mapper.GetConverged())


if __name__ == "__main__":
    unittest.main()
