# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# limpid.render: the picture's layout, its colours, and what the extinction does to it.

import unittest

import numpy as np

import limpid

import phantom
from phantom import COLORS, EXTINCTION, ORIGIN, SPACING, VIEW

STEP = 1  # of an 8-bit picture


def render(values=None, **arguments):
    return limpid.render(phantom.scalars() if values is None else values, **{
        "color_function": COLORS, "extinction_function": EXTINCTION, "spacing": SPACING,
        "origin": ORIGIN, "width": 60, "height": 40, **VIEW, **arguments})


class TestPicture(unittest.TestCase):
    def test_has_rows_columns_and_four_channels(self):
        picture = render()

        self.assertEqual((picture.shape, picture.dtype), ((40, 60, 4), np.uint8))
        self.assertEqual(picture[0, 0].tolist(), [0, 0, 0, 0])
        self.assertGreater(picture[20, 30, 3], 0)

    def test_colours_are_not_multiplied_by_alpha(self):
        one = [[0, 1.0, 0.5, 0.25]]
        thin = [[0, 0.02]]
        picture = render(color_function=one, extinction_function=thin, lit=False)

        alpha = picture[20, 30, 3]
        self.assertLess(alpha, 128)
        # A channel times alpha is rounded to a step, and divided by alpha.
        bound = STEP * 255 / alpha + STEP
        self.assertLess(np.abs(picture[20, 30, :3] - np.array([255, 127.5, 63.75])).max(), bound)

    def test_alpha_is_beers_law(self):
        thickness = SPACING[2] * (phantom.SHAPE[2] - 1)
        x, y, z = ORIGIN + np.multiply(SPACING, np.subtract(phantom.SHAPE, 1)) / 2
        picture = render(extinction_function=[[0, 0.1]], lit=False, width=41, height=41,
                         camera=((x, y, z + 40), (x, y, z), (0, 1, 0)))

        expected = 255 * -np.expm1(-0.1 * thickness)
        self.assertLess(abs(picture[20, 20, 3] - expected), STEP)

    def test_the_top_row_is_first_and_the_left_column_too(self):
        values = np.zeros(phantom.SHAPE, dtype=np.float32, order="F")
        values[-6:, -6:] = 1  # at large x and y
        x, y, z = ORIGIN + np.multiply(SPACING, np.subtract(phantom.SHAPE, 1)) / 2
        alpha = render(values, camera=((x, y, z + 40), (x, y, z), (0, 1, 0)))[..., 3].astype(int)

        self.assertGreater(alpha[:20, 30:].sum(), 0)
        self.assertEqual(alpha.sum(), alpha[:20, 30:].sum())

    def test_every_order_of_axes_has_the_same_picture(self):
        fortran = render().astype(int)
        for values in (phantom.scalars("C"), phantom.scalars(dtype=float)):
            # Sums of samples in another order: half a step more or less is the next one.
            self.assertLessEqual(np.abs(render(values)[..., 3] - fortran[..., 3]).max(), STEP)

    def test_a_parallel_camera_sees_the_same_from_afar(self):
        x, y, z = ORIGIN + np.multiply(SPACING, np.subtract(phantom.SHAPE, 1)) / 2
        far = 1e5
        parallel = {"position": (x, y, z + 40), "focal_point": (x, y, z), "parallel_scale": 8,
                    "parallel_projection": True}
        perspective = {"position": (x, y, z + far), "focal_point": (x, y, z),
                       "view_angle": 2 * np.degrees(np.arctan(8 / far))}

        one = render(camera=parallel, lit=False).astype(int)
        other = render(camera=perspective, lit=False).astype(int)

        self.assertGreater(one[..., 3].max(), 0)
        # Samples lie elsewhere along the rays, by less than one; the shell is three thick.
        self.assertLess(np.abs(one - other)[..., 3].mean(), 2 * STEP)

    def test_shows_what_was_found(self):
        scene = {"spacing": SPACING, "origin": ORIGIN, "extinction_function": EXTINCTION}
        found = limpid.optimize(phantom.scalars(), importance_function=phantom.IMPORTANCE, **scene,
                                **VIEW)

        before, after = render(lit=False), render(extinction=found.extinction, lit=False)

        redness = [int(picture[20, 30, 0]) - int(picture[20, 30, 2]) for picture in (before, after)]
        self.assertLess(*redness)
        same = render(extinction=phantom.fields()[0])
        np.testing.assert_array_equal(same, render())

    def test_points_without_a_number_are_empty(self):
        values = phantom.scalars()
        values[:] = np.nan
        self.assertEqual(render(values).max(), 0)

    def test_light_and_shadows_count(self):
        self.assertGreater(np.abs(render().astype(int) - render(shadows=False)).max(), STEP)
        self.assertGreater(np.abs(render().astype(int) - render(lit=False)).max(), STEP)


if __name__ == "__main__":
    unittest.main()
