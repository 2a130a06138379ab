# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""A color chart as a volume: a block whose face has 24 patches, and how far colors are off."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

# The patches of the usual chart, in 8 bits of sRGB, row by row.
PATCHES = np.array((
    (115, 82, 68), (194, 150, 130), (98, 122, 157), (87, 108, 67), (133, 128, 177),
    (103, 189, 170), (214, 126, 44), (80, 91, 166), (193, 90, 99), (94, 60, 108), (157, 188, 64),
    (224, 163, 46), (56, 61, 150), (70, 148, 73), (175, 54, 60), (231, 199, 31), (187, 86, 149),
    (8, 133, 161), (243, 243, 242), (200, 200, 200), (160, 160, 160), (122, 122, 121),
    (85, 85, 85), (52, 52, 52)), float)
COLUMNS, ROWS = 6, 4
NODES = 10  # of a patch, along either side
INSIDE = 0.5  # scalars of patch n: n outside of the block, n + INSIDE within


def image():
    """Its face looks along z, at nodes 36 and 37 of 44."""
    k, j, i = np.indices((44, ROWS * NODES, COLUMNS * NODES))
    patch = i // NODES + COLUMNS * (j // NODES)
    scalars = (patch + INSIDE * (k < 37)).astype(np.float32)
    result = vtkImageData()
    result.SetDimensions(*reversed(scalars.shape))
    result.SetOrigin(-(COLUMNS * NODES - 1) / 2, -(ROWS * NODES - 1) / 2, -36.5)
    array = numpy_to_vtk(scalars.ravel(), deep=1)
    array.SetName("Chart")
    result.GetPointData().SetScalars(array)
    return result


def color_points():
    """Points (scalar, red, green, blue)."""
    return [(n + x, *(PATCHES[n] / 255)) for n in range(len(PATCHES)) for x in (-0.1, 0.8)]


def opacity_points(opacity):
    """Points (scalar, opacity)."""
    return [(n + x, y) for n in range(len(PATCHES))
            for x, y in ((-0.1, 0.0), (0.1, 0.0), (INSIDE, opacity), (0.8, 0.0))]


def middles(pixels, scale):
    """Mean colors of the middle thirds of the patches in a picture in parallel projection, rows
    from the bottom, whose half height is `scale`."""
    rows, columns, _ = pixels.shape
    unit = rows / (2 * scale)  # pixels per unit of length
    colors = []
    for n in range(len(PATCHES)):
        x = ((n % COLUMNS + 0.5) - COLUMNS / 2) * NODES * unit + columns / 2
        y = ((n // COLUMNS + 0.5) - ROWS / 2) * NODES * unit + rows / 2
        reach = NODES * unit / 6
        part = pixels[int(y - reach):int(y + reach), int(x - reach):int(x + reach)]
        colors.append(part.reshape(-1, 3).mean(axis=0))
    return np.array(colors)


def luminance(colors):
    return colors @ np.array((0.2126, 0.7152, 0.0722))


def luminance_errors(found):
    """Relative, less what rounding to 8 bits makes."""
    own = luminance(PATCHES)
    return np.maximum(np.abs(luminance(found) - own) - 0.5, 0) / own


def hue_errors(found):
    """Angles [degrees], less what rounding to 8 bits can turn them by."""
    def chroma(colors):
        red, green, blue = colors.T
        return red - 0.5 * (green + blue) + 1j * np.sqrt(0.75) * (green - blue)
    one, other = chroma(found), chroma(PATCHES)
    angles = np.abs(np.angle(one * np.conj(other)))
    length = np.abs(other)
    rounding = np.arcsin(np.minimum(1 / np.maximum(length, 1e-9), 1))
    return np.where(length > 2, np.degrees(np.maximum(angles - rounding, 0)), 0)
