# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The colours of structures in the mapper's pictures.

import math
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkDataObject

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import (BACKGROUND, View, caught, difference, gray_property, image_of,
                          phantom, plain_mapper)

OWN = np.array((0.9, 0.5, 0.1))
DEPTH = 0.4  # optical depth of a cell
RED, GREEN, BLUE = np.eye(3)
# The picture and what it is drawn over are rounded to 8 bits.
ROUNDING = 2
POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS
CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS
SIZE = 2.0


def labelled(labels):
    """Eight cells along z, with a label for each of the nine slices, the camera's last."""
    return image_of((9, 9, 9), (2, 2, SIZE), (-8, -8, -8), scalars=np.zeros(729, np.float32),
                    Structure=np.repeat(labels, 81).astype(np.int16))


def slabs(labels=(5, 5, 5, 5, 5, 2, 2, 2, 2), **properties):
    view = View()
    mapper = plain_mapper()
    # Half a cell: the border of slices 4 and 5 is between two samples, not in one.
    mapper.SetSampleDistance(0.5)
    mapper.SetInputArrayToProcess(3, 0, 0, POINTS, "Structure")
    mapper.AddStructure(2, "front", 1)
    mapper.AddStructure(5, "rear", 1)
    for name, value in properties.items():
        getattr(mapper, "Set" + name)(value)
    view.volume = view.add(labelled(labels), gray_property(1 - math.exp(-DEPTH), SIZE, OWN), mapper)
    view.messages = caught(mapper)
    view.camera.ParallelProjectionOn()
    view.camera.SetPosition(0, 0, 100)
    view.camera.SetFocalPoint(0, 0, 0)
    view.camera.SetParallelScale(6)
    view.renderer.ResetCameraClippingRange()
    return view, mapper


def composed(front, rear, front_cells=3.5, cells=8):
    first = 1 - math.exp(-front_cells * DEPTH)
    through = math.exp(-cells * DEPTH)
    return 255 * (first * front + (1 - first - through) * rear + through * np.array(BACKGROUND))


class TestStructures(MapperTest):
    def assert_middle(self, view, expected):
        picture = view.picture()
        rows, columns, _ = picture.shape
        np.testing.assert_allclose(picture[rows // 2, columns // 2], expected, atol=ROUNDING)

    def test_structures_have_their_colors(self):
        view, mapper = slabs(StructureColors=1)
        mapper.AddLabelColor(2, *GREEN)
        mapper.AddLabelColor(5, *BLUE)
        self.assert_middle(view, composed(GREEN, BLUE))
        mapper.SetStructureColors(0.25)
        self.assert_middle(view, composed(0.25 * GREEN + 0.75 * OWN, 0.25 * BLUE + 0.75 * OWN))
        mapper.RemoveAllLabelColors()
        mapper.AddLabelColor(5, *RED)
        mapper.SetStructureColors(1)
        first = np.array((225, 45, 45)) / 255  # of the palette
        self.assert_middle(view, composed(first, RED))
        self.assert_fine(view)

    def test_the_legend_lists_important_structures_with_names(self):
        def legend():
            view.picture()
            table = mapper.GetStructureLegendTable()
            return [tuple(table.GetValue(row, column).ToString() if column == 0 else
                          round(255 * table.GetValue(row, column).ToDouble())
                          for column in range(table.GetNumberOfColumns()))
                    for row in range(table.GetNumberOfRows())]

        view, mapper = slabs(StructureColors=0.5)
        mapper.RemoveAllStructures()
        for label, name, importance in ((2, "front", 0.5), (5, "", 1), (7, "none", 0), (8, "rear", 1)):
            mapper.AddStructure(label, name, importance)
        mapper.AddLabelColor(8, *GREEN)
        self.assertEqual(legend(), [("rear", 0, 255, 0), ("front", 225, 45, 45)])
        mapper.SetStructureColors(0)
        self.assertEqual(legend(), [])
        mapper.SetStructureColors(0.5)
        mapper.RemoveAllStructures()  # all labels have one color
        mapper.RemoveAllLabelColors()
        self.assertEqual(legend(), [])

    def test_other_labels_keep_the_color_of_the_transfer_function(self):
        view, mapper = slabs((5, 5, 5, 5, 5, 7, 7, 7, 7), StructureColors=1)
        mapper.AddLabelColor(5, *GREEN)
        self.assert_middle(view, composed(OWN, GREEN))
        mapper.RemoveAllStructures()
        mapper.AddStructure(7, "front", 1)
        mapper.RemoveAllLabelColors()
        mapper.AddLabelColor(7, *RED)
        self.assert_middle(view, composed(RED, OWN))
        self.assert_fine(view)

    def test_labels_follow_their_array(self):
        view, mapper = slabs(StructureColors=1)
        mapper.AddLabelColor(2, *GREEN)
        mapper.AddLabelColor(5, *BLUE)
        view.picture()
        mapper.SetInputData(labelled((2, 2, 2, 2, 2, 5, 5, 5, 5)))
        self.assert_middle(view, composed(BLUE, GREEN))
        image = labelled((5,) * 9)
        ofCells = numpy_to_vtk(np.repeat([5, 5, 5, 5, 2, 2, 2, 2], 64).astype(np.int16), deep=1)
        ofCells.SetName("OfCells")
        image.GetCellData().AddArray(ofCells)
        mapper.SetInputData(image)
        mapper.SetInputArrayToProcess(3, 0, 0, CELLS, "OfCells")
        # Points on the border have as many cells of both labels, and take the first row.
        self.assert_middle(view, composed(GREEN, BLUE, 4.5))
        self.assert_fine(view)

    def test_without_rows_all_labels_have_one_color(self):
        view, mapper = slabs((5, 5, 5, 5, 2, 0, 0, 0, 0), StructureColors=1)
        mapper.RemoveAllStructures()
        self.assert_middle(view, composed(OWN, np.array((225, 45, 45)) / 255))

    def test_zero_is_the_picture_as_it_was_bit_for_bit(self):
        for method in (Mapper.ORDINARY, Mapper.OPTIMIZED):
            with self.subTest(method=method):
                view, mapper = show(Method=method)
                image = phantom()
                labels = numpy_to_vtk((np.arange(32**3) // 7000).astype(np.int16), deep=1)
                labels.SetName("Labels")
                image.GetPointData().AddArray(labels)
                mapper.SetInputData(image)
                mapper.SetInputArrayToProcess(3, 0, 0, POINTS, "Labels")
                for label in range(1, 5):
                    mapper.AddStructure(label, str(label), 0.25 * label)
                before = view.picture()
                mapper.SetStructureColors(1)
                tinted = view.picture()
                mapper.SetStructureColors(0)
                np.testing.assert_array_equal(view.picture(), before)
                self.assertGreater(difference(tinted, before), 1)
                self.assert_fine(view)

    def test_a_change_of_colors_is_seen_at_once(self):
        view, mapper = slabs(StructureColors=1, ProgressiveStill=1)
        mapper.AddLabelColor(2, *GREEN)
        before = view.picture()
        mapper.AddLabelColor(5, *BLUE)
        self.assertGreater(difference(view.picture(), before), 1)

    def test_no_structure_array_is_said(self):
        view, mapper = slabs(StructureColors=0.5)
        mapper.SetInputArrayToProcess(3, 0, 0, POINTS, "")
        self.assert_says(view, "StructureColors is 0.5", "Choose StructureArray")
        self.assert_middle(view, composed(OWN, OWN))

    def test_a_color_of_no_structure_is_said(self):
        view, mapper = slabs(StructureColors=1)
        mapper.AddLabelColor(2, *GREEN)
        mapper.AddLabelColor(7, *GREEN)
        mapper.AddLabelColor(9, *GREEN)
        self.assert_says(view, "not in Structures", "7, 9.")

    def test_impossible_colors_leave_the_picture_without(self):
        for rows, *words in (
                ([(2, 0, 1.5, 0)], "label 2", "is 1.5"),
                ([(2, 0, -0.5, 0)], "label 2", "is -0.5"),
                ([(2, 0, math.nan, 0)], "label 2", "is nan"),
                ([(math.nan, 0, 1, 0)], "is nan", "whole numbers"),
                ([(2.5, 0, 1, 0)], "is 2.5", "whole numbers"),
                ([(2, 0, 1, 0), (2, 1, 0, 0)], "Two rows", "label 2")):
            with self.subTest(rows=rows):
                view, mapper = slabs(StructureColors=1)
                for row in rows:
                    mapper.AddLabelColor(*row)
                self.assert_says(view, *words, "drawn without colors of structures")
                self.assert_middle(view, composed(OWN, OWN))
                mapper.SetStructureColors(0)
                view.messages.clear()
                self.assert_middle(view, composed(OWN, OWN))
                self.assert_fine(view)

    def test_a_row_has_four_numbers(self):
        mapper = Mapper()
        for row in ((2,), (2, 0, 1), (2, 0, 1, 0, 1)):
            with self.assertRaises(TypeError):
                mapper.AddLabelColor(*row)
        self.assertEqual(mapper.GetNumberOfLabelColors(), 0)

    def test_impossible_shares_are_said(self):
        view, mapper = slabs()
        mapper.SetStructureColors(1.5)
        self.assertEqual(mapper.GetStructureColors(), 1)
        self.assertIn("StructureColors is 1.5", view.messages[0])
        view.messages.clear()
        mapper.SetStructureColors(math.nan)
        view.window.Render()
        self.assertTrue(any("StructureColors is nan" in message for message in view.messages),
                        view.messages)

    def test_values_that_are_no_labels_are_said(self):
        view, mapper = slabs(StructureColors=1)
        image = labelled((5,) * 9)
        halves = numpy_to_vtk(np.full(729, 2.5, np.float32), deep=1)
        halves.SetName("Structure")
        image.GetPointData().AddArray(halves)
        mapper.SetInputData(image)
        view.window.Render()
        self.assertTrue(any("drawn without colors of structures" in message
                            for message in view.messages), view.messages)
        self.assert_middle(view, composed(OWN, OWN))


if __name__ == "__main__":
    unittest.main()
