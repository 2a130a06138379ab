# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Under pvbatch --symmetric: what pictures that processes draw together show of structures.

import sys
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkDataObject

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from images import filter_on
from mapper_tests import MapperTest, placement_of, show
from ranks import RANK, RANKS, slab_of, sum_of_all, together
from volume_views import actor_of, difference, phantom, sphere

LABELS, POINTS = 3, vtkDataObject.FIELD_ASSOCIATION_POINTS
STRUCTURES = ((1, "shell", 0.2), (2, "core", 1.0), (3, "rest", 0.5))
SETTINGS = {"LightWeight": 0, "RestrictToView": 0}


def whole_image():
    """A phantom with labels: a core, a shell around it, and what is beside both."""
    image = phantom(16)
    points = np.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
    middle, size = points.mean(axis=0), np.ptp(points, axis=0).max()
    distance = np.linalg.norm(points - middle, axis=1) / size
    labels = np.where(distance < 0.2, 2, np.where(distance < 0.35, 1, 0))
    labels[(labels == 0) & (points[:, 2] > middle[2])] = 3
    array = numpy_to_vtk(labels.astype(np.int16), deep=1)
    array.SetName("Labels")
    image.GetPointData().AddArray(array)
    return image


def choose(algorithm, structures=STRUCTURES):
    algorithm.SetExtinctionSource(algorithm.ARRAY)
    algorithm.SetInputArrayToProcess(LABELS, 0, 0, POINTS, "Labels")
    for structure in structures:
        algorithm.AddStructure(*structure)


def show_piece(first=0, structures=STRUCTURES, **properties):
    """A view of this process's slab, and the mapper. Processes before the first have no slab."""
    whole = whole_image()
    view, mapper = show(
        slab_of(whole, first), SharesImage=1, WholeExtent=whole.GetExtent(), **properties)
    if RANK < first:  # such bounds are not those of the others
        full, _ = show(whole)
        view.renderer.SetActiveCamera(full.camera)
    mapper.SetExtinctionArray("BaseExtinction")
    choose(mapper, structures)
    return view, mapper


def columns_of(table):
    return {table.GetColumnName(i): [table.GetValue(row, i).ToDouble()
                                     for row in range(table.GetNumberOfRows())]
            for i in range(table.GetNumberOfColumns()) if table.GetColumnName(i) != "Name"}


class TestStructuresOnRanks(MapperTest):
    def filtered(self, view):
        """The table of one process that has the whole image, for the camera of a view."""
        optimizer = filter_on(
            whole_image(), vtkExtinctionOptimizer, **SETTINGS, **placement_of(view))
        choose(optimizer)
        optimizer.UpdatePiece(0, 1, 0)
        return columns_of(optimizer.GetStructureTable())

    def test_shares_are_those_of_one_process(self):
        for first in range(2):
            with self.subTest(without_points=first):
                view, mapper = show_piece(first, **SETTINGS)
                view.window.Render()
                self.assertFalse(mapper.GetStructuresMeasured())
                self.assertEqual(columns_of(mapper.GetStructureTable()), self.filtered(view))
                self.assertTrue(mapper.GetStructuresMeasured())
                self.assertGreater(min(columns_of(mapper.GetStructureTable())["Visible"]), 0)
                self.assert_fine(view)

    def test_opaque_geometry_of_one_process_hides_from_all(self):
        view, mapper = show_piece()
        view.window.Render()
        free = columns_of(mapper.GetStructureTable())["Visible"]
        if RANK == RANKS - 1:
            view.renderer.AddActor(actor_of(sphere((0, 0, 0), 0.3)))
        view.window.Render()
        hidden = columns_of(mapper.GetStructureTable())["Visible"]
        self.assertLess(hidden[1], 0.9 * free[1])
        np.testing.assert_array_equal(RANKS * np.array(hidden), sum_of_all(np.array(hidden)))
        self.assert_fine(view)

    def test_targets_are_met(self):
        settings = {**SETTINGS, "ProtectImportance": 0}
        view, mapper = show_piece(**settings)
        view.window.Render()
        columns = columns_of(mapper.GetStructureTable())
        wanted = 0.7 * columns["Visible"][0] + 0.3 * columns["Attainable"][0]
        (label, name, importance), *others = STRUCTURES
        view, mapper = show_piece(1, ((label, name, importance, wanted), *others), **settings)
        view.window.Render()
        self.assertTrue(mapper.GetConverged())
        columns = columns_of(mapper.GetStructureTable())
        self.assertGreaterEqual(columns["Visible"][0], wanted - 0.001)
        self.assertGreater(columns["Weight"][0] / columns["Weight"][1], importance)
        self.assert_fine(view)

    def test_colors_are_those_of_one_process(self):
        settings = {"Method": Mapper.ORDINARY, "Shadows": 0}
        alone, mapper = show(whole_image(), StructureColors=1, **settings)
        mapper.SetExtinctionArray("BaseExtinction")
        choose(mapper)
        expected = alone.picture()
        for first in range(2):
            with self.subTest(without_points=first):
                view, mapper = show_piece(first, StructureColors=1, **settings)
                picture = together(view)
                self.assertLessEqual(np.abs(picture - expected).max(), 2)  # blended in two ways
                table = mapper.GetStructureLegendTable()
                self.assertEqual([table.GetValue(row, 0).ToString() for row in range(3)],
                                 ["core", "rest", "shell"])
                mapper.SetStructureColors(0)
                self.assertGreater(difference(together(view), expected), 1)
                self.assert_fine(view)


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=0 if RANK else 2).result
    if not result.wasSuccessful():
        sys.exit(1)
