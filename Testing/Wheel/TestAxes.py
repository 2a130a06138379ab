# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Arrays whose axes are z, y, x: those of xarray say so, and images of SimpleITK; of numpy's there
# is a warning. Masked arrays are empty where they have no value.

import unittest
import warnings

import numpy as np

import limpid
from limpid.scene import scene_of

import phantom
from phantom import ORIGIN, SCENE, SHAPE, SPACING, VIEW

try:
    import xarray
except ImportError:
    xarray = None
try:
    import SimpleITK
except ImportError:
    SimpleITK = None

FUNCTIONS = {name: SCENE[name] for name in ("extinction_function", "importance_function")}


class NamedArray:
    """What the package asks of a DataArray of xarray."""

    def __init__(self, values, dims, coords=None):
        self.values, self.dims, self.coords = values, dims, coords or {}
        self.shape = values.shape

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self.values, dtype=dtype)


def coordinates():
    return {axis: first + step * np.arange(count)
            for axis, first, step, count in zip("xyz", ORIGIN, SPACING, SHAPE)}


def told(function, *arguments, **named):
    """What a call returns, and the texts of its warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = function(*arguments, **named)
    return result, [str(warning.message) for warning in caught]


class TestNamedAxes(unittest.TestCase):
    def make(self, values, dims, coords=None):
        return NamedArray(values, dims, coords)

    def test_results_are_those_of_the_array_by_x_y_and_z(self):
        expected = limpid.optimize(phantom.scalars(), **SCENE, **VIEW)
        for dims, axes in ((("z", "y", "x"), (2, 1, 0)), (("Y", "Z", "X"), (1, 2, 0))):
            values = np.ascontiguousarray(phantom.scalars().transpose(axes))
            found, texts = told(limpid.optimize, self.make(values, dims), **SCENE, **VIEW)

            self.assertEqual(found.extinction.shape, values.shape)
            self.assertEqual(texts, [])
            bound = phantom.rounding_of_sweeps() * expected.base_visibility_score
            self.assertLess(abs(found.base_visibility_score - expected.base_visibility_score),
                            bound)
            self.assertEqual(found.dimensions, SHAPE)

    def test_arrays_are_used_where_they_are(self):
        mu, g = (np.ascontiguousarray(field.transpose(2, 1, 0)) for field in phantom.fields())
        scene = scene_of(None, extinction=self.make(mu, ("z", "y", "x")), importance=g)

        self.assertTrue(np.shares_memory(scene.in_core()[1], mu))
        self.assertTrue(np.shares_memory(scene.in_core()[2], g))

    def test_coordinates_tell_where_the_points_are(self):
        values = phantom.scalars().transpose(2, 1, 0)
        grid = scene_of(self.make(values, ("z", "y", "x"), coordinates()), **FUNCTIONS).grid

        np.testing.assert_allclose(grid.spacing, SPACING)
        np.testing.assert_allclose(grid.origin, ORIGIN)
        same = scene_of(self.make(values, ("z", "y", "x"), coordinates()), **SCENE).grid
        np.testing.assert_allclose(same.spacing, SPACING)

    def test_what_cannot_be_told_is_refused(self):
        values = phantom.scalars()
        uneven = {"y": np.arange(SHAPE[1]) ** 2}
        falling = {"y": np.arange(SHAPE[1])[::-1]}
        for array, arguments, words in (
                (self.make(values, ("lat", "lon", "height")), {}, "('lat', 'lon', 'height')"),
                (self.make(values, ("x", "y", "z"), uneven), {}, "along 'y'"),
                (self.make(values, ("x", "y", "z"), falling), {}, "sortby('y')"),
                (self.make(values, ("x", "y", "z"), coordinates()), {"spacing": (1, 1, 1)},
                 "the array's own is"),
                (self.make(values[..., None] + np.zeros(2), ("x", "y", "z", "time")), {},
                 "2 values per point")):
            with self.assertRaises(ValueError) as caught:
                limpid.optimize(array, **{**FUNCTIONS, **arguments})
            self.assertIn(words, str(caught.exception))

    def test_pictures_are_those_of_the_array_by_x_y_and_z(self):
        draw = {"color_function": phantom.COLORS, "width": 30, "height": 30, "lit": False,
                "camera": VIEW["camera"], "spacing": SPACING, "origin": ORIGIN,
                "extinction_function": phantom.EXTINCTION}
        expected = limpid.render(phantom.scalars(), **draw)
        array = self.make(np.ascontiguousarray(phantom.scalars().transpose(2, 1, 0)),
                          ("z", "y", "x"))

        self.assertLessEqual(np.abs(limpid.render(array, **draw).astype(int) - expected).max(), 1)


@unittest.skipIf(xarray is None, "xarray is not installed: a stand-in is tested")
class TestXarray(TestNamedAxes):
    def make(self, values, dims, coords=None):
        return xarray.DataArray(values, dims=dims, coords=coords)

    def test_what_is_found_goes_into_a_copy(self):
        array = self.make(phantom.scalars().transpose(2, 1, 0), ("z", "y", "x"), coordinates())
        found = limpid.optimize(array, **FUNCTIONS, **VIEW)

        self.assertEqual(array.copy(data=found.extinction).dims, array.dims)


@unittest.skipIf(SimpleITK is None, "SimpleITK is not installed: its images are not tested")
class TestSimpleItk(unittest.TestCase):
    def image(self):
        image = SimpleITK.GetImageFromArray(np.ascontiguousarray(
            phantom.scalars().transpose(2, 1, 0)))
        image.SetSpacing(SPACING)
        image.SetOrigin(ORIGIN)
        return image

    def test_an_image_gives_what_its_array_gives(self):
        expected = limpid.optimize(phantom.scalars(), **SCENE, **VIEW)
        found = limpid.optimize(self.image(), **FUNCTIONS, **VIEW)

        np.testing.assert_array_equal(found.extinction.transpose(2, 1, 0), expected.extinction)
        result = SimpleITK.GetImageFromArray(found.extinction)
        result.CopyInformation(self.image())
        self.assertEqual(result.GetSize(), SHAPE)

    def test_its_direction_counts(self):
        image = self.image()
        image.SetDirection((0, -1, 0, 1, 0, 0, 0, 0, 1))
        turn = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]

        np.testing.assert_allclose(scene_of(image, **FUNCTIONS).grid.direction, turn)

    def test_slices_are_refused(self):
        with self.assertRaisesRegex(ValueError, "2 dimensions"):
            limpid.optimize(self.image()[:, :, 3], **FUNCTIONS)


class TestDoubt(unittest.TestCase):
    SCAN = np.zeros((10, 20, 20), dtype=np.float32)  # ten slices, z first

    def test_a_spacing_of_other_axes_is_told(self):
        _, texts = told(limpid.optimize, self.SCAN, spacing=(0.5, 0.5, 2.5), **FUNCTIONS)

        self.assertIn("in which x differs", texts[0])
        self.assertIn("in which z differs", texts[0])
        self.assertIn("transpose(2, 1, 0)", texts[0])

    def test_other_spacings_are_taken_as_they_are(self):
        for values, spacing in ((self.SCAN.T, (0.5, 0.5, 2.5)), (self.SCAN, (2.5, 0.5, 0.5)),
                                (self.SCAN, (1, 1, 1)), (self.SCAN, (1, 2, 3))):
            _, texts = told(scene_of, values, spacing=spacing, **FUNCTIONS)
            self.assertEqual(texts, [])


class TestMasks(unittest.TestCase):
    def test_masked_points_are_empty(self):
        mask = np.zeros(SHAPE, dtype=bool)
        mask[:, :, 9:] = True
        values = phantom.scalars()
        values[mask] = 9  # which would be dense and important
        for masked in (np.ma.array(values, mask=mask),
                       np.ma.array((100 * values).astype(np.int16), mask=mask)):
            scale = 100 if masked.dtype == np.int16 else 1
            nodes = {name: [[scale * node[0], node[1]] for node in FUNCTIONS[name]]
                     for name in FUNCTIONS}
            scene, texts = told(scene_of, masked, **nodes)
            empty = np.where(mask, 0, masked.data)
            expected = scene_of(empty, **nodes)

            self.assertEqual(texts, [])
            np.testing.assert_array_equal(scene.base_extinction, expected.base_extinction)
            np.testing.assert_array_equal(scene.importance, expected.importance)

    def test_a_mask_of_either_field_is_one_of_both(self):
        mu, g = phantom.fields()
        mask = np.zeros(SHAPE, dtype=bool)
        mask[12, 10, 8] = True
        for fields in ({"extinction": np.ma.array(mu, mask=mask), "importance": g},
                       {"extinction": mu, "importance": np.ma.array(g, mask=mask)}):
            scene = scene_of(None, **fields)

            self.assertEqual((scene.base_extinction[mask], scene.importance[mask]), (0, 0))
            self.assertGreater(mu[12, 10, 8], 0, "The caller's array was changed.")

    def test_the_default_ramp_is_over_what_is_not_masked(self):
        values = phantom.scalars()
        mask = values > 0.9
        masked = np.where(mask, 1000, values)
        one = scene_of(np.ma.array(masked, mask=mask), importance=values)
        other = scene_of(np.ma.array(values, mask=mask), importance=values)

        np.testing.assert_array_equal(one.base_extinction, other.base_extinction)

    def test_the_default_ramp_takes_all_types(self):
        values = np.round(100 * phantom.scalars())
        expected = scene_of(values, importance=phantom.scalars()).base_extinction
        for letter in np.typecodes["AllInteger"] + "efd":
            with self.subTest(np.dtype(letter).name):
                scene = scene_of(values.astype(letter), importance=phantom.scalars())

                np.testing.assert_array_equal(scene.base_extinction, expected)

        mask = values > 60
        floats, integers = (scene_of(np.ma.array(values.astype(letter), mask=mask), importance=phantom.scalars())
                            for letter in "dh")
        np.testing.assert_array_equal(integers.base_extinction, floats.base_extinction)
        self.assertGreater(floats.base_extinction.max(), 0)

    def test_masked_points_are_not_drawn(self):
        values = np.ma.array(phantom.scalars(), mask=True)
        picture = limpid.render(values, color_function=phantom.COLORS, spacing=SPACING,
                                extinction_function=phantom.EXTINCTION, camera=VIEW["camera"])

        self.assertEqual(picture.max(), 0)


if __name__ == "__main__":
    unittest.main()
