# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Directions spread over the unit sphere, and the triangles between them."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from .given import Floats

GOLDEN = (1 + 5 ** 0.5) / 2
MOST_POINTS = 100_000

Triangles = npt.NDArray[np.integer[Any]]


def icosahedron() -> tuple[Floats, Triangles]:
    """Twelve points (12, 3) and twenty triangles (20, 3), their corners counterclockwise as seen
    from outside."""
    corners = [np.roll((0, one, long), turn) for turn in range(3)
               for one in (-1, 1) for long in (-GOLDEN, GOLDEN)]
    points = unit(np.array(corners, dtype=float))
    dots = points @ points.T
    near = dots > 0.4  # neighbours have 0.447, others less
    triangles = [(a, b, c) for a in range(12) for b in range(12) for c in range(12)
                 if a < b and a < c and b != c and near[a, b] and near[b, c] and near[c, a]
                 and np.linalg.det(points[[a, b, c]]) > 0]
    return points, np.array(triangles)


def unit(vectors: Floats) -> Floats:
    """Vectors (n, 3) at length one."""
    lengths: Floats = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / lengths


def finer(points: Floats, triangles: Triangles) -> tuple[Floats, Triangles]:
    """Every triangle in four, the new points moved to the sphere."""
    edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, middles = np.unique(edges, axis=0, return_inverse=True)
    ab, bc, ca = (middles.reshape(-1, 3) + len(points)).T
    a, b, c = triangles.T
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return (np.vstack([points, unit(points[edges].sum(axis=1))]),
            np.vstack([np.column_stack(part) for part in parts]))


def icosphere(count: int) -> tuple[Floats, Triangles]:
    """Points and triangles of the icosphere with a number of points as close to `count` as there
    is: 12, 42, 162, 642, 2562 and so on, the filters' default sphere."""
    points, triangles = icosahedron()
    while abs(4 * len(points) - 6 - count) < abs(len(points) - count):
        points, triangles = finer(points, triangles)
    return points, triangles


def triangles_between(points: Floats) -> Triangles:
    """The convex hull of points of the unit sphere, which are sorted from the largest second
    coordinate to the smallest: triangles (2n - 4, 3), counterclockwise as seen from outside."""
    faces = np.array([[0, 1, 2], [0, 2, 3], [2, 1, 3], [1, 0, 3]])
    if np.linalg.det(points[[1, 2, 3]] - points[0]) > 0:
        faces = faces[:, ::-1]
    normals, offsets, lowest = planes_of(points, faces)
    finished = []
    for index in range(4, len(points)):
        seen = normals @ points[index] > offsets
        over = ~seen & (lowest > points[index, 1] + 1e-9)  # no later point sees these
        finished.append(faces[over])
        edges = faces[seen][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        keys = edges[:, 0] * len(points) + edges[:, 1]
        rim = edges[~np.isin(keys, edges[:, 1] * len(points) + edges[:, 0])]
        new = np.column_stack([rim, np.full(len(rim), index)])
        kept = ~(seen | over)
        faces = np.vstack([faces[kept], new])
        normals, offsets, lowest = (np.concatenate([old[kept], added]) for old, added in zip(
            (normals, offsets, lowest), planes_of(points, new)))
    return np.vstack([*finished, faces])


def planes_of(points: Floats, faces: Triangles) -> tuple[Floats, Floats, Floats]:
    """Outward normals of triangles, offsets of their planes, and the second coordinate of the
    lowest point of the sphere outside each plane."""
    a, b, c = points[faces.T]
    normals = unit(np.cross(b - a, c - a))
    offsets = np.sum(normals * a, axis=1)
    opening = np.arccos(np.clip(offsets, -1, 1))
    to_bottom = np.arccos(np.clip(-normals[:, 1], -1, 1))
    return normals, offsets, np.where(to_bottom > opening, -np.cos(to_bottom - opening), -1.0)


def fibonacci(count: int) -> tuple[Floats, Triangles]:
    """Points and triangles of a spiral from pole to pole: any number of points, four at least."""
    number = max(count, 4)  # a tetrahedron
    turns = np.arange(number) * np.pi * (3 - 5 ** 0.5)
    heights = 1 - (2 * np.arange(number) + 1) / number
    radii = np.sqrt((1 - heights) * (1 + heights))
    points = unit(np.column_stack([radii * np.sin(turns), heights, radii * np.cos(turns)]))
    return points, triangles_between(points)


def latitude_longitude(count: int) -> tuple[Floats, Triangles]:
    """Points and triangles of rings about the second axis, whose poles are single points: twice as
    many columns as from pole to pole."""
    rings = max(1, int(0.5 * (max(2 * count - 3, 1) ** 0.5 - 1) + 0.5))
    columns = max(3, int((count - 2) / rings + 0.5))
    down, round_it = np.meshgrid(np.pi * np.arange(1, rings + 1) / (rings + 1),
                                 2 * np.pi * np.arange(columns) / columns, indexing="ij")
    ring_points = np.stack([np.sin(down) * np.sin(round_it), np.cos(down),
                            np.sin(down) * np.cos(round_it)], axis=-1).reshape(-1, 3)
    points = np.vstack([[0, 1, 0], ring_points, [0, -1, 0]])
    ring = 1 + np.arange(rings * columns).reshape(rings, columns)
    after = np.roll(ring, -1, axis=1)
    parts = [np.column_stack([np.zeros(columns, dtype=int), ring[0], after[0]]),
             np.column_stack([np.full(columns, len(points) - 1), after[-1], ring[-1]])]
    for upper, lower, next_upper, next_lower in zip(ring, ring[1:], after, after[1:]):
        parts += [np.column_stack([upper, lower, next_lower]),
                  np.column_stack([upper, next_lower, next_upper])]
    return points, np.vstack(parts)


#: How directions may be spread, by the names of the filters.
SAMPLINGS = {"icosphere": icosphere, "fibonacci": fibonacci,
             "latitude_longitude": latitude_longitude}


def spacing(points: Floats) -> float:
    """Mean angle between neighbouring directions [radians]."""
    return float((4 * np.pi / len(points)) ** 0.5)
