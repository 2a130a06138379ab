# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The representation type "Optimized Volume" looks as it did: one stored picture for each method,
# mode and kind of lighting. Whether it is right is the business of other tests; these notice when
# something changes that they do not know of.
#
# LIMPID_RENEW_BASELINES=1 in the environment writes the stored pictures anew. Look at each of them.
# LIMPID_TEST_OUTPUT is the folder for the pictures of tests that fail.

import itertools
import os
import tempfile
import unittest

import numpy as np
from paraview import simple

import displays
import pictures
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
vars(simple).update(OcclusionPhantom=OcclusionPhantom)

BASELINES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Baselines")
OUTPUT = os.environ.get("LIMPID_TEST_OUTPUT", os.path.join(tempfile.gettempdir(), "limpid-tests"))
RENEW = "LIMPID_RENEW_BASELINES"

# What pictures.difference may find between a picture and the stored one. Other processors and
# compilers round differently, and the optimum is nearly all or nothing in each voxel. Measured:
# without vector instructions (0.00002, 0); the light moved by a millionth (0.07, 2). What a person
# would call a change is above these bounds: a shadow strength of 0.65 instead of 0.7 (1, 5).
MEAN = 0.2
P99 = 3

LIGHT = {"LightSource": "Own", "LightType": "Point", "LightPosition": [-3.5, -3.0, 3.5]}
# What differs from the display of displays.show_head; the name is that of the file.
PICTURES = {
    "Optimized": {},
    "OptimizedSeparate": {"Mode": "Separate"},
    # Smoothing is sweeps of the policy, whatever went before.
    "OptimizedAdam": {"Solver": "Adam", "IterationsPerLevel": [8, 8, 8], "Smoothness": 0},
    "OptimizedWithShade": {"Shadows": 0, "Shade": 1},
    "OptimizedWithoutLight": {"Shadows": 0},
    "Ordinary": {"Method": "Ordinary"},
    "OrdinaryWithShade": {"Method": "Ordinary", "Shadows": 0, "Shade": 1},
    "OrdinaryWithoutLight": {"Method": "Ordinary", "Shadows": 0},
    "Viola2004": {"Method": "Viola 2004"},
    "Marchesin2010": {"Method": "Marchesin 2010"},
    "Ament2017": {"Method": "Ament 2017"},
}


def show(**settings):
    """A view and the display in it."""
    displays.clear()
    view = displays.new_view((256, 256))
    view.UseFXAA = 0
    view.CameraViewAngle = 20
    return view, displays.show_head(view, 64, **LIGHT, **settings)


def path_of(name):
    return os.path.join(BASELINES, name + ".png")


def side_by_side(name, picture, baseline):
    """Writes the picture, the stored one and 20 times their difference. Returns where."""
    os.makedirs(OUTPUT, exist_ok=True)
    path = os.path.join(OUTPUT, name + ".png")
    apart = np.clip(20 * np.abs(picture - baseline), 0, 255)
    pictures.write(path, np.concatenate([picture, baseline, apart], axis=1))
    return path


class TestOptimizedVolumeBaselines(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if os.environ.get(RENEW) == "1":
            for name, settings in PICTURES.items():
                view, _ = show(**settings)
                pictures.write(path_of(name), pictures.take(view))

    def assert_is(self, name, picture):
        self.assertTrue(os.path.exists(path_of(name)), "Run this test with {}=1 in the environment "
                        "to make the baselines.".format(RENEW))
        baseline = pictures.read(path_of(name))
        self.assertEqual(picture.shape, baseline.shape)
        mean, p99 = pictures.difference(picture, baseline)
        if mean > MEAN or p99 > P99:
            self.fail("{} differs from its baseline: mean {:.3f} (at most {}), p99 {:.1f} (at most "
                      "{}). {} has the picture, the baseline and 20 times the difference. If this "
                      "is how it should look now, run this test with {}=1 in the environment and "
                      "commit the files that change in Testing/Baselines.".format(
                          name, mean, MEAN, p99, P99, side_by_side(name, picture, baseline), RENEW))

    def test_pictures_look_as_they_did(self):
        for name, settings in PICTURES.items():
            with self.subTest(name):
                view, display = show(**settings)

                self.assert_is(name, pictures.take(view))
                self.assertEqual(display.Messages, "")

    def test_a_small_change_is_noticed(self):
        view, display = show()
        display.ShadowStrength = display.ShadowStrength - 0.05

        mean, p99 = pictures.difference(pictures.take(view), pictures.read(path_of("Optimized")))
        self.assertGreater(mean, 3 * MEAN)
        self.assertGreater(p99, P99)

    def test_no_two_baselines_look_the_same(self):
        stored = {name: pictures.read(path_of(name)) for name in PICTURES}
        for first, second in itertools.combinations(stored, 2):
            with self.subTest(first=first, second=second):
                mean, p99 = pictures.difference(stored[first], stored[second])
                self.assertGreater(mean, 10 * MEAN)
                self.assertGreater(p99, 10 * P99)

    def test_every_stored_picture_is_used(self):
        files = {name for name, kind in map(os.path.splitext, os.listdir(BASELINES))
                 if kind == ".png"}
        self.assertEqual(files, set(PICTURES))


if __name__ == "__main__":
    runner.run()
