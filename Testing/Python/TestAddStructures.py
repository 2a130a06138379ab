# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Labels of one image at the points of another one, names from tables, and what is said about both.

import os
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkBitArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

from limpid.vtkLimpidFilters import vtkAddStructures

from images import (FilterTest, PartOf, abort_at_every_event, blocks_of, catching, image_of,
                    memory_limited_to, values, with_input)

POINTS, CELLS = vtkDataObject.FIELD_ASSOCIATION_POINTS, vtkDataObject.FIELD_ASSOCIATION_CELLS
GAPS = [0, 3, 1034, 65535]


def grid(shape, spacing=(1, 1, 1), origin=(0, 0, 0), turned=0, on_cells=False, **arrays):
    """An image, turned by an angle about an oblique axis, with arrays indexed [x, y, z]."""
    image = image_of(shape, spacing, origin)
    if turned:
        image.SetDirectionMatrix(rotation(turned).ravel())
    data = image.GetCellData() if on_cells else image.GetPointData()
    for name, array in arrays.items():
        array = numpy_to_vtk(np.asarray(array).ravel(order="F"), deep=1)
        array.SetName(name)
        data.AddArray(array)
    return image


def rotation(degrees):
    """About the axis (1, 2, 2) / 3, by the formula of Rodrigues."""
    x, y, z = np.array([1, 2, 2]) / 3
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def placement(image):
    """Position of the point (0, 0, 0), and columns that lead to the next points."""
    direction = image.GetDirectionMatrix()
    matrix = np.array([[direction.GetElement(i, j) for j in range(3)] for i in range(3)])
    return np.array(image.GetOrigin()), matrix * np.array(image.GetSpacing())


def positions(image):
    """World positions of the points, the first axis fastest."""
    origin, axes = placement(image)
    bounds = np.array(image.GetExtent()).reshape(3, 2)
    index = np.stack(np.meshgrid(*[np.arange(first, last + 1) for first, last in bounds],
                                 indexing="ij"), axis=-1)
    return origin + index.reshape(-1, 3, order="F") @ axes.T


def structures_at(world):
    """Labels of two balls, one in the other, and a half space."""
    labels = np.where(world @ [0.6, 0.0, 0.8] > 9, 1034, 0)
    labels[np.linalg.norm(world - [6, 7, 5], axis=-1) < 5] = 3
    labels[np.linalg.norm(world - [6, 7, 5], axis=-1) < 2.5] = 65535
    return labels


def samples(labels_image, labels, world):
    """The label of the nearest sample at each world position, and whether it is in their box."""
    origin, axes = placement(labels_image)
    index = np.floor((world - origin) @ np.linalg.inv(axes).T + 0.5).astype(int)
    inside = ((index >= 0) & (index < labels.shape)).all(axis=-1)
    return np.where(inside, labels[tuple(np.clip(index, 0, np.array(labels.shape) - 1).T)], 0), inside


def majority(image, labels_image, labels):
    """The rule of vtkAddStructures, point by point."""
    world = positions(image)
    nearest, inside = samples(labels_image, labels, world)
    _, axes = placement(image)
    lengths = np.linalg.norm(np.linalg.inv(placement(labels_image)[1]) @ axes, axis=0)
    counts = [1 if length < 1 - 1e-6 else min(8, int(np.ceil(2 * length - 1e-6)))
              for length in lengths]
    lattice = np.stack(np.meshgrid(*[(np.arange(n) + 0.5) / n - 0.5 for n in counts]), -1)
    votes = {label: np.zeros(len(world), int) for label in np.unique(labels)}
    for offset in lattice.reshape(-1, 3) @ axes.T:
        found, valid = samples(labels_image, labels, world + offset)
        for label, count in votes.items():
            count += valid & (found == label)
    most = np.max(list(votes.values()), axis=0)
    result = np.zeros(len(world), int)
    for label in sorted(votes, key=lambda label: (label != 0, -label)):  # 0, then the smallest last
        result[votes[label] == most] = label
    for label, count in votes.items():
        result[(nearest == label) & (count == most)] = label
    return np.where(inside, result, 0)


def filter_of(image, structures, name=None, on_cells=False, **properties):
    result = vtkAddStructures()
    result.SetInputDataObject(0, image)
    result.SetInputDataObject(1, structures)
    if name:
        result.SetInputArrayToProcess(0, 1, 0, CELLS if on_cells else POINTS, name)
    for key, value in properties.items():
        getattr(result, "Set" + key)(value)
    return catching(result)


class StructureTest(FilterTest):
    def run_filter(self, *arguments, warnings=0, **keywords):
        result = filter_of(*arguments, **keywords)
        result.Update()
        self.assert_no_error(result)
        self.assertEqual(len(result.messages["WarningEvent"]), warnings, result.messages)
        return result

    def found(self, *arguments, **keywords):
        """The labels that the filter adds, the first axis fastest."""
        return values(self.run_filter(*arguments, **keywords).GetOutput(), "Structure")

    def rows(self, result):
        table = result.GetStructureTable()
        columns = [table.GetColumn(i) for i in range(3)]
        self.assertEqual([column.GetName() for column in columns], ["Label", "Name", "Points"])
        return [tuple(column.GetValue(row) for column in columns)
                for row in range(table.GetNumberOfRows())]


class TestTheSameGrid(StructureTest):
    def test_keeps_labels_and_their_type(self):
        for number, kind in enumerate((np.uint8, np.int8, np.uint16, np.int16, np.uint32, np.int32,
                                       np.int64, np.uint64)):
            labels = np.random.default_rng(number).choice(GAPS, (7, 5, 6)).astype(kind)
            for resampling in (vtkAddStructures.MAJORITY, vtkAddStructures.NEAREST):
                with self.subTest(kind=kind, resampling=resampling):
                    image = grid((7, 5, 6), (0.3, 0.7, 1.1), (-5, 3, 1e4), 40, L=labels)
                    found = self.found(image, image, Resampling=resampling)

                    self.assertEqual(found.dtype, kind)
                    np.testing.assert_array_equal(found, labels.ravel(order="F"))

    def test_turns_whole_numbers_into_int(self):
        labels = np.random.default_rng(1).choice(GAPS + [-2], (7, 5, 6))
        for kind in (np.float32, np.float64):
            given = labels.astype(kind)
            given[labels == 0] = np.nan
            found = self.found(grid((7, 5, 6)), grid((7, 5, 6), L=given))

            self.assertEqual(found.dtype, np.int32)
            np.testing.assert_array_equal(found, labels.ravel(order="F"))

    def test_takes_bits(self):
        bits = vtkBitArray()
        bits.SetName("L")
        labels = np.random.default_rng(6).integers(0, 2, 7 * 5 * 6)
        for label in labels:
            bits.InsertNextValue(label)
        image = grid((7, 5, 6))
        image.GetPointData().AddArray(bits)

        np.testing.assert_array_equal(self.found(image, image), labels)

    def test_may_be_a_plane_or_have_an_extent(self):
        labels = np.random.default_rng(2).choice(GAPS, (7, 5, 1))
        np.testing.assert_array_equal(
            self.found(grid((7, 5, 1)), grid((7, 5, 1), L=labels)), labels.ravel(order="F"))
        part = grid((4, 5, 6), L=np.random.default_rng(3).choice(GAPS, (4, 5, 6)))
        part.SetExtent(3, 6, -2, 2, 10, 15)
        np.testing.assert_array_equal(self.found(part, part), values(part, "L"))

    def test_passes_the_arrays_of_the_input(self):
        image = grid((4, 4, 4), density=np.arange(64).reshape(4, 4, 4))
        image.GetPointData().SetActiveScalars("density")
        output = self.run_filter(image, grid((4, 4, 4), L=np.ones((4, 4, 4), int))).GetOutput()

        np.testing.assert_array_equal(values(output, "density"), values(image, "density"))
        self.assertEqual(output.GetPointData().GetScalars().GetName(), "density")

    def test_of_cells_is_the_majority_around_a_point(self):
        labels = np.random.default_rng(4).choice(GAPS, (6, 4, 5))
        image = grid((7, 5, 6), (0.5, 1, 2), turned=20, on_cells=True, L=labels)
        found = self.found(image, image).reshape((7, 5, 6), order="F")

        for point in np.ndindex(*found.shape):
            around = labels[tuple(slice(max(i - 1, 0), i + 1) for i in point)].ravel()
            nearest = labels[tuple(min(i, n - 1) for i, n in zip(point, labels.shape))]
            number = {label: np.count_nonzero(around == label) for label in around}
            best = max(number, key=lambda label: (number[label], label == nearest, label != 0,
                                                  -label))
            self.assertEqual(found[point], best, point)


class TestOtherGrids(StructureTest):
    def structures(self, shape, *placed, **keywords):
        image = grid(shape, *placed, **keywords)
        labels = structures_at(positions(image)).reshape(shape, order="F")
        return grid(shape, *placed, L=labels, **keywords), labels

    def check(self, image, labels_image, labels):
        expected = majority(image, labels_image, labels)
        self.assertEqual(set(np.unique(expected)), set(GAPS))
        wrong = np.mean(self.found(image, labels_image) != expected)
        self.assertLessEqual(wrong, 0.005)  # rounding moves positions between two samples

    def test_that_are_turned_and_finer_have_the_majority(self):
        self.check(grid((14, 15, 12)), *self.structures(
            (34, 36, 30), (0.6, 0.45, 0.7), (-3.5, -2.8, -2.7), turned=30))

    def test_that_are_much_finer_have_the_majority(self):
        self.check(grid((5, 6, 4), (2.9, 2.9, 3.5)), *self.structures(
            (80, 100, 60), (0.3, 0.2, 0.4), (-5.9, -5, -4.3), turned=30))

    def test_that_are_flipped_have_the_majority(self):
        self.check(grid((14, 15, 12), (1, 1.2, 0.9), (-1, -1, 0)), *self.structures(
            (23, 31, 25), (-0.7, 0.55, -0.5), (14, -2, 11)))

    def test_that_are_coarser_have_the_nearest(self):
        labels_image, labels = self.structures((16, 18, 14), (1.3, 1.1, 1.25), (-2.4, -4.1, -1), turned=30)
        image = grid((22, 25, 20), (0.6, 0.6, 0.6))
        expected, _ = samples(labels_image, labels, positions(image))
        for resampling in (vtkAddStructures.MAJORITY, vtkAddStructures.NEAREST):
            found = self.found(image, labels_image, Resampling=resampling)
            np.testing.assert_array_equal(found, expected)

    def test_by_nearest_have_no_other_label_away_from_borders(self):
        labels_image, labels = self.structures(
            (34, 36, 30), (0.6, 0.45, 0.7), (-5.5, -4.8, -4.2), turned=30)
        image = grid((10, 11, 9))
        world = positions(image)
        _, inside = samples(labels_image, labels, world)
        found = self.found(image, labels_image, Resampling=vtkAddStructures.NEAREST)
        # A sample is at most half a diagonal of its box away, 0.52; between these steps, a ball
        # bulges by less than 0.04.
        steps = 0.56 * (np.array(list(np.ndindex(3, 3, 3))) - 1)
        sure = np.all([structures_at(world + step) == structures_at(world) for step in steps] +
                      [inside], axis=0)

        self.assertGreater(np.mean(sure), 0.5)
        np.testing.assert_array_equal(found[sure], structures_at(world)[sure])

    def test_end_half_a_sample_beyond_the_outermost(self):
        labels = np.full((2, 2, 2), 7)
        row = grid((41, 1, 1), (0.1, 1, 1), (-1.5, 0.5, 0.5))
        on_points = self.found(row, grid((2, 2, 2), L=labels))
        on_cells = self.found(row, grid((3, 3, 3), on_cells=True, L=labels))

        x = np.arange(-15, 26) / 10
        np.testing.assert_array_equal(on_points, np.where((x >= -0.5) & (x <= 1.5), 7, 0))
        np.testing.assert_array_equal(on_cells, np.where((x >= 0) & (x <= 2), 7, 0))

    def test_may_be_thin(self):
        sheet = grid((9, 9, 1), (1, 1, 0.1), (0, 0, 4), L=np.full((9, 9, 1), 5))
        found = self.found(grid((9, 9, 9)), sheet).reshape((9, 9, 9), order="F")

        np.testing.assert_array_equal(np.flatnonzero(found.max(axis=(0, 1))), [4])

    def test_that_are_between_labels_make_none_up(self):
        labels = np.where(np.arange(20) < 10, 1, 3)[:, None, None] * np.ones((20, 6, 6), int)
        found = self.found(grid((8, 5, 5), (2.3, 1, 1)), grid((20, 6, 6), L=labels))

        self.assertEqual(set(np.unique(found)), {1, 3})


class TestArrays(StructureTest):
    def image(self):
        image = grid((4, 4, 4), first=np.full((4, 4, 4), 1), second=np.full((4, 4, 4), 2))
        cells = grid((4, 4, 4), on_cells=True, third=np.full((3, 3, 3), 3))
        image.GetCellData().ShallowCopy(cells.GetCellData())
        return image

    def test_that_are_chosen_are_used(self):
        image = self.image()
        for name, on_cells, label in (("first", False, 1), ("second", False, 2), ("third", True, 3)):
            self.assertEqual(set(self.found(image, image, name, on_cells)), {label})

    def test_are_by_default_the_scalars_or_the_first(self):
        image = self.image()
        self.assertEqual(set(self.found(image, image)), {1})
        image.GetCellData().SetActiveScalars("third")
        self.assertEqual(set(self.found(image, image)), {3})
        image.GetPointData().SetActiveScalars("second")
        self.assertEqual(set(self.found(image, image)), {2})


class TestMasks(StructureTest):
    def masks(self):
        masks = np.zeros((3, 6, 5, 4))
        masks[0, :3], masks[1, 2:5], masks[2, 5, :2] = 1, 0.6, 1
        masks[1, 5] = 0.5  # not above
        return masks

    def test_become_labels_in_their_order(self):
        masks = self.masks()
        image = grid((6, 5, 4), liver=masks[0].astype(int) * 255, spleen=masks[1],
                     empty=np.zeros((6, 5, 4), np.int8), tumour=masks[2].astype(np.float32))
        result = self.run_filter(image, image, MasksToLabels=True, warnings=1)
        expected = np.zeros((6, 5, 4))
        expected[:2], expected[2:5], expected[5, :2] = 1, 2, 4

        found = values(result.GetOutput(), "Structure")
        self.assertEqual(found.dtype, np.uint16)
        np.testing.assert_array_equal(found, expected.ravel(order="F"))
        self.assertIn("overlap at 20 points", result.messages["WarningEvent"][0])
        self.assertEqual(self.rows(result), [(1, "liver", 40), (2, "spleen", 60), (3, "empty", 0),
                                             (4, "tumour", 8)])

    def test_may_be_components(self):
        masks = self.masks()
        masks[1, 2] = 0
        array = numpy_to_vtk(np.stack([mask.ravel(order="F") for mask in masks], -1), deep=1)
        array.SetName("masks")
        array.SetComponentName(1, "spleen")
        image = grid((6, 5, 4), other=np.ones((6, 5, 4)))
        image.GetPointData().AddArray(array)
        result = self.run_filter(image, image, "masks")

        self.assertEqual(self.rows(result), [(1, "masks_0", 60), (2, "spleen", 40), (3, "masks_2", 8)])

    def test_may_be_on_cells(self):
        masks = self.masks()[:, :, :, :3]
        image = grid((7, 6, 4), on_cells=True, a=masks[0], b=masks[2])
        result = self.run_filter(grid((6, 5, 3), origin=(0.5, 0.5, 0.5)), image, MasksToLabels=True)

        self.assertEqual(self.rows(result), [(1, "a", 45), (2, "b", 6)])


class TestTableFiles(StructureTest):
    def run_with(self, text, **keywords):
        labels = np.repeat(GAPS, 16).reshape(4, 4, 4, order="F")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "table")
            with open(path, "wb") as file:
                file.write(text if isinstance(text, bytes) else text.encode())
            image = grid((4, 4, 4), L=labels)
            return self.run_filter(image, image, TableFile=path, **keywords)

    def names(self, text, **keywords):
        return [name for _, name, _ in self.rows(self.run_with(text, **keywords))]

    def test_may_be_left_out(self):
        self.assertEqual(self.rows(self.run_with("3,a\n")), [(3, "a", 16), (1034, "", 16),
                                                            (65535, "", 16)])

    def test_of_columns_give_names(self):
        for text in ("3,left kidney,7\n1034,b\n65535,c\n",
                     "label,name,voxels\n3,left kidney,9\n1034,b,8\n65535,c,7\n",
                     "Name;Color;Label\nleft kidney;red;3\nb;;1034\nc;x;65535\n",
                     "\ufeffLabelValue\tSegment\r\n3\tleft kidney\r\n\r\n1034\tb\r\n65535\tc\r\n",
                     '# of today\n"3","left kidney"\n1034, b\n 65535 ,"c"'):
            with self.subTest(text):
                self.assertEqual(self.names(text), ["left kidney", "b", "c"])
        self.assertEqual(self.names('3,"a, ""b"""\n'), ['a, "b"', "", ""])

    def test_of_freesurfer_give_names(self):
        self.assertEqual(self.names(
            "#No. Label Name:   R   G   B   A\n\n0   Unknown   0 0 0 0\n"
            "3   Left-Cerebral-Cortex  205 62 78 0\n1034\t3rd-Ventricle\t25 10 0 0\n65535 plain\n"),
            ["Left-Cerebral-Cortex", "3rd-Ventricle", "plain"])

    def test_may_be_in_latin_1(self):
        self.assertEqual(self.names("3 Léon\n1034 b\n65535 c\n".encode("latin-1")), ["Léon", "b", "c"])

    def colors(self, text):
        table = self.run_with(text).GetStructureTable()
        return np.transpose([vtk_to_numpy(table.GetColumnByName(name))
                             for name in ("Red", "Green", "Blue")])

    def test_give_colors(self):
        none = [np.nan] * 3
        np.testing.assert_allclose(
            self.colors("3 a 255 51 0 0\n1034 b 0 0 256 0\n65535 plain\n"), [[1, 0.2, 0], none, none])
        np.testing.assert_allclose(
            self.colors('3 0 0 255 1 1 1 "a"\n1034 0 255 0 0.5 1 1 "b"\n'),
            [[0, 0, 1], [0, 1, 0], none])
        self.assertIsNone(self.run_with("3,a\n").GetStructureTable().GetColumnByName("Red"))

    def test_of_itk_snap_give_names(self):
        self.assertEqual(self.names(
            '# ITK-SnAP Label Description File\n    0     0    0    0        0  0  0    "Clear Label"\n'
            '    3   255    0    0        1  1  0    "Left kidney, upper"\n'
            ' 1034   0 255 0  0.5 1 1 "b"\n65535 0 0 255 1 1 1 ""\n'), ["Left kidney, upper", "b", ""])

    def test_name_masks(self):
        image = grid((4, 4, 4), a=np.ones((4, 4, 4)), b=np.zeros((4, 4, 4)))
        with tempfile.NamedTemporaryFile("w") as file:
            file.write("2,liver\n")
            file.flush()
            result = self.run_filter(image, image, MasksToLabels=True, TableFile=file.name)

        self.assertEqual(self.rows(result), [(1, "a", 64), (2, "liver", 0)])

    def warning(self, text, expected):
        result = self.run_with(text, warnings=1)
        self.assertEqual(self.rows(result), [(3, expected, 16), (1034, "", 16), (65535, "", 16)])
        return result.messages["WarningEvent"][0]

    def test_with_unreadable_rows_give_the_other_names(self):
        self.assertIn('has 2 rows that cannot be read, the first is line 2, "liver,1034" (',
                      self.warning("3,a\nliver,1034\nalso this\n", "a"))
        self.assertIn('has 1 rows that cannot be read, the first is line 1, "a,3" (',
                      self.warning("a,3\n3,b\n", "b"))

    def test_that_are_none_keep_the_labels(self):
        self.assertIn("has no row that can be read (", self.warning("", ""))
        self.assertIn('the first is line 1, "????', self.warning(bytes(range(128, 256)), ""))

    def test_of_other_labels_are_told(self):
        self.assertIn("names 2 labels, and none of them is in the data", self.warning("1,a\n2,b\n", ""))

    def test_that_are_missing_keep_the_labels(self):
        image = grid((4, 4, 4), L=np.full((4, 4, 4), 3))
        for path in ("/nowhere/labels.csv", tempfile.gettempdir()):
            result = self.run_filter(image, image, TableFile=path, warnings=1)

            self.assertIn(f'The table file "{path}" cannot be opened',
                          result.messages["WarningEvent"][0])
            self.assertEqual(self.rows(result), [(3, "", 64)])


class TestMessages(StructureTest):
    def refuses(self, words, image, structures, *arguments, **keywords):
        result = filter_of(image, structures, *arguments, **keywords)
        self.assert_refuses(words, filter_=result)
        self.assertEqual(result.GetStructureTable().GetNumberOfRows(), 0)

    def test_name_inputs_that_are_no_images(self):
        image = grid((4, 4, 4), L=np.ones((4, 4, 4), int))
        for other, advice in ((vtkPolyData(), "Resample To Image"), (blocks_of(image), "Merge Blocks")):
            self.assert_refuses("The input is a " + other.GetClassName(), advice,
                                filter_=filter_of(other, image))
            self.assert_refuses("The input Structures is a " + other.GetClassName(), advice,
                                filter_=filter_of(image, other))
        self.refuses("The input has no points", vtkImageData(), image)
        self.refuses("The input Structures has no points", image, vtkImageData())

    def test_name_values_that_are_no_labels(self):
        for wrong in (2.5, np.inf, 2.0 ** 31):
            labels = np.full((4, 4, 4), 2.0)
            labels[1, 2, 3] = wrong
            self.refuses(f'The label array "L" has the value {wrong:g}', grid((4, 4, 4)),
                         grid((4, 4, 4), L=labels))

    def test_name_arrays_that_are_missing(self):
        image = grid((4, 4, 4), L=np.ones((4, 4, 4), int))
        self.refuses('The label array "M" is not among', image, image, "M")
        self.refuses('The label array "L" is not among', image, image, "L", on_cells=True)
        self.refuses("The structures have no numeric arrays", image, grid((4, 4, 4)))
        self.refuses("The structures have no numeric arrays", image, grid((4, 4, 4)),
                     MasksToLabels=True)

    def test_name_masks_of_two_kinds(self):
        image = grid((4, 4, 4), a=np.ones((4, 4, 4)))
        cells = grid((4, 4, 4), on_cells=True, b=np.ones((3, 3, 3)))
        image.GetCellData().ShallowCopy(cells.GetCellData())
        self.refuses("There are masks of points and masks of cells", image, image, MasksToLabels=True)

    def test_name_arrays_of_another_size(self):
        short = grid((4, 4, 4), L=np.ones(60, int))
        self.refuses('The array "L" has 60 values for 64 points', grid((4, 4, 4)), short)
        self.refuses('The array "L" has 60 values for 64 points', grid((4, 4, 4)), short,
                     MasksToLabels=True)

    def test_name_the_image_that_has_no_place(self):
        image = grid((4, 4, 4), L=np.ones((4, 4, 4), int))
        flat = grid((4, 4, 4), (1, 0, 1), L=np.ones((4, 4, 4), int))
        self.refuses("The structures cannot be placed. The spacing along axis 1 is 0", image, flat)
        self.refuses("The spacing along axis 1 is 0", flat, image)

    def test_warn_of_images_that_do_not_meet(self):
        far = grid((4, 4, 4), origin=(100, 0, 0), L=np.full((4, 4, 4), 3))
        result = self.run_filter(grid((4, 4, 4)), far, warnings=1)
        self.assertIn("No point of the input is in a structure", result.messages["WarningEvent"][0])
        self.assertEqual(self.rows(result), [(3, "", 0)])

    def test_warn_of_labels_that_are_all_zero(self):
        image = grid((4, 4, 4), L=np.zeros((4, 4, 4), int))
        result = self.run_filter(image, image, warnings=1)
        self.assertIn("All labels are 0", result.messages["WarningEvent"][0])
        self.assertEqual(self.rows(result), [])

    def test_warn_of_an_array_that_is_replaced(self):
        image = grid((4, 4, 4), Structure=np.ones((4, 4, 4)))
        labels = grid((4, 4, 4), L=np.full((4, 4, 4), 2))
        result = self.run_filter(image, labels, warnings=1)
        self.assertIn('The input has an array "Structure"', result.messages["WarningEvent"][0])
        again = self.run_filter(result.GetOutput(), labels)  # it is the filter's own
        self.assertEqual(set(values(again.GetOutput(), "Structure")), {2})

    def test_say_how_much_memory_is_missing(self):
        small = grid((2, 2, 2), L=np.ones((2, 2, 2), int))
        result = filter_of(image_of((700, 700, 700)), small)
        with memory_limited_to(1 << 28):
            self.assert_refuses("There is not enough memory for 700 x 700 x 700 points",
                                filter_=result)


class TestRuns(StructureTest):
    def test_can_be_aborted(self):
        image = grid((40, 40, 40), L=np.ones((40, 40, 40), int))
        result = filter_of(image, image)
        sizes = []
        abort_at_every_event(result, lambda: sizes.append(
            (result.GetOutput().GetNumberOfPoints(), result.GetStructureTable().GetNumberOfRows())))

        self.assertEqual(set(sizes), {(0, 0), (64000, 1)})
        self.assertEqual(sizes[0], (0, 0))
        self.assertEqual(sizes[-1], (64000, 1))
        self.assert_no_error(result)

    def test_make_progress(self):
        image = grid((300, 300, 100), L=np.ones((300, 300, 100), np.uint8))
        result = filter_of(image, image)
        seen = []
        result.AddObserver("ProgressEvent", lambda *_: seen.append(result.GetProgress()))
        result.Update()

        self.assertEqual(seen, sorted(seen))
        self.assertEqual(seen[-1], 1)

    def test_of_pieces_give_pieces(self):
        labels = np.random.default_rng(5).choice(GAPS, (8, 7, 6))
        image = grid((8, 7, 6), L=labels)
        part = with_input(filter_of(image, image), PartOf(image, (2, 5, 0, 6, 3, 5)))
        part.Update()

        self.assertEqual(part.GetOutput().GetExtent(), (2, 5, 0, 6, 3, 5))
        np.testing.assert_array_equal(values(part.GetOutput(), "Structure"),
                                      labels[2:6, :, 3:].ravel(order="F"))

    def test_of_the_table_alone_count_all_points(self):
        image = grid((4, 4, 4), L=np.full((4, 4, 4), 9))
        result = filter_of(image, image)
        result.Update(1)

        self.assertEqual(self.rows(result), [(9, "", 64)])


class TestAbdomen(StructureTest):
    def read(self, name):
        path = os.path.join(os.environ.get("LIMPID_TEST_DATA", ""), "structures", name)
        if not os.path.exists(path):
            self.skipTest(f"structures/{name} is not here: set LIMPID_TEST_DATA")
        reader = vtkXMLImageDataReader()
        reader.SetFileName(path)
        reader.Update()
        return reader.GetOutput()

    def test_has_the_labels_and_names_of_its_segmentation(self):
        labels = self.read("abdomen_labels.vti")
        table = os.path.join(os.environ["LIMPID_TEST_DATA"], "structures", "abdomen_labels.csv")
        result = self.run_filter(self.read("abdomen_ct.vti"), labels, TableFile=table)
        with open(table) as file:
            expected = [line.strip().split(",") for line in file][1:]

        np.testing.assert_array_equal(values(result.GetOutput(), "Structure"),
                                      vtk_to_numpy(labels.GetPointData().GetArray(0)))
        self.assertEqual([tuple(map(str, row)) for row in self.rows(result)],
                         [tuple(row) for row in sorted(expected, key=lambda row: int(row[0]))])


if __name__ == "__main__":
    unittest.main()
