# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether the examples refuse broken scene files with one line that names file and key."""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "Documentation" / "Examples"

IMAGE = """<?xml version="1.0"?>
<VTKFile type="ImageData" version="0.1">
  <ImageData WholeExtent="0 {last} 0 3 0 3" Origin="0 0 0" Spacing="1 1 1">
"""

SCENE = {
    "name": "n",
    "title": "t",
    "becomes_visible": "b",
    "data": {"file": "image.vti", "array": "a"},
    "color_tf": [[0, 0, 0, 0], [1, 1, 1, 1]],
    "extinction_tf": [[0, 0], [1, 2.5]],
    "importance_tf": [[0, 0], [1, 1]],
    "camera": {"position": [0, 0, 9], "focal_point": [0, 0, 0], "view_up": [0, 1, 0],
               "view_angle": 30},
    "light": {"position": [5, 5, 5]},
}

GONE = object()

# Key, its broken value, and the key that the message names where that is another.
BROKEN = [
    ("name", GONE), ("title", 7), ("becomes_visible", []), ("data", GONE), ("data", "image.vti"),
    ("data.file", GONE), ("data.file", 3), ("data.file", "absent.vti"), ("data.file", "."),
    ("data.file", "scene.json"), ("data.file", "huge.vti"), ("data.file", "empty.vti"),
    ("data.file", "nul\0.vti"), ("data.array", GONE), ("data.array", ["a"]),
    ("color_tf", GONE), ("color_tf", []), ("color_tf", {}), ("color_tf", [[0, 0, 0]], "color_tf[0]"),
    ("color_tf", [[0, 0, 0, 255]], "color_tf[0]"), ("color_tf", [0, 0, 0, 0], "color_tf[0]"),
    ("extinction_tf", GONE), ("extinction_tf", 1.0), ("extinction_tf", [[0, 0]]),
    ("extinction_tf", [[0, -1]], "extinction_tf[0]"),
    ("extinction_tf", [[0, 1], ["1", 1]], "extinction_tf[1]"),
    ("extinction_tf", [[1, 1], [0, 1]], "extinction_tf[1]"),
    ("extinction_tf", [[0, float("nan")]], "extinction_tf[0]"),
    ("importance_tf", GONE), ("importance_tf", [[0, 2]], "importance_tf[0]"),
    ("importance_tf", [[0, True]], "importance_tf[0]"),
    ("camera", GONE), ("camera", [1, 2, 3]), ("camera.position", GONE), ("camera.position", 5),
    ("camera.position", [1, 2]), ("camera.position", [1, 2, "3"]),
    ("camera.position", [1, 2, float("inf")]), ("camera.position", [10**400, 0, 0]),
    ("camera.position", [0, 0, 0], "camera.focal_point"), ("camera.focal_point", None),
    ("camera.view_up", [0, 0, 0]), ("camera.view_angle", [30]), ("camera.view_angle", 180),
    ("light", GONE), ("light", None), ("light.position", "above"),
]


def changed(key, value):
    scene = copy.deepcopy(SCENE)
    *parents, last = key.split(".")
    at = scene
    for parent in parents:
        at = at[parent]
    at[last] = value
    if value is GONE:
        del at[last]
    return json.dumps(scene)


class TestSceneFile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = self.folder / "scene.json"
        for name, last in (("image.vti", 3), ("huge.vti", 10**9), ("empty.vti", -1)):
            (self.folder / name).write_text(IMAGE.format(last=last))

    def run_with(self, content):
        """What a program says about a scene file of these bytes or this text."""
        if content is not None:
            self.path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return subprocess.run([sys.executable, "-B", EXAMPLES / "scene_file.py", self.path],
                              capture_output=True, text=True, check=False)

    def expect_refusal(self, content, words):
        result = self.run_with(content)

        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertTrue(result.stderr.startswith("{}: {}".format(self.path, words)), result.stderr)
        self.assertRegex(result.stderr, r"\. [A-Z][^\n]*\.\n$")

    def test_accepts_what_is_whole(self):
        result = self.run_with(json.dumps(SCENE))

        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_names_the_key_that_is_wrong(self):
        for key, value, *named in BROKEN:
            with self.subTest(key=key, value="gone" if value is GONE else value):
                self.expect_refusal(changed(key, value), '"{}" '.format((named or [key])[0]))

    def test_names_a_file_that_is_no_scene(self):
        for content, words in ((None, "cannot be read"), ("", "is not JSON"), ("{", "is not JSON"),
                               (b"\xff\xfe\x00", "is not JSON"), ("[" * 100000, "is not JSON"),
                               ("[]", "is []"), ("3", "is 3")):
            with self.subTest(content=str(content)[:10]):
                self.expect_refusal(content, words)


if __name__ == "__main__":
    unittest.main()
