# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Blanked points and cells in the mapper: the score. The pictures are in TestScenesOfVtk.

import unittest

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes as Flags

from mapper_tests import MapperTest, show
from volume_views import phantom, values


class TestScore(MapperTest):
    def test_is_that_without_what_is_blanked(self):
        without = phantom()
        for name in ("Scalars", "Importance"):
            values(without, name).reshape(32, 32, 32)[8:21, 10:23, 6:15] = 0
        wanted = self.scores(without)
        for flag in (Flags.HIDDENCELL, Flags.DUPLICATECELL, Flags.REFINEDCELL):
            with self.subTest(flag=flag):
                image = phantom()
                image.AllocateCellGhostArray()
                cells = vtk_to_numpy(image.GetCellGhostArray()).reshape(31, 31, 31)
                cells[8:20, 10:22, 6:14] = flag
                self.assertEqual(self.scores(image), wanted)

    def scores(self, image):
        view, mapper = show(image)
        view.window.Render()
        self.assert_fine(view)
        return mapper.GetBaseVisibilityScore(), mapper.GetVisibilityScore()


if __name__ == "__main__":
    unittest.main()
