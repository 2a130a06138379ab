# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Large still pictures: their progress, aborts by its observers, and tiles that are drawn again over
# another background. Only rays make progress, so a frame without any has cast none.

import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import actor_of, colors_of, opacity_of, phantom, sphere

WHITE, BLACK = (1, 1, 1), (0, 0, 0)
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
                mapper.Update()  # which has a progress of its own
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


class TestKeptTiles(MapperTest):
    def assert_casts(self, mapper, act, casts):
        told, result = during(mapper, act)
        self.assertEqual(bool(told), casts)
        return result

    def test_the_same_picture_casts_no_rays_again(self):
        for settings in ({"Method": Mapper.ORDINARY}, {}, {"Method": Mapper.VIOLA_2004},
                         {"ShowMissed": 1}):
            with self.subTest(**settings):
                view, mapper = show(**settings)
                expected = self.assert_casts(mapper, view.picture, True)
                found = mapper.GetVisibleFraction(), mapper.GetConverged()
                again = self.assert_casts(mapper, view.picture, False)
                np.testing.assert_array_equal(again, expected)
                self.assertEqual((mapper.GetVisibleFraction(), mapper.GetConverged()), found)
                mapper.Reset()
                np.testing.assert_array_equal(
                    self.assert_casts(mapper, view.picture, True), expected)

    def test_it_is_blended_over_another_background(self):
        view, mapper = show()
        view.renderer.AddActor(actor_of(sphere((0, 0, 0), 0.3)))
        view.picture()
        view.renderer.SetBackground(*WHITE)
        fresh, _ = show()
        fresh.renderer.AddActor(actor_of(sphere((0, 0, 0), 0.3)))
        fresh.renderer.SetBackground(*WHITE)
        np.testing.assert_array_equal(
            self.assert_casts(mapper, view.picture, False), fresh.picture())

    def test_what_changes_the_picture_casts_them_again(self):
        def other_colors(view, _):
            view.volume.GetProperty().SetColor(colors_of((0, 1, 0, 0), (1, 0, 1, 0)))

        def other_opacity(view, _):
            view.volume.GetProperty().SetScalarOpacity(opacity_of((0, 0), (1, 0.4)))

        changes = {
            "camera": lambda view, _: view.camera.Azimuth(5),
            "place": lambda view, _: view.volume.SetPosition(0.05, 0, 0),
            "size": lambda view, _: view.window.SetSize(170, 150),
            "colors": other_colors,
            "opacity": other_opacity,
            "samples": lambda _, mapper: mapper.SetSampleDistance(0.7),
            "jitter": lambda _, mapper: mapper.SetJitter(1),
            "ambient": lambda _, mapper: mapper.SetAmbient(0.9),
            "weight": lambda _, mapper: mapper.GetVisibilitySettings().SetViewWeight(30),
            "missed": lambda _, mapper: mapper.SetShowMissed(1),
            "method": lambda _, mapper: mapper.SetMethod(Mapper.MARCHESIN_2010),
            "data": lambda _, mapper: mapper.SetInputData(phantom(24)),
            "crop": lambda _, mapper: (mapper.SetCropping(1),
                                       mapper.SetCroppingRegionPlanes(0, 0.4, 0, 1, 0, 1)),
            "geometry": lambda view, _: view.renderer.AddActor(actor_of(sphere((0, 0, 0), 0.3))),
        }
        for name, change in changes.items():
            with self.subTest(change=name):
                view, mapper = show(TemporalCoherence=0)
                view.picture()
                change(view, mapper)
                changed = self.assert_casts(mapper, view.picture, True)
                fresh, another = show(TemporalCoherence=0)
                change(fresh, another)
                np.testing.assert_array_equal(changed, fresh.picture())

    def test_tiles_over_two_backgrounds_are_cast_once(self):
        def capture(view):
            tiles = vtkWindowToImageFilter()
            tiles.SetInput(view.window)
            tiles.SetScale(3)
            tiles.Update()
            return vtk_to_numpy(tiles.GetOutput().GetPointData().GetScalars()).copy()

        def over(background):
            view, mapper = show()
            view.renderer.SetBackground(*background)
            return view, mapper

        view, mapper = over(WHITE)
        white = self.assert_casts(mapper, lambda: capture(view), True)
        view.renderer.SetBackground(*BLACK)
        black = self.assert_casts(mapper, lambda: capture(view), False)
        np.testing.assert_array_equal(white, capture(over(WHITE)[0]))
        np.testing.assert_array_equal(black, capture(over(BLACK)[0]))

    def test_only_finished_pictures_stay_when_memory_is_given_back(self):
        for act in (lambda _, mapper: mapper.ReleaseMemory(),
                    lambda view, _: view.window.Finalize()):
            view, mapper = show()
            expected = view.picture()
            act(view, mapper)
            np.testing.assert_array_equal(self.assert_casts(mapper, view.picture, False), expected)
            view.camera.Azimuth(10)
            turned = self.assert_casts(mapper, view.picture, True)
            other, _ = show()
            other.camera.Azimuth(10)
            np.testing.assert_array_equal(turned, other.picture())


if __name__ == "__main__":
    unittest.main()
