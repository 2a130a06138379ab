# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What hides structures, against a march of its own in double precision: nested shells and a wedge.

import itertools
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from images import image_of, phantom, values
from TestStructures import StructuresTest, add, optimizer

BAR = 0.005  # of what the data have of a structure: four steps per cell, and 160 rays across
POINTS = 33
EYE = np.array([1.7, -5.6, 1.4])  # looks at the box [-1, 1]^3
RAYS = 160  # across the sphere round the box
RADIUS = np.sqrt(3)


class Lattice:
    """Trilinear fields on [-1, 1]^3, indexed [z, y, x]."""

    def __init__(self, points):
        offset = (points + 1) / 2 * (POINTS - 1)
        self.first = np.clip(np.floor(offset).astype(int), 0, POINTS - 2)
        self.share = offset - self.first

    def __call__(self, field):
        found = 0
        for corner in itertools.product((0, 1), repeat=3):
            weight = np.prod(np.where(corner, self.share, 1 - self.share), axis=1)
            x, y, z = (self.first + corner).T
            found = found + weight * field[z, y, x]
        return found


def marched(extinction, base, memberships):
    """Shares [structure] that are visible and removed, and [structure, 0: other or by] hidden."""
    distance = np.linalg.norm(EYE)
    forward = -EYE / distance
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    half = RADIUS / np.sqrt(distance ** 2 - RADIUS ** 2)
    places = half * ((np.arange(RAYS) + 0.5) / RAYS * 2 - 1)
    x, y = (places_of.ravel()[:, None] for places_of in np.meshgrid(places, places))
    ways = forward + x * right + y * up
    length = np.linalg.norm(ways, axis=1)
    ways /= length[:, None]
    step = 2 / (POINTS - 1) / 4
    kept = np.minimum(extinction, base)
    depths = np.zeros((len(memberships) + 1, len(ways)))
    visible, left, data = np.zeros((3, len(memberships)))
    hidden = np.zeros((len(memberships), len(memberships) + 1))
    for way in np.arange(distance - RADIUS, distance + RADIUS, step) + step / 2:
        points = EYE + way * ways
        inside = np.flatnonzero((np.abs(points) <= 1).all(axis=1))
        if not inside.size:
            continue
        at = Lattice(points[inside])
        parts = np.array([at(membership) for membership in memberships])
        absorbed = np.vstack([np.clip(1 - parts.sum(axis=0), 0, 1), parts]) * at(extinction) * step
        middle = depths[:, inside] + 0.5 * absorbed
        depth = middle.sum(axis=0)
        volume = step * way ** 2 / length[inside] ** 3
        here = parts * at(kept) * volume
        visible += (here * np.exp(-depth)).sum(axis=1)
        left += here.sum(axis=1)
        data += (parts * at(base) * volume).sum(axis=1)
        hidden += (here * -np.expm1(-depth)) @ (middle / np.maximum(depth, 1e-30)).T
        depths[:, inside] += absorbed
    return visible / data, 1 - left / data, hidden / data[:, None]


class TestHiddenStructures(StructuresTest):
    def check(self, image, structures, bar=BAR):
        for iterations in (0, 8):
            result = optimizer(
                image, *structures, MaximumIterations=iterations, AutomaticPlacement=0,
                CameraPosition=EYE, CameraFocalPoint=(0, 0, 0), CameraViewUp=(0, 0, 1),
                LightPosition=EYE)
            result.Update()
            self.assert_no_error(result)
            output = result.GetOutput()
            extinction, base, labels = (
                values(output, name).reshape(3 * (POINTS,)).astype(float)
                for name in ("Extinction", "BaseExtinction", "Labels"))
            expected = marched(extinction, base,
                               [(labels == label).astype(float) for label, *_ in structures])
            table = result.GetStructureTable()
            found = [vtk_to_numpy(table.GetColumnByName(name)) for name in ("Visible", "Removed")]
            found.append(np.array([
                vtk_to_numpy(table.GetColumnByName(f"HiddenBy{name}"))
                for name in ("Other", *(name for _, name, _ in structures))]).T)
            for one, other in zip(found, expected):
                self.assertLess(np.abs(one - other).max(), bar)

    def test_of_nested_shells(self):
        image = phantom(POINTS, scene=2)
        labels = values(image, "Structure").astype(np.int32)
        add(image.GetPointData(), "Labels", labels)
        self.check(image, [(1, "outer", 0.1), (2, "second", 0.3), (3, "third", 0.6),
                           (4, "core", 1.0)])

    def test_behind_a_wedge(self):
        """It is thick on one side, with matter of no structure beside it."""
        x, y, z = np.meshgrid(*3 * [np.linspace(-1, 1, POINTS)], indexing="ij")
        labels = np.where(y > 0.5, 2, np.where(y + 0.9 < 0.6 * (x + 1), 1, 0))
        extinction = np.where(labels == 2, 4.0, np.where(labels == 1, 2.0, np.where(z > 0, 0.5, 0)))
        image = image_of(labels.shape, BaseExtinction=extinction.ravel(order="F"))
        image.SetOrigin(-1, -1, -1)
        image.SetSpacing(*3 * [2 / (POINTS - 1)])
        add(image.GetPointData(), "Labels", labels.ravel(order="F").astype(np.int32))
        self.check(image, [(1, "wedge", 0.0), (2, "slab", 1.0)])

    def test_of_sheets_that_touch(self):
        """Of a layer with both, each half's middle counts: too coarse by 0.009 at this depth."""
        _, y, _ = np.meshgrid(*3 * [np.arange(POINTS)], indexing="ij")
        labels = np.where(y == 16, 1, np.where(y == 17, 2, 0))
        image = image_of(labels.shape, BaseExtinction=np.where(labels > 0, 10.0, 0.2).ravel(order="F"))
        image.SetOrigin(-1, -1, -1)
        image.SetSpacing(*3 * [2 / (POINTS - 1)])
        add(image.GetPointData(), "Labels", labels.ravel(order="F").astype(np.int32))
        self.check(image, [(1, "front", 0.5), (2, "rear", 1.0)], bar=0.01)


if __name__ == "__main__":
    unittest.main()
