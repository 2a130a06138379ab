# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Small pictures of results."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Sequence

import numpy as np
import numpy.typing as npt

from .given import LightLike, Picture, Singles
from .grid import Grid
from .rendering import render
from .views import Camera

if TYPE_CHECKING:
    from .scene import Scene

POINTS = 96  # that are kept along an axis, at most
COLORS = [[0.0, 0.62, 0.68, 0.78], [0.3, 0.8, 0.7, 0.6], [1.0, 0.95, 0.45, 0.1]]  # of importance


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Preview:
    """What is kept of a scene to draw it: every n-th point, at most 96 along an axis."""

    grid: Grid  #: of the points that are kept
    steps: tuple[int, int, int]  #: along each axis, from one that is kept to the next
    base_extinction: Singles  #: shape grid.shape [1/length]
    importance: npt.NDArray[np.uint8]  #: shape grid.shape, 255 is 1

    @classmethod
    def of(cls, scene: Scene) -> Preview:
        """That of a scene."""
        steps = tuple(-(-count // POINTS) for count in scene.grid.shape)
        kept = tuple(slice(None, None, step) for step in steps)
        importance = np.rint(255 * scene.importance[kept]).astype(np.uint8, order="F")
        return cls.restored(scene.grid, steps, scene.base_extinction[kept].copy(order="F"),
                            importance)

    @classmethod
    def restored(cls, grid: Grid, steps: Sequence[int], base_extinction: Singles,
                 importance: npt.NDArray[np.uint8]) -> Preview:
        """That of the points of a grid that are kept."""
        coarse = dataclasses.replace(grid, shape=base_extinction.shape,
                                     spacing=tuple(np.multiply(grid.spacing, steps)))
        return cls(coarse, (steps[0], steps[1], steps[2]), base_extinction, importance)

    def kept(self, field: npt.NDArray[np.float32]) -> Singles:
        """Of a field of the whole grid, the values at the points that are kept."""
        return field[tuple(slice(None, None, step) for step in self.steps)]

    def important(self) -> Singles:
        """The extinction of important structures alone [1/length]."""
        return (self.base_extinction * (self.importance / 255)).astype(np.float32)

    def draw(self, extinction: Singles, camera: Camera, size: int,
             light: LightLike = None) -> Picture:
        """A picture of an extinction, colored by importance: gray is context, orange important.

        extinction: at the points that are kept [1/length].
        size: width and height [pixels].
        """
        most = max(float(self.base_extinction.max()), float(extinction.max()), 1e-30)
        return render((self.importance / 255).astype(np.float32), spacing=self.grid.spacing,
                      origin=self.grid.origin, direction=self.grid.direction,
                      color_function=COLORS, extinction_function=[[0, most], [1, most]],
                      extinction=extinction, camera=camera, light=light, width=size, height=size)
