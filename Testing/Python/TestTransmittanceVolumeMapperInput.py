# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What the mapper says and shows of what cannot be drawn.

import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction, vtkRectilinearGrid

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import (BACKGROUND, View, caught, colors_of, difference, gray_property, image_of,
                          opacity_of, phantom, phantom_property, property_of, values)


class TestBadInput(MapperTest):
    """A message, no crash, no pixels that are not colours."""

    def test_a_camera_on_the_box_and_in_its_corners(self):
        for position in ((1, 0, 0), (1, 1, 1), (0, 0, 0), (1, 1, 0)):
            for focus in ((0, 0, 0), (0.3, 0.2, 0.1), (1, 1, 2)):
                if position == focus:
                    continue
                with self.subTest(position=position, focus=focus):
                    view, mapper = show()
                    view.camera.SetPosition(*position)
                    view.camera.SetFocalPoint(*focus)
                    view.camera.SetClippingRange(0.01, 10)
                    view.window.Render()
                    self.assert_fine(view)
                    self.assert_sane(view, mapper)

    def test_a_camera_on_the_box_sees_what_one_beside_it_sees(self):
        view, mapper = show(Optimization=Mapper.OFF)
        view.camera.SetViewUp(0.1, 0.2, 1)
        view.camera.SetClippingRange(0.01, 10)
        for position in ((1, 0, 0), (1, 0.2, 0.3), (1, 1, 0), (-1, 0.5, -1), (1, 1, 1)):
            for focus in ((0, 0, 0), (0.3, 0.2, 0.1), (-1, -1, -1)):
                pictures = []
                for step in (0, 1e-3):
                    view.camera.SetPosition(*(np.array(position) + step * np.array((3, 5, -4))))
                    view.camera.SetFocalPoint(*focus)
                    pictures.append(view.picture())
                with self.subTest(position=position, focus=focus):
                    # A thousandth of the box moves no pixel by more than a step or so.
                    self.assertLess(difference(*pictures), 1)
                    self.assertGreater(pictures[0].std(), 3)
        self.assert_fine(view)

    def test_a_camera_that_is_nowhere(self):
        nan, inf = float("nan"), float("inf")

        def parallel_scale(camera, scale):
            camera.ParallelProjectionOn()
            camera.SetParallelScale(scale)
        for name, act in dict(
                position=lambda camera: camera.SetPosition(nan, 0, 5),
                infinite=lambda camera: camera.SetPosition(inf, 0, 5),
                focal_point=lambda camera: camera.SetFocalPoint(0, nan, 0),
                view_up=lambda camera: camera.SetViewUp(0, nan, 0),
                view_angle=lambda camera: camera.SetViewAngle(nan),
                clipping_range=lambda camera: camera.SetClippingRange(nan, nan),
                no_scale=lambda camera: parallel_scale(camera, 0),
                nan_scale=lambda camera: parallel_scale(camera, nan)).items():
            for moving in (False, True):
                with self.subTest(name=name, moving=moving):
                    view, mapper = show(phantom(8))
                    view.window.Render()
                    act(view.camera)
                    view.interact(moving)
                    self.assert_says(view, "camera", "nan")
                    self.assert_empty(view.pixels())
                    self.assert_sane(view, mapper)

    def test_a_camera_at_its_focal_point(self):
        view, mapper = show()
        view.camera.SetPosition(1, 2, 3)
        view.camera.SetFocalPoint(1, 2, 3)
        view.window.Render()
        self.assert_sane(view, mapper)

    def test_a_view_up_along_the_view_direction(self):
        view, mapper = show()
        view.camera.SetViewUp(*np.subtract(view.camera.GetPosition(),
                                           view.camera.GetFocalPoint()))
        view.window.Render()
        self.assert_sane(view, mapper)

    def test_a_camera_far_away_and_one_that_looks_away(self):
        view, mapper = show()
        view.camera.SetPosition(1e6, 2e5, 3e5)
        view.camera.SetViewAngle(1e-4)
        view.renderer.ResetCameraClippingRange()
        self.assertGreater(view.picture().std(), 3)
        view.camera.SetFocalPoint(2e6, 0, 0)
        view.camera.SetClippingRange(1, 1e9)
        self.assert_empty(view.picture())
        self.assert_fine(view)

    def test_opacity_one_everywhere(self):
        for shadows in (0, 1):
            view, mapper = show(volume_property=gray_property(1.0, 1e-6), Shadows=shadows)
            picture = view.picture()
            self.assert_fine(view)
            self.assert_sane(view, mapper)
            self.assertGreater(picture.std(), 3)
            if not shadows:  # nothing but background and the colour of the medium
                colors = np.unique(picture.reshape(-1, 3), axis=0)
                np.testing.assert_allclose(
                    colors, 255 * np.array([BACKGROUND, (0.9, 0.5, 0.1)]), atol=1)

    def test_functions_with_values_that_are_no_numbers(self):
        nan = float("nan")
        view, _ = show()
        view.volume.GetProperty().SetScalarOpacity(opacity_of((0, nan), (1, 1)))
        self.assert_says(view, "opacity function", "nan")
        view.messages.clear()
        view.volume.SetProperty(phantom_property())
        view.volume.GetProperty().SetColor(colors_of((0, 1, nan, 0), (1, 1, 0, 0)))
        self.assert_says(view, "colour function", "nan")

    def test_opacity_zero_everywhere(self):
        view, mapper = show(volume_property=gray_property(0.0, 1.0))
        self.assert_empty(view.picture())
        self.assert_fine(view)
        self.assert_sane(view, mapper)

    def test_unit_distance_zero(self):
        view, mapper = show()
        view.volume.GetProperty().SetScalarOpacityUnitDistance(0)
        self.assert_says(view, "unit distance", "0")
        self.assert_empty(view.pixels())
        self.assert_sane(view, mapper)
        view.volume.GetProperty().SetScalarOpacityUnitDistance(0.05)
        self.assertGreater(view.picture().std(), 3)
        self.assertEqual(mapper.GetMessages(), "")

    def test_missing_importance(self):
        view, mapper = show(ImportanceArray="Absent")
        self.assert_says(view, '"Absent"', "Scalars, Importance, BaseExtinction")
        self.assertGreater(view.pixels().std(), 3)
        self.assert_sane(view, mapper)
        self.assertIn('"Absent"', mapper.GetMessages())
        mapper.SetOptimization(Mapper.OFF)
        view.window.Render()
        self.assertEqual(mapper.GetMessages(), "")

    def test_importance_that_is_none_or_all(self):
        for value in (0, 1):
            image = phantom()
            values(image, "Importance")[:] = value
            view, mapper = show(image)
            self.assertGreater(view.picture().std(), 3)
            self.assert_fine(view)
            self.assert_sane(view, mapper)

    def test_a_missing_scalar_array(self):
        view, mapper = show()
        mapper.SelectScalarArray("Absent")
        mapper.SetScalarModeToUsePointFieldData()
        self.assert_says(view, '"Absent"', "Scalars, Importance, BaseExtinction")
        self.assert_empty(view.pixels())

    def test_four_components(self):
        image = image_of((8, 8, 8), rgba=np.random.default_rng(1).integers(
            0, 255, (512, 4)).astype(np.uint8), Importance=np.zeros(512))
        view, mapper = show(image, property_of(colors_of((0, 1, 0, 0), (255, 0, 0, 1)),
                                               opacity_of((0, 0), (500, 0.5)), 1.0))
        self.assert_says(view, '"rgba"', "4 components", "ScalarComponent")
        self.assertGreater(view.pixels().std(), 3)
        view.volume.GetProperty().IndependentComponentsOff()
        view.messages.clear()
        self.assert_says(view, '"rgba"', "4 dependent components")
        self.assert_empty(view.pixels())
        view.messages.clear()
        view.volume.GetProperty().IndependentComponentsOn()
        mapper.SetScalarComponent(7)
        self.assert_says(view, "ScalarComponent is 7")

    def test_nan_infinity_and_blanked_points_are_empty_with_one_warning(self):
        image = phantom()
        values(image, "Scalars")[:100] = np.nan
        values(image, "Scalars")[100:200] = np.inf
        values(image, "Importance")[5000:5010] = np.nan
        view, mapper = show(image)
        self.assert_says(view, "210 of 32768")
        self.assert_sane(view, mapper)

        image = phantom()
        image.AllocatePointGhostArray()
        vtk_to_numpy(image.GetPointGhostArray())[:] = 2  # vtkDataSetAttributes::HIDDENPOINT
        view, mapper = show(image)
        self.assert_empty(view.picture())
        self.assert_fine(view)
        self.assertEqual(mapper.GetVisibilityScore(), 0)

    def test_ghost_arrays_of_a_wrong_kind_are_refused(self):
        image = phantom()
        flags = numpy_to_vtk(np.zeros(100, np.uint8), deep=1)
        flags.SetName("vtkGhostType")
        image.GetPointData().AddArray(flags)
        view, mapper = show(image)
        self.assert_says(view, '"vtkGhostType"', "100 tuples", "32768 points")
        self.assert_empty(view.pixels())

        image.GetPointData().RemoveArray("vtkGhostType")
        self.assertGreater(view.picture().std(), 3)

    def test_everything_nan(self):
        view, mapper = show(image_of((4, 4, 4), s=np.full(64, np.nan), Importance=np.ones(64)))
        self.assert_says(view, "64 of 64")
        self.assert_empty(view.pixels())

    def test_flat_images(self):
        for shape in ((5, 5, 1), (1, 5, 5), (5, 1, 1), (1, 1, 1)):
            with self.subTest(shape=shape):
                count = int(np.prod(shape))
                view, mapper = show(image_of(shape, s=np.linspace(0, 1, count),
                                             Importance=np.ones(count)))
                self.assert_says(view, "{} x {} x {}".format(*shape))
                self.assert_empty(view.pixels())

    def test_the_smallest_volume(self):
        view, mapper = show(image_of((2, 2, 2), s=np.linspace(0, 1, 8), Importance=np.ones(8)),
                            gray_property(0.5, 0.2))
        self.assertGreater(view.picture().std(), 3)
        self.assert_fine(view)
        self.assert_sane(view, mapper)

    def test_no_points_and_no_input(self):
        view, mapper = show()
        mapper.SetInputData(vtkImageData())
        view.window.Render()
        mapper.RemoveAllInputConnections(0)
        view.window.Render()
        self.assert_empty(view.pixels())

    def test_another_kind_of_grid(self):
        from vtkmodules.vtkCommonCore import vtkDoubleArray
        grid = vtkRectilinearGrid()
        grid.SetDimensions(2, 2, 2)
        for axis in "XYZ":
            coordinates = vtkDoubleArray()
            coordinates.InsertNextValue(0)
            coordinates.InsertNextValue(1)
            getattr(grid, f"Set{axis}Coordinates")(coordinates)
        view = View()
        mapper = Mapper()
        view.add(grid, phantom_property(), mapper)
        view.renderer.ResetCamera()
        view.messages = caught(mapper)
        self.assert_says(view, "vtkRectilinearGrid", "vtkResampleToImage")

    def test_a_sheared_direction_matrix(self):
        image = phantom(8)
        image.SetDirectionMatrix(1, 0.002, 0, 0, 1, 0, 0, 0, 1)
        view, _ = show(image)
        self.assert_says(view, "direction matrix")
        self.assert_empty(view.picture())

    def test_a_volume_that_is_scaled_flat(self):
        view, mapper = show()
        view.volume.SetScale(1, 1, 0)
        view.window.Render()
        self.assertEqual(len(view.messages), 1)
        self.assert_sane(view, mapper)

    def test_a_window_without_pixels(self):
        view, mapper = show()
        view.renderer.SetViewport(0.2, 0.2, 0.2, 0.2)
        self.assert_says(view, "0 x 0 pixels")
        self.assert_sane(view, mapper)
        view.window.SetSize(1, 1)
        view.renderer.SetViewport(0, 0, 1, 1)
        view.window.Render()

    def test_settings_that_make_no_sense_are_named(self):
        nan = np.nan  # the settings themselves move other numbers into their ranges
        cases = dict(ViewWeight=nan, LightWeight=nan, RegularizationWeight=nan, RayDensity=nan,
                     ClearingThreshold=nan, Tolerance=nan, MaximumSeconds=nan,
                     ShadowStrength=nan, Ambient=nan, Anisotropy=1, Specular=nan,
                     SpecularPower=nan, LightIntensity=nan, SampleDistance=0,
                     InteractiveFrameTime=0, EaseTime=nan,
                     ProtectImportance=nan, Emphasis=nan, AmentRegularization=0, AmentExponent=nan)
        for name, value in cases.items():
            with self.subTest(name=name):
                view, mapper = show(phantom(8), **{name: value})
                view.window.Render()
                view.window.Render()
                self.assertEqual(len(view.messages), 1, view.messages)
                self.assertIn(str(value), view.messages[0])
                self.assert_sane(view, mapper)

    def test_what_is_not_used_is_named(self):
        def gradient(view):
            view.volume.GetProperty().SetGradientOpacity(opacity_of((0, 0), (1, 1)))

        def two_dimensional(view):
            view.volume.GetProperty().SetTransferFunctionMode(1)

        def blend(view):
            view.volume.GetMapper().SetBlendModeToMaximumIntensity()

        def nearest(view):
            view.volume.GetProperty().SetInterpolationTypeToNearest()

        def shader(view):
            view.volume.GetShaderProperty().AddFragmentShaderReplacement(
                "//VTK::Base::Impl", True, "//VTK::Base::Impl", False)

        def nothing(view):
            view.volume.GetProperty().SetScalarOpacity(vtkPiecewiseFunction())
        for act, word in ((nearest, "nearest"), (gradient, "gradient opacity"),
                          (two_dimensional, "two-dimensional"), (blend, "blend mode"),
                          (shader, "shaders"),
                          (nothing, "no points")):
            with self.subTest(word=word):
                view, mapper = show(phantom(16))
                act(view)
                self.assert_says(view, word)

    def test_cuda_is_used_or_an_error(self):
        view, mapper = show(phantom(16), Backend=Mapper.CUDA)
        view.window.Render()
        if view.messages:
            self.assertEqual(len(view.messages), 1)
            self.assertIn("CUDA", view.messages[0])
        else:
            self.assertIn("CUDA", mapper.GetBackendName())

    def test_a_message_comes_again_after_it_was_settled(self):
        view, mapper = show(ImportanceArray="Absent")
        for name in ("Importance", "Absent"):
            view.window.Render()
            mapper.SetImportanceArray(name)
        view.window.Render()
        self.assertEqual(len(view.messages), 2)

    def test_a_message_about_an_error_is_not_repeated_while_the_camera_moves(self):
        view, mapper = show(ImportanceArray="Absent")
        for _ in range(5):
            view.camera.Azimuth(5)
            view.window.Render()
        self.assertEqual(len(view.messages), 1)


if __name__ == "__main__":
    unittest.main()
