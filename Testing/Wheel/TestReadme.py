# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs the Python of the package's README.md, of the repository's and of Segmentations.md as it stands
# there. The first reads carotid_mra.vti: that of LIMPID_TEST_DATA, or a stand-in with values as it has
# them. Needs a display.

import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.append(os.path.join(os.path.dirname(__file__), "..", "House"))
from code_blocks import README, WHEEL_README, block

import limpid

try:
    import pyvista
except ImportError:
    pyvista = None


def write_stand_in(path):
    """A bright tube in dim matter."""
    image = pyvista.ImageData(dimensions=(40, 36, 32), spacing=(4, 4, 1.5))
    x, y, z = image.points.T
    from_axis = np.hypot(x - 80 - 20 * np.sin(0.1 * z), y - 70)
    image["scalars"] = np.where(from_axis < 12, 240, 90 + 20 * np.sin(0.1 * x)).astype(np.float32)
    image.save(path)


@unittest.skipIf(pyvista is None, "PyVista is not installed.")
class TestReadme(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def run_blocks(self, path, *starts, **names):
        """Runs blocks in one namespace, with what it has before. Returns it, and what they print."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            for start in starts:
                exec(compile(block(path, start), f"{path}: {start}", "exec"), names)
        return names, said.getvalue()

    def test_of_the_package(self):
        data = pathlib.Path(os.environ.get("LIMPID_TEST_DATA", ""), "carotid_mra.vti")
        if data.is_file():
            (self.folder / data.name).symlink_to(data.resolve())
        else:
            write_stand_in(self.folder / data.name)

        names, _ = self.run_blocks(
            WHEEL_README, "import limpid\n", "scalars = ", "functions = ", "rgba = ",
            "views = limpid.viewpoints(", "found.save(")

        self.assertEqual(names["picture"].shape[2], 4)
        self.assertGreater(names["picture"][..., 3].max(), 100)
        picture = pyvista.read(self.folder / "opacities.png").active_scalars
        self.assertGreater(np.ptp(picture), 50)
        self.assertGreater(names["views"][0].visible_fraction, 0)
        image = pyvista.read(self.folder / "found.vti")
        np.testing.assert_array_equal(image["Extinction"], names["found"].extinction)
        self.assertEqual(pyvista.read(self.folder / "picture.png").n_points, 600 * 600)
        self.assertEqual(names["small"].shape, (240, 240, 4))

    def test_of_the_repository(self):
        names, said = self.run_blocks(README, "import limpid, pyvista as pv")

        self.assertIn(str(names["found"]), said)
        self.assertGreater(names["found"].visible_fraction, names["found"].base_visible_fraction)

    def test_of_segmentations(self):
        image = pyvista.ImageData(dimensions=(24, 24, 24))
        x, y, z = image.points.T - 11.5
        image["values"] = np.maximum(0, 11 - np.abs(x)).astype(np.float32)
        image["Labels"] = 3 * (np.abs(y) + np.abs(z) + np.abs(x) < 4).astype(np.uint8)
        image["Labels"][np.abs(x + 8) + np.abs(y) < 3] = 7

        names, said = self.run_blocks("Documentation/Segmentations.md",
                                      "found = limpid.optimize(image, structures",
                                      image=image, limpid=limpid)

        self.assertIn(names["found"].targets, said)
        self.assertGreater(names["found"].structures[3].visible, 0)


if __name__ == "__main__":
    unittest.main()
