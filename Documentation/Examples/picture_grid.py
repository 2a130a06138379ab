# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Pictures side by side with words, pixel for pixel, and saved within a limit of bytes."""

import io
import os

import matplotlib

matplotlib.use("Agg")

import numpy as np  # pylint: disable=wrong-import-position
from matplotlib import pyplot  # pylint: disable=wrong-import-position
from PIL import Image  # pylint: disable=wrong-import-position

DOTS = 100  # per inch
LIMIT = 300_000  # bytes of a picture
COLORS = 255  # of a PNG that would be too large: a third of the bytes
GAP = 4  # between pictures [pixels]
POINTS = 6.5  # size of the words
LINE = 12  # height of a line of words [pixels]


def compose(rows, heads=(), names=()):
    """A figure of rows of pictures with a text below each, (picture, text) or None; `heads` stand
    above the columns, `names` left of the rows, one or several lines each."""
    height, width = next(cell for row in rows for cell in row if cell)[0].shape[:2]
    texts = [cell[1] for row in rows for cell in row if cell]
    below = LINE * max(text.count("\n") + 1 if text else 0 for text in texts) + GAP
    above = LINE * max((head.count("\n") + 1 for head in heads), default=0) + GAP
    left = LINE * max((name.count("\n") + 1 for name in names), default=0) + GAP
    across = left + max(map(len, rows)) * (width + GAP)
    down = above + len(rows) * (height + below)
    figure = pyplot.figure(figsize=(across / DOTS, down / DOTS), dpi=DOTS, facecolor="white")

    def write(x, y, words, **how):
        figure.text(x / across, 1 - y / down, words, fontsize=POINTS, linespacing=1.1, **how)

    for column, head in enumerate(heads):
        write(left + column * (width + GAP) + width / 2, above - GAP, head, ha="center", va="bottom")
    for number, row in enumerate(rows):
        top = above + number * (height + below)
        if names:
            write(left - GAP, top + height / 2, names[number], rotation=90, ha="right", va="center",
                  ma="center")
        for column, cell in enumerate(row):
            if cell:
                x = left + column * (width + GAP)
                figure.figimage(cell[0], x, down - top - height)
                write(x + width / 2, top + height + GAP / 2, cell[1], ha="center", va="top")
    return figure


def encoded(picture, extension):
    """The picture as bytes, as good as the limit allows; else as small as it gets."""
    def bytes_of(image, **how):
        file = io.BytesIO()
        image.save(file, **how)
        return file.getvalue()

    if extension == ".png":
        tries = [lambda: bytes_of(picture, format="PNG", optimize=True),
                 lambda: bytes_of(picture.quantize(COLORS, kmeans=3, dither=Image.Dither.NONE),
                                  format="PNG", optimize=True)]
    else:
        tries = [lambda quality=quality: bytes_of(picture, format="JPEG", quality=quality,
                                                  optimize=True, subsampling=0)
                 for quality in (92, 88, 84, 80, 75, 70, 64, 56)]
    for encode in tries:
        data = encode()
        if len(data) <= LIMIT:
            break
    return data


def save(figure, path):
    """As PNG or JPEG, by the name. Returns the number of bytes, which may be above the limit."""
    figure.canvas.draw()
    picture = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
    pyplot.close(figure)
    data = encoded(picture, os.path.splitext(path)[1])
    with open(path, "wb") as file:
        file.write(data)
    return len(data)
