# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Switching between the optimized volume and the original at rest: both pictures are kept, and come
# back complete with the first frame.

import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPlane

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import actor_of, colors_of, difference, sphere

WINDOW = {"ProgressiveStill": 1, "InteractiveFrameTime": 1e-6, "EaseTime": 0.05}


def results(mapper):
    return [getattr(mapper, "Get" + name)() for name in (
        "Converged", "Settled", "Iterations", "VisibleFraction", "BaseVisibleFraction",
        "VisibilityScore", "SacrificedFraction", "AttainableFraction", "LightDescription",
        "BackendName", "Messages")]


def prepare(mapper):
    """All of the original. Returns the number of calls that it takes."""
    for calls in range(1, 1000):
        if not mapper.PrepareOriginal():
            return calls
    raise AssertionError("the preparation does not end")


class TestOriginal(MapperTest):
    def assert_shows_at_once(self, view, mapper, method, picture):
        mapper.SetMethod(method)
        view.window.Render()
        self.assertTrue(mapper.GetConverged())
        np.testing.assert_array_equal(view.pixels(), picture)

    def settled(self, **settings):
        view, mapper = show(**{**WINDOW, **settings})
        self.frames_to_the_end(view, mapper)
        return view, mapper

    def test_the_first_frame_of_each_switch_is_complete(self):
        for settings in ({}, {"Mode": 1}, {"ShowMissed": 1}, {"TemporalCoherence": 0.5}):
            with self.subTest(**settings):
                original = show(Method=Mapper.ORDINARY, **settings)[0].picture()
                view, mapper = self.settled(**settings)
                optimized, found = view.pixels(), results(mapper)
                self.assertGreater(difference(optimized, original), 1)
                self.assertGreater(prepare(mapper), 3)
                self.assertEqual(prepare(mapper), 1)  # nothing is left
                for _ in range(3):
                    self.assert_shows_at_once(view, mapper, Mapper.ORDINARY, original)
                    self.assertEqual(mapper.GetVisibleFraction(), mapper.GetBaseVisibleFraction())
                    self.assert_shows_at_once(view, mapper, Mapper.OPTIMIZED, optimized)
                    self.assertEqual(results(mapper), found)
                self.assert_fine(view)

    def test_what_is_prepared_is_what_a_frame_would_be(self):
        def measured(prepares):
            view, mapper = self.settled(ShowMissed=1)
            prepares and prepare(mapper)
            mapper.SetMethod(Mapper.ORDINARY)
            self.frames_to_the_end(view, mapper)
            return view.pixels(), results(mapper)

        prepared, made = measured(True), measured(False)
        np.testing.assert_array_equal(prepared[0], made[0])
        self.assertEqual(prepared[1], made[1])

    def test_without_preparation_both_come_back_once_they_were_made(self):
        view, mapper = self.settled()
        optimized = view.pixels()
        mapper.SetMethod(Mapper.ORDINARY)
        self.assertGreater(self.frames_to_the_end(view, mapper), 1)
        original = view.pixels()
        self.assert_shows_at_once(view, mapper, Mapper.OPTIMIZED, optimized)
        self.assert_shows_at_once(view, mapper, Mapper.ORDINARY, original)

    def test_other_methods_come_back_too(self):
        for method in (Mapper.VIOLA_2004, Mapper.MARCHESIN_2010, Mapper.AMENT_2017):
            view, mapper = self.settled(Method=method)
            before = view.pixels()
            prepare(mapper)
            original = show(Method=Mapper.ORDINARY)[0].picture()
            self.assert_shows_at_once(view, mapper, Mapper.ORDINARY, original)
            self.assert_shows_at_once(view, mapper, method, before)

    def test_nothing_is_prepared_of_what_is_not_finished_or_is_the_original(self):
        view, mapper = show(**WINDOW)
        self.assertFalse(mapper.PrepareOriginal())
        view.window.Render()
        self.assertFalse(mapper.GetConverged())
        self.assertFalse(mapper.PrepareOriginal())
        self.frames_to_the_end(view, mapper)
        mapper.SetMethod(Mapper.ORDINARY)
        view.camera.Azimuth(10)
        self.frames_to_the_end(view, mapper)
        turned = view.pixels()
        self.assertFalse(mapper.PrepareOriginal())
        np.testing.assert_array_equal(view.picture(), turned)

    def test_an_interrupted_preparation_leaves_nothing_behind(self):
        view, mapper = self.settled(TemporalCoherence=0)
        for _ in range(3):
            self.assertTrue(mapper.PrepareOriginal())
        view.camera.Azimuth(10)
        self.frames_to_the_end(view, mapper)
        expected, _ = show()
        expected.camera.Azimuth(10)
        np.testing.assert_array_equal(view.pixels(), expected.picture())

    def test_what_moves_afterwards_does_not_begin_at_the_original(self):
        for pressed in (False, True):
            view, mapper = self.settled(EaseTime=100, InteractiveFrameTime=10)
            prepare(mapper)
            for method in (Mapper.ORDINARY, Mapper.OPTIMIZED) if pressed else ():
                mapper.SetMethod(method)
                view.window.Render()
            view.interact(True)
            view.camera.Azimuth(1)
            moved = view.picture()
            ordinary, _ = show(Method=Mapper.ORDINARY, InteractiveFrameTime=10)
            ordinary.interact(True)
            ordinary.camera.Azimuth(1)
            fresh, _ = show(InteractiveFrameTime=10)
            fresh.camera.Azimuth(1)
            optimized = fresh.picture()
            self.assertLess(difference(moved, optimized),
                            0.5 * difference(moved, ordinary.picture()))

    def test_what_changes_afterwards_begins_at_what_was_shown(self):
        for pressed in (False, True):
            with self.subTest(pressed=pressed):
                view, mapper = self.settled()
                before = view.pixels()
                prepare(mapper)
                for method in (Mapper.ORDINARY, Mapper.OPTIMIZED) if pressed else ():
                    mapper.SetMethod(method)
                    view.window.Render()
                mapper.SetEaseTime(100)
                mapper.SetInteractiveFrameTime(10)  # all iterations in one frame
                mapper.SetEmphasis(1)
                mapper.SetProtectImportance(0)
                first = view.picture()
                after = show(Emphasis=1, ProtectImportance=0)[0].picture()
                self.assertFalse(mapper.GetConverged())
                self.assertLess(difference(first, before), 0.5 * difference(first, after))

    def test_what_changes_meanwhile_is_in_both(self):
        def clip(_, mapper):
            plane = vtkPlane()
            plane.SetNormal(1, 0.3, 0.2)
            mapper.AddClippingPlane(plane)

        changes = {
            "turn": lambda view, _: view.camera.Azimuth(10),
            "recolor": lambda view, _: view.volume.GetProperty().SetColor(
                colors_of((0, 1, 0, 0), (1, 0, 1, 0))),
            "edit": lambda view, _: view.volume.GetProperty().SetScalarOpacityUnitDistance(0.1),
            "sphere": lambda view, _: view.renderer.AddActor(actor_of(sphere((0, 0, 0), 0.5))),
            "scale": lambda view, _: view.volume.SetScale(0.8),
            "size": lambda view, _: view.window.SetSize(120, 90),
            "clip": clip,
            "ambient": lambda _, mapper: mapper.SetAmbient(1),
            "shadows": lambda _, mapper: mapper.ShadowsOff(),
            "missed": lambda _, mapper: mapper.SetShowMissed(1),
            "distance": lambda _, mapper: mapper.SetSampleDistance(0.3),
            "weight": lambda _, mapper: mapper.SetRegularizationWeight(0.01)}
        for name, change in changes.items():
            with self.subTest(name):
                view, mapper = self.settled(TemporalCoherence=0)
                prepare(mapper)
                mapper.SetMethod(Mapper.ORDINARY)
                view.window.Render()
                change(view, mapper)
                for method in (Mapper.ORDINARY, Mapper.OPTIMIZED, Mapper.ORDINARY):
                    mapper.SetMethod(method)
                    self.frames_to_the_end(view, mapper)
                    prepare(mapper)
                    whole, other = show(Method=method, TemporalCoherence=0)
                    change(whole, other)
                    np.testing.assert_array_equal(view.pixels(), whole.picture())

    def test_a_pause_is_not_forgotten(self):
        view, mapper = self.settled()
        mapper.PauseOptimizationOn()
        view.camera.Azimuth(20)
        self.frames_to_the_end(view, mapper)
        paused = view.pixels()
        prepare(mapper)
        mapper.SetMethod(Mapper.ORDINARY)
        view.window.Render()
        self.assert_shows_at_once(view, mapper, Mapper.OPTIMIZED, paused)
        mapper.PauseOptimizationOff()
        self.frames_to_the_end(view, mapper)
        self.assertGreater(difference(view.pixels(), paused), 0)

    def test_memory_that_was_given_back_comes_again(self):
        view, mapper = self.settled()
        optimized = view.pixels()
        prepare(mapper)
        mapper.ReleaseMemory()
        self.assertFalse(mapper.PrepareOriginal())
        self.frames_to_the_end(view, mapper)
        np.testing.assert_array_equal(view.pixels(), optimized)


if __name__ == "__main__":
    unittest.main()
