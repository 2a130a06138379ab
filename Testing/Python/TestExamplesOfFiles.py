# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What the examples write for other programs: volumes and databases of pictures.

import csv
import importlib.util
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkMetaImageReader

import runner

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "Documentation" / "Examples"
NODES = 64  # of the exported phantom, along each axis


class ExampleTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_example(self, script, *arguments):
        run = subprocess.run(
            [shutil.which("pvpython"), EXAMPLES / script, os.environ["LIMPID_PLUGIN"], *arguments],
            cwd=self.folder, check=False, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(run.returncode, 0, run.stdout)


class TestExportVolume(ExampleTest):
    def read_meta_image(self):
        reader = vtkMetaImageReader()
        reader.SetFileName(str(self.folder / "head.mha"))
        reader.Update()
        return reader.GetOutput()

    def test_nrrd_and_meta_image_have_the_same_colors_and_opacities(self):
        self.run_example("export_volume.py", "head.nrrd", "head.mha")
        header, numbers = (self.folder / "head.nrrd").read_bytes().split(b"\n\n", 1)
        image = self.read_meta_image()
        rgba = vtk_to_numpy(image.GetPointData().GetScalars())

        self.assertIn(f"sizes: 4 {NODES} {NODES} {NODES}".encode(), header)
        self.assertEqual(image.GetDimensions(), (NODES,) * 3)
        np.testing.assert_array_equal(np.frombuffer(numbers, np.uint8).reshape(-1, 4), rgba)
        opacity = rgba[:, 3]
        self.assertEqual(opacity.min(), 0)
        self.assertGreater(opacity.max(), 200)  # of 255: bone and vessels

    @unittest.skipUnless(importlib.util.find_spec("pyopenvdb"), "There is no Python module of OpenVDB.")
    def test_openvdb_has_the_optimised_extinction(self):
        import pyopenvdb
        self.run_example("export_volume.py", "head.mha", "head.vdb")
        density = pyopenvdb.read(str(self.folder / "head.vdb"), "density")
        values = np.zeros((NODES,) * 3, np.float32)
        density.copyToArray(values)
        rgba = vtk_to_numpy(self.read_meta_image().GetPointData().GetScalars())

        opacity = rgba[:, 3].reshape((NODES,) * 3).transpose(2, 1, 0) / 255
        # A byte rounds by half of its step.
        np.testing.assert_allclose(-np.expm1(-0.1 * values), opacity, rtol=0, atol=0.5001 / 255)


class TestCinema(ExampleTest):
    def test_has_a_row_and_a_picture_per_camera(self):
        self.run_example("cinema.py", "head.cdb", "--phi", "2", "--theta", "1", "--size", "100",
                         "--resolution", "32")
        with open(self.folder / "head.cdb" / "data.csv", encoding="utf-8", newline="") as table:
            rows = list(csv.DictReader(table))

        self.assertEqual([(row["phi"], row["theta"]) for row in rows],
                         [("0.0", "90.0"), ("180.0", "90.0")])
        for row in rows:
            self.assertTrue((self.folder / "head.cdb" / row["FILE"]).is_file())
            self.assertGreater(float(row["visible"]), float(row["visible_before"]))


if __name__ == "__main__":
    runner.run()
