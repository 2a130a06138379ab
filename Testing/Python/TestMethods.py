# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The methods that the paper compares with, in the filter: what comes out, and what it says when
# something is wrong.

import unittest

import numpy as np

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer as Optimizer, vtkViewpointSearch

from images import FilterTest, filter_on, phantom, values

METHODS = (Optimizer.OPTIMIZED, Optimizer.ORDINARY, Optimizer.VIOLA_2004, Optimizer.MARCHESIN_2010,
           Optimizer.AMENT_2017)


def optimizer(image, method, **properties):
    return filter_on(image, Optimizer, CameraPosition=(4, 3, 2), LightPosition=(-3, 4, 5),
                     Method=method, **properties)


def number(image, name):
    return image.GetFieldData().GetArray(name).GetTuple1(0)


class TestMethods(FilterTest):
    def run_method(self, method, image=None, **properties):
        result = optimizer(image or phantom(), method, **properties)
        result.Update()
        self.assert_no_error(result)
        return result.GetOutput()

    def test_all_of_them_tell_score_fractions_and_energy(self):
        for method in METHODS:
            with self.subTest(method=method):
                output = self.run_method(method)
                for name in ("VisibilityScore", "VisibleFraction", "SacrificedFraction"):
                    self.assertTrue(np.isfinite(number(output, name)))
                self.assertLessEqual(number(output, "VisibleFraction"), 1)
                self.assertLess(number(output, "Energy"), 0)

    def test_have_the_table_of_one_pass(self):
        for method in METHODS[1:]:
            result = optimizer(phantom(), method, ImportanceSmoothing=1)
            result.Update()
            self.assertEqual(number(result.GetOutput(), "Settled"), 1)
            table = result.GetConvergence()
            scores = [table.GetColumnByName("VisibilityScore").GetValue(row) for row in (0, 1)]
            self.assertEqual(scores, [number(result.GetOutput(), "BaseVisibilityScore"),
                                      number(result.GetOutput(), "VisibilityScore")])

    def test_optimized_shows_most(self):
        # Smoothing costs energy.
        shown = {method: self.run_method(method, Smoothness=0) for method in METHODS}

        best = shown.pop(Optimizer.OPTIMIZED)
        for other in shown.values():
            self.assertGreater(number(best, "VisibilityScore"), number(other, "VisibilityScore"))
            self.assertLess(number(best, "Energy"), number(other, "Energy"))

    def test_ordinary_and_marchesin_leave_the_extinction(self):
        for method in (Optimizer.ORDINARY, Optimizer.MARCHESIN_2010):
            output = self.run_method(method)
            np.testing.assert_array_equal(
                values(output, "Extinction"), values(output, "BaseExtinction"))
        ordinary = self.run_method(Optimizer.ORDINARY)
        self.assertAlmostEqual(number(ordinary, "VisibilityScore"),
                               number(ordinary, "BaseVisibilityScore"), places=9)

    def test_viola_and_ament_only_take_away(self):
        for method in (Optimizer.VIOLA_2004, Optimizer.AMENT_2017):
            output = self.run_method(method)
            base, shown = values(output, "BaseExtinction"), values(output, "Extinction")
            self.assertTrue((shown <= base).all())
            self.assertTrue((shown < base).any())

    def test_ament_has_an_extinction_for_the_light(self):
        output = self.run_method(Optimizer.AMENT_2017)

        self.assertTrue((values(output, "LightExtinction") != values(output, "Extinction")).any())
        for method in METHODS[:4]:
            data = self.run_method(method).GetPointData()
            self.assertIsNone(data.GetArray("LightExtinction"))

    def test_ament_is_ordinary_without_importance(self):
        image = phantom()
        values(image, "Importance")[:] = 0
        output = self.run_method(Optimizer.AMENT_2017, image, AmentBackground=5)

        np.testing.assert_array_equal(
            values(output, "Extinction"), values(output, "BaseExtinction"))

    def test_every_parameter_of_ament_does_something(self):
        plain = values(self.run_method(Optimizer.AMENT_2017), "Extinction")
        for name, value in dict(AmentExponent=2, AmentRegularization=3, AmentOccluders=5,
                                AmentBackground=5, AmentSmoothing=3).items():
            other = self.run_method(Optimizer.AMENT_2017, **{name: value})
            self.assertTrue((values(other, "Extinction") != plain).any(), name)
        light = values(self.run_method(Optimizer.AMENT_2017), "LightExtinction")
        for name in ("AmentLightOccluders", "AmentLightBackground"):
            other = self.run_method(Optimizer.AMENT_2017, **{name: 5})
            self.assertTrue((values(other, "LightExtinction") != light).any(), name)
            np.testing.assert_array_equal(values(other, "Extinction"), plain)

    def test_do_not_depend_on_the_settings_of_the_solver(self):
        for method in METHODS[1:]:
            plain = self.run_method(method)
            other = self.run_method(method, Solver=1, MaximumIterations=0, ProtectImportance=1,
                                    Smoothness=0.5, WarmStart=1, RegularizationWeight=0.5)
            np.testing.assert_array_equal(
                values(other, "Extinction"), values(plain, "Extinction"))
            self.assertEqual(number(other, "VisibilityScore"), number(plain, "VisibilityScore"))

    def test_say_what_is_wrong(self):
        nan = np.nan  # the settings themselves move other numbers into their ranges
        for name, value in dict(AmentExponent=nan, AmentRegularization=0, AmentOccluders=nan,
                                AmentBackground=nan, AmentLightOccluders=nan,
                                AmentLightBackground=nan).items():
            with self.subTest(name=name):
                filter_ = optimizer(phantom(), Optimizer.AMENT_2017)
                getattr(filter_, "Set" + name)(value)
                self.assert_refuses(str(value), filter_=filter_)

    def test_do_not_move_cameras(self):
        self.assert_refuses("Ament 2017", "OptimizeViewpoint", filter_=optimizer(
            phantom(), Optimizer.AMENT_2017, OptimizeViewpoint=1))
        self.assert_refuses("Viola 2004", "Optimized", filter_=filter_on(
            phantom(), vtkViewpointSearch, Method=2, Field=3, NumberOfDirections=12))


if __name__ == "__main__":
    unittest.main()
