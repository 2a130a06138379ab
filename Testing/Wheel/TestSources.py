# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# A source distribution of the package has all that it is made of: the core, and a project file that
# finds it. Testing/wheel.sh makes the package of one.

import os
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import unittest

PROJECT = pathlib.Path(__file__).resolve().parents[2] / "Plugin/Wheel"

try:
    import scikit_build_core
except ImportError:
    scikit_build_core = None

MAKE = "import sources, sys; print(sources.build_sdist(sys.argv[1]))"


def made_of(project, folder):
    """Makes a source distribution of a project and unpacks it. Returns where."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(
        [str(project), os.environ.get("PYTHONPATH", "")]), "PYTHONDONTWRITEBYTECODE": "1"}
    run = subprocess.run([sys.executable, "-c", MAKE, folder], cwd=project, check=True,
                         env=environment, stdout=subprocess.PIPE, text=True)
    name = run.stdout.split()[-1]
    with tarfile.open(pathlib.Path(folder, name)) as archive:
        archive.extractall(folder)
    return pathlib.Path(folder, name[:-len(".tar.gz")])


@unittest.skipIf(scikit_build_core is None, "scikit-build-core is not installed: no source "
                 "distribution is made")
class TestSources(unittest.TestCase):
    def test_a_source_distribution_can_be_configured(self):
        with tempfile.TemporaryDirectory() as folder:
            unpacked = made_of(PROJECT, folder)

            project = (unpacked / "pyproject.toml").read_text(encoding="utf-8")
            self.assertNotIn('"..', project)
            self.assertTrue((unpacked / "source/Plugin/Wheel/Module.cxx").is_file())
            subprocess.run(["cmake", "-G", "Ninja", "-S", unpacked / "source", "-B", unpacked / "build",
                            "-DLIMPID_ENABLE_VTK=OFF", "-DLIMPID_ENABLE_CUDA=OFF",
                            "-DLIMPID_BUILD_TESTING=OFF"], check=True, stdout=subprocess.PIPE)

    def test_one_can_be_made_of_another(self):
        with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second:
            one = made_of(PROJECT, first)
            other = made_of(one, second)

            names = [{file.relative_to(top) for file in top.rglob("*")} for top in (one, other)]
            self.assertEqual(*names)


if __name__ == "__main__":
    unittest.main()
