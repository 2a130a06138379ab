# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Which reader ParaView takes for which file, and structures in images that came through its own readers,
# which ignore directions.

import os
import tempfile
import unittest

import numpy as np
from image_files import in_order, segments, write_meta, write_nifti, write_nrrd
from paraview import simple
from paraview.modules.vtkRemotingServerManager import vtkSMProxyManager
from paraview.vtk.util.numpy_support import vtk_to_numpy

import displays
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())

SHAPE = (12, 11, 10)
# An oblique, left-handed grid: an orthonormal matrix of thirds, times spacings.
STEPS = np.array([[2, -2, 1], [1, 2, 2], [2, 1, -2]]) / 3 * [0.5, 0.75, 2]
ORIGIN = np.array([10, -20, 30])
MATRIX = np.column_stack([STEPS, ORIGIN])


def labels():
    values = np.zeros(SHAPE, "uint8")
    values[3:6, 2:5, 4:6] = 1
    values[4:9, 3:6, 1:4] = 5
    return values


class ReaderTest(unittest.TestCase):
    def setUp(self):
        displays.clear()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        values = np.arange(np.prod(SHAPE)).reshape(SHAPE).astype("int16")
        for name in ("ct.nrrd", "ct.seg.nrrd"):
            write_nrrd(self.path(name), values, MATRIX)
        write_meta(self.path("ct.mha"), values, MATRIX)
        for name in ("ct.nii", "ct.nii.gz"):
            write_nifti(self.path(name), values, np.diag([-1, -1, 1]) @ MATRIX)
        write_nrrd(self.path("a.seg.nrrd"), labels()[2:10, 1:8, :8],
                   np.column_stack([STEPS, ORIGIN + STEPS @ [2, 1, 0]]),
                   more=segments((1, "liver", 0), (5, "tumour", 0)))

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_there_is_one_for_each_file(self):
        factory = vtkSMProxyManager.GetProxyManager().GetReaderFactory()
        session = simple.servermanager.ActiveConnection.Session
        for name, reader in (("ct.nii", "SegmentationReader"), ("ct.nii.gz", "SegmentationReader"),
                             ("ct.nrrd", "NrrdReader"), ("ct.seg.nrrd", "NrrdReader"),
                             ("ct.mha", "MetaImageReader")):
            found = factory.GetReaders(self.path(name), session)
            self.assertEqual((found.GetLength(), found.GetString(1)), (3, reader), name)
            self.assertEqual(simple.OpenDataFile(self.path(name)).SMProxy.GetXMLName(), reader)

    def test_images_of_all_get_each_label_at_its_place(self):
        for name in ("ct.nii.gz", "ct.nrrd", "ct.mha"):
            image = simple.OpenDataFile(self.path(name))
            added = AddStructures(Input=image,
                                  Structures=SegmentationReader(FileName=self.path("a.seg.nrrd")),
                                  ImageFile="" if name == "ct.nii.gz" else self.path(name))
            added.UpdatePipeline()
            found = simple.servermanager.Fetch(added).GetPointData().GetArray("Structure")
            expected = in_order(labels(), MATRIX)[0] if name == "ct.nii.gz" else labels()
            np.testing.assert_array_equal(vtk_to_numpy(found), expected.ravel(order="F"), name)


runner.run()
