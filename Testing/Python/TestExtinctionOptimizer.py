# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The filter round the solver: what goes in, what comes out, and what it says when it cannot.

import functools
import itertools
import math
import os
import subprocess
import sys
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkBitArray
from vtkmodules.vtkCommonDataModel import (vtkImageData, vtkPiecewiseFunction, vtkPolyData,
                                           vtkRectilinearGrid, vtkTable, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkCellCenters
from vtkmodules.vtkFiltersHyperTree import vtkHyperTreeGridToUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkRandomHyperTreeGridSource

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer

from images import (FILL_VALUES, FilterTest, PartOf, abort_at_every_event, blocks_of, caught, filter_on,
                    flipped, function_of, image_of, image_with_fill, in_order, memory_limited_to,
                    phantom, rounded_rotation, starting_importance, values, with_input)
from noise import noisy_ball, speck_share

POINTS, CELLS = 0, 1
SINGLE = float(np.finfo(np.float32).eps)
RESULTS = ("Extinction", "Opacity", "BaseExtinction", "Importance", "Transmittance",
           "LightTransmittance", "MissedImportance")
SUMMARY = ("VisibilityScore", "BaseVisibilityScore", "VisibleFraction", "BaseVisibleFraction",
           "SacrificedFraction", "AttainableFraction", "AttainableScore", "AttainableLightScore",
           "Energy", "ControlFactor", "Iterations", "Settled", "Seconds", "Backend")


def optimizer(image, **properties):
    """A filter with camera and light in a place of their own, which does what the paper says."""
    return filter_on(image, vtkExtinctionOptimizer, **{
        "Preset": "Paper", "CameraPosition": (4, 3, 2), "LightPosition": (-3, 4, 5), **properties})


def number(image, name):
    return image.GetFieldData().GetArray(name).GetTuple1(0)


def add_to_cells(data, name, numbers):
    array = numpy_to_vtk(numbers, deep=1)
    array.SetName(name)
    data.GetCellData().AddArray(array)


def cells_of(trees):
    """A hyper tree grid as an unstructured grid."""
    cells = vtkHyperTreeGridToUnstructuredGrid()
    cells.SetInputData(trees)
    cells.Update()
    return cells.GetOutput()


class OptimizerTest(FilterTest):
    def run_filter(self, image, **properties):
        result = optimizer(image, **properties)
        result.Update()
        self.assert_no_error(result)
        return result.GetOutput()


class TestOutput(OptimizerTest):
    def test_has_the_geometry_and_the_arrays_of_the_input(self):
        image = phantom()
        image.SetOrigin(5, 6, 7)
        output = self.run_filter(image)

        self.assertEqual(output.GetExtent(), image.GetExtent())
        self.assertEqual(output.GetSpacing(), image.GetSpacing())
        self.assertEqual(output.GetOrigin(), image.GetOrigin())
        np.testing.assert_array_equal(values(output, "Scalars"), values(image, "Scalars"))

    def test_has_float_results_in_their_ranges(self):
        output = self.run_filter(phantom())

        for name in RESULTS:
            self.assertEqual(output.GetPointData().GetArray(name).GetDataTypeAsString(), "float")
            self.assertTrue(np.isfinite(values(output, name)).all())
        largest = values(output, "BaseExtinction").max()
        self.assertLessEqual(values(output, "Extinction").max(), largest)
        self.assertGreaterEqual(values(output, "Extinction").min(), 0)
        for name in ("Opacity", "Transmittance", "LightTransmittance", "MissedImportance"):
            self.assertGreaterEqual(values(output, name).min(), 0)
            self.assertLessEqual(values(output, name).max(), 1)

    def test_opacity_is_that_of_one_unit_distance(self):
        output = self.run_filter(phantom(), ScalarOpacityUnitDistance=0.25)

        depth = values(output, "Extinction").astype(float) * 0.25
        # The product and 1 - exp are rounded to single precision; |d opacity| <= |d depth|.
        bound = SINGLE * (2 * depth.max() + 4)
        self.assertLess(np.abs(values(output, "Opacity") - (1 - np.exp(-depth))).max(), bound)

    def test_says_what_was_achieved(self):
        output = self.run_filter(phantom())

        for name in SUMMARY:
            self.assertEqual(output.GetFieldData().GetAbstractArray(name).GetNumberOfTuples(), 1)
        self.assertGreater(number(output, "VisibilityScore"),
                           number(output, "BaseVisibilityScore"))
        self.assertGreater(number(output, "VisibleFraction"), number(output, "BaseVisibleFraction"))
        self.assertGreater(number(output, "SacrificedFraction"), 0)
        self.assertLessEqual(number(output, "VisibleFraction") +
                             number(output, "SacrificedFraction"), 1)
        self.assertNotEqual(output.GetFieldData().GetAbstractArray("Backend").GetValue(0), "")

    def test_knows_what_could_be_seen_at_most(self):
        before = self.run_filter(phantom(24), MaximumIterations=0)
        after = self.run_filter(phantom(24))
        guarded = self.run_filter(phantom(24), ProtectImportance=1)
        unlit = self.run_filter(phantom(24), LightWeight=0)

        for name, found in (("AttainableFraction", "VisibleFraction"),
                            ("AttainableScore", "VisibilityScore")):
            self.assertLess(number(after, found), number(after, name))
            self.assertEqual(number(before, name), number(after, name))  # whatever was found
            self.assertLess(number(guarded, name), number(after, name))
        self.assertGreater(number(after, "AttainableLightScore"), 0)
        self.assertEqual(number(unlit, "AttainableLightScore"), 0)

    def test_says_whether_it_ended_at_a_limit(self):
        for tolerance, settled in ((0, 0), (1, 1)):
            output = self.run_filter(phantom(), Tolerance=tolerance)
            self.assertEqual(number(output, "Settled"), settled)
            self.assertEqual(number(output, "Iterations") < 8, settled == 1)

    def test_settles_whatever_is_looked_at(self):
        for scene, light in itertools.product(range(4), (0, 1)):
            with self.subTest(scene=scene, light=light):
                output = self.run_filter(phantom(24, scene), LightWeight=light)
                self.assertEqual(number(output, "Settled"), 1)

    def test_missed_importance_is_what_is_removed_or_hidden(self):
        output = self.run_filter(phantom(64))

        extinction, base, importance, transmittance, missed = (
            values(output, name).astype(float)
            for name in ("Extinction", "BaseExtinction", "Importance", "Transmittance",
                         "MissedImportance"))
        kept = np.minimum(extinction, base) / np.where(base > 0, base, 1)
        expected = np.where(base > 0, importance * (1 - kept * transmittance), 0)
        self.assertLess(np.abs(missed - expected).max(), 4 * SINGLE)
        # Sums over nodes for the integrals of the fractions: coarse, but of the same thing.
        important = (importance * base).sum()
        self.assertAlmostEqual(number(output, "VisibleFraction"),
                               1 - (missed * base).sum() / important, delta=0.02)
        self.assertAlmostEqual(number(output, "SacrificedFraction"),
                               1 - (importance * base * kept).sum() / important, delta=0.02)

    def test_shares_of_thin_media_are_not_above_one(self):
        ones = np.ones(512)
        for extinction in (1e-8, 1e-10, 1e-12):
            result = optimizer(image_of((8, 8, 8), BaseExtinction=extinction * ones, Importance=ones),
                               CameraPosition=(22, 11, 10))
            result.Update()
            for name in ("VisibleFraction", "BaseVisibleFraction"):
                share = number(result.GetOutput(), name)
                self.assertTrue(1 - 1e-6 <= share <= 1, f"{name} is 1 + {share - 1}")
            table = result.GetConvergence().GetColumnByName("VisibleFraction")
            self.assertLessEqual(table.GetRange()[1], 1)

    def test_has_one_row_per_iteration_in_the_table(self):
        result = optimizer(phantom())
        result.Update()

        table = result.GetConvergence()
        names = [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())]
        self.assertEqual(names, ["Iteration", "Level", "Energy", "RegularizationEnergy",
                                 "ViewEnergy", "LightEnergy", "VisibilityScore",
                                 "VisibleFraction", "SacrificedFraction", "AttainableScore",
                                 "AttainableFraction", "Seconds"])
        most = vtk_to_numpy(table.GetColumnByName("AttainableFraction"))
        np.testing.assert_array_equal(most, number(result.GetOutput(), "AttainableFraction"))
        iterations = vtk_to_numpy(table.GetColumnByName("Iteration"))
        np.testing.assert_array_equal(iterations, np.arange(len(iterations)))
        self.assertEqual(len(iterations), number(result.GetOutput(), "Iterations") + 1)

    def test_has_scores_of_the_importance_as_given_in_the_table(self):
        for properties in ({"ImportanceSmoothing": vtkExtinctionOptimizer.MEDIAN},
                           {"Preset": "Default"}, {"ViewWeight": 0}):
            result = optimizer(phantom(), **properties)
            result.Update()

            for name in ("VisibilityScore", "VisibleFraction", "SacrificedFraction"):
                scores = vtk_to_numpy(result.GetConvergence().GetColumnByName(name))
                self.assertIn(number(result.GetOutput(), name), scores, properties)
            scores = vtk_to_numpy(result.GetConvergence().GetColumnByName("VisibilityScore"))
            self.assertEqual(scores[0], number(result.GetOutput(), "BaseVisibilityScore"))
            self.assertGreater(scores.min(), 0)

    def test_scores_the_importance_as_given_when_that_is_smoothed(self):
        smoothed = self.run_filter(phantom(), ImportanceSmoothing=vtkExtinctionOptimizer.MEDIAN,
                                   Smoothness=0.3)
        given = self.run_filter(phantom())

        # The same rays, summed along other axes of the image.
        self.assertAlmostEqual(number(smoothed, "BaseVisibilityScore") /
                               number(given, "BaseVisibilityScore"), 1, delta=1e-6)
        np.testing.assert_array_equal(vtk_to_numpy(smoothed.GetPointData().GetArray("Importance")),
                                      vtk_to_numpy(given.GetPointData().GetArray("Importance")))
        self.assertGreater(number(smoothed, "VisibleFraction"),
                           0.9 * number(given, "VisibleFraction"))

    def test_has_an_extinction_for_the_light_in_separate_mode_only(self):
        joint = self.run_filter(phantom())
        separate = self.run_filter(phantom(), Mode=vtkExtinctionOptimizer.SEPARATE)

        self.assertIsNone(joint.GetPointData().GetArray("LightExtinction"))
        self.assertTrue(np.isfinite(values(separate, "LightExtinction")).all())

    def test_without_weights_is_the_base_extinction_bit_for_bit(self):
        image = phantom()
        output = self.run_filter(image, ViewWeight=0, LightWeight=0)

        np.testing.assert_array_equal(values(output, "Extinction"),
                                      values(image, "BaseExtinction"))

    def test_is_the_same_bits_again(self):
        first = values(self.run_filter(phantom()), "Extinction").copy()
        second = values(self.run_filter(phantom()), "Extinction")

        np.testing.assert_array_equal(first, second)

    def test_records_camera_and_light(self):
        output = self.run_filter(phantom())

        self.assertEqual(output.GetFieldData().GetArray("CameraPosition").GetTuple3(0), (4, 3, 2))
        self.assertEqual(output.GetFieldData().GetArray("LightPosition").GetTuple3(0), (-3, 4, 5))


class TestPlacement(OptimizerTest):
    def test_an_unplaced_camera_stands_where_a_new_view_has_it(self):
        image = phantom()
        image.SetOrigin(9, 19, 29)
        result = optimizer(image)
        result.SetCameraPosition(0, 0, 1)
        result.SetLightPosition(0, 0, 1)
        result.Update()

        # vtkRenderer::ResetCamera: half the diagonal over the sine of half the view angle.
        distance = np.sqrt(3) / np.sin(np.radians(15))
        fields = result.GetOutput().GetFieldData()
        np.testing.assert_allclose(fields.GetArray("CameraFocalPoint").GetTuple3(0), (10, 20, 30))
        np.testing.assert_allclose(fields.GetArray("CameraPosition").GetTuple3(0),
                                   (10, 20, 30 + distance))
        light = np.subtract(fields.GetArray("LightPosition").GetTuple3(0), (10, 20, 30))
        self.assertAlmostEqual(np.linalg.norm(light), distance)
        self.assertAlmostEqual(light[1], distance * np.sin(np.radians(50)))

    def test_positions_are_literal_on_demand(self):
        result = optimizer(phantom(), AutomaticPlacement=0)
        result.SetCameraPosition(0, 0, 1)
        result.Update()

        camera = result.GetOutput().GetFieldData().GetArray("CameraPosition").GetTuple3(0)
        self.assertEqual(camera, (0, 0, 1))

    def test_a_camera_at_its_focal_point_is_refused(self):
        result = optimizer(phantom())
        result.SetCameraPosition(0, 0, 0)
        self.assert_refuses("focal point", filter_=result)


class TestExtinctionSource(OptimizerTest):
    def base(self, data, function, distance, **properties):
        image = image_of((4, 4, 4), s=data, g=np.zeros(64))
        result = optimizer(image, ExtinctionSource=vtkExtinctionOptimizer.OPACITY_FUNCTION,
                           ScalarOpacityFunction=function, ScalarOpacityUnitDistance=distance,
                           **properties)
        result.SetInputArrayToProcess(0, 0, 0, POINTS, "s")
        result.SetInputArrayToProcess(1, 0, 0, POINTS, "g")
        result.Update()
        self.assertEqual(result.messages["ErrorEvent"], [])
        return values(result.GetOutput(), "BaseExtinction").astype(float)

    def test_opacity_becomes_extinction(self):
        data = np.linspace(0, 9, 64)
        opacity = np.interp(data, [0, 3, 9], [0, 0.2, 0.9])
        base = self.base(data, function_of((0, 0), (3, 0.2), (9, 0.9)), 0.5)

        # One rounding to single precision of a result in double precision.
        np.testing.assert_allclose(base, -np.log1p(-opacity) / 0.5, rtol=SINGLE)

    def test_opacity_one_is_finite(self):
        base = self.base(np.ones(64), function_of((0, 0), (1, 1)), 2.0)

        np.testing.assert_allclose(base, -np.log(1e-6) / 2.0, rtol=1e-6)  # 1 - 1e-6 in double

    def test_curved_functions_are_evaluated_as_vtk_does(self):
        function = vtkPiecewiseFunction()
        function.AddPoint(0, 0.1, 0.3, 0.7)
        function.AddPoint(1, 0.8)
        data = np.linspace(-0.5, 1.5, 64)
        opacity = np.array([function.GetValue(value) for value in data])

        np.testing.assert_allclose(self.base(data, function, 1.0), -np.log1p(-opacity), rtol=SINGLE)

    def test_without_function_is_a_ramp_over_the_range(self):
        data = np.linspace(10, 20, 64)
        opacity = np.minimum((data - 10) / 10, 1 - 1e-6)

        np.testing.assert_allclose(self.base(data, None, 1.0), -np.log1p(-opacity), rtol=1e-6)

    def test_all_types_give_the_same(self):
        data = np.arange(64) % 100
        expected = self.base(data.astype(np.float64), function_of((0, 0), (100, 0.9)), 1.0)
        for kind in (np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64,
                     np.uint64, np.float32):
            with self.subTest(kind=kind):
                base = self.base(data.astype(kind), function_of((0, 0), (100, 0.9)), 1.0)
                np.testing.assert_array_equal(base, expected)

    def test_negative_integers_are_looked_up(self):
        data = (np.arange(64) - 32).astype(np.int8)
        expected = self.base(data.astype(np.float64), function_of((-32, 0), (32, 0.9)), 1.0)

        base = self.base(data, function_of((-32, 0), (32, 0.9)), 1.0)

        np.testing.assert_array_equal(base, expected)

    def test_bits_are_numbers_too(self):
        image = image_of((2, 2, 2), g=np.zeros(8))
        bits = vtkBitArray()
        bits.SetName("s")
        for i in range(8):
            bits.InsertNextValue(i % 2)
        image.GetPointData().AddArray(bits)
        result = optimizer(image, ExtinctionSource=0, ScalarOpacityUnitDistance=1,
                           ScalarOpacityFunction=function_of((0, 0), (1, 0.5)))
        result.SetInputArrayToProcess(0, 0, 0, POINTS, "s")
        result.SetInputArrayToProcess(1, 0, 0, POINTS, "g")
        result.Update()

        base = values(result.GetOutput(), "BaseExtinction")
        np.testing.assert_allclose(base, np.log(2) * (np.arange(8) % 2), rtol=SINGLE)

    def test_a_component_or_the_magnitude_of_vectors(self):
        data = np.random.default_rng(1).uniform(0, 1, (64, 3))
        function = function_of((0, 0), (2, 0.9))

        for component, expected in ((0, data[:, 0]), (2, data[:, 2]),
                                    (-1, np.linalg.norm(data, axis=1))):
            with self.subTest(component=component):
                base = self.base(data, function, 1.0, ScalarComponent=component)
                np.testing.assert_allclose(base, self.base(expected, function, 1.0), rtol=2 * SINGLE)

    def test_a_changed_function_is_a_new_run(self):
        function = function_of((0, 0), (1, 0.5))
        image = image_of((3, 3, 3), s=np.ones(27), Importance=np.zeros(27))
        result = optimizer(image, ExtinctionSource=0, ScalarOpacityFunction=function,
                           ScalarOpacityUnitDistance=1)
        result.SetInputArrayToProcess(0, 0, 0, POINTS, "s")
        result.Update()
        function.AddPoint(1, 0.75)
        result.Update()

        base = values(result.GetOutput(), "BaseExtinction")
        np.testing.assert_allclose(base, np.log(4), rtol=SINGLE)

    def test_cell_arrays_are_averaged_to_the_points(self):
        image = vtkImageData()
        image.SetDimensions(3, 2, 2)
        for name, data in (("mu", [1.0, 3.0]), ("g", [0.0, 1.0])):
            array = numpy_to_vtk(np.array(data), deep=1)
            array.SetName(name)
            image.GetCellData().AddArray(array)
        result = optimizer(image)
        result.SetInputArrayToProcess(1, 0, 0, CELLS, "g")
        result.SetInputArrayToProcess(2, 0, 0, CELLS, "mu")
        result.Update()

        self.assertEqual(result.messages["ErrorEvent"], [])
        output = result.GetOutput()
        np.testing.assert_array_equal(values(output, "BaseExtinction"), [1, 2, 3] * 4)
        np.testing.assert_array_equal(values(output, "Importance"), [0, 0.5, 1] * 4)

    def test_the_importance_function_maps_the_importance_array(self):
        image = image_of((4, 4, 4), BaseExtinction=np.ones(64), Importance=np.arange(64.0))
        output = self.run_filter(image, UseImportanceFunction=1,
                                 ImportanceFunction=function_of((10, 0), (20, 1)))

        np.testing.assert_allclose(values(output, "Importance"),
                                   np.clip((np.arange(64) - 10) / 10, 0, 1), rtol=SINGLE)



class TestReference(OptimizerTest):
    REFERENCES = 4  # first input array of references

    def scene(self):
        image = phantom(16)
        half = 0.5 * values(image, "BaseExtinction")
        return self.with_reference(image, half), half

    def with_reference(self, image, extinction):
        array = numpy_to_vtk(extinction, deep=1)
        array.SetName("Half")
        image.GetPointData().AddArray(array)
        return image

    def test_of_a_large_weight_is_the_result(self):
        image, half = self.scene()
        result = optimizer(image, ReferencePull=1e7)
        result.SetInputArrayToProcess(self.REFERENCES, 0, 0, POINTS, "Half")
        result.Update()

        self.assert_no_error(result)
        largest = float(values(image, "BaseExtinction").max())
        np.testing.assert_allclose(values(result.GetOutput(), "Extinction"), half,
                                   atol=16 * SINGLE * largest)

    def test_that_is_missing_is_refused(self):
        image, _ = self.scene()
        result = optimizer(image, ReferencePull=1)
        result.SetInputArrayToProcess(self.REFERENCES, 0, 0, POINTS, "Other")
        result.Update()

        self.assertIn('The reference array "Other" is not among', result.messages["ErrorEvent"][0])

    def test_that_is_no_extinction_is_refused(self):
        for wrong in (-1.0, math.nan):
            with self.subTest(wrong=wrong):
                image, half = self.scene()
                half[77] = wrong
                self.with_reference(image, half)
                result = optimizer(image, ReferencePull=1)
                result.SetInputArrayToProcess(self.REFERENCES, 0, 0, POINTS, "Half")
                result.Update()

                self.assertIn("The reference extinction of voxel 77 is",
                              result.messages["ErrorEvent"][0])


class TestMajorant(OptimizerTest):
    """What the extinction may rise to, Eq. (25)."""

    FUNCTION = function_of((0, 0), (1, 0.9))

    def scene(self, beside):
        """Something important behind something that hides it; `beside` them, and hiding nothing
        in parallel rays along z, is a block of this scalar. Extinction as the function has it."""
        z, y, x = np.indices((12, 8, 16))
        scalars = np.where(x < 8, np.where(z < 5, 0.4, 0.3), np.where(x > 12, beside, 0)).ravel()
        importance = ((x < 8) & (z < 5)).ravel().astype(float)
        return image_of((16, 8, 12), Scalars=scalars, Importance=importance,
                        BaseExtinction=-np.log1p(-0.9 * scalars))

    def optimized(self, image, source):
        """The extinction away from the block, seen and lit along z."""
        result = optimizer(image, ExtinctionSource=source, ScalarOpacityFunction=self.FUNCTION,
                           ScalarOpacityUnitDistance=1, CameraParallelProjection=1,
                           CameraPosition=(7.5, 3.5, 40), CameraFocalPoint=(7.5, 3.5, 0),
                           LightType=vtkExtinctionOptimizer.DIRECTIONAL,
                           LightPosition=(7.5, 3.5, 40))
        result.SetInputArrayToProcess(0, 0, 0, POINTS, "Scalars")
        result.Update()
        self.assert_no_error(result)
        return values(result.GetOutput(), "Extinction").reshape(12, 8, 16)[:, :, :12]

    def test_does_not_move_with_what_has_no_part_in_the_scene(self):
        with_block, without = self.scene(1), self.scene(0)

        function = vtkExtinctionOptimizer.OPACITY_FUNCTION
        np.testing.assert_array_equal(self.optimized(with_block, function),
                                      self.optimized(without, function))
        # From an array it is the largest value that is there.
        array = vtkExtinctionOptimizer.ARRAY
        self.assertGreater(self.optimized(with_block, array).max(),
                           self.optimized(without, array).max())

    def test_is_the_largest_value_of_the_function(self):
        # What is important rises towards the bound, and well above what the data have.
        largest = self.optimized(self.scene(0), vtkExtinctionOptimizer.OPACITY_FUNCTION).max()

        self.assertLessEqual(largest, np.float32(-np.log(1 - 0.9)))
        self.assertGreater(largest, 3 * -np.log(1 - 0.9 * 0.4))


class TestArraysWithNamesOfResults(OptimizerTest):
    def warning(self, image, **properties):
        """What is said about names, and the output."""
        result = optimizer(image, **properties)
        result.Update()
        self.assert_no_error(result)
        warnings = result.messages["WarningEvent"]
        self.assertLessEqual(len(warnings), 1)
        return "".join(warnings), result.GetOutput()

    def scene(self, **arrays):
        ones = np.ones(512)
        return image_of((8, 8, 8), **{"Importance": ones, "BaseExtinction": ones, **arrays})

    def test_are_named_and_the_results_are_there(self):
        image = self.scene(Opacity=np.full(512, 7.0), Extinction=np.full(512, 7.0))
        energy = numpy_to_vtk(np.full(3, 7.0), deep=1)
        energy.SetName("Energy")
        image.GetFieldData().AddArray(energy)
        text, output = self.warning(image)

        self.assertIn('"Opacity", "Extinction", "Energy"', text)
        self.assertIn("Rename them", text)
        plain = self.run_filter(self.scene())
        for name in ("Opacity", "Extinction"):
            np.testing.assert_array_equal(values(output, name), values(plain, name))
        self.assertEqual(number(output, "Energy"), number(plain, "Energy"))
        np.testing.assert_array_equal(values(image, "Opacity"), 7)

    def test_are_fine_where_they_are_what_the_scene_is_made_of(self):
        self.assertEqual(self.warning(self.scene())[0], "")

        function = {"UseImportanceFunction": 1, "ImportanceFunction": function_of((0, 0), (4, 1))}
        self.assertIn('"Importance"', self.warning(self.scene(), **function)[0])
        opacity = {"ExtinctionSource": 0, "ScalarOpacityFunction": function_of((0, 0), (1, 0.5))}
        image = self.scene(s=np.linspace(0, 1, 512))
        image.GetPointData().SetActiveScalars("s")
        self.assertIn('"BaseExtinction"', self.warning(image, **opacity)[0])

    def test_are_fine_where_they_are_results_of_a_filter_before(self):
        text, output = self.warning(self.scene())
        self.assertEqual(text, "")
        self.assertEqual(self.warning(output)[0], "")
        copy = vtkImageData()
        copy.DeepCopy(output)
        self.assertEqual(self.warning(copy)[0], "")

    def test_are_fine_where_they_are_those_of_the_phantom(self):
        self.assertEqual(self.warning(phantom(12), ExtinctionSource=0)[0], "")


class TestValuesThatCannotBeUsed(OptimizerTest):
    def test_nan_and_infinity_are_empty_and_reported_once(self):
        image = phantom(12)
        extinction = values(image, "BaseExtinction")
        importance = values(image, "Importance")
        extinction[100], extinction[200] = np.nan, np.inf
        importance[300], importance[100] = -np.inf, np.nan
        result = optimizer(image)
        result.Update()

        self.assertEqual(result.messages["ErrorEvent"], [])
        self.assertEqual(len(result.messages["WarningEvent"]), 1)
        self.assertIn("3 of 1728", result.messages["WarningEvent"][0])
        output = result.GetOutput()
        for name in RESULTS:
            self.assertTrue(np.isfinite(values(output, name)).all(), name)
        for name in ("BaseExtinction", "Extinction", "Importance"):
            np.testing.assert_array_equal(values(output, name)[[100, 200, 300]], 0)

    def test_negative_extinction_is_empty_and_reported(self):
        image = phantom(12)
        values(image, "BaseExtinction")[7] = -1
        result = optimizer(image)
        result.Update()

        self.assertIn("1 of 1728", result.messages["WarningEvent"][0])
        self.assertEqual(values(result.GetOutput(), "BaseExtinction")[7], 0)

    def test_importance_outside_its_range_is_clamped_and_reported(self):
        image = phantom(12)
        values(image, "Importance")[:4] = [-2, 0, 1, 3]
        result = optimizer(image)
        result.Update()

        self.assertIn("2 of 1728", result.messages["WarningEvent"][0])
        np.testing.assert_array_equal(values(result.GetOutput(), "Importance")[:4], [0, 0, 1, 1])

    def test_blanked_points_are_empty(self):
        image = phantom(12)
        image.AllocatePointGhostArray()
        vtk_to_numpy(image.GetPointGhostArray())[:200] = 2  # vtkDataSetAttributes::HIDDENPOINT
        values(image, "Importance")[:200] = 1
        output = self.run_filter(image)

        np.testing.assert_array_equal(values(output, "Importance")[:200], 0)
        np.testing.assert_array_equal(values(output, "BaseExtinction")[:200], 0)
        self.assertIsNotNone(output.GetPointGhostArray())


class TestFillValues(OptimizerTest):
    """Importance and extinction are made of an array with huge values where there is none."""

    def optimized(self, fill):
        image, functions = image_with_fill(fill)
        result = optimizer(image, ExtinctionSource=vtkExtinctionOptimizer.OPACITY_FUNCTION,
                           **functions)
        for index in (0, 1):
            result.SetInputArrayToProcess(index, 0, 0, POINTS, "density")
        result.Update()
        self.assertEqual(result.messages, {"ErrorEvent": [], "WarningEvent": []})
        return result.GetOutput()

    def test_change_nothing(self):
        expected = self.optimized(0.0)
        self.assertGreater(number(expected, "VisibilityScore"),
                           1.1 * number(expected, "BaseVisibilityScore"))
        for fill in FILL_VALUES:
            with self.subTest(fill=fill):
                output = self.optimized(fill)
                for name in ("VisibilityScore", "BaseVisibilityScore", "Energy"):
                    self.assertAlmostEqual(number(output, name) / number(expected, name), 1,
                                           delta=1e-5, msg=name)
                for name in RESULTS:
                    np.testing.assert_allclose(values(output, name), values(expected, name),
                                               atol=1e-5 * values(expected, name).max())


class TestImportanceNotGiven(OptimizerTest):
    """The rule of the display, with a warning that has the points of the ramp."""

    def scene(self, **arrays):
        return image_of((12, 11, 10), BaseExtinction=np.ones(1320), **arrays)

    def found(self, image, scalars=None, **properties):
        result = optimizer(image, ExtinctionSource=1, MaximumIterations=0, **properties)
        if scalars:
            result.SetInputArrayToProcess(0, 0, 0, POINTS, scalars)
        result.Update()
        self.assertEqual(result.messages["ErrorEvent"], [])
        return values(result.GetOutput(), "Importance"), result.messages["WarningEvent"]

    def test_the_largest_scalars_are_important(self):
        scalars = np.sort(np.random.default_rng(1).gamma(2, 200, 1320))  # not noise in space

        importance, told = self.found(self.scene(density=scalars), "density")

        np.testing.assert_allclose(importance, starting_importance(scalars), atol=2 * SINGLE)
        self.assertEqual(len(told), 1)
        self.assertIn("No importance is set", told[0])

    def test_noise_is_not_important(self):
        density = noisy_ball()
        ones = np.ones(density.size)

        importance, told = self.found(
            image_of(density.shape, density=density.ravel(), BaseExtinction=ones), "density")

        begin = density.ravel()[importance == 0].max()
        end = density.ravel()[importance == 1].min()
        self.assertGreater(speck_share(density, *np.quantile(density, (0.95, 0.99))), 0.1)
        self.assertLess(speck_share(density, begin, end), 0.1)
        self.assertIn(f"from {begin:.2g}", told[0])

    def test_they_are_the_component_that_counts(self):
        vectors = np.sort(np.random.default_rng(2).normal(0, 100, (1320, 3)), axis=0)
        for component, counted in ((1, vectors[:, 1]), (-1, np.linalg.norm(vectors, axis=1))):
            importance, _ = self.found(self.scene(flow=vectors), "flow", ScalarComponent=component)
            np.testing.assert_allclose(importance, starting_importance(counted), atol=1e-6)

    def test_an_array_or_a_function_says_it(self):
        scalars = np.linspace(0, 100, 1320)
        own = np.linspace(0, 1, 1320)
        importance, told = self.found(self.scene(density=scalars, Importance=own), "density")
        np.testing.assert_allclose(importance, own, atol=SINGLE)
        self.assertEqual(told, [])

        importance, told = self.found(self.scene(density=scalars), "density",
                                      UseImportanceFunction=1,
                                      ImportanceFunction=function_of((20, 0), (60, 1)))
        np.testing.assert_allclose(importance, np.interp(scalars, (20, 60), (0, 1)), atol=1e-6)
        self.assertEqual(told, [])

    def test_automatic_is_no_choice(self):
        scalars = np.linspace(0, 100, 1320)
        for own in (None, np.linspace(1, 0, 1320)):
            image = self.scene(density=scalars, **({} if own is None else {"Importance": own}))
            image.GetPointData().SetActiveScalars("density")
            result = optimizer(image, ExtinctionSource=1)
            result.SetInputArrayToProcess(1, 0, 0, POINTS, "(Automatic)")
            result.Update()
            np.testing.assert_allclose(values(result.GetOutput(), "Importance"),
                                       starting_importance(scalars) if own is None else own,
                                       atol=1e-6)

    def test_scalars_that_are_all_alike_say_nothing(self):
        image = self.scene(density=np.ones(1320))
        image.GetPointData().SetActiveScalars("density")
        self.assert_refuses("No importance is set", "all scalars are equal", filter_=optimizer(image))

    def test_without_scalars_the_array_is_missing(self):
        self.assert_refuses('"Importance" is not among', filter_=optimizer(self.scene()))


class TestDegenerateInput(OptimizerTest):
    def test_no_points(self):
        self.assert_refuses("no points", filter_=optimizer(vtkImageData()))

    def test_other_data_have_the_results_of_their_image_at_their_points(self):
        expected = self.run_filter(phantom(24))
        meshes = vtkAppendFilter()
        meshes.SetInputData(phantom(24))
        meshes.Update()
        for data in (meshes.GetOutput(), blocks_of(meshes.GetOutput(), phantom(24))):
            result = optimizer(data)
            result.Update()
            self.assertEqual(result.messages["ErrorEvent"], [])
            output = result.GetOutputDataObject(0)
            self.assertEqual(output.GetClassName(), data.GetClassName())
            score = output.GetFieldData().GetArray("VisibilityScore").GetValue(0)
            self.assertAlmostEqual(score / number(expected, "VisibilityScore"), 1, delta=1e-3)
            self.assertEqual(output.GetFieldData().GetAbstractArray("SampledAt").GetValue(0),
                             "sampled at 24 x 24 x 24 points")
            for leaf in [output] if data is meshes.GetOutput() else [output.GetBlock(0), output.GetBlock(1)]:
                for name in ("Extinction", "Transmittance", "MissedImportance"):
                    largest = values(expected, name).max()
                    np.testing.assert_allclose(values(leaf, name).mean(), values(expected, name).mean(),
                                               atol=1e-3 * largest)
            self.assertIsNone(phantom(24).GetPointData().GetArray("Extinction"))

    def test_meshes_may_have_further_arrays(self):
        meshes = vtkAppendFilter()
        meshes.SetInputData(phantom(16))
        meshes.Update()
        expected = optimizer(meshes.GetOutput())
        expected.Update()
        data = meshes.GetOutput().NewInstance()
        data.ShallowCopy(meshes.GetOutput())
        for attributes, name, count in ((data.GetPointData(), "velocity", data.GetNumberOfPoints()),
                                        (data.GetCellData(), "rank", data.GetNumberOfCells())):
            array = numpy_to_vtk(np.arange(3.0 * count).reshape(-1, 3), deep=1)
            array.SetName(name)
            attributes.AddArray(array)
        result = optimizer(data)
        result.Update()
        for name in ("Extinction", "Transmittance"):
            np.testing.assert_array_equal(values(result.GetOutputDataObject(0), name),
                                          values(expected.GetOutputDataObject(0), name))
        self.assertIsNotNone(result.GetOutputDataObject(0).GetPointData().GetArray("velocity"))
        result.SetInputArrayToProcess(1, 0, 0, POINTS, "pressure")
        self.assert_refuses('"pressure" is not among', "velocity", "rank", filter_=result)

    def test_meshes_have_the_same_bits_by_any_number_of_threads(self):
        program = """if True:
            from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
            from images import phantom, values
            from limpid.vtkLimpidFilters import vtkExtinctionOptimizer
            image = phantom(24)
            image.SetSpacing(0.0337, 0.0291, 0.0417)  # which doubles have not exactly
            image.SetOrigin(12.345, -7.1, 3.3)
            cells = vtkDataSetTriangleFilter()
            cells.SetInputData(image)
            result = vtkExtinctionOptimizer()
            result.SetInputConnection(cells.GetOutputPort())
            result.Update()
            print(values(result.GetOutputDataObject(0), "Extinction").tobytes().hex())
            """
        found = {subprocess.run(
            [sys.executable, "-c", program], check=True, capture_output=True, cwd=os.path.dirname(__file__) or ".",
            preexec_fn=functools.partial(os.sched_setaffinity, 0, processors)).stdout
                 for processors in ({min(os.sched_getaffinity(0))}, os.sched_getaffinity(0))}
        self.assertEqual(len(found), 1)
        self.assertGreater(len(found.pop()), 8 * 24**3)

    def test_hyper_tree_grids_have_results_at_the_centres_of_their_cells(self):
        source = vtkRandomHyperTreeGridSource()
        source.SetDimensions(13, 13, 13)
        source.SetSplitFraction(0)  # without refinement, the image has its points at corners of cells
        source.Update()
        trees = source.GetHyperTreeGridOutput()
        add_to_cells(trees, "number", np.arange(12.0**3))
        where = vtk_to_numpy(cells_of(trees).GetCellData().GetArray("number")).astype(int)
        centres = vtkCellCenters()
        centres.SetInputData(cells_of(trees))
        centres.Update()
        positions = vtk_to_numpy(centres.GetOutput().GetPoints().GetData())
        density = np.empty(12**3)
        density[where] = np.exp(-2 * ((positions - positions.mean(axis=0)) ** 2).sum(axis=1))
        add_to_cells(trees, "density", density)
        cells = cells_of(trees)
        results = []
        for data in (trees, cells):
            result = optimizer(data)
            for role in (0, 1):
                result.SetInputArrayToProcess(role, 0, 0, CELLS, "density")
            result.SetExtinctionSource(result.OPACITY_FUNCTION)
            result.Update()
            self.assertEqual(result.messages["ErrorEvent"], [])
            results.append(result.GetOutputDataObject(0))

        self.assertTrue(results[0].IsA("vtkHyperTreeGrid"))
        self.assertIsNone(trees.GetCellData().GetArray("Extinction"))
        for name in ("Extinction", "Transmittance", "MissedImportance"):
            here = vtk_to_numpy(results[0].GetCellData().GetArray(name))[where]
            corners = values(results[1], name)
            around = [np.mean([corners[cells.GetCell(cell).GetPointId(i)] for i in range(8)])
                      for cell in range(cells.GetNumberOfCells())]
            np.testing.assert_allclose(here, around, atol=1e-4 * corners.max())

    def test_data_without_a_volume_are_refused(self):
        for kind in (vtkUnstructuredGrid, vtkPolyData, vtkRectilinearGrid, vtkTable):
            with self.subTest(kind=kind.__name__):
                result = optimizer(kind())
                executive = caught(result.GetExecutive())
                self.assert_refuses(kind.__name__, "without cells that have a volume", filter_=result)
                self.assertEqual(len(executive), 1, executive)  # that the request has failed
                self.assertIn("returned failure", executive[0])

    def test_a_part_of_an_image_is_refused(self):
        image = phantom(12)
        for extent in ((0, 11, 0, 11, 0, 8), (1, 11, 0, 11, 0, 11)):
            result = with_input(optimizer(image), PartOf(image, extent))
            self.assert_refuses("only the extent {}..{} {}..{} {}..{}".format(*extent),
                                "0..11 0..11 0..11", "uninitialized", filter_=result)
        result = with_input(optimizer(image), PartOf(image, image.GetExtent()))
        result.Update()
        self.assert_no_error(result)

    def test_flat_images_have_all_results(self):
        image = image_of((5, 6, 1), BaseExtinction=np.ones(30), Importance=np.ones(30))
        volume = phantom(12)
        volume.GetPointData().RemoveArray("Scalars")
        volume.GetPointData().RemoveArray("Structure")
        for properties in ({}, {"Mode": 1}, {"Method": vtkExtinctionOptimizer.AMENT_2017},
                           {"OptimizeViewpoint": 1}):
            with self.subTest(properties):
                flat, whole = optimizer(image, **properties), optimizer(volume, **properties)
                names = []
                for result in (flat, whole):
                    result.Update()
                    self.assert_no_error(result)
                    attributes = (result.GetOutput().GetPointData(),
                                  result.GetOutput().GetFieldData(),
                                  result.GetConvergence().GetRowData())
                    names.append([{data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}
                                  for data in attributes])
                names[1][1] -= {"HighestAttainableFraction", "Proof"}  # where they are known
                self.assertEqual(*names)
                for name in SUMMARY[:-1]:
                    self.assertEqual(number(flat.GetOutput(), name),
                                     1 if name in ("Settled", "ControlFactor") else 0)
                self.assertEqual(flat.GetConvergence().GetNumberOfRows(), 0)

    def test_flat_images_keep_their_extinction_with_a_warning(self):
        for shape in ((5, 5, 1), (5, 1, 1), (1, 1, 1), (1, 6, 7)):
            with self.subTest(shape=shape):
                count = int(np.prod(shape))
                image = image_of(shape, BaseExtinction=np.linspace(0, 1, count),
                                 Importance=np.ones(count))
                result = optimizer(image)
                result.Update()

                self.assertEqual(result.messages["ErrorEvent"], [])
                self.assertEqual(len(result.messages["WarningEvent"]), 1)
                output = result.GetOutput()
                np.testing.assert_array_equal(values(output, "Extinction"),
                                              np.linspace(0, 1, count).astype(np.float32))
                for name in RESULTS:
                    self.assertTrue(np.isfinite(values(output, name)).all())

    def test_no_importance_and_no_extinction_change_nothing(self):
        for name in ("Importance", "BaseExtinction"):
            with self.subTest(zero=name):
                image = phantom(12)
                values(image, name)[:] = 0
                output = self.run_filter(image)

                np.testing.assert_array_equal(values(output, "Extinction"),
                                              values(image, "BaseExtinction"))
                self.assertEqual(number(output, "VisibilityScore"), 0)
                for field in SUMMARY[:5]:
                    self.assertTrue(np.isfinite(number(output, field)), field)

    def test_the_smallest_image_with_a_volume(self):
        image = image_of((2, 2, 2), BaseExtinction=np.ones(8), Importance=np.ones(8))
        output = self.run_filter(image)

        for name in RESULTS:
            self.assertTrue(np.isfinite(values(output, name)).all())

    def test_missing_arrays_are_named_with_the_choice(self):
        image = phantom(8)
        cases = ((0, "scalar", dict(ExtinctionSource=0)), (1, "importance", {}),
                 (2, "extinction", {}))
        for index, role, properties in cases:
            with self.subTest(role=role):
                result = optimizer(image, **properties)
                result.SetInputArrayToProcess(index, 0, 0, POINTS, "Absent")
                self.assert_refuses(role, '"Absent"', "Scalars, Importance, BaseExtinction",
                                    filter_=result)

    def test_unit_distances_that_no_float_holds_are_refused(self):
        for distance in (1e300, 1e-300):
            result = optimizer(phantom(8), ScalarOpacityUnitDistance=distance)
            self.assert_refuses("ScalarOpacityUnitDistance", "{:g}".format(distance),
                                filter_=result)

    def test_settings_that_make_no_sense_are_named(self):
        nan = math.nan  # the settings themselves move other numbers into their ranges
        cases = dict(ViewWeight=nan, LightWeight=nan, RegularizationWeight=nan, RayDensity=nan,
                     ClearingThreshold=nan, ScalarOpacityUnitDistance=-1,
                     ScalarComponent=4, LearningRate=-1, Tolerance=nan,
                     MaximumSeconds=nan, ProtectImportance=nan, Emphasis=nan, Smoothness=nan)
        for name, value in cases.items():
            with self.subTest(name=name):
                result = optimizer(phantom(8), **{name: value})
                if name == "ScalarComponent":
                    result.SetExtinctionSource(0)
                if name in ("LearningRate",):
                    result.SetSolver(vtkExtinctionOptimizer.ADAM)
                result.Update()
                self.assertEqual(len(result.messages["ErrorEvent"]), 1)
                self.assertIn(str(value), result.messages["ErrorEvent"][0])

    def test_a_sheared_direction_matrix_is_refused(self):
        for shear in (0.002, 0.5):
            image = phantom(8)
            image.SetDirectionMatrix(1, shear, 0, 0, 1, 0, 0, 0, 1)
            self.assert_refuses("direction matrix", filter_=optimizer(image))

    def test_extinction_with_components_is_refused(self):
        image = image_of((2, 2, 2), Importance=np.ones(8), BaseExtinction=np.ones((8, 3)))
        self.assert_refuses("3", "components", filter_=optimizer(image))


class TestViewpoint(OptimizerTest):
    def test_extinction_and_viewpoint_together(self):
        def field(result, name):
            return result.GetOutput().GetFieldData().GetArray(name).GetTuple(0)

        alone = optimizer(phantom(24))
        alone.Update()
        start, = field(alone, "VisibilityScore")
        self.assertIsNone(alone.GetOutput().GetFieldData().GetArray("StartVisibilityScore"))
        for guide in (vtkExtinctionOptimizer.PROXY, vtkExtinctionOptimizer.COUPLED):
            with self.subTest(guide=guide):
                both = optimizer(phantom(24), OptimizeViewpoint=1, ViewpointGuide=guide)
                both.Update()
                self.assertEqual(both.messages["ErrorEvent"], [])
                self.assertEqual(field(both, "StartVisibilityScore"), (start,))
                reached, = field(both, "VisibilityScore")
                self.assertGreater(reached, start)
                position = np.array(field(both, "CameraPosition"))
                self.assertAlmostEqual(np.linalg.norm(position), np.sqrt(29), places=9)

                # The extinction is the one for that camera.
                there = optimizer(phantom(24), CameraPosition=tuple(position),
                                  CameraViewUp=field(both, "CameraViewUp"))
                there.Update()
                self.assertEqual(field(there, "VisibilityScore"), (reached,))

    def test_goes_to_the_highest_ceiling_and_says_what_that_proves(self):
        alone = optimizer(phantom(24))
        alone.Update()
        both = optimizer(phantom(24), OptimizeViewpoint=1)
        both.Update()

        self.assertEqual(both.GetViewpointGuide(), vtkExtinctionOptimizer.ATTAINABLE)
        self.assertEqual(both.messages["ErrorEvent"], [])
        found = both.GetOutput()
        self.assertGreaterEqual(number(found, "VisibleFraction"),
                                number(alone.GetOutput(), "VisibleFraction"))
        self.assertLessEqual(number(found, "VisibleFraction"),
                             number(found, "HighestAttainableFraction"))
        proof = found.GetFieldData().GetAbstractArray("Proof").GetValue(0)
        self.assertRegex(proof, "^The result reaches [0-9.]+ % of the ceiling of its view, which "
                                "is [0-9.]+ % of the highest ceiling of [0-9]+ views.$")
        self.assertIsNone(alone.GetOutput().GetFieldData().GetAbstractArray("Proof"))

    def test_is_aborted_like_any_other(self):
        both = optimizer(phantom(16), OptimizeViewpoint=1)
        both.AddObserver("ProgressEvent", lambda *_: both.SetAbortExecute(1))
        both.Update()
        self.assertIsNone(both.GetOutput().GetPointData().GetArray("Extinction"))


class TestPlaceInTheWorld(OptimizerTest):
    """The same scene elsewhere: S scales by length squared, arrays agree to 1e-4 of the largest."""

    def compare(self, image, scale, move):
        def transformed(result, *vectors):
            for name in vectors:
                position = getattr(result, "Get" + name)()
                getattr(result, "Set" + name)(*move(np.array(position)))
            return result

        reference = self.run_filter(phantom())
        result = transformed(optimizer(image), "CameraPosition", "CameraFocalPoint",
                             "LightPosition")
        result.SetCameraViewUp(*(move(np.array((0.0, 1, 0))) - move(np.zeros(3))))
        result.Update()
        self.assertEqual(result.messages["ErrorEvent"], [])

        output = result.GetOutput()
        self.assertLess(abs(number(output, "VisibilityScore") / scale**2 /
                            number(reference, "VisibilityScore") - 1), 1e-4)
        for name in ("Transmittance", "LightTransmittance"):
            np.testing.assert_allclose(values(output, name), values(reference, name), atol=1e-4)

    def test_in_another_unit_of_length(self):
        # A power of two keeps the digits of the extinctions: where a voxel may as well be clear as
        # opaque, the rounding of its input would decide.
        unit = 1024
        image = phantom()
        image.SetSpacing(*(unit * np.array(image.GetSpacing())))
        image.SetOrigin(*(unit * np.array(image.GetOrigin())))
        values(image, "BaseExtinction")[:] /= unit
        self.compare(image, unit, lambda position: unit * position)

    def test_far_from_the_origin(self):
        image = phantom()
        image.SetOrigin(1e6 - 1, 1e6 - 1, -1e6 - 1)
        self.compare(image, 1, lambda position: position + (1e6, 1e6, -1e6))

    def test_with_an_extent_that_does_not_start_at_zero(self):
        image = phantom()
        spacing = np.array(image.GetSpacing())
        image.SetExtent(100, 119, -50, -31, 7, 26)
        image.SetOrigin(*(-1 - spacing * (100, -50, 7)))
        self.compare(image, 1, lambda position: position)

    def test_rotated_by_a_direction_matrix(self):
        matrix = np.array([[0.0, -1, 0], [0.6, 0, -0.8], [0.8, 0, 0.6]])
        image = phantom()
        image.SetDirectionMatrix(*matrix.ravel())
        image.SetOrigin(*(matrix @ np.array([-1.0, -1, -1])))
        self.compare(image, 1, lambda position: matrix @ position)

    def test_by_a_direction_matrix_of_few_digits(self):
        image = phantom()
        image.SetDirectionMatrix(*rounded_rotation(16).ravel())
        exact = self.run_filter(image)
        for digits in (3, 4, 5, 6):
            image.SetDirectionMatrix(*rounded_rotation(digits).ravel())
            output = self.run_filter(image)
            # Nodes move by up to 1.5 units of the last digit, in radii, and optical depths, of
            # about 6, by as much of themselves.
            self.assertLess(abs(number(output, "VisibilityScore") /
                                number(exact, "VisibilityScore") - 1), 10 * 10.0**-digits)
            self.assertEqual(output.GetDirectionMatrix().GetElement(0, 1),
                             rounded_rotation(digits)[0, 1])

    def test_a_shear_as_small_as_rounding_may_be_is_none(self):
        exact = self.run_filter(phantom())
        for shear in (0.001, 0.0017):
            image = phantom()
            image.SetDirectionMatrix(1, shear, 0, 0, 1, 0, 0, 0, 1)
            output = self.run_filter(image)
            # Turned by half of the shear, which moves nodes by as much in radii, see above.
            self.assertLess(abs(number(output, "VisibilityScore") /
                                number(exact, "VisibilityScore") - 1), 10 * shear / 2)

    def test_with_a_negative_spacing(self):
        image = phantom()
        reference = self.run_filter(image)
        for axes in ((0,), (1,), (2,), (0, 1, 2)):
            backwards = flipped(image, *axes)
            output = self.run_filter(backwards)
            self.assertEqual(output.GetSpacing(), backwards.GetSpacing())
            self.assertLess(abs(number(output, "VisibilityScore") /
                                number(reference, "VisibilityScore") - 1), 1e-6)
            for name in ("Extinction", "Transmittance", "LightTransmittance", "MissedImportance"):
                expected = values(reference, name)
                # Sums in another order; iterations end at changes of 1e-3, see Tolerance.
                np.testing.assert_allclose(in_order(output, name, *axes), expected,
                                           atol=1e-3 * expected.max())

    def test_mirrored_by_a_left_handed_direction_matrix(self):
        matrix = np.diag([1.0, -1, 1])
        image = phantom()
        image.SetDirectionMatrix(*matrix.ravel())
        image.SetOrigin(-1, 1, -1)
        self.compare(image, 1, lambda position: matrix @ position)


class TestRuns(OptimizerTest):
    def test_progress_rises_and_has_a_text(self):
        result = optimizer(phantom())
        seen = []
        result.AddObserver("ProgressEvent",
                           lambda *_: seen.append((result.GetProgress(), result.GetProgressText())))
        result.Update()

        shares = [share for share, _ in seen]
        self.assertEqual(shares, sorted(shares))
        self.assertTrue(any(text for _, text in seen))

    def test_an_aborted_run_leaves_the_input_as_it_came(self):
        image = phantom()
        result = optimizer(image)
        result.AddObserver("ProgressEvent", lambda *_: result.SetAbortExecute(1)
                           if result.GetProgress() > 0 else None)
        result.Update()

        self.assert_is_input(result, image)

    def test_an_abort_at_any_event_leaves_a_filter_that_can_run(self):
        image = phantom(12)
        for properties, step in (
                ({}, 1), ({"Mode": vtkExtinctionOptimizer.SEPARATE}, 3),
                ({"Solver": vtkExtinctionOptimizer.ADAM, "IterationsPerLevel": (2, 2, 2)}, 2),
                ({"OptimizeViewpoint": 1}, 9)):
            with self.subTest(**properties):
                undisturbed = optimizer(image, **properties)
                undisturbed.Update()
                result = optimizer(image, **properties)

                def look():
                    if result.GetOutput().GetPointData().GetArray("Extinction") is None:
                        self.assert_is_input(result, image)
                        return False
                    for name in RESULTS:
                        np.testing.assert_array_equal(values(result.GetOutput(), name),
                                                      values(undisturbed.GetOutput(), name))
                    return True
                self.assertGreater(abort_at_every_event(result, look, step), 5)
                self.assertTrue(look())
                self.assert_no_error(result)

    def assert_is_input(self, result, image):
        output = result.GetOutput()
        self.assertEqual(output.GetExtent(), image.GetExtent())
        names = [output.GetPointData().GetArrayName(i)
                 for i in range(output.GetPointData().GetNumberOfArrays())]
        self.assertEqual(names, ["Scalars", "Importance", "BaseExtinction", "Structure"])
        self.assertEqual(output.GetFieldData().GetNumberOfArrays(), 0)
        self.assertEqual(result.GetConvergence().GetNumberOfRows(), 0)

    def test_changed_data_is_a_new_run(self):
        image = phantom(12)
        result = optimizer(image)
        result.Update()
        values(image, "BaseExtinction")[:] *= 2
        image.GetPointData().GetArray("BaseExtinction").Modified()
        image.Modified()
        result.Update()
        fresh = self.run_filter(image)

        np.testing.assert_array_equal(values(result.GetOutput(), "Extinction"),
                                      values(fresh, "Extinction"))

    def test_a_warm_start_ends_no_worse_than_it_began(self):
        result = optimizer(phantom(), WarmStart=1, MaximumIterations=2)
        result.Update()
        first = number(result.GetOutput(), "Energy")
        result.Modified()
        result.Update()

        # To the rounding of floats: a resilient step sums what is seen in another sweep than a start.
        self.assertLessEqual(number(result.GetOutput(), "Energy"), first + abs(first) * 1e-7)

    def test_a_warm_start_survives_a_change_of_size(self):
        result = optimizer(phantom(12), WarmStart=1)
        result.Update()
        result.SetInputData(phantom(14))
        result.Update()

        self.assertEqual(result.messages["ErrorEvent"], [])

    def moved(self, coherence, degrees=2, **settings):
        """How much the extinction changes when the camera turns."""
        result = optimizer(phantom(24), TemporalCoherence=coherence, **settings)
        found = []
        for angle in (0, math.radians(degrees)):
            result.SetCameraPosition(5 * math.sin(angle), -1, 5 * math.cos(angle))
            result.Update()
            found.append(values(result.GetOutput(), "Extinction"))
        return np.abs(found[1] - found[0]).mean(), result

    def test_coherence_keeps_what_was_found_for_a_near_view(self):
        free, _ = self.moved(0)
        near, _ = self.moved(1)

        self.assertLess(near, 0.5 * free)

    def test_coherence_is_for_the_same_box_and_settings(self):
        _, result = self.moved(1)
        for change in ({"ViewWeight": 5}, {"ViewWeight": 10}):
            for name, value in change.items():
                getattr(result, "Set" + name)(value)
            result.Update()
            fresh = optimizer(phantom(24), CameraPosition=result.GetCameraPosition(), **change)
            fresh.Update()
            np.testing.assert_array_equal(values(result.GetOutput(), "Extinction"),
                                          values(fresh.GetOutput(), "Extinction"))
        other = phantom(24)
        other.SetOrigin(1, 2, 3)
        result.SetInputData(other)
        fresh.SetInputData(other)
        for filter_ in (result, fresh):
            filter_.Update()
        np.testing.assert_array_equal(values(result.GetOutput(), "Extinction"),
                                      values(fresh.GetOutput(), "Extinction"))

    def test_coherence_counts_less_for_other_data(self):
        def found(change, coherence):
            result = optimizer(phantom(24), TemporalCoherence=coherence)
            result.Update()
            change(result)
            result.SetCameraPosition(4, 3.1, 2)
            result.Update()
            return values(result.GetOutput(), "Extinction")

        np.testing.assert_array_equal(found(lambda result: result.SetInputData(phantom(24)), 0.5),
                                      found(lambda result: None, 0.2))

    def test_coherence_of_more_points(self):
        _, result = self.moved(1)
        result.SetInputData(phantom(28))
        result.Update()
        fresh = optimizer(phantom(28), CameraPosition=result.GetCameraPosition())
        fresh.Update()

        self.assertEqual(result.messages["ErrorEvent"], [])
        self.assertTrue((values(result.GetOutput(), "Extinction")
                         != values(fresh.GetOutput(), "Extinction")).any())

    def test_cuda_is_used_or_an_error(self):
        result = optimizer(phantom(8), Backend=vtkExtinctionOptimizer.CUDA)
        result.Update()

        if result.messages["ErrorEvent"]:
            self.assertIn("CUDA", result.messages["ErrorEvent"][0])
        else:
            backend = result.GetOutput().GetFieldData().GetAbstractArray("Backend").GetValue(0)
            self.assertIn("CUDA", backend)

    def test_says_how_much_memory_is_missing_and_goes_on(self):
        result = optimizer(phantom(8), Solver=1, IterationsPerLevel=(1, 1, 1))
        result.Update()  # its threads are there
        result.SetInputData(phantom(208))
        with memory_limited_to(2 ** 20):
            self.assert_refuses("208 x 208 x 208 points (about 0.687 GiB", "Resample To Image",
                                filter_=result)

        result.SetInputData(phantom(8))
        result.messages["ErrorEvent"].clear()
        result.Update()
        self.assert_no_error(result)
        self.assertEqual(result.GetOutput().GetNumberOfPoints(), 512)

    def test_recovers_from_an_error(self):
        result = optimizer(phantom(), ViewWeight=math.nan)
        result.Update()
        result.SetViewWeight(10)
        result.Update()

        self.assertEqual(len(result.messages["ErrorEvent"]), 1)
        self.assertIsNotNone(result.GetOutput().GetPointData().GetArray("Extinction"))


if __name__ == "__main__":
    unittest.main()
