# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# One extinction for several views: the filter's, and the display's while a camera goes round.

import unittest

import numpy as np
from vtkmodules.vtkRenderingCore import vtkLight

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from images import FilterTest, filter_on, phantom, values
from mapper_tests import MapperTest, show


def optimizer(**properties):
    return filter_on(phantom(24), vtkExtinctionOptimizer, **{
        "Preset": "Paper", "CameraPosition": (4, 3, 2), "LightPosition": (-3, 4, 5), **properties})


def score(result, name="VisibilityScore"):
    return result.GetOutput().GetFieldData().GetArray(name).GetTuple1(0)


class TestFilter(FilterTest):
    def run_filter(self, **properties):
        result = optimizer(**properties)
        result.Update()
        self.assert_no_error(result)
        return result

    def test_scores_are_means_over_the_orbit(self):
        turned = [(4, 3, 2), (2, 3, -4), (-4, 3, -2), (-2, 3, 4)]  # about y
        single = [self.run_filter(CameraPosition=position) for position in turned]
        orbit = self.run_filter(Views=vtkExtinctionOptimizer.ORBIT, NumberOfViews=4)

        base = [score(result, "BaseVisibilityScore") for result in single]
        self.assertAlmostEqual(score(orbit, "BaseVisibilityScore") / np.mean(base), 1, places=5)
        best = np.mean([score(result) for result in single])
        self.assertLess(score(orbit), best)
        self.assertGreater(score(orbit), 0.5 * (np.mean(base) + best))

    def test_one_view_is_that_of_the_camera(self):
        single = self.run_filter()
        orbit = self.run_filter(Views=vtkExtinctionOptimizer.ORBIT, NumberOfViews=1)
        np.testing.assert_array_equal(values(orbit.GetOutput(), "Extinction"),
                                      values(single.GetOutput(), "Extinction"))

    def test_both_eyes_see_nearly_what_the_camera_sees(self):
        single = self.run_filter()
        pair = self.run_filter(Views=vtkExtinctionOptimizer.STEREO_PAIR, EyeAngle=1)
        self.assertAlmostEqual(score(pair) / score(single), 1, delta=0.03)
        self.assertEqual(pair.GetOutput().GetFieldData().GetArray("CameraPosition").GetTuple3(0),
                         (4, 3, 2))

    def test_an_iteration_is_for_one_view(self):
        limited = self.run_filter(Views=vtkExtinctionOptimizer.ORBIT, NumberOfViews=3,
                                  MaximumIterations=2, Tolerance=0)
        self.assertEqual(score(limited, "Iterations"), 6)

    def test_other_methods_are_for_the_camera(self):
        for method in (vtkExtinctionOptimizer.VIOLA_2004, vtkExtinctionOptimizer.AMENT_2017):
            single = self.run_filter(Method=method)
            orbit = self.run_filter(Method=method, Views=vtkExtinctionOptimizer.ORBIT)
            np.testing.assert_array_equal(values(orbit.GetOutput(), "Extinction"),
                                          values(single.GetOutput(), "Extinction"))

    def test_says_what_cannot_be(self):
        orbit = {"Views": vtkExtinctionOptimizer.ORBIT}
        self.assert_refuses("eye angle is 180", filter_=optimizer(
            EyeAngle=180, Views=vtkExtinctionOptimizer.STEREO_PAIR))
        self.assert_refuses("only a single camera can be optimised",
                            filter_=optimizer(OptimizeViewpoint=1, **orbit))


class TestMapper(MapperTest):
    def test_nothing_changes_while_a_camera_goes_round(self):
        view, mapper = show(Views=Mapper.ORBIT, NumberOfViews=4, TemporalCoherence=0)
        first = view.picture()
        iterations = mapper.GetIterations()
        self.assertGreater(iterations, 4)
        for degrees in (10, 80, 133):
            view.camera.Azimuth(degrees)
            view.window.Render()
            self.assertEqual(mapper.GetIterations(), iterations)
        view.camera.Azimuth(137)
        np.testing.assert_allclose(view.picture(), first, atol=1)  # to rounding
        view.camera.Elevation(20)
        view.window.Render()
        fresh, other = show(Views=Mapper.ORBIT, NumberOfViews=4, TemporalCoherence=0)
        fresh.camera.Elevation(20)
        np.testing.assert_allclose(view.picture(), fresh.picture(), atol=1)
        self.assertEqual(mapper.GetIterations(), other.GetIterations())
        self.assert_fine(view)

    def test_the_score_is_that_of_the_camera(self):
        view, mapper = show(Views=Mapper.ORBIT, NumberOfViews=4, Emphasis=1)
        scores = set()
        for _ in range(3):
            view.window.Render()
            scores.add(mapper.GetVisibilityScore())
            self.assert_sane(view, mapper)
            self.assertGreater(mapper.GetVisibilityScore(), 1.2 * mapper.GetBaseVisibilityScore())
            view.camera.Azimuth(50)
        self.assertEqual(len(scores), 3)

    def test_a_light_of_the_scene_counts(self):
        def picture(place):
            view, _ = show(Views=Mapper.ORBIT, NumberOfViews=3)
            light = vtkLight()
            light.SetPosition(place)
            light.PositionalOn()
            view.renderer.RemoveAllLights()
            view.renderer.AddLight(light)
            view.window.Render()
            return view.volume.GetMapper().GetVisibilityScore()

        self.assertNotEqual(picture((9, 9, 9)), picture((-9, -9, 9)))


if __name__ == "__main__":
    unittest.main()
