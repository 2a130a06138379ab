# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# limpid.viewpoints: the sphere of directions, and the views that are ranked.

import unittest
import warnings

import numpy as np

import limpid
from limpid import sphere

import phantom
from phantom import SCENE

FEW = 42


def search(order="F", **arguments):
    return limpid.viewpoints(phantom.scalars(order), number_of_directions=FEW,
                             **{**SCENE, **arguments})


class TestSphere(unittest.TestCase):
    def test_has_the_nearest_number_of_directions(self):
        for wanted, number in ((1, 12), (26, 12), (28, 42), (642, 642), (3000, 2562)):
            self.assertEqual(len(sphere.icosphere(wanted)[0]), number)

    def test_is_closed_and_looks_outward(self):
        points, triangles = sphere.icosphere(162)

        np.testing.assert_allclose(np.linalg.norm(points, axis=1), 1)
        self.assertEqual(len(triangles), 2 * len(points) - 4)
        edges = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        self.assertEqual(len(np.unique(edges, axis=0)), len(edges))  # once in each direction
        self.assertEqual(set(map(tuple, edges)), set(map(tuple, edges[:, ::-1])))
        self.assertGreater(np.linalg.det(points[triangles]).min(), 0)


class TestSearch(unittest.TestCase):
    def test_ranks_views_the_best_first(self):
        found = search()

        scores = [view.visibility_score for view in found]
        self.assertEqual(scores, sorted(scores, reverse=True))
        self.assertGreaterEqual(scores[0], found.visibility_scores.max())
        self.assertEqual(len(found), 4)
        self.assertIn("4 ranked", repr(found))

    def test_cameras_stand_round_the_volume_and_look_at_its_centre(self):
        found = search(camera_distance=2.5, refine=False)

        box = np.multiply(phantom.SPACING, np.subtract(phantom.SHAPE, 1))
        centre = phantom.ORIGIN + box / 2
        for view in found:
            np.testing.assert_allclose(view.focal_point, centre)
            np.testing.assert_allclose(
                view.position, centre + 1.25 * np.linalg.norm(box) * np.array(view.direction))

    def test_every_order_of_axes_has_the_same_scores(self):
        fortran, c = (search(order, refine=False) for order in "FC")

        np.testing.assert_allclose(c.visibility_scores, fortran.visibility_scores,
                                   rtol=phantom.rounding_of_sweeps())

    def test_by_default_knows_what_could_be_seen_at_most(self):
        found = search(refine=False)
        guarded = search(refine=False, protect_importance=1)
        proxy = search(refine=False, field="importance_proxy")
        result = limpid.optimize(phantom.scalars(), camera=found[0], ray_density=3, **SCENE)

        # Both are quadratures of the same integral, with rays at different places.
        self.assertAlmostEqual(found[0].visible_fraction, result.attainable_fraction, delta=0.005)
        self.assertTrue((guarded.visible_fractions < found.visible_fractions).all())
        self.assertFalse(np.array_equal(proxy.visible_fractions, found.visible_fractions))

    def test_a_view_can_be_optimised_for(self):
        best = search(refine=False)[0]
        result = limpid.optimize(phantom.scalars(), camera=best, **SCENE)

        self.assertEqual(result.camera.position, best.position)
        self.assertEqual(result.camera.view_up, best.view_up)

    def test_nothing_to_see_is_told(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            search(importance_function=[[0, 0]], refine=False)

        self.assertIn("nothing is important", str(caught[0].message))
        self.assertEqual(caught[0].filename, __file__)


if __name__ == "__main__":
    unittest.main()
