# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Directions spread over the unit sphere, and the triangles between them."""

import numpy as np

GOLDEN = (1 + 5 ** 0.5) / 2
MOST_POINTS = 100_000


def icosahedron():
    """Twelve points (12, 3) and twenty triangles (20, 3), their corners counterclockwise as seen
    from outside."""
    points = [np.roll((0, one, long), turn) for turn in range(3)
              for one in (-1, 1) for long in (-GOLDEN, GOLDEN)]
    points = unit(np.array(points, dtype=float))
    dots = points @ points.T
    near = dots > 0.4  # neighbours have 0.447, others less
    triangles = [(a, b, c) for a in range(12) for b in range(12) for c in range(12)
                 if a < b and a < c and b != c and near[a, b] and near[b, c] and near[c, a]
                 and np.linalg.det(points[[a, b, c]]) > 0]
    return points, np.array(triangles)


def unit(vectors):
    """Vectors (n, 3) at length one."""
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def finer(points, triangles):
    """Every triangle in four, the new points moved to the sphere."""
    edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, middles = np.unique(edges, axis=0, return_inverse=True)
    ab, bc, ca = (middles.reshape(-1, 3) + len(points)).T
    a, b, c = triangles.T
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return (np.vstack([points, unit(points[edges].sum(axis=1))]),
            np.vstack([np.column_stack(part) for part in parts]))


def icosphere(count):
    """Points and triangles of the icosphere with a number of points as close to `count` as there
    is: 12, 42, 162, 642, 2562 and so on, the filters' default sphere."""
    points, triangles = icosahedron()
    while abs(4 * len(points) - 6 - count) < abs(len(points) - count):
        points, triangles = finer(points, triangles)
    return points, triangles


def spacing(points):
    """Mean angle between neighbouring directions [radians]."""
    return (4 * np.pi / len(points)) ** 0.5
