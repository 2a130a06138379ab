# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# limpid.optimize on arrays: what comes out, in which order, without copies, and how it ends.

import signal
import threading
import unittest
import warnings

import numpy as np

import limpid
from limpid.scene import eighth_largest_neighbours, scene_of

import phantom
from phantom import ORIGIN, SCENE, SHAPE, SPACING, VIEW


def optimize(values=None, **arguments):
    return limpid.optimize(phantom.scalars() if values is None else values,
                           **{**SCENE, **VIEW, **arguments})


class TestResult(unittest.TestCase):
    def test_shows_more_than_before(self):
        result = optimize()

        self.assertGreater(result.visibility_score, result.base_visibility_score)
        self.assertGreater(result.visible_fraction, result.base_visible_fraction)
        self.assertLessEqual(result.visible_fraction + result.sacrificed_fraction, 1)
        self.assertLess(result.visible_fraction, result.attainable_fraction)
        self.assertLess(result.visibility_score, result.attainable_score)
        self.assertGreater(result.attainable_light_score, 0)
        self.assertTrue(result.settled)
        self.assertIn("CPU", result.backend)

    def test_keeps_extinction_within_its_bounds(self):
        result = optimize()

        self.assertEqual(result.extinction.dtype, np.float32)
        self.assertGreaterEqual(result.extinction.min(), 0)
        self.assertLessEqual(result.extinction.max(), np.float32(phantom.EXTINCTION[-1][1]))

    def test_tells_every_iteration(self):
        for settings in ({}, {"preset": "Paper"}):
            result = optimize(**settings)

            rows = result.convergence
            self.assertEqual(list(rows["iteration"]), list(range(result.iterations + 1)))
            self.assertEqual(rows["visibility_score"][0], result.base_visibility_score)
            self.assertIn(result.visibility_score, rows["visibility_score"])
            self.assertIn(result.energy, rows["energy"])
        self.assertEqual(rows["energy"].min(), result.energy)  # without smoothing

    def test_has_opacities_of_a_distance(self):
        result = optimize()

        for distance in (None, 2.5):
            length = result.unit_distance if distance is None else distance
            depth = result.extinction.astype(float) * length
            # The product and 1 - exp are rounded to single precision; |d opacity| <= |d depth|.
            bound = phantom.SINGLE * (2 * depth.max() + 4)
            difference = result.opacity(distance) - -np.expm1(-depth)
            self.assertLess(np.abs(difference).max(), bound)

    def test_says_in_a_line_what_was_achieved(self):
        result = optimize()

        self.assertIn(f"{100 * result.visible_fraction:.1f} % after", repr(result))
        self.assertIn("24 x 20 x 16 points", repr(result))

    def test_has_an_extinction_for_the_light_in_separate_mode(self):
        self.assertIsNone(optimize().light_extinction)
        self.assertEqual(optimize(mode="separate").light_extinction.shape, SHAPE)

    def test_settings_count(self):
        ordinary = optimize(method="ordinary").visibility_score
        # Both are of the base extinction, by rays of other orders.
        self.assertAlmostEqual(optimize(view_weight=0, light_weight=0).visibility_score, ordinary,
                               delta=phantom.rounding_of_sweeps() * ordinary)
        self.assertLess(optimize().sacrificed_fraction,
                        optimize(protect_importance=0).sacrificed_fraction)
        self.assertEqual(
            optimize(solver="adam", iterations_per_level=(1, 2, 3), smoothness=0).iterations, 6)

    def test_presets_set_several_settings(self):
        paper = limpid.Settings.preset("Paper")
        self.assertEqual((paper.protect_importance, paper.emphasis, paper.clearing_threshold,
                          paper.importance_smoothing, paper.smoothness), (0, 1, 0, "off", 0))
        self.assertEqual(limpid.Settings.preset("default"), limpid.Settings())
        self.assertEqual(optimize(preset="Paper").visibility_score, optimize(
            protect_importance=0, emphasis=1, clearing_threshold=0, importance_smoothing="off",
            smoothness=0).visibility_score)
        self.assertLess(optimize(preset="keep context").visible_fraction,
                        optimize(preset="strong reveal").visible_fraction)
        with self.assertRaisesRegex(ValueError, "Default, Keep Context, Strong Reveal, Paper"):
            optimize(preset="Nonsense")

    def test_an_object_has_several_settings(self):
        weak = limpid.Settings(view_weight=0.01, protect_importance=0)
        result = optimize(settings=weak)

        self.assertEqual(result.energy, optimize(view_weight=0.01, protect_importance=0).energy)
        self.assertEqual(optimize(settings=weak, view_weight=10).energy,
                         optimize(protect_importance=0).energy)
        self.assertEqual(optimize(settings=limpid.Settings.preset("Paper")).energy,
                         optimize(preset="Paper").energy)

    def test_a_weight_that_does_not_count_is_told(self):
        with self.assertWarnsRegex(UserWarning, "clearing_threshold=0") as caught:
            limpid.Settings(regularization_weight=5)
        self.assertEqual(caught.filename, __file__)

    def test_a_regularization_weight_counts(self):
        self.assertLess(optimize(regularization_weight=10.0).visible_fraction,
                        optimize(regularization_weight=1e-3).visible_fraction)
        self.assertEqual(
            optimize(regularization_weight=10.0, clearing_threshold=0.1).visible_fraction,
            optimize(clearing_threshold=0.1).visible_fraction)

    def test_nothing_to_see_is_told(self):
        for nothing, words in (("importance_function", "no structure is important"),
                               ("extinction_function", "without extinction nothing is visible")):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                optimize(**{nothing: [[0, 0]]})

            self.assertIn(words, str(caught[0].message))
            self.assertEqual(caught[0].filename, __file__)

    def test_moves_the_camera_to_where_more_is_seen(self):
        moved = optimize(optimize_viewpoint=True)

        self.assertGreaterEqual(moved.visibility_score, optimize().visibility_score)
        self.assertEqual(moved.camera.focal_point, VIEW["camera"]["focal_point"])


class TestMemoryLimit(unittest.TestCase):
    def test_a_coarser_result_is_improved_at_the_resolution_of_the_data(self):
        # At half resolution, 17.4 bytes a point are needed, and 19.4 to measure results.
        points = float(np.prod(SHAPE))
        full = optimize()
        shares = []
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for bytes_of_point in (18.4, 20.4):
                found = optimize(memory_limit=bytes_of_point * points / 1e6,
                                 progress=lambda share, text: shares.append(share))
                self.assertEqual(found.control_factor, 2)
                gain = found.visibility_score - found.base_visibility_score
                self.assertGreater(gain, 0.97 * (full.visibility_score - full.base_visibility_score))
                self.assertAlmostEqual(found.base_visibility_score / full.base_visibility_score, 1, 9)
        self.assertGreater(len([share for share in shares if 0.4 < share < 1]), 4)


class TestViews(unittest.TestCase):
    def turned(self, degrees):
        """The camera of the scene turned about the z axis through its focal point."""
        c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        camera = limpid.Camera(**VIEW["camera"])
        offset = np.subtract(camera.position, camera.focal_point)
        x, y = c * offset[0] - s * offset[1], s * offset[0] + c * offset[1]
        return limpid.Camera(np.add(camera.focal_point, (x, y, offset[2])), camera.focal_point,
                             camera.view_up)

    def test_scores_of_an_orbit_are_the_mean_of_its_cameras(self):
        for count in (1, 3):
            found = optimize(views="orbit", number_of_views=count)

            single = [optimize(camera=self.turned(360 * i / count)).base_visibility_score
                      for i in range(count)]
            self.assertAlmostEqual(found.base_visibility_score, np.mean(single),
                                   delta=phantom.rounding_of_sweeps() * np.mean(single))
            self.assertEqual(found.camera, limpid.Camera(**VIEW["camera"]))

    def test_an_orbit_shows_something_from_all_sides(self):
        found = optimize(views="orbit", number_of_views=4)
        single = optimize()

        behind = {"extinction": found.extinction, "extinction_function": None,
                  "importance": phantom.fields()[1], "importance_function": None,
                  "camera": self.turned(180), "method": "ordinary"}
        self.assertGreater(optimize(**behind).visibility_score, optimize(
            **{**behind, "extinction": single.extinction}).visibility_score)

    def test_eyes_of_a_pair_are_apart(self):
        wide, narrow, none = (optimize(views="stereo_pair", eye_angle=angle)
                              for angle in (60, 2, 0))

        self.assertEqual(none.base_visibility_score, optimize().base_visibility_score)
        self.assertNotEqual(wide.energy, narrow.energy)


class TestPrevious(unittest.TestCase):
    def near(self, result, other):
        return np.abs(result.extinction.astype(float) - other.extinction).mean()

    def test_a_warm_start_goes_on_from_it(self):
        before = optimize(smoothness=0)
        for order in "FC":
            warm = optimize(phantom.scalars(order), maximum_iterations=0, smoothness=0,
                            warm_start=True, previous=before)

            np.testing.assert_array_equal(warm.extinction, before.extinction)
            self.assertEqual(warm.energy, before.energy)
        self.assertEqual(optimize(smoothness=0, warm_start=True, previous=None).energy,
                         before.energy)

    #: Seven degrees from that of the scene.
    CAMERA = {**VIEW["camera"], "position": tuple(np.add(VIEW["camera"]["position"], (0, 4, 3)))}

    def test_coherence_stays_near_it(self):
        strong = {"temporal_coherence": 2}
        first = optimize(previous=None, **strong)
        fresh = optimize(camera=self.CAMERA)
        for values in (phantom.scalars(), phantom.scalars("C")):
            coherent = optimize(values, camera=self.CAMERA, previous=first, **strong)

            self.assertLess(self.near(coherent, first), self.near(fresh, first))

    def test_coherence_counts_less_for_another_time_step(self):
        strong = {"temporal_coherence": 0.5}
        first = optimize(previous=None, **strong)
        later = phantom.scalars()
        later[12, 10, 8] += 1e-6
        same, other = (optimize(values, previous=first, camera=self.CAMERA, **strong)
                       for values in (phantom.scalars(), later))

        self.assertLess(self.near(same, first), self.near(other, first))

    def test_fields_have_previous_results_too(self):
        mu, g = phantom.fields()
        first = limpid.optimize(extinction=mu, importance=g, **VIEW)
        again = limpid.optimize(extinction=mu, importance=g, previous=first, warm_start=True,
                                **VIEW)

        self.assertLessEqual(again.iterations, first.iterations)


class TestReference(unittest.TestCase):
    def test_is_the_result_if_its_weight_is_large(self):
        base = optimize(maximum_iterations=0).extinction
        self.assertGreater(np.abs(optimize().extinction - base).max(), 0.5 * base.max())
        for reference in (base, np.ascontiguousarray(base)):
            result = optimize(reference=reference, reference_pull=1e7)

            # 16 roundings of the largest extinction.
            np.testing.assert_allclose(result.extinction, base, rtol=0,
                                       atol=16 * np.finfo(np.float32).eps * base.max())

    def test_of_another_shape_is_refused(self):
        with self.assertRaisesRegex(ValueError, "reference"):
            optimize(reference=np.zeros((3, 4, 5), np.float32), reference_pull=1)

    def test_a_weight_without_one_is_refused(self):
        with self.assertRaisesRegex(ValueError, "there is no reference"):
            optimize(reference_pull=1)


class TestStructures(unittest.TestCase):
    def labels(self, kind):
        """Two structures with gaps between their numbers, and where they are."""
        g = phantom.fields()[1]
        first = np.median(np.nonzero(g > 0)[0])
        half = np.arange(g.shape[0])[:, None, None] > first
        return np.where(g > 0, np.where(half, 1034, 3), 0).astype(kind)

    def test_are_important_as_they_are_said_to_be(self):
        mu, _ = phantom.fields()
        for kind in (np.uint16, np.int64, np.float64):
            labels = self.labels(kind)
            by_labels = limpid.optimize(extinction=mu, structures=labels,
                                        importance={1034: 1, 3: 0.25, 7: 1}, **VIEW)
            importance = np.where(labels == 1034, 1, np.where(labels == 3, 0.25, 0))
            by_importance = limpid.optimize(extinction=mu, importance=importance,
                                            importance_smoothing="off", **VIEW)

            np.testing.assert_array_equal(by_labels.extinction, by_importance.extinction)

    def test_are_all_important_if_nobody_says_more(self):
        mu, _ = phantom.fields()
        labels = self.labels(np.int32)
        with self.assertWarnsRegex(UserWarning, "all labels but 0"):
            by_labels = limpid.optimize(extinction=mu, structures=labels, **VIEW)
        by_importance = limpid.optimize(extinction=mu, importance=labels > 0,
                                        importance_smoothing="off", **VIEW)

        np.testing.assert_array_equal(by_labels.extinction, by_importance.extinction)

    def test_are_told_apart_in_the_result(self):
        mu, _ = phantom.fields()
        for order in "FC":
            labels = np.array(self.labels(np.int32), order=order)
            result = limpid.optimize(extinction=mu, structures=labels,
                                     importance={1034: 1, 3: 0.25, 7: 1}, **VIEW)
            seen = result.structures

            self.assertEqual(list(seen), [3, 7, 1034])
            for shares in (seen[3], seen[1034]):
                self.assertAlmostEqual(
                    shares.visible + shares.removed + sum(shares.hidden_by.values()), 1, delta=1e-5)
                self.assertLessEqual(shares.visible, shares.attainable + 1e-5)
                self.assertEqual(list(shares.hidden_by), [None, 3, 7, 1034])
            self.assertEqual(seen[7].visible, 0)
            ends = sorted((seen[3].visible, seen[1034].visible))
            self.assertTrue(ends[0] <= result.visible_fraction <= ends[1])
        self.assertIsNone(optimize().structures)

    def test_meet_their_targets(self):
        mu, _ = phantom.fields()
        labels = self.labels(np.int32)
        given = {"extinction": mu, "structures": labels, "importance": {1034: 1, 3: 0.05},
                 "protect_importance": 0, **VIEW}
        before = limpid.optimize(**given)
        wanted = 0.5 * (before.structures[3].visible + before.structures[3].attainable)
        result = limpid.optimize(targets={3: wanted}, **given)
        shares = result.structures[3]

        self.assertGreaterEqual(shares.visible, wanted - 0.001)
        self.assertEqual((shares.importance, shares.target), (0.05, wanted))
        self.assertGreater(shares.weight, 0.05)
        self.assertRegex(result.targets, r"^3 .* % \(>= .* %\)$")

    def test_with_targets_alone_are_important(self):
        mu, _ = phantom.fields()
        labels = self.labels(np.int32)
        result = limpid.optimize(extinction=mu, structures=labels, targets={3: 0}, **VIEW)
        expected = limpid.optimize(extinction=mu, structures=labels, importance={3: 1}, **VIEW)

        np.testing.assert_array_equal(result.extinction, expected.extinction)

    def test_whose_targets_cannot_be_met_are_named(self):
        mu, _ = phantom.fields()
        with self.assertWarnsRegex(UserWarning, 'The target of "3" is 100.0 %, and at most'):
            limpid.optimize(extinction=mu, structures=self.labels(np.int32), targets={3: 1}, **VIEW)

    def test_have_targets_that_are_shares(self):
        mu, _ = phantom.fields()
        labels = self.labels(np.int32)
        for targets, words in (({3: 2}, "The target of the structure 3 is 2"),
                               ({"liver": 1}, "A label of targets is 'liver'"),
                               (0.5, "targets are of the type float")):
            with self.subTest(words), self.assertRaisesRegex(ValueError, words):
                limpid.optimize(extinction=mu, structures=labels, targets=targets, **VIEW)
        with self.assertRaisesRegex(ValueError, "structures are not"):
            optimize(targets={3: 0.5})

    def test_are_searched_too(self):
        mu, _ = phantom.fields()
        labels = self.labels(np.int32)
        by_labels, by_importance = (
            limpid.viewpoints(extinction=mu, sampling="fibonacci", number_of_directions=12,
                              refine=False, importance_smoothing="off", **importance)
            for importance in ({"structures": labels, "importance": {3: 1}},
                               {"importance": labels == 3}))

        np.testing.assert_array_equal(by_labels.visibility_scores, by_importance.visibility_scores)

    def test_with_mistakes_are_refused(self):
        mu, _ = phantom.fields()
        labels = self.labels(np.float64)
        for importance, words in (({3: 2}, "The importance of the structure 3 is 2"),
                                  ({"liver": 1}, "A label of importance is 'liver'"),
                                  (np.zeros(mu.shape), "Give a mapping")):
            with self.subTest(words), self.assertRaisesRegex(ValueError, words):
                limpid.optimize(extinction=mu, structures=labels, importance=importance, **VIEW)
        labels[3, 4, 5] = 2.5
        with self.assertRaisesRegex(ValueError, "structures have the value 2.5"):
            limpid.optimize(extinction=mu, structures=labels, importance={3: 1}, **VIEW)


class TestAssumedImportance(unittest.TestCase):
    def assumed(self, values, **arguments):
        """The importance and the text of the warning."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            scene = scene_of(values, extinction_function=phantom.EXTINCTION, **arguments)
        self.assertEqual(len(caught), 1)
        return scene.importance, str(caught[0].message)

    def test_the_largest_scalars_are_important_where_nobody_says_it(self):
        values = np.arange(1000.0).reshape(10, 10, 10)
        for order in "FC":
            importance, text = self.assumed(np.asarray(values, order=order))

            np.testing.assert_allclose(importance, np.interp(values, [949, 989], [0, 1]),
                                       atol=phantom.SINGLE)
            self.assertIn("importance_function=[[949, 0], [989, 1]]", text)

    def test_masked_scalars_and_those_that_are_no_numbers_do_not_count(self):
        values = np.arange(1000.0).reshape(10, 10, 10)
        more = np.concatenate([values, np.full((1, 10, 10), 5000.0)])
        importance, _ = self.assumed(np.ma.array(more, mask=more == 5000))
        np.testing.assert_array_equal(importance[:-1], self.assumed(values)[0])

        more[-1] = np.nan
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            scene = scene_of(more, extinction_function=phantom.EXTINCTION)
        np.testing.assert_array_equal(scene.importance[:-1], self.assumed(values)[0])
        self.assertEqual(len(caught), 2)

    def test_it_begins_above_the_noise_in_every_order(self):
        values = phantom.noisy_ball()
        importance, text = self.assumed(values)

        begin = values[importance == 0].max()
        self.assertGreater(begin, np.quantile(values, 0.95))
        self.assertGreater(importance.max(), 0)
        self.assertEqual(text, self.assumed(np.asfortranarray(values))[1])

    def test_neighbours_are_those_of_the_median(self):
        values = phantom.noisy_ball()
        hidden = values > 1.2
        beyond = np.pad(np.where(hidden, -np.inf, values), 1, mode="edge")
        places = np.argwhere(np.ones(values.shape, dtype=bool))[::7]
        expected = []
        for place in places:
            around = beyond[tuple(slice(start, start + 3) for start in place)].ravel()
            expected.append(np.sort(np.delete(around, 13))[-8])

        np.testing.assert_array_equal(eighth_largest_neighbours(values, hidden, places), expected)
        np.testing.assert_array_equal(eighth_largest_neighbours(
            np.where(hidden, np.nan, values), None, places), expected)

    def test_searches_and_runs_assume_the_same(self):
        with self.assertWarnsRegex(UserWarning, "No importance is set") as caught:
            found = optimize(importance_function=None)
        self.assertEqual(caught.filename, __file__)
        with self.assertWarnsRegex(UserWarning, "No importance is set"):
            limpid.viewpoints(phantom.scalars(), number_of_directions=12, refine=False,
                              **{**SCENE, "importance_function": None})
        self.assertGreater(found.visible_fraction, found.base_visible_fraction)


class TestComponents(unittest.TestCase):
    def test_one_of_several_is_the_importance(self):
        mu, g = phantom.fields()
        several = np.stack([np.zeros_like(g), g, 2 * g], axis=-1)
        expected = limpid.optimize(extinction=mu, importance=g, **VIEW)
        for array, component in ((several, 1), (several[..., :2], -1), (g, -1), (g, 0),
                                 (several[..., 1:2], None)):
            found = limpid.optimize(extinction=mu, importance=array, importance_component=component,
                                    **VIEW)
            np.testing.assert_array_equal(found.extinction, expected.extinction)

    def test_a_search_has_components_too(self):
        several = np.stack([phantom.scalars(), np.zeros(SHAPE)], axis=-1)
        found = [limpid.viewpoints(phantom.scalars(), number_of_directions=12, refine=False,
                                   importance=array, importance_component=component, **SCENE)
                 for array, component in ((several, 0), (phantom.scalars(), None))]

        np.testing.assert_array_equal(*(views.visible_fractions for views in found))


class TestEquality(unittest.TestCase):
    def test_what_has_the_same_values_is_equal_and_has_the_same_hash(self):
        array = np.array([1, 2, 3])
        for one, other, different in (
                (limpid.Settings(iterations_per_level=array), limpid.Settings(
                    iterations_per_level=[1, 2, 3]), limpid.Settings(skip_unneeded=0)),
                (limpid.Camera(array, 2 * array), limpid.Camera([1, 2, 3], (2, 4, 6)),
                 limpid.Camera(array, array)),
                (limpid.Light(array, True, array), limpid.Light([1, 2, 3], True, [1, 2, 3]),
                 limpid.Light(array))):
            self.assertEqual(one, other)
            self.assertEqual(hash(one), hash(other))
            self.assertNotEqual(one, different)
            self.assertEqual(len({one, other, different}), 2)

    def test_results_can_be_compared_and_be_keys(self):
        views = limpid.viewpoints(phantom.scalars(), number_of_directions=12, refine=False, **SCENE)
        for result, another in ((optimize(), optimize()), (views, None), (views[0], views[1])):
            self.assertEqual(result, result)
            self.assertNotEqual(result, another)
            self.assertIn(result, {result: 1})


class TestOrder(unittest.TestCase):
    def test_results_have_the_shape_and_the_order_of_the_input(self):
        for order in "FC":
            result = optimize(phantom.scalars(order))

            self.assertEqual(result.extinction.shape, SHAPE)
            self.assertTrue(result.extinction.flags[f"{order}_CONTIGUOUS"])
        turned = phantom.scalars().transpose(2, 0, 1).copy().transpose(1, 2, 0)
        self.assertEqual(optimize(turned).extinction.strides, turned.strides)

    def test_every_order_of_axes_has_the_same_result(self):
        fortran = optimize()
        for axes in ((2, 1, 0), (1, 0, 2), (0, 2, 1), (1, 2, 0), (2, 0, 1)):
            values = phantom.scalars().transpose(axes).copy("F").transpose(np.argsort(axes))
            result = optimize(values)

            bound = phantom.rounding_of_sweeps()
            for name in ("base_visibility_score", "visibility_score", "energy"):
                one, other = getattr(fortran, name), getattr(result, name)
                self.assertLess(abs(one - other), bound * abs(one), (axes, name))

    def test_the_box_may_be_turned(self):
        turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], dtype=float)

        def turned(point):
            return tuple(turn @ point)
        camera = {name: turned(value) for name, value in VIEW["camera"].items()}
        for order in "FC":
            result = optimize(phantom.scalars(order), direction=turn, origin=turned(ORIGIN),
                              camera=camera, light=turned(VIEW["light"]))

            # A quarter turn rounds no coordinate.
            self.assertEqual(result.visibility_score,
                             optimize(phantom.scalars(order)).visibility_score)


class TestArrays(unittest.TestCase):
    def scene(self, **arrays):
        return scene_of(None, spacing=SPACING, **arrays)

    def test_dense_arrays_of_single_precision_are_used_where_they_are(self):
        for order in "FC":
            mu, g = phantom.fields(order)
            mu.flags.writeable = g.flags.writeable = False
            scene = self.scene(extinction=mu, importance=g)
            _, flat_extinction, flat_importance = scene.in_core()

            self.assertIs(scene.base_extinction, mu)
            self.assertIs(scene.importance, g)
            self.assertTrue(np.shares_memory(flat_extinction, mu))
            self.assertTrue(np.shares_memory(flat_importance, g))

    def test_others_are_converted_and_not_changed(self):
        expected = limpid.optimize(extinction=phantom.fields()[0], importance=phantom.fields()[1],
                                   **VIEW)
        for convert in (lambda array: array.astype(float), lambda array: array.astype(">f4"),
                        lambda array: np.repeat(array, 2, axis=1)[:, ::2]):
            mu, g = map(convert, phantom.fields())
            before = mu.copy(), g.copy()
            result = limpid.optimize(extinction=mu, importance=g, **VIEW)

            np.testing.assert_array_equal(result.extinction, expected.extinction)
            np.testing.assert_array_equal((mu, g), before)

    def test_arrays_of_different_orders_go_together(self):
        mu, g = phantom.fields()
        result = limpid.optimize(extinction=mu, importance=np.ascontiguousarray(g), **VIEW)

        expected = limpid.optimize(extinction=mu, importance=g, **VIEW)
        np.testing.assert_array_equal(result.extinction, expected.extinction)

    def test_functions_give_what_their_fields_give(self):
        mu, g = phantom.fields()
        result = limpid.optimize(extinction=mu, importance=g, spacing=SPACING, origin=ORIGIN,
                                 **VIEW)

        np.testing.assert_array_equal(result.extinction, optimize().extinction)
        self.assertEqual(result.energy, optimize().energy)

    def test_small_integers_are_as_their_values(self):
        for dtype in (np.uint8, np.int8, np.uint16, np.int16):
            values = (100 * phantom.scalars()).astype(dtype) - np.array(50).astype(dtype) * (
                np.dtype(dtype).kind == "i")
            self.assertEqual(values.dtype, dtype)
            nodes = {"extinction_function": [[-30, 0], [0, 1], [90, 2]],
                     "importance_function": [[30, 0], [45, 1]]}
            result = optimize(values, **nodes)

            np.testing.assert_array_equal(result.extinction,
                                          optimize(values.astype(float), **nodes).extinction)

    def test_opacities_are_those_of_their_distance(self):
        nodes = [[0.3, 0.0], [1.0, 0.5]]
        scene = scene_of(phantom.scalars(), opacity_function=nodes, unit_distance=2.0,
                         importance_function=phantom.IMPORTANCE)

        opacity = np.interp(phantom.scalars().astype(float), *np.transpose(nodes))
        np.testing.assert_allclose(scene.base_extinction, -np.log1p(-opacity) / 2,
                                   rtol=phantom.SINGLE)
        self.assertAlmostEqual(scene.majorant, np.log(2) / 2)

    def test_unusable_points_are_empty_and_told_once(self):
        mu, g = phantom.fields()
        mu[3, 4, 5], mu[4, 4, 4], g[5, 5, 5], g[6, 6, 6] = np.nan, -1, np.inf, 2
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            scene = self.scene(extinction=mu, importance=g)
            limpid.optimize(extinction=mu, importance=g)

        self.assertEqual(len(caught), 2)
        self.assertEqual(caught[1].filename, __file__)
        text = str(caught[0].message)
        self.assertIn("2 of 7680 points have a NaN or an infinite value", text)
        self.assertIn("1 of 7680 points have a negative extinction", text)
        self.assertIn("1 of 7680 points have an importance outside [0, 1]", text)
        for point in ((3, 4, 5), (4, 4, 4), (5, 5, 5)):
            self.assertEqual((scene.base_extinction[point], scene.importance[point]), (0, 0))
        self.assertEqual(scene.importance[6, 6, 6], 1)
        self.assertTrue(np.isnan(mu[3, 4, 5]), "The caller's array was changed.")


class TestEnds(unittest.TestCase):
    ENDLESS = {"solver": "adam", "iterations_per_level": (0, 0, 10 ** 9), "tolerance": 0}

    def test_is_told_how_far_it_is_and_can_be_stopped(self):
        seen = []

        def progress(share, text):
            seen.append((share, text))
            return len(seen) < 3
        result = optimize(progress=progress, **self.ENDLESS)

        self.assertEqual(result.iterations, 3)
        self.assertGreater(result.visibility_score, result.base_visibility_score)

    def test_progress_ends_with_all_of_the_work(self):
        for settings in ({}, {"mode": "separate"}, {"preset": "Paper"}, {"method": "ordinary"},
                         {"solver": "adam", "iterations_per_level": (1, 1, 2), "smoothness": 0},
                         {"maximum_iterations": 0}, {"maximum_seconds": 1e-9},
                         {"optimize_viewpoint": True}):
            shares = []
            optimize(progress=lambda share, _: shares.append(share), **settings)

            self.assertEqual(shares, sorted(shares), settings)
            self.assertEqual(shares.count(1), 1, settings)
            self.assertEqual(shares[-1], 1, settings)

    def test_a_run_for_the_light_is_half_of_the_work(self):
        shares = []
        result = optimize(progress=lambda share, _: shares.append(share), mode="separate")

        self.assertEqual(len(shares), result.iterations)
        self.assertIn(0.5, shares)

    def test_an_exception_of_the_callers_comes_out(self):
        with self.assertRaises(ZeroDivisionError):
            optimize(progress=lambda *_: 1 // 0)

    def test_ctrl_c_ends_it(self):
        signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
        signal.setitimer(signal.ITIMER_REAL, 0.2)

        with self.assertRaises(KeyboardInterrupt):
            optimize(**self.ENDLESS)

    def test_other_threads_run_meanwhile(self):
        stop = threading.Event()

        def interrupt():
            stop.wait(0.2)
            signal.raise_signal(signal.SIGINT)
        other = threading.Thread(target=interrupt)
        other.start()

        with self.assertRaises(KeyboardInterrupt):  # which is what the other thread did
            optimize(**self.ENDLESS)
        other.join()


if __name__ == "__main__":
    unittest.main()
