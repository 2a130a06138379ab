# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Pictures as PNG files, with numpy alone."""

from __future__ import annotations

import base64
import struct
import zlib

import numpy as np

from .given import Picture

COLOR_TYPES = {3: 2, 4: 6}  # of PNG, by the number of channels


def png(picture: Picture) -> bytes:
    """Encodes a picture as a PNG file.

    Parameters
    ----------
    picture : numpy.ndarray of uint8
        As `render` returns it: (height, width, 4), or (height, width, 3) without alpha; the top row
        first, colors not multiplied by alpha.

    Returns
    -------
    bytes
        The contents of a file.

    Raises
    ------
    ValueError
        The array has another type or shape.

    Examples
    --------
    >>> pathlib.Path("picture.png").write_bytes(png(picture))
    """
    array = np.asarray(picture)
    if array.dtype != np.uint8 or array.ndim != 3 or array.shape[2] not in COLOR_TYPES \
            or 0 in array.shape:
        raise ValueError(f"The picture is an array of {array.dtype} with the shape {array.shape} "
                         "(a file has 8 bits for each of 3 or 4 channels). Give an array of uint8, "
                         "(height, width, 4), as render returns it.")
    height, width, channels = array.shape
    rows = np.zeros((height, 1 + width * channels), dtype=np.uint8)  # 0: a row without a filter
    rows[:, 1:] = array.reshape(height, -1)
    header = struct.pack(">IIBBBBB", width, height, 8, COLOR_TYPES[channels], 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + \
        chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b"")


def chunk(kind: bytes, data: bytes) -> bytes:
    """A chunk of a PNG file: its length, kind, data and checksum."""
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def image_tag(picture: Picture, text: str) -> str:
    """A picture as an element of HTML that holds all of it. `text`: what it shows."""
    data = base64.b64encode(png(picture)).decode()
    return f'<img alt="{text}" title="{text}" src="data:image/png;base64,{data}">'
