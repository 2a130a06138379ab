# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The mapper with an extinction that comes from an array, in place of the opacity function.

import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import (vtkDataObject, vtkImageData, vtkPlane, vtkPlaneCollection)
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import (colors_of, difference, gray_property, image_of, opacity_of, phantom,
                          phantom_property, property_of, values)

UNIT_DISTANCE = 0.05
STEEPNESS = 6.0  # extinction of the scalar 1 [1/length]

# Pictures whose samples agree but for rounding differ where a value is next to the border between
# two of the 256 steps.
ROUNDING = 1


def add(data, name, array):
    array = numpy_to_vtk(np.ascontiguousarray(array), deep=1)
    array.SetName(name)
    data.AddArray(array)
    return array


def linear_property(*colors):
    """An extinction that is linear in the scalar: its interpolation is that of the scalar's."""
    samples = np.linspace(0, 1, 1001)
    opacities = 1 - np.exp(-STEEPNESS * UNIT_DISTANCE * samples)
    return property_of(colors_of(*colors), opacity_of(*zip(samples, opacities)), UNIT_DISTANCE)


ONE_COLOR = ((0, 0.9, 0.5, 0.1), (1, 0.9, 0.5, 0.1))
COLORS = ((0, 0.2, 0.3, 0.9), (0.5, 0.9, 0.8, 0.6), (1, 0.9, 0.2, 0.1))


def linear_phantom(resolution=32):
    """The phantom with the extinction of linear_property."""
    image = phantom(resolution)
    add(image.GetPointData(), "Extinction", STEEPNESS * values(image, "Scalars").astype(float))
    return image


def crop(mapper):
    mapper.SetCropping(1)
    mapper.SetCroppingRegionPlanes(-0.7, 0.8, -0.6, 0.55, -0.9, 0.3)


def clip(mapper):
    plane = vtkPlane()
    plane.SetOrigin(0.1, 0, 0)
    plane.SetNormal(-1, 0.2, 0.3)
    planes = vtkPlaneCollection()
    planes.AddItem(plane)
    mapper.SetClippingPlanes(planes)


class TestPicture(MapperTest):
    def test_is_that_of_the_opacity_function_with_the_same_extinction(self):
        def nothing(_):
            pass
        for name, act, settings in (
                ("unlit", nothing, dict(Method=Mapper.ORDINARY, Shadows=0)),
                ("shadows", nothing, dict(Method=Mapper.ORDINARY)),
                ("optimized", nothing, {}),
                ("missed", nothing, dict(ShowMissed=1)),
                ("Viola", nothing, dict(Method=Mapper.VIOLA_2004)),
                ("Marchesin", nothing, dict(Method=Mapper.MARCHESIN_2010)),
                ("Ament", nothing, dict(Method=Mapper.AMENT_2017)),
                ("cropped", crop, {}),
                ("clipped", clip, {})):
            with self.subTest(name=name):
                view, mapper = show(linear_phantom(24), linear_property(*ONE_COLOR), **settings)
                act(mapper)
                expected = view.picture()
                scores = [mapper.GetVisibleFraction(), mapper.GetBaseVisibleFraction()]
                mapper.SetExtinctionSource(Mapper.ARRAY)
                picture = view.picture()

                self.assert_fine(view)
                self.assertGreater(expected.std(), 3)
                self.assertLessEqual(np.abs(picture - expected).max(), ROUNDING)
                # Single precision rounds the extinction of each point by 1e-7; what the optimization
                # makes of that depends on it smoothly.
                np.testing.assert_allclose(
                    [mapper.GetVisibleFraction(), mapper.GetBaseVisibleFraction()], scores, atol=1e-5)

                mapper.SetExtinctionSource(Mapper.OPACITY_FUNCTION)
                np.testing.assert_array_equal(view.picture(), expected)

    def test_is_the_same_in_cropping_regions_that_are_no_box(self):
        view, mapper = show(linear_phantom(), linear_property(*ONE_COLOR), Method=Mapper.ORDINARY)
        whole = view.picture()
        crop(mapper)
        mapper.SetCroppingRegionFlagsToInvertedCross()
        expected = view.picture()
        mapper.SetExtinctionSource(Mapper.ARRAY)
        # In cells between empty points and others, scalars are guessed for the empty ones, which an
        # array needs not: there alone both differ.
        self.assertLess(difference(view.picture(), expected), 0.1 * difference(whole, expected))

    def test_with_shade_alone(self):
        view, mapper = show(linear_phantom(), linear_property(*ONE_COLOR), Shadows=0,
                            Method=Mapper.ORDINARY)
        unlit = view.picture()
        view.volume.GetProperty().ShadeOn()
        expected = view.picture()
        self.assertGreater(difference(expected, unlit), 1)
        mapper.SetExtinctionSource(Mapper.ARRAY)
        self.assertLessEqual(np.abs(view.picture() - expected).max(), ROUNDING)

    def test_in_motion(self):
        view, mapper = show(linear_phantom(), linear_property(*ONE_COLOR), AdaptiveQuality=1,
                            InteractiveFrameTime=10.0, Method=Mapper.ORDINARY)
        view.interact(True)
        expected = view.picture()
        mapper.SetExtinctionSource(Mapper.ARRAY)
        self.assertLessEqual(np.abs(view.picture() - expected).max(), ROUNDING)

    def test_has_the_colours_of_the_scalars(self):
        # Within a segment between two samples, the opacity function weighs colours by extinctions,
        # and an array, of which it knows the ends, does not: an error of second order in its length.
        apart = []
        for distance in (1, 0.25):
            view, mapper = show(linear_phantom(), linear_property(*COLORS), Shadows=0,
                                Method=Mapper.ORDINARY, SampleDistance=distance)
            expected = view.picture()
            mapper.SetExtinctionSource(Mapper.ARRAY)
            apart.append(difference(view.picture(), expected))
        self.assertLess(apart[0], 0.5)  # mean of roundings to 256 steps of two pictures
        self.assertLess(apart[1], apart[0] / 8)

    def test_of_a_constant_extinction_follows_beers_law(self):
        extinction, length = 0.25, 2.0
        nodes = 17
        field = np.full((nodes, nodes, nodes), extinction)
        # A grain at a corner, far from the pixels that are looked at, and so dense that numbers with
        # a step of 2^-15 of it could not tell the rest from nothing.
        field[0, 0, 0] = 1e5 * extinction
        image = image_of((nodes,) * 3, (length / (nodes - 1),) * 3, (-1, -1, -1),
                         values=np.zeros(nodes ** 3), Extinction=field.ravel())
        view, _ = show(image, gray_property(color=(1, 1, 1)), Shadows=0, Method=Mapper.ORDINARY,
                       ExtinctionSource=Mapper.ARRAY, Optimization=Mapper.OFF)
        view.renderer.SetBackground(0, 0, 0)
        view.camera.ParallelProjectionOn()
        view.look(0, 0)
        rows, columns, _ = view.picture().shape
        centre = view.picture()[rows // 2 - 10:rows // 2 + 10, columns // 2 - 10:columns // 2 + 10]
        # Half a step for the picture, and half for what the graphics card makes of it.
        np.testing.assert_allclose(centre, 255 * (1 - np.exp(-extinction * length)), atol=1)

    def test_of_integers_is_that_of_a_copy_in_floating_point(self):
        pictures = []
        for kind in (np.uint16, np.float32):
            image = linear_phantom()
            add(image.GetPointData(), "Values", np.rint(1000 * values(image, "Scalars")).astype(kind))
            image.GetPointData().SetActiveScalars("Values")
            colors = [(1000 * node, *color) for node, *color in COLORS]
            view, _ = show(image, property_of(colors_of(*colors), opacity_of((0, 0), (1, 1)), 1.0),
                           ExtinctionSource=Mapper.ARRAY)
            pictures.append(view.picture())
            self.assert_fine(view)
        self.assertGreater(pictures[0].std(), 3)
        np.testing.assert_array_equal(*pictures)

    def test_does_not_depend_on_the_opacity_function(self):
        view, mapper = show(linear_phantom(), linear_property(*COLORS),
                            ExtinctionSource=Mapper.ARRAY)
        expected = view.picture()
        for opacity in (opacity_of(), opacity_of((0.2, 0), (0.4, float("nan"))), opacity_of((0, 1))):
            view.volume.GetProperty().SetScalarOpacity(opacity)
            view.volume.GetProperty().SetScalarOpacityUnitDistance(0)
            np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)


class TestOptimization(MapperTest):
    def test_starts_from_the_array_as_the_filter_does(self):
        image = phantom()
        view, mapper = show(image, ExtinctionSource=Mapper.ARRAY, ExtinctionArray="BaseExtinction",
                            LightSource=Mapper.OWN, LightPosition=(1.0, 2.0, 5.0))
        view.window.Render()
        filter_ = vtkExtinctionOptimizer()
        filter_.SetInputData(image)
        filter_.SetVisibilitySettings(mapper.GetVisibilitySettings())
        filter_.SetExtinctionSource(filter_.ARRAY)
        for name in ("Position", "FocalPoint", "ViewUp", "ViewAngle"):
            getattr(filter_, "SetCamera" + name)(getattr(view.camera, "Get" + name)())
        filter_.Update()

        def found(name):
            return filter_.GetOutput().GetFieldData().GetArray(name).GetValue(0)
        # The same sums over the same numbers; the camera went through matrices of the view.
        for name in ("VisibilityScore", "BaseVisibilityScore", "VisibleFraction",
                     "SacrificedFraction"):
            with self.subTest(name=name):
                self.assertAlmostEqual(getattr(mapper, "Get" + name)(), found(name),
                                       delta=1e-4 * found(name))

        # What the filter has found is shown and scored as it found it.
        result, shown = show(filter_.GetOutput(), ExtinctionSource=Mapper.ARRAY,
                             Method=Mapper.ORDINARY)
        result.renderer.SetActiveCamera(view.camera)
        picture = result.picture()
        self.assertAlmostEqual(shown.GetVisibilityScore(), found("VisibilityScore"),
                               delta=1e-4 * found("VisibilityScore"))
        self.assertGreater(picture.std(), 3)
        self.assert_fine(result)


class TestArray(MapperTest):
    def test_changes_are_followed(self):
        image = linear_phantom()
        view, mapper = show(image, ExtinctionSource=Mapper.ARRAY)
        before = view.picture()
        extinction = values(image, "Extinction")
        extinction[:] *= 3
        image.GetPointData().GetArray("Extinction").Modified()
        after = view.picture()
        self.assertGreater(difference(before, after), 1)
        np.testing.assert_array_equal(show(image, ExtinctionSource=Mapper.ARRAY)[0].picture(), after)
        self.assert_fine(view)

    def test_values_that_are_no_extinctions_are_empty_with_one_warning(self):
        image = linear_phantom()
        extinction = values(image, "Extinction")
        extinction[15000:15100] = np.nan
        extinction[15100:15150] = -1
        extinction[15150:15200] = np.inf
        settings = dict(ExtinctionSource=Mapper.ARRAY, Method=Mapper.ORDINARY)
        view, mapper = show(image, linear_property(*ONE_COLOR), **settings)
        self.assert_says(view, "150 of 32768 points have a NaN", "50 of 32768 points have a negative")
        self.assert_sane(view, mapper)
        picture = view.picture()

        extinction[15000:15200] = 0
        image.GetPointData().GetArray("Extinction").Modified()
        np.testing.assert_array_equal(view.picture(), picture)
        self.assertEqual(mapper.GetMessages(), "")

    def test_what_is_blanked_is_empty(self):
        image = linear_phantom()
        image.AllocatePointGhostArray()
        settings = dict(ExtinctionSource=Mapper.ARRAY, Method=Mapper.ORDINARY)
        view, mapper = show(image, linear_property(*ONE_COLOR), **settings)
        view.window.Render()
        vtk_to_numpy(image.GetPointGhostArray())[10000:16000] = 2  # HIDDENPOINT
        image.GetPointGhostArray().Modified()
        picture = view.picture()

        without = linear_phantom()
        values(without, "Extinction")[10000:16000] = 0
        other, _ = show(without, linear_property(*ONE_COLOR), **settings)
        np.testing.assert_array_equal(other.picture(), picture)
        self.assert_fine(view)

    def test_none_at_all_is_an_empty_picture(self):
        image = linear_phantom()
        values(image, "Extinction")[:] = 0
        view, mapper = show(image, ExtinctionSource=Mapper.ARRAY)
        self.assert_empty(view.picture())
        self.assert_fine(view)
        self.assert_sane(view, mapper)

    def test_of_cells_is_averaged_to_the_points(self):
        image = phantom()
        cells = values(image, "BaseExtinction").reshape(32, 32, 32)[:-1, :-1, :-1].ravel()
        alone = vtkImageData()
        alone.CopyStructure(image)
        add(alone.GetCellData(), "Averaged", cells)
        average = vtkCellDataToPointData()
        average.SetInputData(alone)
        average.Update()
        image.GetPointData().AddArray(average.GetOutput().GetPointData().GetArray("Averaged"))
        add(image.GetCellData(), "OfCells", cells)

        view, mapper = show(image, ExtinctionSource=Mapper.ARRAY, ExtinctionArray="Averaged")
        expected = view.picture()
        self.assertGreater(expected.std(), 3)
        mapper.SetExtinctionArray("OfCells")
        np.testing.assert_array_equal(view.picture(), expected)
        mapper.SetExtinctionArrayAssociation(vtkDataObject.FIELD_ASSOCIATION_CELLS)
        np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)
        mapper.SetExtinctionArrayAssociation(vtkDataObject.FIELD_ASSOCIATION_POINTS)
        self.assert_says(view, '"OfCells"', "extinction")

    def test_that_is_missing_is_named(self):
        view, mapper = show(linear_phantom(), ExtinctionSource=Mapper.ARRAY,
                            ExtinctionArray="Absent")
        self.assert_says(view, '"Absent"',
                         "Scalars, Importance, BaseExtinction, Structure, Extinction",
                         "ExtinctionSource")
        self.assert_empty(view.pixels())
        self.assert_sane(view, mapper)
        mapper.SetExtinctionArray("")
        self.assertGreater(view.picture().std(), 3)
        self.assertEqual(mapper.GetMessages(), "")

    def test_with_several_components_is_refused(self):
        image = phantom()
        add(image.GetPointData(), "Extinction", np.ones((32 ** 3, 3)))
        view, _ = show(image, ExtinctionSource=Mapper.ARRAY)
        self.assert_says(view, '"Extinction"', "3 components")

    def test_memory_is_given_back_and_everything_made_again(self):
        view, mapper = show(linear_phantom(), phantom_property(), ExtinctionSource=Mapper.ARRAY)
        self.assert_made_again(view, mapper)


class TestReference(MapperTest):
    """An extinction to stay near, which is the base extinction."""

    REFERENCES = 4  # first input array of references

    def test_with_a_large_weight_is_what_is_drawn(self):
        image = linear_phantom()
        view, mapper = show(image)
        view.window.Render()
        self.assertGreater(mapper.GetVisibleFraction(), 1.05 * mapper.GetBaseVisibleFraction())
        mapper.SetInputArrayToProcess(self.REFERENCES, 0, 0, vtkDataObject.POINT, "Extinction")
        mapper.SetReferencePull(1e7)
        view.window.Render()

        self.assert_fine(view)
        # Extinctions of the display are those of a table, with steps of 1/4095 of the range.
        self.assertAlmostEqual(mapper.GetVisibleFraction(), mapper.GetBaseVisibleFraction(),
                               delta=1e-3)

    def test_is_read_again_when_it_changes(self):
        image = linear_phantom()
        array = image.GetPointData().GetArray("Extinction")
        view, mapper = show(image, ReferencePull=1e7)
        mapper.SetInputArrayToProcess(self.REFERENCES, 0, 0, vtkDataObject.POINT, "Extinction")
        view.window.Render()
        self.assert_fine(view)
        value = array.GetValue(77)
        array.SetValue(77, np.nan)
        array.Modified()
        self.assert_says(view, "The reference extinction of voxel 77 is nan")
        array.SetValue(77, value)
        array.Modified()
        view.window.Render()
        self.assertEqual(mapper.GetMessages(), "")

    def test_that_is_missing_is_named(self):
        view, mapper = show(linear_phantom(), ReferencePull=1)
        mapper.SetInputArrayToProcess(self.REFERENCES, 0, 0, vtkDataObject.POINT, "Absent")
        self.assert_says(view, 'The reference array "Absent"')


if __name__ == "__main__":
    unittest.main()
