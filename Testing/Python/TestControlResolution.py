# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The change of the extinction on a coarser grid than the data, as is chosen or as memory allows.

import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer

from images import FilterTest, filter_on, function_of, image_of, phantom, values
from mapper_tests import MapperTest, show
from volume_views import difference
from volume_views import phantom as volume

FULL, HALF, QUARTER = 1, 2, 3
ALL = ("Extinction", "Opacity", "BaseExtinction", "Importance", "Transmittance",
       "LightTransmittance", "MissedImportance")
OF_SWEEPS = ("Transmittance", "LightTransmittance", "MissedImportance")


def number(output, name):
    return output.GetFieldData().GetArray(name).GetTuple1(0)


def names_of(output):
    arrays = output.GetPointData()
    return {arrays.GetArrayName(index) for index in range(arrays.GetNumberOfArrays())}


class TestFilter(FilterTest):
    def run_filter(self, image=None, **properties):
        result = filter_on(image or phantom(32), vtkExtinctionOptimizer, **properties)
        result.Update()
        self.assert_no_error(result)
        return result

    def test_has_results_at_all_points_and_scores_of_them(self):
        full, half, quarter = (
            self.run_filter(phantom(64), ControlResolution=resolution).GetOutput()
            for resolution in (FULL, HALF, QUARTER))

        for output, factor in ((full, 1), (half, 2), (quarter, 4)):
            self.assertEqual(number(output, "ControlFactor"), factor)
            self.assertEqual(number(output, "BaseVisibilityScore"),
                             number(full, "BaseVisibilityScore"))
            self.assertEqual(number(output, "AttainableScore"), number(full, "AttainableScore"))
            self.assertGreater(number(output, "VisibleFraction"),
                               number(output, "BaseVisibleFraction"))
            for name in ALL:
                self.assertEqual(values(output, name).shape, values(full, name).shape)
        # The fewer nodes, the less can be shown.
        self.assertGreater(number(full, "VisibleFraction"), number(half, "VisibleFraction"))
        self.assertGreater(number(half, "VisibleFraction"), number(quarter, "VisibleFraction"))
        self.assertGreater(number(half, "VisibleFraction"), 0.9 * number(full, "VisibleFraction"))

    def test_records_its_iterations(self):
        result = self.run_filter(ControlResolution=HALF)
        rows = result.GetConvergence().GetNumberOfRows()
        self.assertEqual(rows, number(result.GetOutput(), "Iterations") + 1)

    def test_takes_what_fits_and_says_so(self):
        result = self.run_filter(MemoryLimit=32**3 * 25e-6)  # 25 bytes a point
        output = result.GetOutput()

        self.assertGreater(number(output, "ControlFactor"), 1)
        self.assertEqual(len(result.messages["WarningEvent"]), 1)
        warning = result.messages["WarningEvent"][0]
        for word in ("resolution: ", "GB", "MemoryLimit", *OF_SWEEPS):
            self.assertIn(word, warning)
        for name in OF_SWEEPS:
            self.assertNotIn(name, names_of(output))
        self.assertTrue((values(output, "Extinction") <= values(output, "BaseExtinction")).all())
        self.assertGreater(number(output, "VisibleFraction"), number(output, "BaseVisibleFraction"))

    def test_converts_fields_in_layers_where_they_do_not_fit(self):
        scalars = np.random.default_rng(3).random(40**3).astype(np.float32)
        scalars[5::301] = np.nan
        arrays = {"BaseExtinction": 0.3 * scalars - 0.001, "Importance": 1.001 * scalars}
        functions = {"ExtinctionSource": vtkExtinctionOptimizer.OPACITY_FUNCTION,
                     "ScalarOpacityFunction": function_of((0, 0), (1, 0.4)),
                     "ImportanceFunction": function_of((0.5, 0), (1, 1)),
                     "UseImportanceFunction": 1}
        for properties in ({}, functions, {"Mode": 1}, {"ImportanceSmoothing": 0},
                           {"ProtectImportance": 0.5, "Emphasis": 0.5}):
            with self.subTest(**properties):
                image = image_of((40, 40, 40), Scalars=scalars, **arrays)
                image.GetPointData().SetActiveScalars("Scalars")
                # Flags of blanked points, of which there are none, need the fields as a whole.
                whole = vtkImageData()
                whole.ShallowCopy(image)
                flags = numpy_to_vtk(np.zeros(40**3, np.uint8), deep=1)
                flags.SetName("vtkGhostType")
                whole.GetPointData().AddArray(flags)
                bytes_per_point = 38.5 if "Mode" in properties else 30
                expected, found = (
                    filter_on(one, vtkExtinctionOptimizer,
                              MemoryLimit=40**3 * bytes_per_point * 1e-6, **properties)
                    for one in (whole, image))
                for result in (expected, found):
                    result.Update()
                self.assertEqual(*(result.messages["WarningEvent"][0].split("): ")[1]
                                   for result in (expected, found)))
                self.assertIn("213 of 64000 points", found.messages["WarningEvent"][0])
                left = found.messages["WarningEvent"][1]
                self.assertIn('"BaseExtinction", "Importance"', left)
                for name in ("ControlFactor", "VisibleFraction", "AttainableFraction", "Energy"):
                    self.assertEqual(
                        *(number(result.GetOutput(), name) for result in (expected, found)))
                for name in ("Extinction", "Opacity", *(["LightExtinction"] if "Mode" in properties
                                                        else [])):
                    np.testing.assert_array_equal(
                        *(values(result.GetOutput(), name) for result in (expected, found)))

    def test_refuses_a_resolution_above_a_chosen_limit(self):
        self.assert_refuses("full resolution", "MemoryLimit", "ControlResolution", filter_=filter_on(
            phantom(32), vtkExtinctionOptimizer, ControlResolution=FULL, MemoryLimit=0.1))

    def test_optimises_the_viewpoint_and_separate_extinctions(self):
        for properties in ({"OptimizeViewpoint": 1}, {"Mode": 1}, {"TemporalCoherence": 0.2},
                           {"WarmStart": 1}, {"Solver": 1}):
            with self.subTest(**properties):
                result = self.run_filter(ControlResolution=HALF, **properties)
                first = number(result.GetOutput(), "VisibleFraction")
                self.assertGreater(first, number(result.GetOutput(), "BaseVisibleFraction"))
                result.SetCameraViewUp(0, 1, 0.01)
                result.Update()  # from what was kept
                self.assert_no_error(result)
                self.assertGreater(number(result.GetOutput(), "VisibleFraction"), 0.95 * first)

    def test_other_methods_have_the_full_resolution(self):
        for method in range(1, 5):
            output = self.run_filter(ControlResolution=HALF, Method=method).GetOutput()
            self.assertEqual(number(output, "ControlFactor"), 1)


class TestResultArrays(FilterTest):
    def test_are_those_asked_for(self):
        result = filter_on(phantom(24), vtkExtinctionOptimizer)
        self.assertEqual(result.GetNumberOfResultArrays(), 8)
        result.Update()
        everything = result.GetOutput()
        expected = {name: values(everything, name).copy() for name in ALL}
        scores = [number(everything, name) for name in ("VisibilityScore", "AttainableScore")]
        given = names_of(everything) - set(ALL)
        for name in ALL:
            with self.subTest(name=name):
                result.RemoveAllResultArrays()
                result.AddResultArray(name)
                self.assertEqual((result.GetNumberOfResultArrays(), result.GetResultArray(0)),
                                 (1, name))
                result.Update()
                output = result.GetOutput()
                self.assert_no_error(result)
                np.testing.assert_array_equal(values(output, name), expected[name])
                self.assertEqual(names_of(output) - {"BaseExtinction", "Importance"},
                                 given | {name} - {"BaseExtinction", "Importance"})
                self.assertEqual([number(output, score) for score in
                                  ("VisibilityScore", "AttainableScore")], scores)

    def test_may_be_none(self):
        result = filter_on(phantom(24), vtkExtinctionOptimizer)
        result.RemoveAllResultArrays()
        result.Update()
        self.assert_no_error(result)
        self.assertNotIn("Extinction", names_of(result.GetOutput()))

    def test_that_do_not_exist_are_refused(self):
        result = filter_on(phantom(24), vtkExtinctionOptimizer)
        result.AddResultArray("Colour")
        self.assert_refuses("Colour", "Transmittance", filter_=result)

    def test_do_not_keep_a_run_from_starting_where_the_last_one_ended(self):
        warm = [filter_on(phantom(24), vtkExtinctionOptimizer, WarmStart=1) for _ in range(2)]
        warm[1].RemoveAllResultArrays()
        warm[1].AddResultArray("Opacity")
        for result in warm:
            result.Update()
            result.SetCameraViewUp(0, 1, 0.01)
            result.Update()
        self.assertNotIn("Extinction", names_of(warm[1].GetOutput()))
        np.testing.assert_array_equal(*(values(result.GetOutput(), "Opacity") for result in warm))


class TestMapper(MapperTest):
    def test_draws_at_the_resolution_of_the_data(self):
        view, mapper = show(volume(64), ControlResolution=FULL)
        full = view.picture()
        seen = mapper.GetVisibleFraction()
        self.assertEqual(mapper.GetOptimizedAt(), "")
        mapper.SetControlResolution(HALF)
        half = view.picture()

        self.assert_fine(view)
        self.assertTrue(mapper.GetConverged())
        self.assertEqual(mapper.GetOptimizedAt(), "half resolution")
        self.assertAlmostEqual(mapper.GetVisibleFraction(), seen, delta=0.1)
        self.assertLess(difference(full, half), 10)  # of 255; see Resolutions.md
        mapper.SetControlResolution(FULL)
        self.assertEqual(difference(view.picture(), full), 0)

    def test_takes_what_fits_and_says_so(self):
        view, mapper = show(volume(32), MemoryLimit=32**3 * 20e-6)
        view.picture()
        self.assert_fine(view)
        self.assertIn(" of 0.00066 GB", mapper.GetOptimizedAt())

    def test_optimises_again_at_another_resolution(self):
        view, mapper = show(volume(48))
        for resolution in (HALF, QUARTER, FULL, HALF):
            mapper.SetControlResolution(resolution)
            view.picture()
            self.assert_sane(view, mapper)
            self.assertTrue(mapper.GetConverged())

    def test_shows_at_another_resolution_what_a_new_display_shows(self):
        view, mapper = show(volume(48), ControlResolution=HALF)
        view.picture()
        for resolution in (QUARTER, HALF):
            mapper.SetControlResolution(resolution)
            expected, _ = show(volume(48), ControlResolution=resolution)
            self.assertEqual(difference(view.picture(), expected.picture()), 0)

    def test_goes_on_after_memory_was_released(self):
        for resolution in (FULL, HALF):
            view, mapper = show(volume(48), ControlResolution=resolution)
            before, iterations = view.picture(), mapper.GetIterations()
            mapper.ReleaseMemory()
            self.assertEqual(difference(view.picture(), before), 0)
            self.assertEqual(mapper.GetIterations(), iterations)
            # What is seen from elsewhere is that of a display that was always there.
            expected, _ = show(volume(48), ControlResolution=resolution)
            for other in (view, expected):
                other.look(azimuth=80)
            self.assertEqual(difference(view.picture(), expected.picture()), 0)
            mapper.ReleaseMemory()
            mapper.ShowMissedOn()
            missed = view.picture()
            self.assert_sane(view, mapper)
            self.assertGreater(difference(missed, expected.picture()), 0)

    def test_has_the_importance_again_when_pictures_need_it(self):
        expected, _ = show(volume(48), ControlResolution=HALF, ShowMissed=1)
        view, mapper = show(volume(48), ControlResolution=HALF)
        without = view.picture()
        for _ in range(2):
            mapper.ShowMissedOn()
            self.assertEqual(difference(view.picture(), expected.picture()), 0)
            self.assert_sane(view, mapper)
            mapper.ShowMissedOff()
            self.assertEqual(difference(view.picture(), without), 0)

    def test_follows_other_functions(self):
        view, mapper = show(volume(48), ControlResolution=HALF)
        before = view.picture()
        opacity = view.renderer.GetVolumes().GetItemAsObject(0).GetProperty().GetScalarOpacity()
        opacity.AddPoint(0.5, 0.9)
        after = view.picture()
        self.assert_sane(view, mapper)
        self.assertGreater(difference(after, before), 1)
        opacity.RemovePoint(0.5)
        self.assertEqual(difference(view.picture(), before), 0)

    def test_moves(self):
        view, mapper = show(volume(48), ControlResolution=QUARTER)
        view.picture()
        view.interact(True)
        for step in range(4):
            view.look(azimuth=35 + 3 * step)
            view.picture()
            self.assert_sane(view, mapper)
        view.interact(False)
        view.picture()
        self.assertTrue(mapper.GetConverged())


if __name__ == "__main__":
    unittest.main()
