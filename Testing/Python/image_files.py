# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Writes files of images as other programs do, without VTK. Values are indexed [x, y, z]; a matrix has
the steps from a point to the next ones in its columns, and the place of the first one in the last."""

import gzip
import itertools
import struct
import zlib

import numpy as np

NIFTI_TYPES = {"uint8": 2, "int16": 4, "int32": 8, "float32": 16, "float64": 64, "int8": 256,
               "uint16": 512, "uint32": 768, "int64": 1024, "uint64": 1280}
NRRD_TYPES = {"uint8": "unsigned char", "int16": "short", "uint16": "ushort", "float32": "float"}
META_TYPES = {"uint8": "MET_UCHAR", "int16": "MET_SHORT", "uint16": "MET_USHORT",
              "float32": "MET_FLOAT"}


def in_order(values, matrix):
    """The same image with its axes as near to those of the world as they can be."""
    values, matrix = np.asarray(values), np.array(matrix, float)
    nearness = abs(matrix[:, :3] / np.linalg.norm(matrix[:, :3], axis=0))
    order = list(max(itertools.permutations(range(3)),
                     key=lambda axes: sum(nearness[i, axis] for i, axis in enumerate(axes))))
    values, matrix = values.transpose(order), matrix[:, order + [3]]
    for axis in range(3):
        if matrix[axis, axis] < 0:
            matrix[:, 3] += matrix[:, axis] * (values.shape[axis] - 1)
            matrix[:, axis] *= -1
            values = np.flip(values, axis)
    return values, matrix


def bytes_of(values, order="<"):
    values = np.asarray(values)
    return values.astype(values.dtype.newbyteorder(order)).tobytes(order="F")


def write(path, content):
    with (gzip.open if path.endswith(".gz") else open)(path, "wb") as file:
        file.write(content)


def write_nifti(path, values, matrix, order="<", scale=(1, 0), quaternion=None, names=None, **fields):
    """Version 1. `matrix` becomes the sform; with a quaternion (b, c, d, qfac), the qform has its
    spacings and its origin. `fields`: others as (place, format, value)."""
    matrix = np.asarray(matrix, float)
    spacing = np.linalg.norm(matrix[:, :3], axis=0)
    table = "".join('<Label Key="{0}" Red="{2}" Green="{3}" Blue="{4}" Alpha="1"><![CDATA[{1}]]>'
                    "</Label>\n".format(key, name, *color_of(key))
                    for key, name in (names or {}).items()).encode()
    extension = b""
    if table:
        table = b"<CaretExtension><LabelTable>" + table + b"</LabelTable></CaretExtension>"
        table += bytes(-(len(table) + 8) % 16)
        extension = struct.pack(order + "ii", len(table) + 8, 0) + table
    header = bytearray(352)

    def put(place, kind, *numbers):
        struct.pack_into(order + kind, header, place, *numbers)
    put(0, "i", 348)
    put(40, "8h", values.ndim, *values.shape, *[1] * (7 - values.ndim))
    put(70, "2h", NIFTI_TYPES[values.dtype.name], 8 * values.dtype.itemsize)
    put(76, "4f", 1 if quaternion is None else quaternion[3], *spacing)
    put(108, "3f", 352 + len(extension), *scale)
    put(252, "2h", quaternion is not None, quaternion is None)
    if quaternion is None:
        put(280, "12f", *matrix.ravel())
    else:
        put(256, "6f", *quaternion[:3], *matrix[:, 3])
    put(344, "4s", b"n+1")
    put(348, "b", bool(extension))
    for place, kind, number in fields.values():
        put(place, kind, number)
    write(path, bytes(header) + extension + bytes_of(values, order))


def write_nifti2(path, values, matrix):
    header = bytearray(544)
    struct.pack_into("<i8s2h", header, 0, 540, b"n+2\0\r\n\032\n", NIFTI_TYPES[values.dtype.name],
                     8 * values.dtype.itemsize)
    struct.pack_into("<8q", header, 16, 3, *values.shape, 1, 1, 1, 1)
    struct.pack_into("<8d", header, 104, 1, *np.linalg.norm(matrix[:, :3], axis=0), 1, 1, 1, 1)
    struct.pack_into("<q", header, 168, 544)
    struct.pack_into("<2i", header, 344, 0, 1)
    struct.pack_into("<12d", header, 400, *np.ravel(matrix))
    write(path, bytes(header) + bytes_of(values))


def vector(numbers):
    return "(" + ",".join(repr(float(number)) for number in numbers) + ")"


def write_nrrd(path, values, matrix, encoding="gzip", space="left-posterior-superior", more="",
               order="<", data_file=None):
    """Values with four axes have their layers along the first one."""
    values = np.asarray(values)
    layers = ["none"] if values.ndim == 4 else []
    data = bytes_of(values, order)
    data = gzip.compress(data) if encoding == "gzip" else data
    matrix = np.asarray(matrix)
    lines = ["NRRD0004", "# as 3D Slicer writes it", f"type: {NRRD_TYPES[values.dtype.name]}",
             f"dimension: {values.ndim}", f"space: {space}",
             "sizes: " + " ".join(map(str, values.shape)),
             "space directions: " + " ".join(layers + [vector(step) for step in matrix[:, :3].T]),
             f"endian: {'little' if order == '<' else 'big'}", f"encoding: {encoding}",
             f"space origin: {vector(matrix[:, 3])}"]
    if data_file:
        lines.append("data file: " + data_file.split("/")[-1])
        write(data_file, data)
    write(path, ("\n".join(lines) + "\n" + more + "\n").encode() + (b"" if data_file else data))


def color_of(label):
    """The colour that files give to a label."""
    return 0.5, 0.125 * (label % 9), 0.25


def segments(*rows):
    """Keys of 3D Slicer for (label, name, layer)."""
    return "".join(f"Segment{i}_ID:=Segment_{i}\nSegment{i}_LabelValue:={label}\n"
                   f"Segment{i}_Layer:={layer}\nSegment{i}_Name:={name}\n"
                   "Segment{}_Color:={} {} {}\n".format(i, *color_of(label))
                   for i, (label, name, layer) in enumerate(rows))


def write_meta(path, values, matrix, compressed=True, data_file=None, more=""):
    matrix = np.asarray(matrix)
    spacing = np.linalg.norm(matrix[:, :3], axis=0)
    data = zlib.compress(bytes_of(values)) if compressed else bytes_of(values)
    lines = ["ObjectType = Image", f"NDims = {values.ndim}", "BinaryData = True",
             "BinaryDataByteOrderMSB = False", f"CompressedData = {compressed}",
             *([f"CompressedDataSize = {len(data)}"] if compressed else []),
             "TransformMatrix = " + " ".join(map(repr, map(float, (matrix[:, :3] / spacing).T.ravel()))),
             "Offset = " + " ".join(map(repr, map(float, matrix[:, 3]))),
             "ElementSpacing = " + " ".join(map(repr, map(float, spacing))),
             "DimSize = " + " ".join(map(str, values.shape)), *filter(None, [more]),
             f"ElementType = {META_TYPES[values.dtype.name]}",
             "ElementDataFile = " + (data_file.split("/")[-1] if data_file else "LOCAL")]
    if data_file:
        write(data_file, data)
    write(path, ("\n".join(lines) + "\n").encode() + (b"" if data_file else data))
