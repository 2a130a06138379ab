# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether every code block of the READMEs that people follow is run by a test, or is at least right
in its syntax where there is a reason not to run it."""

import shutil
import subprocess
import unittest
from typing import NamedTuple

import code_blocks
import house
from code_blocks import README, WHEEL_README


class NotRun(NamedTuple):
    """Marks a block of which only the syntax is checked."""

    reason: str


#: By file and by the first words of a block: the test that runs it, or why there is none.
RUN_BY = {
    README: {
        "bash Documentation/Examples/demo.sh": NotRun(
            "It builds everything and runs all tests, this one included. Testing/releases.sh runs it."),
        "export PV_PLUGIN_PATH=": "Install.TestReadme",
        "cmake -S . -B build/vtk": "Install.TestReadme",
        "#include": "Install.TestReadme",
        "cmake_minimum_required": "Install.TestReadme",
        "cmake -S program": "Install.TestReadme",
        "from paraview.simple import *": "Install.TestReadme",
        "seen = ExtinctionOptimizer(": "Install.TestReadme",
        "search = ViewpointSearch(": "Install.TestReadme",
        "import limpid, pyvista as pv": "Wheel.TestReadme",
    },
    WHEEL_README: {
        "python3 -m venv": NotRun(
            "It downloads and compiles for minutes. Testing/wheel.sh installs the package, of a "
            "source distribution, into such an environment."),
        "import limpid\n": "Wheel.TestReadme",
        "scalars = ": "Wheel.TestReadme",
        "functions = ": "Wheel.TestReadme",
        "rgba = ": "Wheel.TestReadme",
        "views = limpid.viewpoints(": "Wheel.TestReadme",
        "found.save(": "Wheel.TestReadme",
        "LIMPID_TEST_PICTURES=": NotRun("Testing/wheel.sh runs the same test."),
    },
}


class TestCodeBlocks(unittest.TestCase):
    def setUp(self):
        self.all = [(path, block) for path in RUN_BY
                    for block in code_blocks.blocks(path)]

    def test_each_is_run_by_one_test_or_not_for_a_reason(self):
        for path, block in self.all:
            starts = [start for start in RUN_BY[path] if block.text.startswith(start)]
            self.assertEqual(len(starts), 1, f"{path}: RUN_BY has {starts} "
                             f"for this block:\n{block.text}")

    def test_none_that_is_gone_is_listed(self):
        for path, run_by in RUN_BY.items():
            for start in run_by:
                found = [text for _, text in code_blocks.blocks(path) if text.startswith(start)]
                self.assertEqual(len(found), 1, f"{path} has {len(found)} blocks with {start}")

    def test_the_tests_that_are_listed_exist_and_run_them(self):
        for run_by in RUN_BY.values():
            for start, test in run_by.items():
                if isinstance(test, NotRun):
                    continue
                self.assertIn(test, house.tests())
                folder, name = test.split(".")
                words = start.encode("unicode_escape").decode()
                self.assertIn(f'"{words}"', house.text(f"Testing/{folder}/{name}.py"))

    def test_each_is_right_in_its_syntax(self):
        for path, block in self.all:
            if block.language == "python":
                compile(block.text, str(path), "exec")
            elif block.language == "sh":
                bash = shutil.which("bash")
                if not bash:
                    self.skipTest("There is no bash.")
                subprocess.run([bash, "-n"], input=block.text, text=True, check=True)
            else:
                self.assertIn(block.language, ("cmake", "cpp"), path)


if __name__ == "__main__":
    unittest.main()
