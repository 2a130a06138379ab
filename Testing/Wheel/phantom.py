# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What the tests of the Python package share: a small volume, and who looks at it."""

import numpy as np

SHAPE = (24, 20, 16)
SPACING = (0.5, 0.6, 0.8)
ORIGIN = (3.0, -2.0, 1.0)
EXTINCTION = [[0.0, 0.0], [0.3, 0.0], [0.5, 0.6], [0.9, 1.2]]  # which is reached
IMPORTANCE = [[0.7, 0.0], [0.9, 1.0]]
COLORS = [[0.0, 0.2, 0.3, 0.8], [0.6, 0.8, 0.7, 0.6], [1.0, 1.0, 0.2, 0.1]]
SINGLE = float(np.finfo(np.float32).eps)

#: A scene is these, with scalars().
SCENE = {"spacing": SPACING, "origin": ORIGIN, "extinction_function": EXTINCTION,
         "importance_function": IMPORTANCE}
#: Cameras and lights off all axes.
VIEW = {"camera": {"position": (30, -22, 18), "focal_point": (8.5, 3.5, 7), "view_up": (0, 0, 1)},
        "light": (-9, -20, 30)}


def scalars(order="F", dtype=np.float32):
    """A dense core in a shell, with a wave that has no symmetry, shape SHAPE, in [0, 1]."""
    x, y, z = (np.linspace(-1, 1, count) for count in SHAPE)
    x, y, z = np.meshgrid(x, y, z, indexing="ij")
    radius = np.sqrt(x * x + y * y + z * z)
    values = np.where(radius < 0.35, 0.95, np.where(np.abs(radius - 0.75) < 0.15, 0.55, 0.1))
    values = values + 0.04 * np.sin(5 * x + 3 * y * z + 1)
    return np.asarray(np.clip(values, 0, 1), dtype=dtype, order=order)


def noisy_ball():
    """A ball of 1 in 0.5 in nothing, with so much noise that the largest 5 % are mostly specks."""
    x, y, z = np.indices((30, 29, 28)) - np.reshape([14.5, 14, 13.5], (3, 1, 1, 1))
    radius = np.sqrt(x * x + y * y + z * z)
    inside = np.where(radius < 5, 1, np.where(radius < 12.5, 0.5, 0))
    noise = 0.09 * np.random.default_rng(3).standard_normal((2, *inside.shape))
    return np.hypot(inside + noise[0], noise[1]).astype(np.float32)


def fields(order="F"):
    """Base extinction and importance of the scene, float32."""
    values = scalars().astype(float)
    return tuple(np.asarray(np.interp(values, *np.transpose(nodes)), dtype=np.float32, order=order)
                 for nodes in (EXTINCTION, IMPORTANCE))


def rounding_of_sweeps():
    """Bound of the relative difference between scores of the same fields in another order of axes.

    A ray crosses at most the sum of all layers. In each it rounds a handful of single-precision
    operations, which the score inherits: exp and products keep relative errors, sums average them.
    """
    return 16 * sum(SHAPE) * SINGLE
