# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What a run of optimize takes over from the one before."""

from __future__ import annotations

import dataclasses
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from .fields import Layout, converted
from .grid import Grid

if TYPE_CHECKING:
    from .scene import Scene
    from .settings import Settings


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Memory:
    """What a run leaves for the next one."""

    grid: Grid
    layout: Layout
    data: int | None  #: tells data apart: the next time step has other; None: nobody will ask
    axes: tuple[int, int, int] | None  #: of results: those that are x, y, z; None: they are flat
    change: Any = None  #: the core's CarriedChange; None: without temporal_coherence

    @classmethod
    def of(cls, scene: Scene, settings: Settings) -> Memory:
        """That of a scene, before it is optimised."""
        coherent = settings.temporal_coherence > 0
        source = scene.source
        return cls(scene.grid, scene.layout, checksum(scene.data) if coherent else None,
                   source.axes if source.image is None else None)

    def in_order(self, field: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """A field of a result, indexed [x, y, z]; not copied."""
        return field.reshape(self.grid.shape, order="F") if self.axes is None else \
            field.transpose(self.axes)

    def as_header(self) -> dict[str, Any]:
        """What a file has of it: all but the change."""
        grid = {field.name: np.asarray(getattr(self.grid, field.name)).tolist()
                for field in dataclasses.fields(Grid)}
        return {"grid": grid, "order": self.layout.order, "axes": self.axes, "data": self.data}

    @classmethod
    def from_header(cls, header: dict[str, Any]) -> Memory:
        """That of a file."""
        grid = Grid(**{**header["grid"], "shape": tuple(header["grid"]["shape"])})
        axes = header["axes"]
        return cls(grid, Layout(header["order"]), header["data"],
                   None if axes is None else tuple(axes))

    def with_change(self, change: Any) -> Memory:
        """The same with what was made of the base extinction."""
        return dataclasses.replace(self, change=change)


def checksum(arrays: tuple[npt.NDArray[Any], ...]) -> int:
    """A number that is another one for other values."""
    result = 0
    for array in arrays:
        for part in array if array.strides[0] == max(array.strides) else array.transpose():
            result = zlib.crc32(np.ascontiguousarray(part).view(np.uint8).data, result)
    return result


class Previous:
    """What optimize is given as `previous`, checked, as far as settings let it count.

    found: an Optimization; None: the run is the first; (): nobody has said.
    """

    def __init__(self, found: Any, settings: Settings) -> None:
        unsaid = isinstance(found, tuple) and not found
        if unsaid and (settings.warm_start or settings.temporal_coherence > 0):
            raise ValueError("warm_start or temporal_coherence is set, and there is no previous "
                             "(these settings refer to a previous result). Give previous=, the "
                             "last result of optimize, or None for the first run.")
        self.found: Any = None if unsaid else found
        self.warm = settings.warm_start
        self.coherent = settings.temporal_coherence > 0
        self.counts = self.found is not None and (self.warm or self.coherent)
        if self.found is None:
            return
        if not isinstance(getattr(self.found, "memory", None), Memory):
            raise ValueError(f"previous is a {type(found).__name__} (a run continues from a result "
                             "of optimize). Give such a result, or None.")
        if not self.counts:
            raise ValueError("previous is given, warm_start is off and temporal_coherence 0 (it "
                             "would have no effect). Set one of these, or leave previous out.")
        if self.coherent and self.found.memory.change is None:
            raise ValueError("temporal_coherence is set, and previous was found without it or loaded "
                             "from a file (so its change was not stored). Set it in both runs.")

    def layout(self) -> Layout | None:
        """The order of axes that fields are wanted in; None: any."""
        return self.found.memory.layout if self.counts else None

    def require_box(self, grid: Grid) -> None:
        """Raises ValueError unless it is of the same box, for a warm start of the same points."""
        if not self.counts:
            return
        before = self.found.memory.grid
        ends = [(of.origin, of.origin + of.direction @ np.multiply(of.spacing, np.subtract(
            of.shape, 1))) for of in (before, grid)]
        if not np.allclose(ends[0], ends[1], rtol=0, atol=1e-4 * grid.radius()):
            raise ValueError(f"previous is of a box from {ends[0][0]} to {ends[0][1].tolist()}, "
                             f"and the volume is one from {ends[1][0]} to {ends[1][1].tolist()} "
                             "(its extinction belongs to another box). Leave previous out.")
        if self.warm and before.shape != grid.shape:
            raise ValueError(f"previous has {before.shape} points, and the volume {grid.shape} (a "
                             "warm start needs one value per point). Leave warm_start out.")

    def initial(self, scene: Scene) -> npt.NDArray[Any] | None:
        """The extinction to start from, flat; None: the base extinction."""
        if not (self.counts and self.warm):
            return None
        extinction = scene.source.field("previous extinction", self.found.extinction)
        return scene.layout.flat(converted(extinction, scene.layout))

    def change(self, memory: Memory) -> Any:
        """What the core is to stay near of; None: nothing.

        memory: of the run that begins.
        """
        if not (self.counts and self.coherent):
            return None
        change = self.found.memory.change
        same = self.found.memory.data == memory.data
        change.likeness = 1.0 if same else _core.likeness_in_time
        return change
