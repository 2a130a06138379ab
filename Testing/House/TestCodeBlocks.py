# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether every code block of the pages is run by a test, or is at least right in its syntax where
there is a reason not to run it. With --count, prints how many there are of each kind."""

import collections
import re
import shutil
import subprocess
import sys
import unittest
from typing import NamedTuple

import code_blocks
import house
from code_blocks import INSTALL, README, VTK, WHEEL_README


class NotRun(NamedTuple):
    """Marks a block of which only the syntax is checked."""

    reason: str


BUILDS = NotRun("It builds everything and runs all tests, this one included. Testing/releases.sh runs it.")
MAKES_PICTURES = NotRun("It makes the pictures of the page from the test scenes, for minutes. Tests run "
                        "the same scripts on small images (ParaView.Example*, Gui.TestTutorial).")
WRITES_FILES = NotRun("ParaView.TestExamplesOfFiles runs the same script, and reads its files.")
OF_DEVELOPERS = NotRun("It takes up to two hours, or changes the tree or the machine of a developer.")

#: By page and by the first words of a block: the test that runs it, or why there is none.
RUN_BY = {
    README: {
        "bash Documentation/Examples/demo.sh": BUILDS,
        "import os\nfrom paraview.simple import *": "Install.TestReadme",
        "import limpid, pyvista as pv": "Wheel.TestReadme",
    },
    INSTALL: {
        "bash Documentation/Examples/demo.sh": BUILDS,
        "export PV_PLUGIN_PATH=": "Install.TestReadme",
        "cmake -S . -B build/vtk": "Install.TestReadme",
        "bash Testing/run.sh": BUILDS,
    },
    VTK: {
        "#include": "Install.TestReadme",
        "cmake_minimum_required": "Install.TestReadme",
        "cmake -S program": "Install.TestReadme",
        "from limpid.vtkLimpidFilters import": "Install.TestReadme",
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
    "Documentation/Segmentations.md": {
        "found = limpid.optimize(image, structures": "Wheel.TestReadme",
    },
    "Documentation/Parameters.md": {
        "sheet() {": MAKES_PICTURES,
        "python3 Plugin/cmake/settings.py": NotRun(
            "House.TestSettings makes the same text, and compares it with the page."),
    },
    "Documentation/Gallery.md": {
        "bash Documentation/Examples/figures/all.sh": MAKES_PICTURES,
        "pvpython Documentation/Examples/structures_sheet.py": MAKES_PICTURES,
        "pvpython Documentation/Examples/opaque_sheet.py": MAKES_PICTURES,
        "pvpython Documentation/Examples/any_data.py": MAKES_PICTURES,
    },
    "Documentation/Export.md": {
        "pvpython Documentation/Examples/export_volume.py": WRITES_FILES,
        "pvpython Documentation/Examples/cinema.py": WRITES_FILES,
    },
    "Documentation/Headless.md": {
        "xvfb-run --auto-servernum pvpython": NotRun(
            "ParaView.ExampleOptimizedVolume runs the same script, on a display of its own."),
        "docker build": OF_DEVELOPERS,
        "bash Testing/pvserver.sh": OF_DEVELOPERS,
    },
    "Plugin/Packaging/README.md": {
        "bash Testing/recipes.sh": OF_DEVELOPERS,
        "spack repo add": OF_DEVELOPERS,
    },
    "Documentation/Examples/figures/README.md": {"bash Testing/build.sh": MAKES_PICTURES},
    "Documentation/Tutorial.md": {"bash Documentation/Examples/tutorial.sh": MAKES_PICTURES},
    "Documentation/Benchmarks/Structures.md": {
        "python3 Testing/Benchmarks/structures.py": OF_DEVELOPERS},
    "Documentation/Compatibility.md": {"bash Testing/releases.sh": OF_DEVELOPERS},
    "CONTRIBUTING.md": {
        "bash Testing/run.sh": OF_DEVELOPERS,
        "cmake --preset core": OF_DEVELOPERS,
        "bash Testing/check.sh sanitize": OF_DEVELOPERS,
        "build/bin/limpid_hash_results": OF_DEVELOPERS,
        "cmake --preset vtk": OF_DEVELOPERS,
        "pip install pre-commit": OF_DEVELOPERS,
    },
}

#: Pages whose Python is all run by a script that a test starts.
RUN_WHOLE = "ParaView.ExamplePages"
WHOLE = ("Cookbook.md", "Importance.md", "Pvpython.md")


def run_by(path, block):
    """The tests, or reasons, that are listed for a block."""
    if path in [f"Documentation/{name}" for name in WHOLE] and block.language == "python":
        return [RUN_WHOLE]
    return [test for start, test in RUN_BY.get(path, {}).items() if block.text.startswith(start)]


ALL = [(path, block) for path in code_blocks.pages() for block in code_blocks.blocks(path)]


class TestCodeBlocks(unittest.TestCase):
    def test_each_is_run_by_one_test_or_not_for_a_reason(self):
        for path, block in ALL:
            found = run_by(path, block)
            self.assertEqual(len(found), 1, f"{path}: RUN_BY has {found} for this block:\n{block.text}")

    def test_none_that_is_gone_is_listed(self):
        for path, listed in RUN_BY.items():
            for start in listed:
                found = [text for _, text in code_blocks.blocks(path) if text.startswith(start)]
                self.assertEqual(len(found), 1, f"{path} has {len(found)} blocks with {start}")

    def test_the_tests_that_are_listed_exist_and_run_them(self):
        for listed in RUN_BY.values():
            for start, test in listed.items():
                if isinstance(test, NotRun):
                    continue
                self.assertIn(test, house.tests())
                folder, name = test.split(".")
                words = start.encode("unicode_escape").decode()
                self.assertIn(f'"{words}"', house.text(f"Testing/{folder}/{name}.py"))

    def test_pages_that_are_run_whole_are_those_of_the_test(self):
        self.assertIn(RUN_WHOLE, house.tests())
        command = house.text("Testing/Python/CMakeLists.txt").split(f'"{RUN_WHOLE}"')[1].split("\n\n")[0]
        self.assertEqual(tuple(re.findall(r"Documentation/(\w+\.md)", command)), WHOLE)

    def test_each_is_right_in_its_syntax(self):
        for path, block in ALL:
            if block.language == "python":
                compile(block.text, str(path), "exec")
            elif block.language == "sh":
                bash = shutil.which("bash")
                if not bash:
                    self.skipTest("There is no bash.")
                subprocess.run([bash, "-n"], input=block.text, text=True, check=True)

    def test_scripts_that_are_called_exist(self):
        for path, block in ALL:
            for script in re.findall(r"(?:Documentation|Plugin|Testing)/[\w/]+\.(?:py|sh)", block.text):
                self.assertTrue((house.ROOT / script).is_file(), f"{path} calls {script}")


def count():
    """How many blocks are run, and of how many only the syntax is checked, and why."""
    kinds = collections.Counter(
        test.reason if isinstance(test, NotRun) else f"run by {test}"
        for path, block in ALL for test in run_by(path, block))
    for kind, number in kinds.most_common():
        print(f"{number:3} {kind}")
    print(f"{len(ALL):3} code blocks on {len({path for path, _ in ALL})} pages")


if __name__ == "__main__":
    if sys.argv[1:] == ["--count"]:
        count()
    else:
        unittest.main()
