# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Volumes of NIfTI, NRRD and MetaImage: values, places and names, and what is said about files that
# cannot be read. The tests write the files.

import os
import re
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

from limpid.vtkLimpidFilters import vtkAddStructures, vtkSegmentationReader

from image_files import (bytes_of, color_of, in_order, segments, write_meta, write_nifti,
                         write_nifti2, write_nrrd)
from images import FilterTest, catching, image_of, values

SHAPE = (5, 4, 3)
TO_LEFT = np.diag([-1.0, -1.0, 1.0])  # from right, front, head to left, back, head


def rotation(degrees, axis=(1, 2, 2)):
    """By the formula of Rodrigues."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def placed(direction, spacing=(0.5, 0.75, 2), origin=(10, -20, 30)):
    return np.column_stack([direction * np.array(spacing), origin])


OBLIQUE = placed(rotation(40))
PLACEMENTS = {"along the axes": placed(np.eye(3)), "oblique": OBLIQUE,
              "left-handed": placed(rotation(-70) @ np.diag([1, -1, 1])),
              "exchanged": placed(np.eye(3)[:, [2, 0, 1]])}


def placement(image):
    direction = image.GetDirectionMatrix()
    matrix = np.array([[direction.GetElement(i, j) for j in range(3)] for i in range(3)])
    return np.column_stack([matrix * np.array(image.GetSpacing()), image.GetOrigin()])


def counted(kind="int16", shape=SHAPE):
    return np.arange(np.prod(shape)).reshape(shape).astype(kind)


class ReaderTest(FilterTest):
    def content(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def reader(self, name, **properties):
        reader = vtkSegmentationReader()
        reader.SetFileName(self.path(name))
        for key, value in properties.items():
            getattr(reader, "Set" + key)(value)
        return catching(reader)

    def read(self, name, warnings=0, **properties):
        reader = self.reader(name, **properties)
        reader.Update()
        self.assert_no_error(reader)
        self.assertEqual(len(reader.messages["WarningEvent"]), warnings, reader.messages)
        self.messages = reader.messages["WarningEvent"]
        return reader.GetOutput()

    def expect(self, name, expected, matrix, rounding=0, **properties):
        image = self.read(name, **properties)
        expected, matrix = in_order(expected, matrix)
        self.assertEqual(image.GetDimensions(), expected.shape)
        found = values(image, "Values")
        np.testing.assert_array_equal(found, expected.ravel(order="F"))
        self.assertEqual(found.dtype, expected.dtype)
        # Headers of NIfTI have single precision: 2^-24 of the largest entry, 30.
        np.testing.assert_allclose(placement(image), matrix, rtol=0, atol=4e-6 + rounding)
        return image


class TestPlacements(ReaderTest):
    def test_of_all_formats_are_one(self):
        data = counted()
        for what, matrix in PLACEMENTS.items():
            with self.subTest(what):
                ras = TO_LEFT @ matrix
                write_nifti(self.path("a.nii.gz"), data, ras)
                write_nifti2(self.path("b.nii"), data, ras)
                write_nrrd(self.path("c.nrrd"), data, matrix)
                write_nrrd(self.path("d.nrrd"), data, ras, space="RAS", encoding="raw")
                write_nrrd(self.path("e.nrrd"), data, np.diag([1, -1, 1]) @ matrix, space="LAS")
                write_meta(self.path("f.mha"), data, matrix)
                for name in ("a.nii.gz", "b.nii", "c.nrrd", "d.nrrd", "e.nrrd", "f.mha"):
                    self.expect(name, data, matrix)

    def test_by_quaternion(self):
        half = np.radians(20)
        b, c, d = np.sin(half) * np.array([1, 2, 2]) / 3
        for qfac in (1, -1):
            matrix = placed(rotation(40) @ np.diag([1, 1, qfac]))
            write_nifti(self.path("a.nii"), counted(), matrix, quaternion=(b, c, d, qfac))
            self.expect("a.nii", counted(), TO_LEFT @ matrix)

    def test_by_quaternion_where_the_other_is_sheared(self):
        sheared = np.array(placed(np.eye(3)))
        sheared[0, 1] = 0.5
        write_nifti(self.path("a.nii"), counted(), sheared, q=(252, "h", 1))
        found = placement(self.read("a.nii"))
        np.testing.assert_allclose(found[:, 0], [0.5, 0, 0], atol=1e-6)

    def test_without_any_are_steps_alone(self):
        write_nifti(self.path("a.nii"), counted(), OBLIQUE, s=(254, "h", 0))
        self.expect("a.nii", counted(), placed(np.eye(3), origin=(0, 0, 0)))
        self.write_text("b.nrrd", "NRRD0001\ntype: uint8\ndimension: 3\nsizes: 5 4 3\n"
                        "spacings: 1 2 3\nencoding: raw\n\n", counted("uint8"))
        self.expect("b.nrrd", counted("uint8"), placed(np.eye(3), (1, 2, 3), (0, 0, 0)))

    def test_along_the_axes_alone(self):
        head = "NRRD0004\ntype: uint8\ndimension: {}\nsizes: {}\nencoding: raw\n{}\n"
        for sizes, more, spacing, origin in (
                ("5 4 3", "spacings: 1 2 3\naxis mins: -4 5 6\n", (1, 2, 3), (-4, 5, 6)),
                ("5 4 3", "axismins: -4 5 6\naxismaxs: 4 11 12\n", (2, 2, 3), (-4, 5, 6)),
                ("5 4 3", "axis mins: -4 5 6\naxis maxs: 6 13 15\ncenterings: cell cell cell\n",
                 (2, 2, 3), (-3, 6, 7.5)),
                ("5 4 3", "spacings: nan 2 3\n", (1, 2, 3), (0, 0, 0)),
                ("5 4 3 1", "spacings: 1 2 3 nan\nkinds: domain domain domain time\n", (1, 2, 3), (0, 0, 0)),
                ("1 5 4 3", "spacings: NaN 1 2 3\n", (1, 2, 3), (0, 0, 0))):
            with self.subTest(more):
                self.write_text("b.nrrd", head.format(len(sizes.split()), sizes, more), counted("uint8"))
                self.expect("b.nrrd", counted("uint8"), placed(np.eye(3), spacing, origin))

    def test_with_one_time_step(self):
        write_nrrd(self.path("a.nrrd"), counted()[np.newaxis], OBLIQUE)
        self.expect("a.nrrd", counted(), OBLIQUE)
        direction, spacing = np.eye(4), (0.5, 0.75, 2, 40)
        direction[:3, :3] = rotation(40)
        words = {"NDims": [4], "DimSize": [5, 4, 3, 1], "ElementSpacing": spacing, "Offset": [10, -20, 30, 7],
                 "TransformMatrix": map(float, direction.T.ravel()), "ElementType": ["MET_UCHAR"],
                 "ElementDataFile": ["LOCAL"]}
        self.write_text("a.mha", "".join(f"{name} = {' '.join(map(str, words[name]))}\n" for name in words),
                        counted("uint8"))
        self.expect("a.mha", counted("uint8"), OBLIQUE)

    def write_text(self, name, text, data):
        with open(self.path(name), "wb") as file:
            file.write(text.encode() + bytes_of(data))

    def test_of_the_abdomen_are_those_of_its_other_file(self):
        stem = os.path.join(os.environ.get("LIMPID_TEST_DATA", ""), "structures", "abdomen_labels")
        if not os.path.isfile(stem + ".nii.gz"):
            self.skipTest("LIMPID_TEST_DATA has no structures")
        plain = vtkXMLImageDataReader()
        plain.SetFileName(stem + ".vti")
        plain.Update()
        image = plain.GetOutput()  # with the coordinates of NIfTI

        found = self.expect(stem + ".nii.gz", values(image, image.GetPointData().GetScalars().GetName())
                            .reshape(image.GetDimensions(), order="F"), TO_LEFT @ placement(image),
                            rounding=5e-4)  # of numbers with six digits
        names = found.GetFieldData().GetAbstractArray("StructureNames")
        self.assertEqual((names.GetNumberOfValues(), names.GetValue(0)), (117, "spleen"))


class TestVariants(ReaderTest):
    """Spellings of headers that other programs write, and read."""

    def rewrite(self, name, *pairs):
        with open(self.path(name), "rb") as file:
            data = file.read()
        for old, new in pairs:
            self.assertIn(old, data)
            data = data.replace(old, new, 1)
        with open(self.path(name), "wb") as file:
            file.write(data)

    def test_of_metaimage(self):
        swapped = counted("int16").byteswap()
        for more in ("BinaryDataByteOrderMSB = 1", "BinaryDataByteOrderMSB = T",
                     "\nElementByteOrderMSB = true"):
            write_meta(self.path("a.mha"), swapped, OBLIQUE, compressed=False, more=more)
            self.rewrite("a.mha", (b"BinaryDataByteOrderMSB = False\n", b""))
            self.expect("a.mha", counted("int16"), OBLIQUE)
        write_meta(self.path("a.mha"), counted(), OBLIQUE)
        self.rewrite("a.mha", (b"= LOCAL", b"= Local"),
                     (b"CompressedData = True", b"CompressedData = 1"))
        self.expect("a.mha", counted(), OBLIQUE)
        write_meta(self.path("a.mha"), counted(), OBLIQUE, compressed=False, more="BinaryData = False")
        self.assert_refuses("written as text", filter_=self.reader("a.mha"))

    def test_of_nifti(self):
        write_nifti(self.path("a.nii"), counted("int16"), OBLIQUE, offset=(108, "f", 0),
                    intercept=(116, "f", float("nan")))
        self.expect("a.nii", counted("int16"), TO_LEFT @ OBLIQUE)

    def test_with_something_behind_compressed_values(self):
        write_nifti(self.path("a.nii.gz"), counted(), OBLIQUE)
        for padding in (bytes(512), b"padding"):
            with open(self.path("a.nii.gz"), "ab") as file:
                file.write(padding)
            self.expect("a.nii.gz", counted(), TO_LEFT @ OBLIQUE)

    def test_with_gaps_in_the_numbers_of_segments(self):
        more = segments((1, "liver", 0), (2, "spleen", 0)).replace("Segment1_", "Segment7_")
        write_nrrd(self.path("a.seg.nrrd"), counted("uint8") % 3, OBLIQUE, more=more)
        names = self.read("a.seg.nrrd").GetFieldData().GetAbstractArray("StructureNames")
        self.assertEqual([names.GetValue(i) for i in range(names.GetNumberOfValues())],
                         ["liver", "spleen"])

    def test_of_names_in_xml(self):
        write_nifti(self.path("a.nii"), counted(), OBLIQUE, names={1: "A" * 25})
        old = b"<![CDATA[" + b"A" * 25 + b"]]>"
        self.rewrite("a.nii", (old, b"a &amp;amp; b &lt; &quot;c&quot;".ljust(len(old))))
        names = self.read("a.nii").GetFieldData().GetAbstractArray("StructureNames")
        self.assertEqual(names.GetValue(0).rstrip(), 'a &amp; b < "c"')


class TestValues(ReaderTest):
    def test_keep_their_type(self):
        for kind in ("uint8", "int8", "int16", "uint16", "int32", "uint32", "int64", "uint64",
                     "float32", "float64"):
            for order in "<>":
                with self.subTest(kind=kind, order=order):
                    write_nifti(self.path("a.nii"), counted(kind), OBLIQUE, order)
                    self.expect("a.nii", counted(kind), TO_LEFT @ OBLIQUE)

    def test_of_the_other_order_of_bytes(self):
        for encoding in ("raw", "gzip"):
            write_nrrd(self.path("a.nrrd"), counted(), OBLIQUE, encoding, order=">")
            self.expect("a.nrrd", counted(), OBLIQUE)

    def test_in_files_of_their_own(self):
        write_nrrd(self.path("a.nhdr"), counted(), OBLIQUE, data_file=self.path("a.raw.gz_"))
        self.expect("a.nhdr", counted(), OBLIQUE)
        for compressed in (False, True):
            write_meta(self.path("a.mhd"), counted(), OBLIQUE, compressed, self.path("a.raw"))
            self.expect("a.mhd", counted(), OBLIQUE)

    def test_are_rescaled_if_the_file_says_so(self):
        for scale, expected in (((0, 5), counted()), ((1, 0), counted()),
                                ((0.5, -10), (0.5 * counted() - 10).astype("float32"))):
            write_nifti(self.path("a.nii"), counted(), OBLIQUE, scale=scale)
            self.expect("a.nii", expected, TO_LEFT @ OBLIQUE)

    def test_of_many_blocks_are_decompressed(self):
        data = np.random.default_rng(1).integers(0, 60000, (97, 101, 103)).astype("uint16")
        write_nrrd(self.path("a.nrrd"), data, OBLIQUE)
        write_nifti(self.path("a.nii.gz"), data, OBLIQUE, names={5: "x" * 300000})
        self.expect("a.nrrd", data, OBLIQUE)
        self.expect("a.nii.gz", data, TO_LEFT @ OBLIQUE)

    def test_of_a_part_are_those_of_the_whole(self):
        write_nrrd(self.path("a.nrrd"), counted(), OBLIQUE)
        reader = self.reader("a.nrrd")
        reader.UpdateExtent((1, 3, 0, 2, 2, 2))
        np.testing.assert_array_equal(values(reader.GetOutput(), "Values"),
                                      in_order(counted(), OBLIQUE)[0][1:4, 0:3, 2:3].ravel(order="F"))
        self.assertEqual(reader.GetOutput().GetExtent(), (1, 3, 0, 2, 2, 2))


class TestNames(ReaderTest):
    def names(self, image):
        labels, names = (image.GetFieldData().GetAbstractArray("Structure" + name)
                         for name in ("Labels", "Names"))
        return {labels.GetValue(i): names.GetValue(i)
                for i in range(labels.GetNumberOfValues())} if names else None

    def test_of_segments_and_label_tables(self):
        labels = (counted("uint8") % 4).astype("uint8")
        expected = {1: "liver", 3: "tumour, left"}
        write_nrrd(self.path("a.seg.nrrd"), labels, OBLIQUE,
                   more=segments((3, "tumour, left", 0), (1, "liver", 0)))
        write_nifti(self.path("a.nii.gz"), labels, TO_LEFT @ OBLIQUE, names=expected)
        for name in ("a.seg.nrrd", "a.nii.gz"):
            image = self.expect(name, labels, OBLIQUE)
            self.assertEqual(self.names(image), expected)
            np.testing.assert_array_equal(
                vtk_to_numpy(image.GetFieldData().GetArray("StructureColors")),
                [color_of(label) for label in (1, 3)])

    def test_without_a_color_that_can_be_read(self):
        labels = (counted("uint8") % 3).astype("uint8")
        more = segments((1, "liver", 0), (2, "spleen", 0))
        for color in ("red", "0.5 2 0.25", "0.5 0.1"):
            write_nrrd(self.path("a.seg.nrrd"), labels, OBLIQUE,
                       more=more.replace("0.5 0.125 0.25", color))
            image = self.expect("a.seg.nrrd", labels, OBLIQUE)
            colors = vtk_to_numpy(image.GetFieldData().GetArray("StructureColors"))
            self.assertTrue(np.isnan(colors[0]).all(), color)
            np.testing.assert_array_equal(colors[1], color_of(2))

    def test_in_latin_1(self):
        labels = counted("uint8") % 3
        write_nrrd(self.path("a.seg.nrrd"), labels, OBLIQUE,
                   more=segments((1, "L_on", 0), (2, "fígado", 0)))
        self.write("a.seg.nrrd", self.content("a.seg.nrrd").replace(b"L_on", b"L\xe9on"))
        self.assertEqual(self.names(self.read("a.seg.nrrd")), {1: "Léon", 2: "fígado"})

    def test_without_labels_are_of_labels_in_their_order(self):
        more = re.sub("Segment._LabelValue.*\n", "", segments((9, "liver", 0), (9, "spleen", 0)))
        write_nrrd(self.path("a.seg.nrrd"), counted("uint8") % 3, OBLIQUE, more=more)
        self.assertEqual(self.names(self.read("a.seg.nrrd")), {1: "liver", 2: "spleen"})

    def test_are_left_out_where_there_are_none(self):
        write_nrrd(self.path("a.nrrd"), counted(), OBLIQUE)
        self.assertIsNone(self.names(self.read("a.nrrd")))

    def test_of_layers_that_are_not_read_are_told(self):
        layers = np.stack([counted("uint8") % 3, counted("uint8") % 2])
        write_nrrd(self.path("a.seg.nrrd"), layers, OBLIQUE,
                   more=segments((1, "liver", 0), (2, "spleen", 0), (1, "tumour", 1)))

        image = self.expect("a.seg.nrrd", layers[0], OBLIQUE, warnings=1)
        self.assertEqual(self.names(image), {1: "liver", 2: "spleen"})
        self.assertIn("tumour (1)", self.messages[0])
        image = self.expect("a.seg.nrrd", layers[1], OBLIQUE, warnings=1, Layer=1)
        self.assertEqual(self.names(image), {1: "tumour"})
        self.assert_refuses("layer 2", filter_=self.reader("a.seg.nrrd", Layer=2))


class TestAddedStructures(ReaderTest):
    """What a segmentation, cropped to its segments, becomes on an image of the same patient."""

    def setUp(self):
        super().setUp()
        self.labels = np.zeros((9, 8, 7), "uint8")
        self.labels[3:6, 2:5, 4:6] = 1
        self.labels[4:7, 3:6, 1:4] = 5
        cropped = np.column_stack([OBLIQUE[:, :3], OBLIQUE @ [2, 1, 1, 1]])
        write_nrrd(self.path("a.seg.nrrd"), self.labels[2:8, 1:7, 1:7], cropped,
                   more=segments((1, "liver", 0), (3, "empty", 0), (5, "tumour", 0)))
        write_nifti(self.path("ct.nii.gz"), counted(shape=(9, 8, 7)), TO_LEFT @ OBLIQUE)

    def added(self, image, **properties):
        add = catching(vtkAddStructures())
        add.SetInputDataObject(0, image)
        add.SetInputDataObject(1, self.read("a.seg.nrrd"))
        for key, value in properties.items():
            getattr(add, "Set" + key)(value)
        return add

    def expect_added(self, add, labels):
        add.Update()
        self.assert_no_error(add)
        np.testing.assert_array_equal(values(add.GetOutput(), "Structure"), labels.ravel(order="F"))
        table = add.GetStructureTable()
        self.assertEqual([table.GetValueByName(i, "Name").ToString()
                          for i in range(table.GetNumberOfRows())], ["liver", "tumour"])

    def test_is_at_its_place_with_its_names(self):
        self.expect_added(self.added(self.read("ct.nii.gz")), in_order(self.labels, OBLIQUE)[0])

    def test_is_at_its_place_in_an_image_that_lost_its_own(self):
        spacing = np.linalg.norm(OBLIQUE[:, :3], axis=0)
        lost = image_of((9, 8, 7), spacing, values=counted(shape=(9, 8, 7)).ravel(order="F"))
        self.expect_added(self.added(lost, ImageFile=self.path("ct.nii.gz")), self.labels)

        part = image_of((9, 8, 7), spacing)
        part.SetExtent(3, 6, 2, 7, 1, 5)
        self.expect_added(self.added(part, ImageFile=self.path("ct.nii.gz")),
                          self.labels[3:7, 2:8, 1:6])

    def test_refuses_files_of_other_images(self):
        lost = image_of((9, 8, 7))
        for path, word in (("ct.nii.gz", "0.5 apart"), ("none.nii", "no such file")):
            self.assert_refuses(word, "ImageFile" if path[0] == "c" else "none.nii",
                                filter_=self.added(lost, ImageFile=self.path(path)))


class TestMessages(ReaderTest):
    def expect_words(self, name, *words):
        self.assert_refuses("cannot be read", name, *words, filter_=self.reader(name))

    def test_name_files_that_are_none(self):
        self.expect_words("", "no such file")
        self.expect_words("missing.nii.gz", "no such file")
        for name, word in (("a.nii", "no header"), ("a.nii.gz", "no header"), ("a.nrrd", "NRRD"),
                           ("a.mha", "axes"), ("a.png", "known endings")):
            for content in (b"", b"something else\n" * 100, bytes(600)):
                self.write(name, content)
                self.expect_words(name, word)

    def test_name_files_that_are_cut_short(self):
        data = np.random.default_rng(1).integers(0, 200, (20, 20, 20)).astype("uint8")
        write_nifti(self.path("a.nii"), data, OBLIQUE)
        write_nifti(self.path("a.nii.gz"), data, OBLIQUE)
        write_nrrd(self.path("a.nrrd"), data, OBLIQUE)
        write_nrrd(self.path("b.nrrd"), data, OBLIQUE, "raw")
        write_meta(self.path("a.mha"), data, OBLIQUE)
        for name in ("a.nii", "a.nii.gz", "a.nrrd", "b.nrrd", "a.mha"):
            content = self.content(name)
            for share in (0.5, 0.9, 0.99):
                self.write(name, content[:int(share * len(content))])
                self.expect_words(name, "bytes of values")

    def test_name_damaged_files(self):
        data = np.random.default_rng(1).integers(0, 200, (20, 20, 20)).astype("uint8")
        write_nrrd(self.path("a.nrrd"), data, OBLIQUE)
        content = self.content("a.nrrd")
        for place in (-5, -3000):  # of the checksum, and of the values
            self.write("a.nrrd", content[:place] + bytes([content[place] ^ 8]) + content[place + 1:])
            self.expect_words("a.nrrd", "damaged")

    def test_name_sizes_that_are_wrong(self):
        for place, kind, number, word in ((40, "h", 9, "9 axes"), (42, "h", -3, "-3 points"),
                                          (42, "h", 30000, "announces"), (40, "h", 2, "2 axes"),
                                          (108, "f", 3, "byte 3"), (70, "h", 128, "datatype is 128"),
                                          (284, "f", 7, "orthonormal"), (280, "f", np.nan, "nan")):
            write_nifti(self.path("a.nii"), counted(), placed(np.eye(3)), w=(place, kind, number))
            self.expect_words("a.nii", word)

    def test_name_several_volumes_and_colors(self):
        four = counted(shape=(5, 4, 3, 2))
        write_nifti(self.path("a.nii"), four, OBLIQUE)
        self.expect_words("a.nii", "2 points along axis 4")
        write_nrrd(self.path("a.nrrd"), four, OBLIQUE)
        self.expect_words("a.nrrd", "4 axes")
        write_meta(self.path("a.mha"), four, OBLIQUE)
        self.expect_words("a.mha", "4 axes")
        write_meta(self.path("b.mha"), counted(), OBLIQUE, more="ElementNumberOfChannels = 3")
        self.expect_words("b.mha", "several numbers per point")

    def test_name_fields_that_are_wrong(self):
        write_nrrd(self.path("a.nrrd"), counted(), OBLIQUE)
        content = self.content("a.nrrd")
        for now, then, word in ((b"gzip", b"bzip2", '"bzip2"'), (b"sizes: 5", b"sizes: x", "sizes"),
                                (b"type: short", b"type: block", '"block"'),
                                (b"directions: (", b"directions: (a", "space directions"),
                                (b"directions: (", b"directions: none (", "no vector for axis 0"),
                                (b"sizes: 5 4", b"sizes: 5 0", "0 points"),
                                (b"sizes: 5 4", b"sizes: 5 60000", "announces"),
                                (b"endian", b"byte skip: -2\nendian", '"byte skip" is -2'),
                                (b"endian", b"line skip: 1\nendian", "skips lines")):
            self.write("b.nrrd", content.replace(now, then, 1))
            self.expect_words("b.nrrd", word)


if __name__ == "__main__":
    unittest.main()
