# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Images of which points or cells are blanked, that is, have a flag in the array vtkGhostType.

import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes
from vtkmodules.vtkFiltersCore import vtkPointDataToCellData

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer

from images import FilterTest, filter_on, phantom, values

POINTS, CELLS = 0, 1
CELL_FLAGS = (vtkDataSetAttributes.HIDDENCELL, vtkDataSetAttributes.DUPLICATECELL,
              vtkDataSetAttributes.REFINEDCELL)


def optimizer(image, **properties):
    return filter_on(image, vtkExtinctionOptimizer, **{
        "CameraPosition": (4, 3, 2), "LightPosition": (-3, 4, 5), **properties})


def flag_points(image, points, flag):
    image.AllocatePointGhostArray()
    vtk_to_numpy(image.GetPointGhostArray())[points] = flag


def flag_cells(image, cells, flag):
    """Gives a flag to `cells`, a part of an array [z, y, x]."""
    image.AllocateCellGhostArray()
    shape = tuple(n - 1 for n in reversed(image.GetDimensions()))
    vtk_to_numpy(image.GetCellGhostArray()).reshape(shape)[cells] = flag
    return image


def add_array(owner, name, data):
    array = numpy_to_vtk(np.ascontiguousarray(data), deep=1)
    array.SetName(name)
    owner.AddArray(array)


def arrays_of(image):
    """Copies of all arrays of points, cells and field."""
    return {(owner.GetClassName(), i): vtk_to_numpy(owner.GetArray(i)).copy()
            for owner in (image.GetPointData(), image.GetCellData(), image.GetFieldData())
            for i in range(owner.GetNumberOfArrays())}


class TestInput(FilterTest):
    def test_is_not_changed(self):
        image = phantom(12)
        flag_points(image, slice(200), vtkDataSetAttributes.HIDDENPOINT)
        add_array(image.GetCellData(), "g", np.linspace(0, 1, 11 ** 3))
        flag_cells(image, np.s_[-1], vtkDataSetAttributes.HIDDENCELL)
        before = arrays_of(image)
        result = optimizer(image)
        result.SetInputArrayToProcess(1, 0, 0, CELLS, "g")
        scores = []
        for _ in range(2):
            result.Modified()
            result.Update()
            self.assert_no_error(result)
            scores.append(result.GetOutput().GetFieldData().GetArray("VisibilityScore").GetValue(0))

        after = arrays_of(image)
        self.assertEqual(before.keys(), after.keys())
        for key, data in before.items():
            np.testing.assert_array_equal(after[key], data)
        self.assertEqual(scores[0], scores[1])


def number(output, name):
    return output.GetFieldData().GetArray(name).GetValue(0)


class TestBlankedParts(FilterTest):
    """A block in the middle of an image, which hides something, against the image without it."""

    POINTS = np.s_[5:12, 6:13, 4:9]   # z, y, x
    CELLS = np.s_[5:11, 6:12, 4:8]

    def run_filter(self, image, association):
        result = optimizer(image)
        result.SetInputArrayToProcess(1, 0, 0, association, "Importance")
        result.SetInputArrayToProcess(2, 0, 0, association, "BaseExtinction")
        result.Update()
        self.assert_no_error(result)
        return result.GetOutput()

    def point_image(self):
        return phantom(16)

    def cell_image(self):
        average = vtkPointDataToCellData()
        average.SetInputData(phantom(17))
        average.Update()
        return average.GetOutput()

    def without(self, image, owner, part):
        for name in ("BaseExtinction", "Importance"):
            shape = tuple(n - (owner == "CellData") for n in reversed(image.GetDimensions()))
            array = getattr(image, "Get" + owner)().GetArray(name)
            vtk_to_numpy(array).reshape(shape)[part] = 0
        return image

    def assert_same(self, blanked, without, tolerance):
        for name in ("VisibilityScore", "BaseVisibilityScore", "Energy"):
            self.assertAlmostEqual(number(blanked, name) / number(without, name), 1,
                                   delta=tolerance, msg=name)
        for name in ("Extinction", "BaseExtinction", "Importance"):
            np.testing.assert_allclose(values(blanked, name), values(without, name),
                                       atol=tolerance * values(without, name).max())

    def test_points_are_empty(self):
        without = self.run_filter(self.without(self.point_image(), "PointData", self.POINTS), POINTS)
        for flag in (vtkDataSetAttributes.HIDDENPOINT, vtkDataSetAttributes.DUPLICATEPOINT):
            with self.subTest(flag=flag):
                image = self.point_image()
                flag_points(image, slice(0), 0)
                vtk_to_numpy(image.GetPointGhostArray()).reshape(16, 16, 16)[self.POINTS] = flag
                self.assert_same(self.run_filter(image, POINTS), without, 0)

    def test_cells_of_points_are_empty_where_their_points_are(self):
        without = self.run_filter(self.without(self.point_image(), "PointData", self.POINTS), POINTS)
        for flag in CELL_FLAGS:
            with self.subTest(flag=flag):
                image = flag_cells(self.point_image(), self.CELLS, flag)
                values(image, "BaseExtinction").reshape(16, 16, 16)[7, 8, 6] = np.nan
                self.assert_same(self.run_filter(image, POINTS), without, 0)

    def test_cells_of_cell_arrays_are_samples_without_a_value(self):
        without = self.run_filter(self.without(self.cell_image(), "CellData", self.CELLS), CELLS)
        for flag in CELL_FLAGS:
            with self.subTest(flag=flag):
                image = flag_cells(self.cell_image(), self.CELLS, flag)
                # The mean of the others times their share is rounded, the mean with zeros is not.
                self.assert_same(self.run_filter(image, CELLS), without, 1e-5)

    def test_other_flags_blank_nothing(self):
        plain = self.run_filter(self.point_image(), POINTS)
        image = flag_cells(self.point_image(), self.CELLS, vtkDataSetAttributes.EXTERIORCELL)

        self.assert_same(self.run_filter(image, POINTS), plain, 0)


class TestFlagsThatAreNone(FilterTest):
    def test_are_refused_with_their_numbers(self):
        for owner, count, what in (("PointData", 1728, "points"), ("CellData", 1331, "cells")):
            for flags, tuples, type_ in (
                    (np.zeros(100, np.uint8), "100 tuples of 1 component", "unsigned char"),
                    (np.zeros((count, 2), np.uint8), f"{count} tuples of 2", "unsigned char"),
                    (np.zeros(count, np.float32), f"{count} tuples of 1 component", "float")):
                with self.subTest(owner=owner, tuples=tuples, type=type_):
                    image = phantom(12)
                    add_array(getattr(image, "Get" + owner)(), "vtkGhostType", flags)
                    self.assert_refuses('"vtkGhostType"', tuples, type_, f"for {count} {what}",
                                        filter_=optimizer(image))


if __name__ == "__main__":
    unittest.main()
