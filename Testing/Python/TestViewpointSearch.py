# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The filter round the search for viewpoints: the sphere, the views, and what it says if it cannot.

import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkFeatureEdges

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer, vtkViewpointSearch

from images import (FILL_VALUES, FilterTest, PartOf, abort_at_every_event, blocks_of, caught, filter_on,
                    flipped, function_of, image_of, image_with_fill, memory_limited_to, phantom,
                    rounded_rotation, starting_importance, values, with_input)

ICOSPHERE, FIBONACCI, LATITUDE_LONGITUDE = SAMPLINGS = (
    vtkViewpointSearch.ICOSPHERE, vtkViewpointSearch.FIBONACCI,
    vtkViewpointSearch.LATITUDE_LONGITUDE)
PROXY, BASE, ARRAY, PER_VIEW, ATTAINABLE = FIELDS = (
    vtkViewpointSearch.IMPORTANCE_PROXY, vtkViewpointSearch.BASE_EXTINCTION,
    vtkViewpointSearch.EXTINCTION_ARRAY, vtkViewpointSearch.OPTIMIZE_PER_VIEW,
    vtkViewpointSearch.ATTAINABLE)
SPHERE, VIEWPOINTS, PATHS = range(3)
DOUBLE = float(np.finfo(float).eps)

SPHERE_ARRAYS = {"VisibilityScore", "VisibleFraction", "NormalizedScore", "Azimuth", "Polar",
                 "ViewDirection", "CameraPosition", "CameraFocalPoint", "CameraViewUp", "Rank",
                 "Valid"}
VIEW = ("VisibilityScore", "VisibleFraction", "CameraPosition", "CameraFocalPoint", "CameraViewUp",
        "Azimuth", "Polar")
SUMMARY = {"CameraFocalPoint", "CameraViewAngle", "CameraAspectRatio", "CameraParallelProjection",
           "CameraParallelScale", "ImageCorners", "Evaluations", "Seconds", "ScalarOpacityUnitDistance",
           "Backend"} | {which + name for which in ("Best", "Worst") for name in VIEW}


def image_on(points, **arrays):
    """A cube of points on [-1, 1]^3 with the arrays; `points` along each axis."""
    flat = {name: np.asarray(data, dtype=np.float32).ravel() for name, data in arrays.items()}
    return image_of(3 * (points,), 3 * (2 / (points - 1),), 3 * (-1,), **flat)


def coordinates(points):
    """Coordinates x, y, z at the points of a cube on [-1, 1]^3, first axis fastest."""
    axis = np.linspace(-1, 1, points)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    return x, y, z


def smooth_step(value):
    share = np.clip(value, 0, 1)
    return share * share * (3 - 2 * share)


def ball(points=48):
    """A ball of importance and extinction, the same from everywhere."""
    x, y, z = coordinates(points)
    inside = smooth_step((0.8 - np.sqrt(x * x + y * y + z * z)) / 0.4)
    return image_on(points, Importance=inside, BaseExtinction=4 * inside)


def hidden_blob(opening, points=40):
    """An important blob in a shell that is the thinner, the closer to the opening."""
    x, y, z = coordinates(points)
    radius = np.sqrt(x * x + y * y + z * z)
    cosine = (x * opening[0] + y * opening[1] + z * opening[2]) / np.maximum(radius, 1e-9)
    blob = smooth_step((0.4 - radius) / 0.2)
    shell = smooth_step((0.2 - np.abs(radius - 0.7)) / 0.1) * (1 - cosine)
    return image_on(points, Importance=blob, BaseExtinction=3 * blob + 40 * shell)


def search(image, **properties):
    """A filter with few directions."""
    return filter_on(image, vtkViewpointSearch, **{"NumberOfDirections": 42, **properties})


def points_of(output):
    return vtk_to_numpy(output.GetPoints().GetData())


def triangles_of(output):
    return vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def field(output, name):
    array = output.GetFieldData().GetArray(name)
    return np.squeeze(vtk_to_numpy(array))[()]


def names_of(attributes):
    return {attributes.GetArrayName(i) for i in range(attributes.GetNumberOfArrays())}


def rotation(azimuth, polar):
    """R of Eq. (10); angles in degrees."""
    (s1, c1), (s2, c2) = ((np.sin(a), np.cos(a)) for a in np.radians((azimuth, polar)))
    return np.array([[c1, s1 * s2, s1 * c2], [0, c2, -s2], [-s1, c1 * s2, c1 * c2]])


def angle_between(a, b):
    return np.degrees(np.arccos(np.clip(
        np.dot(a, b) / np.linalg.norm(a) / np.linalg.norm(b), -1, 1)))


class SearchTest(FilterTest):
    def run_filter(self, image, **properties):
        result = search(image, **properties)
        result.Update()
        self.assert_no_error(result)
        self.assert_finite(result)
        return result

    def assert_finite(self, result):
        for port in range(3):
            output = result.GetOutput(port)
            for attributes in (output.GetPointData(), output.GetFieldData()):
                for i in range(attributes.GetNumberOfArrays()):
                    array = attributes.GetArray(i)
                    if array is not None:
                        self.assertTrue(np.isfinite(vtk_to_numpy(array)).all(), array.GetName())
            if output.GetNumberOfPoints():
                self.assertTrue(np.isfinite(points_of(output)).all())


class TestSphere(SearchTest):
    def test_is_closed_and_looks_outward_in_every_sampling(self):
        image = image_on(2, Importance=np.ones(8), BaseExtinction=np.ones(8))
        for sampling in SAMPLINGS:
            for count in (1, 4, 5, 7, 12, 42, 50, 100, 162, 333):
                with self.subTest(sampling=sampling, count=count):
                    output = self.run_filter(image, Sampling=sampling, NumberOfDirections=count,
                                             Refine=0).GetOutput()
                    points, triangles = points_of(output), triangles_of(output)
                    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)

                    faces, corners = len(triangles), len(points)
                    self.assertEqual(corners - len(np.unique(edges, axis=0)) + faces, 2)
                    self.assertEqual(len(np.unique(triangles)), corners)
                    self.assertEqual(len(np.unique(points.round(9), axis=0)), corners)
                    normals = np.cross(points[triangles[:, 1]] - points[triangles[:, 0]],
                                       points[triangles[:, 2]] - points[triangles[:, 0]])
                    outward = np.einsum("ij,ij->i", normals, points[triangles].mean(axis=1))
                    self.assertGreater(outward.min(), 0)

    def test_has_no_boundary_and_no_edge_of_more_than_two_triangles(self):
        for sampling in SAMPLINGS:
            output = self.run_filter(phantom(8), Sampling=sampling, Refine=0).GetOutput()
            edges = vtkFeatureEdges()
            edges.SetInputData(output)
            edges.BoundaryEdgesOn()
            edges.NonManifoldEdgesOn()
            edges.FeatureEdgesOff()
            edges.ManifoldEdgesOff()
            edges.Update()

            self.assertEqual(edges.GetOutput().GetNumberOfCells(), 0)

    def test_has_as_many_directions_as_the_sampling_can(self):
        image = image_on(2, Importance=np.ones(8), BaseExtinction=np.ones(8))
        expected = {ICOSPHERE: {1: 12, 12: 12, 30: 42, 100: 42, 103: 162, 500: 642, 642: 642},
                    FIBONACCI: {1: 4, 4: 4, 77: 77, 642: 642}}
        for sampling, counts in expected.items():
            for wanted, count in counts.items():
                output = self.run_filter(image, Sampling=sampling, NumberOfDirections=wanted,
                                         Refine=0).GetOutput()
                self.assertEqual(output.GetNumberOfPoints(), count)
        for wanted in (20, 100, 642):
            output = self.run_filter(image, Sampling=LATITUDE_LONGITUDE, Refine=0,
                                     NumberOfDirections=wanted).GetOutput()
            self.assertLess(abs(output.GetNumberOfPoints() / wanted - 1), 0.1)

    def test_lies_round_the_data(self):
        image = phantom(8)
        image.SetOrigin(9, 19, 29)
        points = points_of(self.run_filter(image, SphereRadius=1.25).GetOutput())

        np.testing.assert_allclose(np.linalg.norm(points - (10, 20, 30), axis=1),
                                   1.25 * np.sqrt(3), rtol=1e-12)

    def test_has_one_point_per_pole(self):
        output = self.run_filter(phantom(8), Sampling=LATITUDE_LONGITUDE).GetOutput()

        polar = values(output, "Polar")
        self.assertEqual((np.abs(polar) > 89.9).sum(), 2)
        self.assertAlmostEqual(np.abs(polar).max(), 90)


class TestArrays(SearchTest):
    def test_are_those_of_the_contract_and_finite(self):
        for field_ in FIELDS:
            result = self.run_filter(phantom(12), Field=field_, NumberOfDirections=12)

            self.assertLessEqual(SPHERE_ARRAYS, names_of(result.GetOutput().GetPointData()))
            for port in (VIEWPOINTS, PATHS):
                self.assertLessEqual({*VIEW, "CameraParallelScale"},
                                     names_of(result.GetOutput(port).GetPointData()))
            for port in range(3):
                fields = result.GetOutput(port).GetFieldData()
                self.assertLessEqual(SUMMARY, names_of(fields))
                for name in SUMMARY:
                    self.assertEqual(fields.GetAbstractArray(name).GetNumberOfTuples(), 1)
            self.assertEqual(result.GetOutput().GetPointData().GetScalars().GetName(),
                             "VisibilityScore")

    def test_angles_give_directions_and_cameras_by_eq_10(self):
        for sampling in SAMPLINGS:
            output = self.run_filter(phantom(8), Sampling=sampling, CameraDistance=2,
                                     Refine=0).GetOutput()
            centre, radius = np.zeros(3), np.sqrt(3)
            for i in range(output.GetNumberOfPoints()):
                matrix = rotation(values(output, "Azimuth")[i], values(output, "Polar")[i])
                direction = values(output, "ViewDirection")[i]
                np.testing.assert_allclose(matrix[:, 2], direction, atol=8 * DOUBLE)
                np.testing.assert_allclose(matrix[:, 1], values(output, "CameraViewUp")[i],
                                           atol=8 * DOUBLE)
                np.testing.assert_allclose(values(output, "CameraPosition")[i],
                                           centre + 2 * radius * direction, atol=1e-14)
                np.testing.assert_allclose(values(output, "CameraFocalPoint")[i], centre,
                                           atol=1e-14)
                np.testing.assert_allclose(points_of(output)[i], centre + 1.1 * radius * direction,
                                           atol=1e-14)

    def test_normalized_scores_and_ranks_follow_the_scores(self):
        output = self.run_filter(phantom()).GetOutput()

        scores = values(output, "VisibilityScore")
        least, span = scores.min(), scores.max() - scores.min()
        np.testing.assert_allclose(values(output, "NormalizedScore"), (scores - least) / span,
                                   atol=1e-12)
        order = np.argsort(values(output, "Rank"))
        self.assertTrue((np.diff(scores[order]) <= 0).all())
        np.testing.assert_array_equal(np.sort(values(output, "Rank")), np.arange(1, 43))
        np.testing.assert_array_equal(values(output, "Valid"), 1)

    def test_field_data_name_the_best_and_the_worst_view(self):
        result = self.run_filter(phantom())
        output, best = result.GetOutput(), result.GetViewpoints()

        scores = values(output, "VisibilityScore")
        worst = scores.argmin()
        self.assertEqual(field(output, "WorstVisibilityScore"), scores[worst])
        for name in ("CameraPosition", "CameraFocalPoint", "CameraViewUp", "Azimuth", "Polar"):
            np.testing.assert_array_equal(field(output, "Worst" + name),
                                          values(output, name)[worst])
            np.testing.assert_array_equal(field(output, "Best" + name), values(best, name)[0])
        self.assertEqual(field(output, "BestVisibilityScore"), values(best, "VisibilityScore")[0])
        self.assertGreater(field(output, "Evaluations"), 42)
        self.assertGreater(field(output, "Seconds"), 0)


class TestScores(SearchTest):
    """S is that of Eq. (32), whatever it is computed for."""

    def optimizer_at(self, image, output, i, **properties):
        optimizer = vtkExtinctionOptimizer()
        optimizer.SetInputData(image)
        optimizer.SetExtinctionSource(vtkExtinctionOptimizer.ARRAY)
        for name in ("CameraPosition", "CameraFocalPoint", "CameraViewUp"):
            getattr(optimizer, "Set" + name)(*values(output, name)[i])
        for name, value in properties.items():
            getattr(optimizer, "Set" + name)(value)
        optimizer.Update()
        return optimizer.GetOutput()

    def test_of_the_base_extinction_are_those_of_the_optimizer(self):
        image = phantom(32)
        for parallel in (0, 1):
            output = self.run_filter(image, Field=BASE, Sampling=FIBONACCI, NumberOfDirections=5, Refine=0,
                                     CameraParallelProjection=parallel).GetOutput()
            for i in range(5):
                expected = self.optimizer_at(image, output, i, MaximumIterations=0, RayDensity=3,
                                             CameraParallelProjection=parallel)
                # Both are quadratures of the same integral, with rays at different places. The
                # search has 96 rays across small images; so has the optimizer here, which cuts
                # thick layers at the faces of cells, too: 0.64 % are the most that was seen.
                self.assertLess(abs(values(output, "VisibilityScore")[i] /
                                    field(expected, "BaseVisibilityScore") - 1), 1e-2)
                self.assertLess(abs(values(output, "VisibleFraction")[i] -
                                    field(expected, "BaseVisibleFraction")), 5e-3)

    def test_round_a_focal_point_are_those_of_the_optimizer_too(self):
        image, point = phantom(32), (0.3, -0.4, 0.2)
        output = self.run_filter(image, Field=BASE, Sampling=FIBONACCI, NumberOfDirections=8, Refine=0,
                                 UseFocalPoint=1, CameraFocalPoint=point).GetOutput()

        np.testing.assert_array_equal(values(output, "CameraFocalPoint"), 8 * [point])
        np.testing.assert_allclose(
            values(output, "CameraPosition"),
            point + 3 * np.sqrt(3) * values(output, "ViewDirection"), rtol=1e-12)
        np.testing.assert_allclose(np.linalg.norm(points_of(output), axis=1), 1.1 * np.sqrt(3),
                                   rtol=1e-12)  # still round the data
        for i in range(8):
            expected = self.optimizer_at(image, output, i, MaximumIterations=0, RayDensity=3)
            # See above.
            self.assertLess(abs(values(output, "VisibilityScore")[i] /
                                field(expected, "BaseVisibilityScore") - 1), 1e-2)

    def test_of_the_proxy_are_those_of_the_largest_extinction_times_importance(self):
        image = phantom(24)
        proxy = phantom(24)
        largest = values(image, "BaseExtinction").max()
        values(proxy, "BaseExtinction")[:] = largest * values(image, "Importance")

        # Which part of it is the base's is counted in a loop of its own, with other rounding.
        np.testing.assert_allclose(
            values(self.run_filter(image, Field=PROXY).GetOutput(), "VisibilityScore"),
            values(self.run_filter(proxy, Field=BASE).GetOutput(), "VisibilityScore"), rtol=1e-8)

    def test_that_are_attainable_are_the_ceilings_of_the_optimizer(self):
        image = phantom(32)
        for protect in (0, 1):
            output = self.run_filter(image, Field=ATTAINABLE, ProtectImportance=protect,
                                     Sampling=FIBONACCI, NumberOfDirections=4, Refine=0).GetOutput()
            np.testing.assert_array_equal(values(output, "AttainableFraction"),
                                          values(output, "VisibleFraction"))
            for i in range(4):
                expected = self.optimizer_at(image, output, i, ProtectImportance=protect,
                                             MaximumIterations=2, RayDensity=3)
                # Both are quadratures of the same integral, with rays at different places.
                self.assertLess(abs(values(output, "AttainableFraction")[i] -
                                    field(expected, "AttainableFraction")), 5e-3)
                self.assertGreater(values(output, "AttainableFraction")[i],
                                   field(expected, "VisibleFraction"))

    def test_that_are_attainable_are_the_default_and_have_an_array_of_their_own(self):
        self.assertEqual(vtkViewpointSearch().GetField(), ATTAINABLE)
        for field_ in (ATTAINABLE, BASE):
            output = self.run_filter(phantom(), Field=field_).GetOutput()
            self.assertEqual("AttainableFraction" in names_of(output.GetPointData()),
                             field_ == ATTAINABLE)

    def test_of_an_array_are_those_of_the_same_base_extinction(self):
        image = phantom(20)
        other = vtkImageData()
        other.ShallowCopy(image)
        named = numpy_to_vtk(np.sqrt(values(image, "BaseExtinction")), deep=1)
        named.SetName("Mine")
        other.GetPointData().AddArray(named)
        from_array = search(other, Field=ARRAY, ExtinctionSource=0)
        from_array.SetInputArrayToProcess(2, 0, 0, 0, "Mine")
        from_array.Update()
        values(image, "BaseExtinction")[:] = np.sqrt(values(image, "BaseExtinction"))

        self.assertEqual(from_array.messages["ErrorEvent"], [])
        np.testing.assert_array_equal(
            values(from_array.GetOutput(), "VisibilityScore"),
            values(self.run_filter(image, Field=BASE).GetOutput(), "VisibilityScore"))

    def test_optimized_per_view_are_those_of_the_optimizer(self):
        image = phantom()
        output = self.run_filter(image, Field=PER_VIEW, NumberOfDirections=12, Refine=0,
                                 MaximumIterations=2).GetOutput()

        for i in range(12):
            # A search does not smooth by default.
            expected = self.optimizer_at(image, output, i, MaximumIterations=2, Smoothness=0)
            self.assertLess(abs(values(output, "VisibilityScore")[i] /
                                field(expected, "VisibilityScore") - 1), 1e-9)

    def test_of_a_ball_are_the_same_from_everywhere(self):
        image = ball()
        for parallel in (0, 1):
            for field_ in (PROXY, BASE, ATTAINABLE):
                output = self.run_filter(image, Field=field_, NumberOfDirections=162, Refine=0,
                                         CameraParallelProjection=parallel).GetOutput()
                scores = values(output, "VisibilityScore")
                self.assertLess(scores.max() / scores.min() - 1, 5e-3)

    def test_do_not_depend_on_the_unit_of_length_or_the_place(self):
        reference = self.run_filter(phantom()).GetOutput()
        moved = phantom()
        for unit in (1024, 2.0**-30):
            moved.SetSpacing(*3 * (unit * 2 / 19,))
            moved.SetOrigin(*unit * np.array((1e3, -2e3, 5e2)))
            image = phantom()
            values(moved, "BaseExtinction")[:] = values(image, "BaseExtinction") / unit
            output = self.run_filter(moved).GetOutput()

            np.testing.assert_allclose(values(output, "VisibilityScore") / unit**2,
                                       values(reference, "VisibilityScore"), rtol=1e-3)

    def test_do_not_depend_on_the_sign_of_the_spacing(self):
        reference = self.run_filter(phantom()).GetOutput()
        output = self.run_filter(flipped(phantom(), 0, 2)).GetOutput()
        np.testing.assert_allclose(values(output, "VisibilityScore"),
                                   values(reference, "VisibilityScore"), rtol=1e-5)
        np.testing.assert_allclose(output.GetBounds(), reference.GetBounds(), rtol=1e-12)

    def test_take_a_direction_matrix_of_few_digits(self):
        image = phantom()
        for digits in (16, 4):
            image.SetDirectionMatrix(*rounded_rotation(digits).ravel())
            scores = values(self.run_filter(image).GetOutput(), "VisibilityScore")
            exact = scores if digits == 16 else exact
        np.testing.assert_allclose(scores, exact, rtol=1e-3)

    def test_take_importance_from_a_function(self):
        image = phantom()
        half = function_of((0, 0), (1, 0.5))
        whole = values(self.run_filter(image, Field=BASE).GetOutput(), "VisibilityScore")
        mapped = values(self.run_filter(image, Field=BASE, UseImportanceFunction=1,
                                        ImportanceFunction=half).GetOutput(), "VisibilityScore")

        np.testing.assert_allclose(mapped, 0.5 * whole, rtol=1e-6)


class TestImportanceNotGiven(SearchTest):
    """The largest scalars are important, as in the display."""

    def searched(self, field_, **importance):
        scalars = hidden_blob((1, 0, 0), points=14)
        image = image_on(14, density=values(scalars, "BaseExtinction"), **importance)
        image.GetPointData().SetActiveScalars("density")
        result = self.run_filter(image, Field=field_, NumberOfDirections=12,
                                 ExtinctionSource=vtkViewpointSearch.OPACITY_FUNCTION,
                                 ScalarOpacityFunction=function_of((0, 0), (80, 0.3)))
        return values(result.GetOutput(), "VisibilityScore"), result.messages["WarningEvent"]

    def test_the_largest_scalars_are_important(self):
        density = values(hidden_blob((1, 0, 0), points=14), "BaseExtinction")
        for field_ in (PROXY, BASE, ATTAINABLE):
            with self.subTest(field=field_):
                expected, told = self.searched(field_, Importance=starting_importance(density))
                self.assertEqual(told, [])
                self.assertGreater(expected.min(), 0)
                scores, told = self.searched(field_)
                np.testing.assert_allclose(scores, expected, rtol=1e-5)
                self.assertEqual(len(told), 1)
                self.assertIn("No importance is set", told[0])

    def test_scalars_that_are_all_alike_say_nothing(self):
        image = image_on(8, density=np.ones(512), BaseExtinction=np.ones(512))
        image.GetPointData().SetActiveScalars("density")
        self.assert_refuses("No importance is set", "all scalars are equal", filter_=search(image))

    def test_without_scalars_the_array_is_missing(self):
        image = image_on(8, BaseExtinction=np.ones(512))
        self.assert_refuses('"Importance" is not among', filter_=search(image))


class TestFillValues(SearchTest):
    def scores(self, fill, field_):
        image, functions = image_with_fill(fill)
        result = search(image, Field=field_, NumberOfDirections=12, Refine=0,
                        ExtinctionSource=vtkViewpointSearch.OPACITY_FUNCTION, **functions)
        for index in (0, 1):
            result.SetInputArrayToProcess(index, 0, 0, 0, "density")
        result.Update()
        self.assertEqual(result.messages, {"ErrorEvent": [], "WarningEvent": []})
        return values(result.GetOutput(), "VisibilityScore")

    def test_change_no_score(self):
        for field_ in (PROXY, BASE, ATTAINABLE):
            expected = self.scores(0.0, field_)
            self.assertGreater(expected.min(), 0)
            for fill in FILL_VALUES:
                with self.subTest(field=field_, fill=fill):
                    np.testing.assert_allclose(self.scores(fill, field_), expected, rtol=1e-5)


class TestViewpoints(SearchTest):
    def test_the_best_one_looks_through_the_opening(self):
        for opening in ((-1, 0, 0), (0, 0, 1), (0, 1, 0), (1, 2, -2)):
            opening = np.array(opening) / np.linalg.norm(opening)
            for parallel in (0, 1):
                result = self.run_filter(hidden_blob(opening), Field=BASE, NumberOfDirections=162,
                                         CameraParallelProjection=parallel)
                best = values(result.GetViewpoints(), "ViewDirection")[0]
                self.assertLess(angle_between(best, opening), 1)
                worst = -field(result.GetOutput(), "WorstCameraPosition")
                self.assertLess(angle_between(worst, opening), 20)

    def test_are_ranked_and_apart(self):
        for count, separation in ((1, 30), (4, 30), (6, 60), (3, 0), (50, 45)):
            result = self.run_filter(phantom(), NumberOfViewpoints=count,
                                     SeparationAngle=separation)
            output = result.GetViewpoints()
            found = output.GetNumberOfPoints()

            self.assertEqual(output.GetNumberOfVerts(), found)
            self.assertGreaterEqual(found, 1)
            self.assertLessEqual(found, count)
            self.assertTrue((np.diff(values(output, "VisibilityScore")) <= 0).all())
            np.testing.assert_array_equal(values(output, "Rank"), np.arange(1, found + 1))
            directions = values(output, "ViewDirection")
            for i in range(found):
                for j in range(i):
                    self.assertGreaterEqual(angle_between(directions[i], directions[j]),
                                            separation - 1e-6)

    def test_stand_where_their_cameras_are(self):
        output = self.run_filter(phantom()).GetViewpoints()

        np.testing.assert_array_equal(points_of(output), values(output, "CameraPosition"))

    def test_show_the_whole_box_and_fill_their_pictures(self):
        wide = image_of((20, 8, 12), (0.1, 0.2, 0.4), (3, -2, 9),
                        Importance=np.ones(1920, dtype=np.float32),
                        BaseExtinction=np.ones(1920, dtype=np.float32))
        tilted = image_of((20, 8, 12), (0.1, 0.2, 0.4), (3, -2, 9),
                          Importance=np.ones(1920, dtype=np.float32),
                          BaseExtinction=np.ones(1920, dtype=np.float32))
        tilted.SetDirectionMatrix(*rounded_rotation(12).ravel())
        pictures = ((1, 30), (1.5, 30), (0.6, 30), (2.4, 30), (1, 10), (1.78, 20), (1.33, 45),
                    (0.75, 60), (1.78, 60), (3, 75))
        for image in (wide, tilted):
            bounds = np.zeros(3)
            corners = []
            for corner in np.indices((2, 2, 2)).reshape(3, -1).T:
                image.TransformContinuousIndexToPhysicalPoint(corner * (19, 7, 11), bounds)
                corners.append(bounds.copy())
            for aspect, angle in pictures:
                for parallel in (0, 1):
                    with self.subTest(aspect=aspect, angle=angle, parallel=parallel):
                        output = self.run_filter(
                            image, CameraAspectRatio=aspect, CameraViewAngle=angle,
                            CameraParallelProjection=parallel, CameraViewUp=(0, 0, 1), Refine=0,
                            Field=PROXY, Sampling=FIBONACCI, NumberOfDirections=16,
                            NumberOfViewpoints=12).GetViewpoints()
                        self.assertGreater(output.GetNumberOfPoints(), 8)
                        for i in range(output.GetNumberOfPoints()):
                            self.assert_filled(output, i, np.array(corners), aspect,
                                               None if parallel else angle)

    def assert_filled(self, output, i, corners, aspect, angle):
        """The box is inside the picture, and fills 85 % of one side; the picture is upright."""
        position, focal_point, up = (values(output, "Camera" + name)[i]
                                     for name in ("Position", "FocalPoint", "ViewUp"))
        ahead = (focal_point - position) / np.linalg.norm(focal_point - position)
        right = np.cross(ahead, up)
        self.assertLess(abs(right[2]), 1e-9)  # z is upwards
        offsets = corners - position
        half = (np.tan(np.radians(angle / 2)) * (offsets @ ahead) if angle
                else np.full(8, values(output, "CameraParallelScale")[i]))
        at = np.stack([offsets @ right / (half * aspect), offsets @ up / half])
        self.assertLess(abs(at).max(), 1)
        self.assertGreater(np.ptp(at, axis=1).max(), 2 * 0.85)

    def test_look_at_the_focal_point_that_is_asked_for(self):
        point = (0.3, -0.4, 0.2)
        output = self.run_filter(phantom(), UseFocalPoint=1,
                                 CameraFocalPoint=point).GetViewpoints()

        for focal_point in values(output, "CameraFocalPoint"):
            np.testing.assert_allclose(focal_point, point, atol=1e-12)

    def test_the_refined_best_is_never_below_the_best_direction(self):
        for field_ in FIELDS:
            # Scores of extinctions that differ do not compare; the shares that are visible do.
            ranked_by = "VisibleFraction" if field_ == PER_VIEW else "VisibilityScore"
            for scene in range(3):
                result = self.run_filter(phantom(12, scene), Field=field_, NumberOfDirections=12,
                                         NumberOfViewpoints=2)

                best = values(result.GetOutput(), ranked_by).max()
                self.assertGreaterEqual(field(result.GetOutput(), "Best" + ranked_by), best)

    def test_without_refinement_are_directions_of_the_sphere(self):
        result = self.run_filter(phantom(), Refine=0)

        directions = values(result.GetOutput(), "ViewDirection")
        for direction in values(result.GetViewpoints(), "ViewDirection"):
            self.assertIn(direction.tolist(), directions.tolist())
        self.assertEqual(result.GetPaths().GetNumberOfLines(), 0)
        self.assertEqual(field(result.GetOutput(), "Evaluations"), 42)


class TestAllowedViews(SearchTest):
    def elevations(self, result, up):
        directions = values(result.GetViewpoints(), "ViewDirection")
        return np.degrees(np.arcsin(directions @ (np.array(up) / np.linalg.norm(up))))

    def test_the_axis_that_is_up_is_up_in_all_cameras(self):
        for up in ((0, 0, 1), (0, -2, 0), (1, 2, 3)):
            result = self.run_filter(hidden_blob((0, 0, 1), 16), NumberOfDirections=42, CameraViewUp=up)
            for output in (result.GetOutput(), result.GetViewpoints()):
                away = values(output, "CameraPosition") - values(output, "CameraFocalPoint")
                away /= np.linalg.norm(away, axis=1)[:, np.newaxis]
                view_ups = values(output, "CameraViewUp")
                sides = np.cross(away, view_ups)
                np.testing.assert_allclose(np.linalg.norm(view_ups, axis=1), 1, atol=20 * DOUBLE)
                np.testing.assert_allclose(sides @ np.array(up), 0, atol=100 * DOUBLE)
                self.assertTrue((view_ups @ np.array(up) > -100 * DOUBLE).all())

    def test_viewpoints_keep_to_elevations_and_away_from_directions(self):
        image = hidden_blob((0, 0, 1), 16)
        everywhere = self.run_filter(image, NumberOfDirections=162)
        for up, low, high in (((0, 0, 1), 0, 90), ((0, 0, 1), -90, -20), ((0, 1, 0), 0, 0),
                              ((1, 1, 0), 10, 10.5)):
            with self.subTest(up=up, low=low, high=high):
                result = self.run_filter(image, NumberOfDirections=162, CameraViewUp=up,
                                ElevationRange=(low, high))
                found = self.elevations(result, up)
                self.assertGreater(len(found), 0)
                self.assertTrue((found > low - 1e-5).all() and (found < high + 1e-5).all())
                np.testing.assert_array_equal(values(result.GetOutput(), "VisibilityScore"),
                                              values(everywhere.GetOutput(), "VisibilityScore"))
        best = values(everywhere.GetViewpoints(), "ViewDirection")[0]
        away = search(image, NumberOfDirections=162, AvoidanceAngle=50)
        away.AddAvoidedDirection(*(3 * best))
        away.Update()
        for direction in values(away.GetViewpoints(), "ViewDirection"):
            self.assertGreaterEqual(np.degrees(np.arccos(direction @ best)), 50 - 1e-5)
        away.RemoveAllAvoidedDirections()
        away.Update()
        np.testing.assert_array_equal(values(away.GetViewpoints(), "ViewDirection")[0], best)

    def test_says_where_nothing_is_allowed(self):
        result = search(hidden_blob((0, 0, 1), 16), NumberOfDirections=12, AvoidanceAngle=180)
        result.AddAvoidedDirection(0, 0, 1)
        result.Update()

        self.assertEqual(result.GetViewpoints().GetNumberOfPoints(), 0)
        self.assertIn("ElevationRange", result.messages["WarningEvent"][-1])


class TestPaths(SearchTest):
    def test_climb_from_directions_of_the_sphere(self):
        for field_ in (PROXY, BASE, PER_VIEW, ATTAINABLE):
            result = self.run_filter(hidden_blob((0.6, 0.0, 0.8), 20), Field=field_)
            output = result.GetPaths()
            if field_ == BASE:
                self.assertGreater(output.GetNumberOfLines(), 0)
            samples = values(result.GetOutput(), "ViewDirection").tolist()
            for line in range(output.GetNumberOfLines()):
                ids = output.GetCell(line).GetPointIds()
                ids = [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
                # Scores of different extinctions do not compare.
                name = "VisibleFraction" if field_ == PER_VIEW else "VisibilityScore"

                self.assertGreaterEqual(len(ids), 2)
                self.assertTrue((np.diff(values(output, name)[ids]) > 0).all())
                self.assertIn(values(output, "ViewDirection")[ids[0]].tolist(), samples)

    def test_run_through_the_cameras(self):
        output = self.run_filter(phantom(), CameraDistance=4).GetPaths()

        np.testing.assert_array_equal(points_of(output), values(output, "CameraPosition"))
        np.testing.assert_allclose(np.linalg.norm(points_of(output), axis=1), 4 * np.sqrt(3))


class TestRuns(SearchTest):
    def test_progress_rises_with_the_directions_and_has_a_text(self):
        result = search(phantom(), NumberOfDirections=162)
        seen = []
        result.AddObserver("ProgressEvent",
                           lambda *_: seen.append((result.GetProgress(), result.GetProgressText())))
        result.Update()

        shares = [share for share, _ in seen]
        self.assertEqual(shares, sorted(shares))
        self.assertGreater(len(shares), 20)
        self.assertTrue(any(text for _, text in seen))

    def abort_at(self, share, points=24, directions=162, **properties):
        result = search(phantom(points), NumberOfDirections=directions, **properties)
        result.AddObserver("ProgressEvent", lambda *_: result.SetAbortExecute(1)
                           if result.GetProgress() > share else None)
        result.Update()
        self.assertEqual(result.messages["ErrorEvent"], [])
        self.assert_finite(result)
        return result

    def test_an_abort_keeps_the_directions_that_are_done(self):
        for field_, points, directions in ((PROXY, 24, 162), (PER_VIEW, 12, 42)):
            whole = self.run_filter(phantom(points), NumberOfDirections=directions, Field=field_,
                                    Refine=0)
            output = self.abort_at(0.2, points, directions, Field=field_, Refine=0).GetOutput()

            valid = values(output, "Valid") == 1
            self.assertGreater(valid.sum(), 0)
            self.assertLess(valid.sum(), directions)
            np.testing.assert_array_equal(values(output, "VisibilityScore")[valid],
                                          values(whole.GetOutput(), "VisibilityScore")[valid])
            for name in ("VisibilityScore", "NormalizedScore", "VisibleFraction", "Rank"):
                np.testing.assert_array_equal(values(output, name)[~valid], 0)
            np.testing.assert_array_equal(np.sort(values(output, "Rank")[valid]),
                                          np.arange(1, valid.sum() + 1))
            name = "VisibleFraction" if field_ == PER_VIEW else "VisibilityScore"
            self.assertEqual(field(output, "Best" + name), values(output, name).max())
            self.assertEqual(field(output, "Worst" + name), values(output, name)[valid].min())

    def test_an_abort_while_climbing_keeps_all_directions(self):
        output = self.abort_at(0.75).GetOutput()

        np.testing.assert_array_equal(values(output, "Valid"), 1)
        self.assertGreaterEqual(field(output, "BestVisibilityScore"),
                                values(output, "VisibilityScore").max())

    def test_an_abort_before_the_first_direction_leaves_no_view(self):
        result = self.abort_at(-1)

        for port in range(3):
            self.assertEqual(result.GetOutput(port).GetNumberOfPoints(), 0)

    def test_an_abort_at_any_event_leaves_a_filter_that_can_run(self):
        for properties, step in (({}, 5), ({"Field": PER_VIEW}, 11)):
            with self.subTest(**properties):
                properties = {**properties, "NumberOfDirections": 12, "NumberOfViewpoints": 1}
                undisturbed = self.run_filter(phantom(10), **properties)
                result = search(phantom(10), **properties)
                self.assertGreater(
                    abort_at_every_event(result, lambda: self.assert_finite(result), step), 12)

                self.assert_no_error(result)
                for port in range(3):
                    for name in ("VisibilityScore", "CameraPosition"):
                        np.testing.assert_array_equal(
                            values(result.GetOutput(port), name),
                            values(undisturbed.GetOutput(port), name))

    def test_is_the_same_bits_again(self):
        first, second = self.run_filter(phantom()), self.run_filter(phantom())

        for port in range(3):
            for name in ("VisibilityScore", "CameraPosition"):
                np.testing.assert_array_equal(values(first.GetOutput(port), name),
                                              values(second.GetOutput(port), name))

    def test_changed_data_is_a_new_run(self):
        image = phantom()
        result = search(image)
        result.Update()
        before = values(result.GetOutput(), "VisibilityScore").copy()
        values(image, "Importance")[:] *= 0.5
        image.GetPointData().GetArray("Importance").Modified()
        image.Modified()
        result.Update()

        self.assertTrue((values(result.GetOutput(), "VisibilityScore") != before).all())

    def test_later_pieces_are_empty(self):
        result = search(phantom())
        result.UpdatePiece(1, 2, 0)

        for port in range(3):
            self.assertEqual(result.GetOutput(port).GetNumberOfPoints(), 0)
        result.UpdatePiece(0, 2, 0)
        self.assertEqual(result.GetOutput().GetNumberOfPoints(), 42)

    def test_says_how_much_memory_is_missing_and_goes_on(self):
        result = search(phantom(8))
        result.Update()  # its threads are there
        result.SetInputData(phantom(208))
        with memory_limited_to(2 ** 20):
            self.assert_refuses("208 x 208 x 208 points (about", "GiB are needed",
                                "Resample To Image", filter_=result)

        result.SetInputData(phantom(8))
        result.messages["ErrorEvent"].clear()
        result.Update()
        self.assert_no_error(result)
        self.assertGreater(result.GetOutput().GetNumberOfPoints(), 0)

    def test_recovers_from_an_error(self):
        result = search(phantom(), CameraDistance=np.nan)
        result.Update()
        result.SetCameraDistance(2)
        result.Update()

        self.assertEqual(len(result.messages["ErrorEvent"]), 1)
        self.assertEqual(result.GetOutput().GetNumberOfPoints(), 42)

    def test_cuda_is_used_or_an_error(self):
        result = search(phantom(8), Backend=vtkViewpointSearch.CUDA)
        result.Update()

        if result.messages["ErrorEvent"]:
            self.assertIn("CUDA", result.messages["ErrorEvent"][0])
        else:
            backend = result.GetOutput().GetFieldData().GetAbstractArray("Backend").GetValue(0)
            self.assertIn("CUDA", backend)


class TestDegenerateInput(SearchTest):
    def test_settings_that_make_no_sense_are_named(self):
        nan = np.nan  # the setters move other numbers into closed ranges
        cases = dict(CameraAspectRatio=(0, -1, np.inf, nan), CameraDistance=(nan,),
                     CameraViewAngle=(0, 180, nan), SeparationAngle=(nan,), AvoidanceAngle=(nan,),
                     SphereRadius=(0, -2), RayDensity=(nan,), ScalarOpacityUnitDistance=(-1,),
                     ViewWeight=(nan,))
        for name, wrong in cases.items():
            for value in wrong:
                with self.subTest(name=name, value=value):
                    self.assert_refuses(str(value), filter_=search(phantom(8), **{name: value}))

    def test_directions_that_are_none_are_named(self):
        self.assert_refuses("CameraViewUp", filter_=search(phantom(8), CameraViewUp=(0, 0, 0)))
        for wrong in ((10, 5), (0, np.nan)):
            self.assert_refuses("ElevationRange", filter_=search(phantom(8), ElevationRange=wrong))
        result = search(phantom(8))
        result.AddAvoidedDirection(0, 0, 0)
        self.assert_refuses("avoided direction", filter_=result)

    def test_a_focal_point_round_which_cameras_come_inside_is_refused(self):
        image = phantom(8)
        for point in ((9.5, 0, 0), (0, 0, np.nan)):
            self.assert_refuses("CameraFocalPoint", "inside", str(point[0]), filter_=search(
                image, UseFocalPoint=1, CameraFocalPoint=point))
        self.run_filter(image, CameraFocalPoint=(9.5, 0, 0))  # not used
        self.run_filter(image, UseFocalPoint=1, CameraFocalPoint=(9.5, 0, 0), CameraDistance=7)

    def test_a_camera_on_the_sphere_round_the_box_or_far_away_will_do(self):
        for distance in (1, 1.001, 1e3, 1e6):
            result = self.run_filter(phantom(12), CameraDistance=distance,
                                     Sampling=LATITUDE_LONGITUDE, NumberOfViewpoints=1)
            self.assertGreater(values(result.GetOutput(), "VisibilityScore").min(), 0)

    def test_a_camera_that_is_too_far_away_is_refused(self):
        self.assert_refuses("Move it closer", filter_=search(phantom(8), CameraDistance=1e14))

    def test_data_of_other_kinds_and_parts_of_images_are_refused(self):
        result = search(vtkUnstructuredGrid())
        executive = caught(result.GetExecutive())
        self.assert_refuses("vtkUnstructuredGrid", "without cells", filter_=result)
        self.assertEqual(len(executive), 1, executive)  # that the request has failed
        part = PartOf(phantom(12), (0, 11, 0, 11, 0, 8))
        self.assert_refuses("0..11 0..11 0..8", "uninitialized",
                            filter_=with_input(search(phantom(12)), part))

    def test_a_sheared_direction_matrix_is_refused(self):
        image = phantom(8)
        image.SetDirectionMatrix(1, 0.002, 0, 0, 1, 0, 0, 0, 1)
        self.assert_refuses("direction matrix", filter_=search(image))

    def test_images_without_a_volume_are_refused(self):
        for shape in ((2, 1, 1), (5, 5, 1), (1, 1, 1), (1, 6, 7)):
            with self.subTest(shape=shape):
                image = vtkImageData()
                image.SetDimensions(shape)
                for name in ("Importance", "BaseExtinction"):
                    array = numpy_to_vtk(np.ones(int(np.prod(shape))), deep=1)
                    array.SetName(name)
                    image.GetPointData().AddArray(array)
                self.assert_refuses(" x ".join(map(str, shape)), "volume", filter_=search(image))

    def test_no_points_are_refused(self):
        self.assert_refuses("no points", filter_=search(vtkImageData()))

    def test_other_data_are_sampled(self):
        expected = self.run_filter(phantom(24))
        meshes = vtkAppendFilter()
        meshes.SetInputData(phantom(24))
        meshes.Update()
        for data in (meshes.GetOutput(), blocks_of(phantom(24), phantom(24))):
            result = self.run_filter(data)
            np.testing.assert_allclose(values(result.GetOutput(), "VisibilityScore"),
                                       values(expected.GetOutput(), "VisibilityScore"), rtol=1e-3)

    def test_the_smallest_volume_has_scores(self):
        image = image_on(2, Importance=np.ones(8), BaseExtinction=np.ones(8))
        for field_ in FIELDS:
            output = self.run_filter(image, Field=field_).GetOutput()
            self.assertGreater(values(output, "VisibilityScore").min(), 0)

    def test_nothing_important_or_nothing_dense_gives_zeros_and_a_warning(self):
        for name in ("Importance", "BaseExtinction"):
            for field_ in FIELDS:
                with self.subTest(zero=name, field=field_):
                    image = phantom(12)
                    values(image, name)[:] = 0
                    result = self.run_filter(image, Field=field_)

                    self.assertEqual(len(result.messages["WarningEvent"]), 1)
                    self.assertIn("score 0", result.messages["WarningEvent"][0])
                    for array in ("VisibilityScore", "NormalizedScore", "VisibleFraction"):
                        np.testing.assert_array_equal(values(result.GetOutput(), array), 0)
                    self.assertEqual(field(result.GetOutput(), "BestVisibilityScore"), 0)

    def test_constant_importance_has_scores(self):
        for constant in (1, 0.25):
            image = phantom(12)
            values(image, "Importance")[:] = constant
            for field_ in FIELDS:
                result = self.run_filter(image, Field=field_, NumberOfDirections=12, Refine=0)
                self.assertGreater(values(result.GetOutput(), "VisibilityScore").min(), 0)

    def test_nan_and_infinity_are_empty_and_reported_once(self):
        image, clean = phantom(12), phantom(12)
        for index, value in ((100, np.nan), (200, np.inf)):
            values(image, "BaseExtinction")[index] = value
            for name in ("BaseExtinction", "Importance"):
                values(clean, name)[index] = 0
        result = self.run_filter(image)

        self.assertEqual(len(result.messages["WarningEvent"]), 1)
        self.assertIn("2 of 1728", result.messages["WarningEvent"][0])
        np.testing.assert_array_equal(
            values(result.GetOutput(), "VisibilityScore"),
            values(self.run_filter(clean).GetOutput(), "VisibilityScore"))

    def test_nothing_but_nan_gives_zeros(self):
        image = phantom(8)
        values(image, "Importance")[:] = np.nan
        output = self.run_filter(image).GetOutput()

        np.testing.assert_array_equal(values(output, "VisibilityScore"), 0)

    def test_opaque_voxels_have_scores(self):
        image = phantom(12)
        values(image, "BaseExtinction")[:] *= 1e9
        for field_ in FIELDS:
            self.run_filter(image, Field=field_, NumberOfDirections=12)

    def test_missing_arrays_are_named_with_the_choice(self):
        cases = ((0, "scalar", dict(ExtinctionSource=0)), (1, "importance", {}),
                 (2, "extinction", {}), (2, "extinction", dict(ExtinctionSource=0, Field=ARRAY)))
        for index, role, properties in cases:
            with self.subTest(role=role):
                result = search(phantom(8), **properties)
                result.SetInputArrayToProcess(index, 0, 0, 0, "Absent")
                self.assert_refuses(role, '"Absent"', "Scalars, Importance, BaseExtinction",
                                    filter_=result)


if __name__ == "__main__":
    unittest.main()
