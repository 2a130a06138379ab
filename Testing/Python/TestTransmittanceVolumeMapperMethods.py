# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The methods that the paper compares with, in the mapper: what is drawn, and what it is worth.

import unittest

import numpy as np

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import actor_of, phantom, sphere

RIVALS = {Mapper.VIOLA_2004: "Viola 2004", Mapper.MARCHESIN_2010: "Marchesin 2010",
          Mapper.AMENT_2017: "Ament 2017"}
WITHOUT_SHADOWS = (Mapper.VIOLA_2004, Mapper.MARCHESIN_2010)


def add_veil(view):
    view.renderer.AddActor(actor_of(sphere((0, 0, 0), 0.5), (1, 0, 0), 0.5))
    view.renderer.UseDepthPeelingOn()
    view.renderer.UseDepthPeelingForVolumesOn()
    view.renderer.ResetCameraClippingRange()


class TestMethods(MapperTest):
    def test_draw_something_else_than_ordinary_and_score_it(self):
        ordinary, base = show(phantom(32), Method=Mapper.ORDINARY)
        for method, name in RIVALS.items():
            with self.subTest(method=name):
                view, mapper = show(phantom(32), Method=method)
                picture = view.picture()

                self.assertGreater(np.abs(picture - ordinary.picture()).mean(), 0.5)
                if method != Mapper.AMENT_2017:  # thins out what is half important, too
                    self.assertGreater(mapper.GetVisibilityScore(), base.GetVisibilityScore())
                self.assertAlmostEqual(mapper.GetBaseVisibilityScore(),
                                       base.GetVisibilityScore(), delta=1e-6)
                self.assertTrue(mapper.GetConverged())
                self.assertEqual(mapper.GetMethodName(), name)
                self.assert_sane(view, mapper)
                self.assert_fine(view)

    def test_optimized_shows_most(self):
        view, mapper = show(phantom(32), ProtectImportance=0)
        view.picture()
        best = mapper.GetVisibilityScore()
        for method in RIVALS:
            mapper.SetMethod(method)
            view.picture()
            self.assertLess(mapper.GetVisibilityScore(), best)

    def test_some_cast_no_shadows(self):
        for method, name in RIVALS.items():
            with self.subTest(method=name):
                view, mapper = show(phantom(32), Method=method)
                shaded = view.picture()
                mapper.SetShadowStrength(0)
                changes = bool((view.picture() != shaded).any())
                self.assertEqual(changes, method not in WITHOUT_SHADOWS)

    def test_come_and_go_without_a_trace(self):
        view, mapper = show(phantom(32))
        optimized = view.picture()
        pictures = {}
        for _ in range(2):
            for method in RIVALS:
                mapper.SetMethod(method)
                picture = view.picture()
                np.testing.assert_array_equal(pictures.setdefault(method, picture), picture)
            mapper.SetMethod(Mapper.OPTIMIZED)
            np.testing.assert_array_equal(view.picture(), optimized)
        self.assert_fine(view)

    def test_are_drawn_while_moving(self):
        for method in RIVALS:
            view, mapper = show(phantom(32), Method=method)
            view.window.SetDesiredUpdateRate(15)
            for _ in range(3):
                view.camera.Azimuth(5)
                view.window.Render()
            view.window.SetDesiredUpdateRate(0.01)
            self.assert_sane(view, mapper)
            self.assert_fine(view)
            fresh, _ = show(phantom(32), Method=method)
            fresh.camera.DeepCopy(view.camera)
            np.testing.assert_array_equal(view.picture(), fresh.picture())

    def test_are_ordinary_with_optimization_off(self):
        ordinary, _ = show(phantom(24), Method=Mapper.ORDINARY)
        for method in RIVALS:
            view, _ = show(phantom(24), Method=method, Optimization=Mapper.OFF)
            np.testing.assert_array_equal(view.picture(), ordinary.picture())

    def test_are_ordinary_without_importance_and_say_so(self):
        ordinary, _ = show(phantom(24), Method=Mapper.ORDINARY)
        for method in RIVALS:
            view, mapper = show(phantom(24), Method=method, ImportanceArray="nothing")
            self.assert_says(view, "nothing", "without optimization")
            np.testing.assert_array_equal(view.pixels(), ordinary.picture())
            self.assert_sane(view, mapper)

    def test_that_look_at_whole_rays_say_so_among_translucent_surfaces(self):
        for method in WITHOUT_SHADOWS:
            ordinary, _ = show(phantom(24), Method=Mapper.ORDINARY)
            add_veil(ordinary)
            view, _ = show(phantom(24), Method=method)
            view.messages.clear()
            add_veil(view)
            self.assert_says(view, RIVALS[method], "translucent")
            np.testing.assert_array_equal(view.pixels(), ordinary.picture())

    def test_survive_what_others_do(self):
        for method in RIVALS:
            view, mapper = show(phantom(24), Method=method)
            self.assert_survives_lack_of_memory(view, mapper, "memory")


if __name__ == "__main__":
    unittest.main()
