# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs the code blocks of README.md, Install.md and Vtk.md as they stand there: in a folder that has
# what a clone has, with a folder of its own for PREFIX, and with the build trees that are there in place of new ones, for
# which compiling would take minutes. LIMPID_BUILD: build tree of the plugin; LIMPID_VTK_BUILD: of
# the VTK modules; without one of them, what needs it is skipped. Needs a display.

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.append(os.path.join(os.path.dirname(__file__), "..", "House"))
import house
from code_blocks import INSTALL, README, VTK, block

PLUGIN_BUILD = os.environ.get("LIMPID_BUILD")
MODULES_BUILD = os.environ.get("LIMPID_VTK_BUILD")

# The modules are configured anew, but compiled they are already.
CMAKE = """
cmake()
{
  case "$1 $2" in
    "--build build/vtk") ;;
    "--install build/vtk") command cmake --install "$LIMPID_VTK_BUILD" "${@:3}" ;;
    *) command cmake "$@" ;;
  esac
}
"""


class Clone:
    """A folder with the files of the repository, and PREFIX below it."""

    def __init__(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.temporary.name, "limpid")
        self.prefix = pathlib.Path(self.temporary.name, "prefix")
        self.root.mkdir()
        for path in house.ROOT.iterdir():
            if not path.name.startswith("build"):
                (self.root / path.name).symlink_to(path)

    def remove(self):
        self.temporary.cleanup()

    def run(self, *scripts):
        """Runs scripts of bash as one. Returns what they print."""
        script = re.sub(r"\bPREFIX\b", str(self.prefix), "\n".join(scripts))
        run = subprocess.run([shutil.which("bash"), "-euo", "pipefail", "-c", script], cwd=self.root,
                             text=True, check=False, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT)
        if run.returncode != 0:
            raise AssertionError(f"This failed:\n{script}\nIt said:\n{run.stdout}")
        return run.stdout


@unittest.skipUnless(MODULES_BUILD, "There is no build tree of the VTK modules.")
class TestPlainVtk(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clone = Clone()
        cls.addClassCleanup(cls.clone.remove)
        cls.said = cls.clone.run(
            CMAKE, block(INSTALL, "cmake -S . -B build/vtk"),
            f"'{sys.executable}' -c 'from limpid import vtkLimpidFilters as f; print(f.__file__)'")

    def test_python_finds_what_was_installed(self):
        self.assertIn(str(self.clone.prefix), self.said.splitlines()[-1])

    def test_a_script_optimizes(self):
        script = self.clone.root / "script.py"
        script.write_text(block(VTK, "from limpid.vtkLimpidFilters import"))

        said = self.clone.run(
            f"export PYTHONPATH={self.said.splitlines()[-1].rsplit('/', 2)[0]}",
            f"'{sys.executable}' script.py")

        self.assertRegex(said, r"^[0-9.]+ % of the important structures can be seen")

    def test_a_program_draws(self):
        folder = self.clone.root / "program"
        folder.mkdir()
        (folder / "program.cxx").write_text(block(VTK, "#include"))
        (folder / "CMakeLists.txt").write_text(block(VTK, "cmake_minimum_required"))

        said = self.clone.run(block(VTK, "cmake -S program"))

        share, = re.findall(r"([0-9.]+) % of the important structures can be seen", said)
        self.assertGreater(float(share), 0)


@unittest.skipUnless(PLUGIN_BUILD, "There is no build tree of the plugin.")
class TestParaView(unittest.TestCase):
    def setUp(self):
        self.clone = Clone()
        self.addCleanup(self.clone.remove)
        (self.clone.root / "build").symlink_to(PLUGIN_BUILD)

    def run_in_pvpython(self, text, *before):
        (self.clone.root / "script.py").write_text(text)
        return self.clone.run(*before, "pvpython script.py")

    def test_paraview_finds_what_was_installed(self):
        self.clone.run("cmake --install build --prefix PREFIX")
        plugin, = self.clone.prefix.glob("**/Limpid.so")
        version = plugin.parents[2].name
        self.assertRegex(version, "^paraview-")

        said = self.run_in_pvpython(
            "from paraview.simple import *\nprint(OcclusionPhantom(), 'made')",
            re.sub(r"paraview-\d+\.\d+", version, block(INSTALL, "export PV_PLUGIN_PATH=")))

        self.assertIn("made", said)

    def test_pvpython_shows_a_volume(self):
        said = self.run_in_pvpython(block(README, "import os\nfrom paraview.simple import *"))

        self.assertRegex(said, r"[0-9.]+ % of the important structures can be seen, [0-9.]+ % before")
        self.assertTrue((self.clone.root / "optimized.png").is_file())


if __name__ == "__main__":
    unittest.main()
