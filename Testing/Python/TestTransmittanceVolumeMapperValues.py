# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Values and functions as people have them: fill values, labels, many decades, values that are
# written in place. The picture and the score are those of the filter and of a new mapper.

import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkImageData
from vtkmodules.vtkRenderingCore import VTK_SCALAR_MODE_USE_CELL_DATA

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from images import FILL_VALUES, image_with_fill
from mapper_tests import MapperTest, show
from volume_views import colors_of, image_of, opacity_of, property_of


def blob(nodes=17):
    z, y, x = np.mgrid[-1:1:nodes * 1j, -1:1:nodes * 1j, -1:1:nodes * 1j]
    return np.exp(-4 * (x ** 2 + y ** 2 + z ** 2))


def nodes_of(function):
    """The positions of the nodes."""
    node = [0.0] * 4
    for i in range(function.GetSize()):
        function.GetNodeValue(i, node)
        yield node[0]


def scored(scalars, volume_property, importance, **settings):
    """A view of scalars [z, y, x] and the mapper, that score without any optimization."""
    image = image_of(scalars.shape[::-1], scalars=scalars.ravel(), Importance=importance.ravel())
    return show(image, volume_property, Optimization=Mapper.OFF, Shadows=0, RestrictToView=0,
                **settings)


def score_of(*args, **settings):
    view, mapper = scored(*args, **settings)
    view.window.Render()
    return mapper.GetVisibilityScore(), view.messages


class TestFillValues(MapperTest):
    def test_of_any_size_change_no_score_and_no_picture(self):
        importance = np.clip((blob() - 0.5) / 0.3, 0, 1)
        functions = property_of(colors_of((0, 0.2, 0.3, 0.9), (50, 0.9, 0.2, 0.1)),
                                opacity_of((0, 0), (50, 0.5)), 1)
        largest = float(np.finfo(np.float32).max)
        for fills in ((1e20, 9.96921e36, 1e37, largest, 1e200, 1.7e308),
                      (-1e20, -1e38, -largest, -1e200, -1.7e308)):
            scores, pictures = [], []
            for fill in fills:
                scalars = 50 * blob()
                scalars[:3] = fill  # no values below the ground
                scalars = scalars if abs(fill) > largest else scalars.astype(np.float32)
                view, mapper = scored(scalars, functions, importance)
                pictures.append(view.picture())
                scores.append(mapper.GetVisibilityScore())
                self.assert_fine(view)
            self.assertGreater(scores[0], 5)
            np.testing.assert_allclose(scores, scores[0], rtol=1e-4)
            for picture in pictures:
                np.testing.assert_allclose(picture, pictures[0], atol=1.5)

    def test_that_are_empty_are_not_important_either(self):
        expected = None
        for fill in (0.0, *FILL_VALUES):
            image, functions = image_with_fill(fill)
            view, mapper = show(image, property_of(
                colors_of((0, 0.2, 0.3, 0.9), (50, 0.9, 0.2, 0.1)),
                functions["ScalarOpacityFunction"], functions["ScalarOpacityUnitDistance"]),
                ImportanceArray="density", UseImportanceFunction=1,
                ImportanceFunction=functions["ImportanceFunction"])
            self.frames_to_the_end(view, mapper)
            scores = mapper.GetBaseVisibilityScore(), mapper.GetVisibilityScore()
            expected = expected or scores
            with self.subTest(fill=fill):
                self.assertGreater(scores[1], scores[0])
                np.testing.assert_allclose(scores, expected, rtol=1e-3)
                self.assert_fine(view)

    def test_leave_functions_of_huge_values_their_meaning(self):
        importance = np.clip((blob() - 0.5) / 0.3, 0, 1)
        scores = []
        for unit in (1.0, 1e34, 1e250):
            scalars = 50 * blob() * unit
            scalars[:3] = 1e6 * unit
            functions = property_of(colors_of((0, 0.2, 0.3, 0.9), (50 * unit, 0.9, 0.2, 0.1)),
                                    opacity_of((0, 0), (50 * unit, 0.5)), 1)
            score, messages = score_of(scalars, functions, importance)
            self.assertEqual(messages, [])
            scores.append(score)
        np.testing.assert_allclose(scores, scores[0], rtol=1e-4)

    def test_follow_the_functions(self):
        scalars = 50 * blob()
        scalars[:3] = 1e37
        importance = np.clip((blob() - 0.5) / 0.3, 0, 1)
        opacity = opacity_of((0, 0), (50, 0.5))
        view, mapper = scored(
            scalars, property_of(colors_of((0, 1, 1, 1), (50, 1, 1, 1)), opacity, 1), importance)
        view.window.Render()
        first = mapper.GetVisibilityScore()
        opacity.AddPoint(1e35, 0.5)
        view.window.Render()
        opacity.RemovePoint(1e35)
        view.window.Render()
        self.assertAlmostEqual(mapper.GetVisibilityScore(), first, delta=1e-6 * first)


class TestFunctions(MapperTest):
    """The scores of mapper and filter are the same for all functions."""

    def assert_scored_as_by_the_filter(self, scalars, opacity, log=False):
        importance = (np.arange(scalars.size) % 3 / 2).reshape(scalars.shape).astype(np.float32)
        opacity.SetUseLogScale(log)
        colors = colors_of(*((position, 1, 1, 1) for position in nodes_of(opacity)))
        if log:
            colors.SetScaleToLog10()
        functions = property_of(colors, opacity, 1)
        view, mapper = scored(scalars, functions, importance)
        view.window.Render()
        self.assert_fine(view)

        optimizer = vtkExtinctionOptimizer()
        optimizer.SetInputDataObject(mapper.GetInput())
        optimizer.SetInputArrayToProcess(0, 0, 0, 0, "scalars")
        optimizer.SetExtinctionSource(vtkExtinctionOptimizer.OPACITY_FUNCTION)
        optimizer.SetScalarOpacityFunction(opacity)
        optimizer.SetScalarOpacityUnitDistance(1)
        optimizer.SetMaximumIterations(0)
        camera = view.camera
        optimizer.SetCameraPosition(*camera.GetPosition())
        optimizer.SetCameraFocalPoint(*camera.GetFocalPoint())
        optimizer.SetCameraViewUp(*camera.GetViewUp())
        optimizer.SetCameraViewAngle(camera.GetViewAngle())
        optimizer.Update()
        table = optimizer.GetOutput().GetFieldData()
        base = table.GetArray("BaseVisibilityScore").GetValue(0)
        self.assertGreater(base, 0)
        self.assertAlmostEqual(mapper.GetVisibilityScore(), base, delta=1e-3 * base)

    def test_of_labels(self):
        for top in (255, 14175, 65535):
            labels = np.zeros((17, 17, 17), np.int32)
            labels[..., 0:5], labels[..., 5:10] = top // 7, top // 7 + 1
            labels[..., 10:17], labels[0, 0, 0] = top // 7 + 2, top
            middle = top // 7 + 1
            opacity = opacity_of((0, 0), (middle - 0.6, 0), (middle - 0.4, 0.9),
                                 (middle + 0.4, 0.9), (middle + 0.6, 0), (top, 0))
            with self.subTest(top=top):
                self.assert_scored_as_by_the_filter(labels, opacity)

    def test_of_many_decades(self):
        for decades in (3, 8, 12):
            scalars = 10 ** (decades * (blob() - 1)).astype(np.float32)
            opacity = opacity_of((scalars.min(), 0), (1, 0.3))
            for log in (False, True):
                with self.subTest(decades=decades, log=log):
                    self.assert_scored_as_by_the_filter(scalars, opacity, log)

    def test_of_many_nodes(self):
        for count in (64, 4096):
            heights = np.random.default_rng(5).uniform(0, 0.3, count)
            opacity = opacity_of(*zip(np.linspace(0, 1, count), heights))
            with self.subTest(count=count):
                self.assert_scored_as_by_the_filter(blob().astype(np.float32), opacity)
            opacity = opacity_of(*zip(10.0 ** np.linspace(-6, 6, count), heights))
            for log in (False, True):
                with self.subTest(count=count, decades=12, log=log):
                    self.assert_scored_as_by_the_filter(10 ** (12 * blob() - 6), opacity, log)

    def test_that_reach_as_far_as_numbers_do(self):
        opacity = opacity_of((-1e308, 0), (1e308, 0.3))
        self.assert_scored_as_by_the_filter(blob().astype(np.float32), opacity)

    def test_of_labels_show_their_own_label_alone(self):
        labels = np.zeros((17, 17, 17), np.int16)
        labels[..., 0:5], labels[..., 6:11], labels[..., 12:17] = 1034, 1035, 1036
        labels[0, 0, 0] = 14175
        opacity = opacity_of((0, 0), (1034.4, 0), (1034.6, 0.9), (1035.4, 0.9), (1035.6, 0),
                             (14175, 0))
        view, _ = scored(labels, property_of(
            colors_of((0, 1, 1, 1), (14175, 1, 1, 1)), opacity, 1), np.ones(labels.shape))
        view.renderer.SetBackground(0, 0, 0)
        view.camera.ParallelProjectionOn()
        view.camera.SetFocalPoint(8, 8, 8)
        view.camera.SetPosition(8, 8, 60)
        view.camera.SetViewUp(0, 1, 0)
        view.camera.SetParallelScale(8.5)
        row = view.picture()[80, :, 0]
        pixel = len(row) / 17
        self.assertLess(row[int(2.5 * pixel)], 2)
        self.assertGreater(row[int(8.5 * pixel)], 250)
        self.assertLess(row[int(14.5 * pixel)], 2)


class TestTypes(MapperTest):
    """Values that are read where they are, and the same as doubles, which are converted."""

    def pictures(self, type_, prepare=lambda mapper, image: None, **settings):
        lowest = np.iinfo(type_).min if np.issubdtype(type_, np.integer) else -100
        highest = np.iinfo(type_).max if np.issubdtype(type_, np.integer) else 155
        scalars = np.round(lowest + (highest - lowest) * blob()).astype(type_)
        middle = 0.7 * lowest + 0.3 * highest
        functions = property_of(colors_of((lowest, 0.2, 0.3, 0.9), (highest, 0.9, 0.2, 0.1)),
                                opacity_of((middle, 0), (highest, 0.5)), 1)
        functions.ShadeOn()
        importance = np.clip((blob() - 0.5) / 0.3, 0, 1)
        for values in (scalars, scalars.astype(float)):
            image = image_of(values.shape, scalars=values.ravel(), Importance=importance.ravel())
            view, mapper = show(image, functions, **settings)
            prepare(mapper, image)
            self.frames_to_the_end(view, mapper)
            self.assert_fine(view)
            yield view.picture(), mapper.GetVisibilityScore()

    def assert_alike(self, *args, **settings):
        for type_ in (np.int8, np.uint8, np.int16, np.uint16, np.float32):
            with self.subTest(type=type_.__name__):
                (picture, score), (expected, expected_score) = self.pictures(type_, *args, **settings)
                np.testing.assert_array_equal(picture, expected)
                self.assertEqual(score, expected_score)
                self.assertGreater(np.ptp(picture), 50)

    def test_are_drawn_and_optimized_alike(self):
        self.assert_alike()

    def test_on_opengl(self):
        self.assert_alike(DrawOn=Mapper.OPENGL)

    def test_with_a_coarser_control_grid(self):
        self.assert_alike(ControlResolution=2)

    def test_with_cropping(self):
        def crop(mapper, _):
            mapper.SetCroppingRegionPlanes(2, 13, 0, 16, 3, 16)
            mapper.CroppingOn()
        self.assert_alike(crop)

    def test_with_blanked_points(self):
        def blank(_, image):
            image.AllocatePointGhostArray()
            image.GetPointGhostArray().SetValue(17 * 17 * 8 + 17 * 8 + 3, vtkDataSetAttributes.HIDDENPOINT)
        self.assert_alike(blank)


class TestValuesInPlace(MapperTest):
    """Programs write into arrays and modify the image alone."""

    def changed(self, act, prepare=lambda image: None, **settings):
        """Asserts that a view follows `act` on its image as a new view has it from the beginning.
        Returns the largest difference in the picture, and the scores before and after."""
        scalars = blob().astype(np.float32)
        importance = np.clip((scalars - 0.5) / 0.3, 0, 1)
        image = image_of(scalars.shape, scalars=scalars.ravel(), Importance=importance.ravel())
        prepare(image)

        def new_view():
            return show(image, property_of(colors_of((0, 0.2, 0.3, 0.9), (1, 0.9, 0.2, 0.1)),
                                           opacity_of((0, 0), (1, 0.5)), 1),
                        Optimization=Mapper.OFF, Shadows=0, RestrictToView=0, **settings)
        view, mapper = new_view()
        before, score = view.picture(), mapper.GetVisibilityScore()
        act(image)
        image.Modified()
        after = view.picture()
        other, again = new_view()
        np.testing.assert_array_equal(after, other.picture())
        self.assertEqual(mapper.GetVisibilityScore(), again.GetVisibilityScore())
        self.assert_fine(view)
        return np.abs(before - after).max(), score, mapper.GetVisibilityScore()

    def assert_follows(self, act, prepare=lambda image: None, **settings):
        difference, before, after = self.changed(act, prepare, **settings)
        self.assertGreater(difference, 10)
        self.assertGreater(abs(after - before), 0.01 * before)

    def test_of_scalars(self):
        def act(image):
            vtk_to_numpy(image.GetPointData().GetArray("scalars"))[2000:] *= 0.3
        self.assert_follows(act)

    def test_of_scalars_of_cells(self):
        def prepare(image):
            cells = numpy_to_vtk(blob(16).astype(np.float32).ravel(), deep=1)
            image.GetCellData().SetScalars(cells)

        def act(image):
            vtk_to_numpy(image.GetCellData().GetScalars())[1600:] *= 0.3
        self.assert_follows(act, prepare, ScalarMode=VTK_SCALAR_MODE_USE_CELL_DATA)

    def test_of_extinction(self):
        def prepare(image):
            extinction = numpy_to_vtk(blob().ravel(), deep=1)
            extinction.SetName("Extinction")
            image.GetPointData().AddArray(extinction)

        def act(image):
            vtk_to_numpy(image.GetPointData().GetArray("Extinction"))[2000:] *= 0.3
        self.assert_follows(act, prepare, ExtinctionSource=Mapper.ARRAY,
                            ExtinctionArray="Extinction")

    def test_of_importance(self):
        def act(image):
            vtk_to_numpy(image.GetPointData().GetArray("Importance"))[:] = 0.25
        _, before, after = self.changed(act)
        self.assertGreater(abs(after - before), 0.01 * before)

    def test_of_flags_of_points(self):
        def act(image):
            vtk_to_numpy(image.GetPointGhostArray())[2000:] = vtkDataSetAttributes.HIDDENPOINT
        self.assert_follows(act, vtkImageData.AllocatePointGhostArray)

    def test_of_flags_of_cells(self):
        def act(image):
            vtk_to_numpy(image.GetCellGhostArray())[1600:] = vtkDataSetAttributes.HIDDENCELL
        self.assert_follows(act, vtkImageData.AllocateCellGhostArray)

    def test_of_new_flags_of_points(self):
        def act(image):
            image.AllocatePointGhostArray()
            vtk_to_numpy(image.GetPointGhostArray())[2000:] = vtkDataSetAttributes.HIDDENPOINT
        self.assert_follows(act)

    def test_of_none_make_nothing_anew(self):
        view, mapper = show()
        view.window.Render()
        while not mapper.GetConverged():
            view.window.Render()
        before = view.picture()
        mapper.GetInput().Modified()
        view.window.Render()
        self.assertTrue(mapper.GetConverged())
        np.testing.assert_array_equal(view.picture(), before)


if __name__ == "__main__":
    unittest.main()
