# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The package against the filter vtkExtinctionOptimizer, each in a process of its own: the same
# defaults, the same importance where it is not given, the same scores, and no more memory.

import dataclasses
import inspect
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import limpid
from limpid.settings import CHOICES
from limpid.sphere import SAMPLINGS
from limpid.viewpoint_search import OF_SEARCH

import phantom

HERE = pathlib.Path(__file__).resolve().parent
DATA = os.environ.get("LIMPID_TEST_DATA", "")
MODULES = os.environ.get("LIMPID_PYTHON_PATH", "")
PYTHON = os.environ.get("LIMPID_PYTHON", "/usr/bin/python3")
SCENES = ("carotid_mra", "visible_male")
SINGLE = float(np.finfo(np.float32).eps)


def printed_by(script, *arguments, with_filter):
    """What a script prints as JSON, run with the package or with the filter."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    if with_filter:
        environment["PYTHONPATH"] = MODULES
    elif "PYTHONPATH" in os.environ:
        environment["PYTHONPATH"] = os.environ["PYTHONPATH"]
    run = subprocess.run([PYTHON if with_filter else sys.executable, "-B", HERE / script,
                          *arguments], env=environment, check=True, stdout=subprocess.PIPE)
    return json.loads(run.stdout)


@unittest.skipIf(not MODULES, "The VTK modules were not built (Testing/build.sh --tests does): the "
                 "package is not compared with the filter")
class TestAgainstFilter(unittest.TestCase):
    def test_defaults_are_the_same(self):
        settings = {field.name: field.default for field in dataclasses.fields(limpid.Settings)}
        self.compare_defaults("vtkExtinctionOptimizer", settings)
        own = {name: settings[name] for name in OF_SEARCH}
        arguments = {name: argument.default for name, argument in inspect.signature(
            limpid.viewpoints).parameters.items() if name in (
                "sampling", "number_of_directions", "camera_distance", "camera_view_angle",
                "camera_parallel_projection", "camera_aspect_ratio", "camera_view_up",
                "elevation_range", "avoidance_angle", "number_of_viewpoints", "separation_angle",
                "refine")}
        self.compare_defaults("vtkViewpointSearch", {**own, **arguments})

    def compare_defaults(self, filter_name, settings):
        choices = {name: list(choice.__members__) for name, choice in CHOICES.items()}
        choices["sampling"] = list(SAMPLINGS)
        filters = printed_by("print_defaults.py", filter_name, *settings, with_filter=True)
        for name, default in settings.items():
            if name in choices:
                default = choices[name].index(default)
            expected = filters[name]
            self.assertEqual(default, tuple(expected) if isinstance(expected, list) else expected,
                             name)

    def test_the_same_is_important_where_nobody_says_what_is(self):
        for order in "FC":
            for missing in (np.s_[:0], np.s_[3, 7, 20:]):
                values = np.asarray(phantom.noisy_ball(), order=order)
                values[missing] = np.nan
                with self.subTest(order=order, missing=missing), \
                        tempfile.TemporaryDirectory() as folder:
                    scalars = pathlib.Path(folder, "scalars.npy")
                    np.save(scalars, values)
                    package, filters = [printed_by("print_importance.py", side, scalars,
                                                   with_filter=with_filter)
                                        for side, with_filter in (
                                            ("package", False), ("filter", True))]
                    np.testing.assert_allclose(package, filters, rtol=0, atol=SINGLE)
                    self.assertEqual(np.max(package), 1)

    def scene_and_scalars(self, name, folder):
        import pyvista

        path = pathlib.Path(DATA, f"{name}.scene.json")
        if not path.is_file():
            self.skipTest(f"{path} is not there")
        data = json.loads(path.read_text())["data"]
        image = pyvista.read(path.with_name(data["file"]))
        scalars = pathlib.Path(folder, f"{name}.npy")
        np.save(scalars, np.asarray(image[data["array"]]).reshape(image.dimensions, order="F"))
        return path, scalars

    def test_scores_are_the_same_and_memory_is_no_more(self):
        for name in SCENES:
            for given in ("function", "array"):
                with self.subTest(scene=name, extinction=given), \
                        tempfile.TemporaryDirectory() as folder:
                    paths = self.scene_and_scalars(name, folder)
                    package, filters = [
                        printed_by("run_scene.py", side, *paths, given, with_filter=with_filter)
                        for side, with_filter in (("package", False), ("filter", True))]
                    self.report(name, given, package, filters)
                    self.compare(package, filters)

    def compare(self, package, filters):
        self.assertEqual(package["iterations"], filters["iterations"])
        for score in ("visibility_score", "base_visibility_score", "visible_fraction",
                      "base_visible_fraction", "sacrificed_fraction", "attainable_fraction",
                      "attainable_score", "energy"):
            # Both evaluate the same functions in double precision; where a value falls between two
            # in single precision they may round apart, which is one step of the field's.
            self.assertLessEqual(abs(package[score] - filters[score]),
                                 SINGLE * abs(filters[score]), score)
        self.assertLessEqual(package["peak"], filters["peak"])

    def report(self, name, given, package, filters):
        def told(numbers):
            run = numbers["peak"] - numbers["before"]
            return (f"S {numbers['visibility_score']!r}, peak {numbers['peak'] / 1e6:.1f} MB, "
                    f"{run / 1e6:.1f} of them in the run")
        print(f"\n{name}, extinction from {given}: {told(package)}; the filter {told(filters)}",
              file=sys.__stderr__)


if __name__ == "__main__":
    unittest.main()
