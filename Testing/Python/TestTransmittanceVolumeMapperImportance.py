# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Where the mapper takes from what is important.

import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkDataObject

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer, vtkViewpointSearch

from images import filter_on
from mapper_tests import MapperTest, show
from volume_views import opacity_of, phantom, phantom_property, values


class TestImportance(MapperTest):
    def test_importance_is_mapped_by_a_function(self):
        image = phantom()
        view, mapper = show(image, ImportanceArray="Scalars", UseImportanceFunction=1,
                            ImportanceFunction=opacity_of((0.6, 0), (0.8, 1)))
        view.window.Render()
        expected = mapper.GetVisibilityScore()
        self.assertGreater(expected, 0)

        mapped = np.interp(values(image, "Scalars"), (0.6, 0.8), (0, 1)).astype(np.float32)
        array = numpy_to_vtk(mapped, deep=1)
        array.SetName("mapped")
        image.GetPointData().AddArray(array)
        mapper.UseImportanceFunctionOff()
        mapper.SetImportanceArray("mapped")
        view.window.Render()
        self.assertAlmostEqual(mapper.GetVisibilityScore(), expected, delta=1e-4 * expected)

        # Without a name and without an array "Importance", it maps the scalars.
        image.GetPointData().RemoveArray("Importance")
        mapper.UseImportanceFunctionOn()
        mapper.SetImportanceArray("")
        view.window.Render()
        self.assertAlmostEqual(mapper.GetVisibilityScore(), expected, delta=1e-4 * expected)
        mapper.SetImportanceFunction(opacity_of((0.1, 0), (0.2, 1)))
        view.window.Render()
        self.assertNotEqual(mapper.GetVisibilityScore(), expected)
        self.assert_fine(view)

    def test_the_function_of_the_importance_can_be_switched_off_and_on(self):
        view, mapper = show(phantom(16), ImportanceArray="Scalars",
                            ImportanceFunction=opacity_of((0.6, 0), (0.8, 1)))
        scores = {}
        for use in (1, 0, 1):
            mapper.SetUseImportanceFunction(use)
            view.window.Render()
            self.assertEqual(scores.setdefault(use, mapper.GetBaseVisibilityScore()),
                             mapper.GetBaseVisibilityScore())
        self.assertNotEqual(scores[0], scores[1])

    def test_what_is_assumed_counts_where_nothing_says_what_is_important(self):
        image = phantom(16)
        function = opacity_of((0.6, 0), (0.8, 1))
        view, mapper = show(image, AssumedImportance=opacity_of((0.1, 0), (0.2, 1)))
        view.window.Render()
        own = mapper.GetBaseVisibilityScore()
        mapper.SetAssumedImportance(function)
        view.window.Render()
        self.assertEqual(mapper.GetBaseVisibilityScore(), own, "it has an array of its own")

        image.GetPointData().RemoveArray("Importance")
        view.window.Render()
        assumed = mapper.GetBaseVisibilityScore()
        mapper.SetImportanceFunction(function)
        mapper.UseImportanceFunctionOn()
        mapper.SetAssumedImportance(None)
        view.window.Render()
        self.assertEqual(mapper.GetBaseVisibilityScore(), assumed)
        self.assert_fine(view)

    def test_the_largest_scalars_count_where_nothing_says_what_is_important(self):
        image = phantom(16)
        image.GetPointData().RemoveArray("Importance")
        ordered = np.sort(values(image, "Scalars").astype(float))
        ends = [ordered[int(share * (ordered.size - 1))] for share in (0.95, 0.99)]
        function = opacity_of((ends[0], 0), (ends[1], 1))
        view, mapper = show(image, UseImportanceFunction=1, ImportanceFunction=function)
        view.window.Render()
        expected = mapper.GetVisibilityScore()
        self.assertGreater(expected, 0)
        self.assert_fine(view)

        mapper.UseImportanceFunctionOff()
        view.window.Render()
        self.assertEqual(mapper.GetVisibilityScore(), expected)
        self.assertIn(f"from {ends[0]:g} (0) to {ends[1]:g} (1)", mapper.GetMessages())
        mapper.SetImportanceArray("Scalars")
        view.window.Render()
        self.assertNotEqual(mapper.GetVisibilityScore(), expected, "its values are importance")
        mapper.SetImportanceArray("")
        mapper.SetOptimization(mapper.OFF)
        view.window.Render()
        self.assertEqual(mapper.GetMessages(), "", "nothing is made of it but the score")
        self.assertGreater(mapper.GetVisibilityScore(), 0)

    def test_nothing_is_assumed_for_a_score_that_nobody_asks_for(self):
        image = phantom(16)
        image.GetPointData().RemoveArray("Importance")
        view, mapper = show(image, Optimization=0)
        view.window.Render()
        self.assertFalse(mapper.GetMeasured())
        self.assertEqual(mapper.GetVisibilityScore(), 0)
        plain = view.pixels()

        mapper.SetShowMissed(1)
        view.window.Render()
        mapper.SetShowMissed(0)
        view.window.Render()
        self.assertTrue(mapper.GetMeasured(), "it is there now")
        self.assertGreater(mapper.GetVisibilityScore(), 0)
        np.testing.assert_array_equal(view.pixels(), plain)

        asked, mapper = show(image, Optimization=0, UseImportanceFunction=1,
                             ImportanceFunction=opacity_of((0.6, 0), (0.8, 1)))
        asked.window.Render()
        self.assertTrue(mapper.GetMeasured())

    def test_filter_search_and_mapper_assume_the_same(self):
        image = phantom(24)
        image.GetPointData().RemoveArray("Importance")
        shown = phantom_property()

        def run(filter_class, **properties):
            result = filter_on(image, filter_class, ScalarOpacityFunction=shown.GetScalarOpacity(),
                               ExtinctionSource=filter_class.OPACITY_FUNCTION,
                               ScalarOpacityUnitDistance=shown.GetScalarOpacityUnitDistance(),
                               **properties)
            result.Update()
            self.assertEqual(result.messages["ErrorEvent"], [])
            self.assertEqual(len(result.messages["WarningEvent"]), 1)
            return result.GetOutput(), result.messages["WarningEvent"][0]

        searched, told_by_search = run(vtkViewpointSearch, Field=vtkViewpointSearch.BASE_EXTINCTION,
                                       NumberOfDirections=12)
        camera = {name: tuple(values(searched, name)[5])
                  for name in ("CameraPosition", "CameraFocalPoint", "CameraViewUp")}
        optimized, told = run(vtkExtinctionOptimizer, MaximumIterations=0, RayDensity=3, **camera)
        view, mapper = show(image, shown, RestrictToView=0, Shadows=0, RayDensity=3)
        for name, place in camera.items():
            getattr(view.camera, "Set" + name.replace("Camera", ""))(*place)
        view.renderer.ResetCameraClippingRange()
        view.window.Render()

        score = optimized.GetFieldData().GetArray("BaseVisibilityScore").GetValue(0)
        self.assertGreater(score, 0)
        self.assertAlmostEqual(mapper.GetBaseVisibilityScore(), score, delta=1e-3 * score)
        # The search has rays at other places, see TestViewpointSearch.
        self.assertAlmostEqual(values(searched, "VisibilityScore")[5], score, delta=1e-2 * score)
        ramp = told[told.index("from "):told.index(" (1)")]
        for text in (told_by_search, mapper.GetMessages()):
            self.assertIn(ramp, text)

    def test_a_named_scalar_array_gets_what_is_assumed_of_it(self):
        image = phantom(16)
        function = opacity_of((0.6, 0), (0.8, 1))
        view, mapper = show(image, ImportanceArray="Scalars", AssumedImportance=function)
        mapper.SelectScalarArray("Scalars")
        mapper.SetScalarModeToUsePointFieldData()
        view.window.Render()
        assumed = mapper.GetBaseVisibilityScore()
        mapper.SetAssumedImportance(None)
        mapper.SetImportanceFunction(function)
        mapper.UseImportanceFunctionOn()
        view.window.Render()
        self.assertEqual(mapper.GetBaseVisibilityScore(), assumed)
        self.assert_fine(view)

    def test_importance_of_cells(self):
        image = phantom()
        importance = values(image, "Importance").reshape(32, 32, 32)
        cells = importance[:-1, :-1, :-1].ravel()
        array = numpy_to_vtk(cells, deep=1)
        array.SetName("Importance")
        image.GetCellData().AddArray(array)
        view, mapper = show(image)
        view.window.Render()
        of_points = mapper.GetVisibilityScore()
        mapper.SetImportanceArrayAssociation(vtkDataObject.FIELD_ASSOCIATION_CELLS)
        view.window.Render()
        self.assertNotEqual(mapper.GetVisibilityScore(), of_points)
        self.assertGreater(mapper.GetVisibilityScore(), 0)
        self.assert_fine(view)


if __name__ == "__main__":
    unittest.main()
