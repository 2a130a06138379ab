# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# limpid.viewpoints: the sphere of directions, and the views that are ranked.

import dataclasses
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
        for wanted, number in ((1, 4), (5, 5), (26, 26), (641, 641)):
            self.assertEqual(len(sphere.fibonacci(wanted)[0]), number)
        for wanted, number in ((1, 5), (26, 26), (642, 648)):  # 2 and rings of twice as many
            self.assertEqual(len(sphere.latitude_longitude(wanted)[0]), number)

    def test_is_closed_and_looks_outward(self):
        for name, sampling in sphere.SAMPLINGS.items():
            for count in (1, 20, 162, 1000):
                points, triangles = sampling(count)

                np.testing.assert_allclose(np.linalg.norm(points, axis=1), 1)
                self.assertEqual(len(triangles), 2 * len(points) - 4)
                edges = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
                # Once in each direction.
                self.assertEqual(len(np.unique(edges, axis=0)), len(edges))
                self.assertEqual(set(map(tuple, edges)), set(map(tuple, edges[:, ::-1])))
                corners = points[triangles]
                outward = np.einsum("ij,ij->i", np.cross(corners[:, 1] - corners[:, 0],
                                                         corners[:, 2] - corners[:, 0]),
                                    corners.sum(axis=1))
                self.assertGreater(outward.min(), 0, (name, count))

    def test_a_spiral_has_triangles_with_nothing_outside(self):
        points, triangles = sphere.fibonacci(200)

        corners = points[triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        heights = normals @ points.T - np.einsum("ij,ij->i", normals, corners[:, 0])[:, None]
        self.assertLess(heights.max(), 1e-12)  # a convex hull, but for rounding


class TestSearch(unittest.TestCase):
    def test_ranks_views_the_best_first(self):
        found = search()

        scores = [view.visibility_score for view in found]
        self.assertEqual(scores, sorted(scores, reverse=True))
        self.assertGreaterEqual(scores[0], found.visibility_scores.max())
        self.assertEqual(len(found), 4)
        self.assertIn("4 ranked", repr(found))

    def test_cameras_show_the_whole_volume_from_their_directions(self):
        box = np.multiply(phantom.SPACING, np.subtract(phantom.SHAPE, 1))
        centre = phantom.ORIGIN + box / 2
        corners = centre + box * (np.indices((2, 2, 2)).reshape(3, -1).T - 0.5)
        for angle, aspect, parallel in ((30, 1, False), (20, 1.7, False), (60, 0.6, False),
                                        (30, 1.7, True)):
            for view in search(refine=False, camera_view_angle=angle, camera_aspect_ratio=aspect,
                               camera_parallel_projection=parallel):
                away = np.subtract(view.position, centre)
                np.testing.assert_allclose(away / np.linalg.norm(away), view.direction, atol=1e-12)
                ahead = np.subtract(view.focal_point, view.position)
                ahead /= np.linalg.norm(ahead)
                right = np.cross(ahead, view.view_up)
                offsets = corners - view.position
                half = (np.full(8, view.parallel_scale) if parallel
                        else np.tan(np.radians(angle / 2)) * (offsets @ ahead))
                at = np.stack([offsets @ right / (half * aspect), offsets @ view.view_up / half])
                self.assertLess(abs(at).max(), 1)
                self.assertGreater(np.ptp(at, axis=1).max(), 2 * 0.85)

    def test_cameras_look_at_a_given_point(self):
        point = tuple(phantom.ORIGIN + 0.4 * np.multiply(phantom.SPACING, phantom.SHAPE))
        for view in search(refine=False, camera_focal_point=point):
            np.testing.assert_allclose(view.focal_point, point)

    def test_every_order_of_axes_has_the_same_scores(self):
        fortran, c = (search(order, refine=False) for order in "FC")

        np.testing.assert_allclose(c.visibility_scores, fortran.visibility_scores,
                                   rtol=phantom.rounding_of_sweeps())

    def test_by_default_knows_what_could_be_seen_at_most(self):
        found = search(refine=False)
        free = search(refine=False, protect_importance=0)
        proxy = search(refine=False, field="importance_proxy")
        result = limpid.optimize(phantom.scalars(), camera=found[0], ray_density=3, **SCENE)

        # Both are quadratures of the same integral, with rays at different places.
        self.assertAlmostEqual(found[0].visible_fraction, result.attainable_fraction, delta=0.005)
        self.assertTrue((found.visible_fractions < free.visible_fractions).all())
        self.assertFalse(np.array_equal(proxy.visible_fractions, found.visible_fractions))

    def test_a_view_can_be_optimised_for(self):
        best = search(refine=False, camera_view_angle=20, camera_aspect_ratio=1.7)[0]
        result = limpid.optimize(phantom.scalars(), camera=best, restrict_to_view=True, **SCENE)

        for field in dataclasses.fields(limpid.Camera):
            self.assertEqual(getattr(result.camera, field.name), getattr(best, field.name))

    def test_directions_are_spread_as_is_asked(self):
        for sampling in ("fibonacci", "latitude_longitude"):
            found = search(sampling=sampling, refine=False)

            np.testing.assert_array_equal(found.directions, sphere.SAMPLINGS[sampling](FEW)[0])
            self.assertTrue((found.visibility_scores > 0).all())

    def test_viewpoints_are_where_a_person_would_look_from(self):
        up = np.array([0, 0, 2])
        found = search(camera_view_up=up, elevation_range=(10, 30),
                       avoided_directions=[(1, 0, 0.3)], avoidance_angle=80)

        self.assertGreater(len(found), 0)
        for view in found:
            self.assertTrue(10 - 1e-6 <= np.degrees(np.arcsin(view.direction[2])) <= 30 + 1e-6)
            self.assertGreater(view.view_up[2], 0.8)
            self.assertLess(view.direction @ np.array([1, 0, 0.3]) / np.hypot(1, 0.3),
                            np.cos(np.radians(80)) + 1e-6)
            ahead = np.subtract(view.focal_point, view.position)  # turned to the middle of the box
            self.assertAlmostEqual(np.dot(view.view_up, ahead / np.linalg.norm(ahead)), 0)
        self.assertEqual(len(found.visibility_scores), FEW)

    def test_nowhere_to_look_from_is_told(self):
        with self.assertWarnsRegex(UserWarning, "no viewpoint can be ranked") as caught:
            found = search(avoided_directions=[(0, 1, 0), (0, -1, 0)], avoidance_angle=100,
                           refine=False)

        self.assertEqual(caught.filename, __file__)
        self.assertEqual(len(found), 0)
        self.assertIn("none of 42", repr(found))

    def test_presets_and_settings_count(self):
        free = search(protect_importance=0, importance_smoothing="off", refine=False)
        for given in ({"preset": "Paper"}, {"settings": limpid.Settings.preset("Paper")}):
            found = search(refine=False, **given)
            np.testing.assert_array_equal(found.visible_fractions, free.visible_fractions)

    def test_tells_how_far_it_is(self):
        told = []
        search(progress=lambda *what: told.append(what))

        shares, texts = zip(*told)
        self.assertEqual(list(shares), sorted(shares))
        self.assertGreater(len(set(shares)), 10)
        self.assertEqual(shares[-1], 1)
        self.assertEqual(list(dict.fromkeys(texts)), ["Scoring views", "Climbing to better views"])

    def test_can_be_stopped(self):
        told = []

        def stop(*what):
            told.append(what)
            return len(told) < 3
        found = search(progress=stop)

        self.assertEqual(len(told), 3)
        is_scored = ~np.isnan(found.visibility_scores)
        self.assertTrue(0 < is_scored.sum() < FEW)
        self.assertEqual(found[0].visibility_score, found.visibility_scores[is_scored].max())
        with self.assertRaises(ZeroDivisionError):
            search(progress=lambda *_: 1 // 0)

    def test_nothing_to_see_is_told(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            search(importance_function=[[0, 0]], refine=False)

        self.assertIn("no structure is important", str(caught[0].message))
        self.assertEqual(caught[0].filename, __file__)


if __name__ == "__main__":
    unittest.main()
