# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Where the points of a volume are."""

from __future__ import annotations

import dataclasses
import math
from typing import Any, Sequence

import numpy as np

from . import _core
from .arguments import vector
from .given import Floats


def matrix_of(direction: Any) -> Floats:
    """A direction matrix as an array of shape (3, 3). Takes arrays and VTK's matrices."""
    if hasattr(direction, "GetElement"):
        direction = [[direction.GetElement(row, column) for column in range(3)]
                     for row in range(3)]
    matrix = np.asarray(direction, dtype=float)
    if matrix.shape != (3, 3):
        raise ValueError(f"direction has the shape {matrix.shape} (its columns are the directions "
                         "of the three axes). Give a matrix of 3 x 3 numbers.")
    return matrix


@dataclasses.dataclass(frozen=True, eq=False)
class Grid:
    """The points of a volume: index (i, j, k) is at origin + direction @ (spacing * index)."""

    shape: tuple[int, int, int]  #: points along each axis
    spacing: Any = (1.0, 1.0, 1.0)  #: from point to point, not zero; negative: backwards [length]
    origin: Any = (0.0, 0.0, 0.0)  #: position of the first point [length]
    direction: Any = None  #: (3, 3), columns: directions of the axes; None: x, y, z

    def __post_init__(self) -> None:
        direction = np.eye(3) if self.direction is None else matrix_of(self.direction)
        object.__setattr__(self, "direction", direction)
        object.__setattr__(self, "spacing",
                           vector("spacing", self.spacing, "lengths are computed from it"))
        object.__setattr__(self, "origin",
                           vector("origin", self.origin, "it is the position of the volume"))

    @classmethod
    def of_image(cls, image: Any) -> Grid:
        """The points of an image of PyVista's or VTK's."""
        spacing = np.array(image.spacing, dtype=float)
        direction = matrix_of(image.direction_matrix)
        first = np.array(image.extent, dtype=float)[0::2]
        return cls(tuple(image.dimensions), spacing,
                   np.array(image.origin) + direction @ (spacing * first), direction)

    def has_volume(self) -> bool:
        """Whether there are at least two points along each axis."""
        return min(self.shape) > 1

    def diagonal(self) -> float:
        """Of the box of the points [length]."""
        return math.hypot(*((count - 1) * step for count, step in zip(self.shape, self.spacing)))

    def radius(self) -> float:
        """Of the sphere round the box of the points [length]."""
        return 0.5 * self.diagonal()

    def centre(self) -> Floats:
        """Of the box of the points, (3,) [length]."""
        half = [0.5 * (count - 1) * step for count, step in zip(self.shape, self.spacing)]
        return np.asarray(np.array(self.origin) + self.direction @ half)

    def cell_length(self) -> float:
        """Diagonal over the cube root of the number of cells, as ParaView's default for the unit
        distance of opacities [length]."""
        cells = math.prod(max(count - 1, 1) for count in self.shape)
        return float(self.diagonal() / cells ** (1 / 3))

    def in_core(self, order: Sequence[int]) -> _core.Grid:
        """The grid as the core has it, its axes in this order: (2, 1, 0) is z, y, x."""
        return _core.Grid([self.shape[axis] for axis in order], self.origin,
                          [self.spacing[axis] for axis in order],
                          [tuple(self.direction[:, axis]) for axis in order])
