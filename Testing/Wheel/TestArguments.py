# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What the package says when it cannot work with what it is given: what is wrong (why). What to do.

import unittest

import numpy as np

import limpid

import phantom
from phantom import COLORS, SCENE

VALUES = phantom.scalars()


class Refusals(unittest.TestCase):
    def assert_refuses(self, function, *words, error=ValueError, **arguments):
        with self.assertRaises(error) as caught:
            function(arguments.pop("volume", VALUES), **{**SCENE, **arguments})
        for word in words:
            self.assertIn(word, str(caught.exception))


class TestOptimizeRefuses(Refusals):
    def refuses(self, *words, **arguments):
        self.assert_refuses(limpid.optimize, *words, **arguments)

    def test_volumes_without_volume(self):
        self.refuses("24 x 20 x 1 points", "at least two", volume=VALUES[:, :, :1])
        self.refuses("(24, 20)", "three axes", volume=VALUES[:, :, 0])
        self.refuses("neither a volume", volume=None)
        self.refuses("A list was given", "numpy.array", volume=VALUES.tolist())

    def test_arrays_that_do_not_fit(self):
        mu, g = phantom.fields()
        self.refuses("importance", "(23, 20, 16)", "(24, 20, 16)", importance=g[1:])
        self.refuses("complex64", importance=g.astype(np.complex64))
        self.refuses("'density'", "a name", scalars="density")
        self.refuses("There is no importance", volume=None, importance_function=None,
                     extinction_function=None, extinction=mu)
        self.refuses("all scalars are equal", volume=np.ones((4, 5, 6)), importance_function=None)
        self.refuses("extinction and a function", extinction=mu)

    def test_values_of_cells(self):
        self.refuses("(23, 19, 15)", "cells", "cell_data_to_point_data", importance=VALUES[
            1:, 1:, 1:])

    def test_functions_that_are_none(self):
        for nodes in ([], [1, 2], "steep", [[1, 2, 3]], [[0, "a"]]):
            self.refuses("extinction_function is not a list of nodes", extinction_function=nodes)
        self.refuses("after", "Sort nodes by their values", extinction_function=[[1, 0], [0, 1]])
        self.refuses("[1.0, -2.0]", extinction_function=[[0, 0], [1, -2]])
        self.refuses("[0.0, nan]", extinction_function=[[0, np.nan]])
        self.refuses("[1.0, 1.5]", extinction_function=None, opacity_function=[[0, 0], [1, 1.5]])
        self.refuses("Give one of them", opacity_function=[[0, 0], [1, 1]])
        self.refuses("unit_distance is 0", unit_distance=0)

    def test_grids_that_are_none(self):
        self.refuses("spacing is (1, 2)", spacing=(1, 2))
        self.refuses("spacing along axis 1 is 0", spacing=(1, 0, 1))  # the core's words
        self.refuses("(2, 2)", "3 x 3", direction=np.eye(2))
        self.refuses("not orthonormal", direction=2 * np.eye(3))
        self.refuses("origin is (0, nan, 0)", origin=(0, np.nan, 0))

    def test_cameras_and_lights_that_are_none(self):
        self.refuses("camera is 'front'", "focal_point", camera="front")
        self.refuses("direction is undefined", camera=((1, 2, 3), (1, 2, 3), (0, 0, 1)))
        self.refuses("The camera's position is (1, 2)", camera=((1, 2), (0, 0, 0), (0, 0, 1)))
        self.refuses("The light's position", light=3)

    def test_settings_that_are_none(self):
        self.refuses("'view_weigth'", "'view_weight'", error=TypeError, view_weigth=1)
        self.refuses("mode is 'both'", "'joint', 'separate'", mode="both")
        self.refuses("view_weight is 'strong'", "10.0", view_weight="strong")
        self.refuses("maximum_iterations is 2.5", maximum_iterations=2.5)
        self.refuses("maximum_iterations is 100000000", maximum_iterations=10 ** 12)
        self.refuses("iterations_per_level is (1, 2)", iterations_per_level=(1, 2))
        self.refuses("skip_unneeded is 'no'", skip_unneeded="no")
        self.refuses("view weight", "-1", view_weight=-1)  # the core's words
        self.refuses("viewpoint_guide is 'map'", viewpoint_guide="map")

    def test_views_that_do_not_go_together(self):
        self.refuses("number of views is 400", views="orbit", number_of_views=400)
        self.refuses("eye angle is 180", views="stereo_pair", eye_angle=180)
        self.refuses("views is 'orbit' and method 'ordinary'", views="orbit", method="ordinary")
        self.refuses("only a single camera can be optimised", views="orbit", optimize_viewpoint=True)
        self.refuses("method is 'ordinary'", method="ordinary", optimize_viewpoint=True)

    def test_previous_results_that_are_none(self):
        found = limpid.optimize(VALUES, temporal_coherence=0.2, previous=None, **SCENE)
        plain = limpid.optimize(VALUES, **SCENE)
        for name, value in (("warm_start", True), ("temporal_coherence", 0.2)):
            self.refuses("there is no previous", **{name: value})
        self.refuses("it would have no effect", previous=found)
        self.refuses("previous is a ndarray", previous=found.extinction, warm_start=True)
        self.refuses("found without it", previous=plain, temporal_coherence=0.2)
        self.refuses("previous is of a box", previous=found, warm_start=True, origin=(0, 0, 9))
        self.refuses("separate mode", previous=found, warm_start=True, mode="separate")
        self.refuses("previous is given", previous=found, warm_start=True, optimize_viewpoint=True)
        finer = {"volume": np.zeros((47, 39, 31), dtype=np.float32),
                 "spacing": np.divide(SCENE["spacing"], 2)}
        self.refuses("(24, 20, 16) points", previous=found, warm_start=True, **finer)

    def test_components_that_are_none(self):
        g = np.stack([VALUES, VALUES], axis=-1)
        self.refuses("2 values per point", "importance_component", importance=g)
        self.refuses("component of the importance is 2", importance=g, importance_component=2)
        self.refuses("importance_component is 1.5", importance=g, importance_component=1.5)
        self.refuses("scalar array has 2 values", "[..., 0]", volume=g)

    def test_settings_twice(self):
        self.refuses("preset 'Paper' and settings", preset="Paper", settings=limpid.Settings())
        self.refuses("settings is {", "limpid.Settings", error=TypeError, settings={"mode": 1})
        with self.assertRaisesRegex(ValueError, "view_weight is 'strong'"):
            limpid.Settings(view_weight="strong")

    def test_numbers_of_numpy_are_numbers(self):
        settings = limpid.Settings(view_weight=np.float32(3), maximum_iterations=np.int64(4),
                                   iterations_per_level=np.array([1, 2, 3]),
                                   skip_unneeded=np.bool_(False)).in_core()

        self.assertEqual((settings.view_weight, settings.maximum_iterations), (3.0, 4))
        self.assertEqual(tuple(settings.iterations_per_level), (1, 2, 3))
        self.assertFalse(settings.skip_unneeded)

    def test_a_gpu_that_is_not_there(self):
        self.refuses("CUDA", backend="cuda")


class TestViewpointsRefuses(Refusals):
    def refuses(self, *words, **arguments):
        self.assert_refuses(limpid.viewpoints, *words, **arguments)

    def test_searches_that_are_none(self):
        self.refuses("number_of_directions is 0", number_of_directions=0)
        self.refuses("number_of_viewpoints is 0", number_of_viewpoints=0)
        self.refuses("separation_angle is 270", separation_angle=270)
        self.refuses("camera_distance is 0.5", camera_distance=0.5)
        self.refuses("camera_view_angle is 180", camera_view_angle=180)
        for aspect in (0, -1.5, np.inf, np.nan, "wide"):
            self.refuses(f"camera_aspect_ratio is {aspect!r}",
                         "the width of the picture over its height", camera_aspect_ratio=aspect)
        self.refuses("camera_focal_point", "radii", camera_focal_point=(50, 0, 0))
        self.refuses("field is 'all'", "'base_extinction'", field="all")
        self.refuses("backend is 'gpu'", backend="gpu")
        self.refuses("sampling is 'random'", "'fibonacci'", sampling="random")
        self.refuses("elevation_range is (30, 10)", elevation_range=(30, 10))
        self.refuses("elevation_range is 5", elevation_range=5)
        self.refuses("camera_view_up is (0.0, 0.0, 0.0)", camera_view_up=(0, 0, 0))
        self.refuses("An avoided direction", avoided_directions=[(0, 0, 0)])
        self.refuses("avoidance_angle is 270", avoidance_angle=270)
        self.refuses("progress is 3", progress=3)

    def test_settings_that_would_not_count(self):
        self.refuses("no setting 'view_weight'", "preset", error=TypeError, view_weight=3)
        self.refuses("method is 'ordinary'", settings=limpid.Settings(method="ordinary"))
        self.refuses("views", settings=limpid.Settings(views="orbit"))


class TestRenderRefuses(Refusals):
    def refuses(self, *words, **arguments):
        scene = {**SCENE, "color_function": COLORS, **arguments}
        del scene["importance_function"]
        with self.assertRaises(ValueError) as caught:
            limpid.render(VALUES, **scene)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_pictures_that_are_none(self):
        self.refuses("color_function is not a list", color_function=[[0, 1]])
        self.refuses("Divide by 255", color_function=[[0, 255, 0, 0]])
        self.refuses("width is 0", width=0)
        self.refuses("sample distance is 0", sample_distance=0)
        self.refuses("ambient is nan", ambient=np.nan)
        self.refuses("without extinction", light_extinction=phantom.fields()[0])


if __name__ == "__main__":
    unittest.main()
