# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# VTK's own tests of volume rendering with our mapper in place of VTK's, see vtk_scenes.py: each
# picture is VTK's, or there is a message. The table is Documentation/VtkTests.md.

import os
import re
import unittest

import numpy as np

from images import caught
from vtk_scenes import REFUSED, SCENES, Stage
from volume_views import difference, save

BAR = 1.5  # mean absolute difference of 8-bit values


def pictures_of(scene, ours, finer=1):
    stage = Stage(ours, finer)
    pictures = list(scene(stage))
    return pictures, stage.mappers


class TestIsVtksPicture(unittest.TestCase):
    def check(self, name):
        scene, finer, differs = SCENES[name]
        ours, mappers = pictures_of(scene, True, finer)
        vtks, _ = pictures_of(scene, False, finer)
        for i, pair in enumerate(zip(ours, vtks)):
            save(np.concatenate(pair, axis=1), f"{name} {i}")
        apart = max(difference(*pair) for pair in zip(ours, vtks))
        print(f"| {name} | {apart:.2f} |")

        for mapper in mappers:
            self.assertEqual(mapper.GetMessages(), "")
        for picture in ours:
            self.assertGreater(picture.std(), 3)  # there is something in it
        if differs:
            self.skipTest(differs)
        self.assertLess(apart, BAR)


class TestIsRefused(unittest.TestCase):
    def check(self, name):
        scene, sayings = REFUSED[name]
        try:
            _, mappers = pictures_of(scene, True)
            said = "".join(mapper.GetMessages() for mapper in mappers)
        except AttributeError as error:
            said = str(error)
        print(f"| {name} | {said} |")
        for saying in sayings:
            self.assertIn(saying, said)


class TestTable(unittest.TestCase):
    def test_every_scene_has_a_row(self):
        path = os.path.join(os.path.dirname(os.path.abspath(__file__)),
                            "../../Documentation/VtkTests.md")
        with open(path, encoding="utf-8") as file:
            rows = re.findall(r"^\| (Test\w+) \|", file.read(), re.MULTILINE)
        self.assertEqual(sorted(rows), sorted([*SCENES, *REFUSED]))


def add_tests(test_case, names):
    for name in names:
        setattr(test_case, "test_" + name, lambda self, name=name: self.check(name))


add_tests(TestIsVtksPicture, SCENES)
add_tests(TestIsRefused, REFUSED)

if __name__ == "__main__":
    unittest.main()
