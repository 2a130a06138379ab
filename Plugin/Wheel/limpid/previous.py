# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What a run of optimize takes over from the one before."""

import dataclasses
import typing
import zlib

import numpy as np

from . import _core
from .fields import Layout, converted
from .grid import Grid


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Memory:
    """What a run leaves for the next one."""

    grid: Grid
    layout: Layout
    data: int  #: tells data apart: the next time step has other; None: nobody will ask
    change: typing.Any = None  #: the core's CarriedChange; None: without temporal_coherence

    @classmethod
    def of(cls, scene, settings):
        """That of a scene, before it is optimised."""
        coherent = settings.temporal_coherence > 0
        return cls(scene.grid, scene.layout, checksum(scene.data) if coherent else None)

    def with_change(self, change):
        """The same with what was made of the base extinction."""
        return dataclasses.replace(self, change=change)


def checksum(arrays):
    """A number that is another one for other values."""
    result = 0
    for array in arrays:
        for part in array if array.strides[0] == max(array.strides) else array.transpose():
            result = zlib.crc32(np.ascontiguousarray(part).view(np.uint8), result)
    return result


class Previous:
    """What optimize is given as `previous`, checked, as far as settings let it count.

    found: an Optimization; None: the run is the first; (): nobody has said.
    """

    def __init__(self, found, settings):
        unsaid = isinstance(found, tuple) and not found
        if unsaid and (settings.warm_start or settings.temporal_coherence > 0):
            raise ValueError("warm_start or temporal_coherence is set, and there is no previous "
                             "(these settings refer to a previous result). Give previous=, the "
                             "last result of optimize, or None for the first run.")
        self.found = None if unsaid else found
        self.warm = settings.warm_start
        self.coherent = settings.temporal_coherence > 0
        self.counts = self.found is not None and (self.warm or self.coherent)
        if self.found is None:
            return
        if not isinstance(getattr(found, "memory", None), Memory):
            raise ValueError(f"previous is a {type(found).__name__} (a run continues from a result "
                             "of optimize). Give such a result, or None.")
        if not self.counts:
            raise ValueError("previous is given, warm_start is off and temporal_coherence 0 (it "
                             "would have no effect). Set one of these, or leave previous out.")
        if self.coherent and found.memory.change is None:
            raise ValueError("temporal_coherence is set, and previous was found without it (so its "
                             "change was not stored). Set it in both runs.")

    def layout(self):
        """The order of axes that fields are wanted in; None: any."""
        return self.found.memory.layout if self.counts else None

    def require_box(self, grid):
        """Raises ValueError unless it is of the same box, for a warm start of the same points."""
        if not self.counts:
            return
        before = self.found.memory.grid
        ends = [(of.origin, of.origin + of.direction @ np.multiply(of.spacing, np.subtract(
            of.shape, 1))) for of in (before, grid)]
        if not np.allclose(*ends, rtol=0, atol=1e-4 * grid.radius()):
            raise ValueError(f"previous is of a box from {ends[0][0]} to {ends[0][1].tolist()}, "
                             f"and the volume is one from {ends[1][0]} to {ends[1][1].tolist()} "
                             "(its extinction belongs to another box). Leave previous out.")
        if self.warm and before.shape != grid.shape:
            raise ValueError(f"previous has {before.shape} points, and the volume {grid.shape} (a "
                             "warm start needs one value per point). Leave warm_start out.")

    def initial(self, scene):
        """The extinction to start from, flat; None: the base extinction."""
        if not (self.counts and self.warm):
            return None
        extinction = scene.source.field("previous extinction", self.found.extinction)
        return scene.layout.flat(converted(extinction, scene.layout))

    def change(self, memory):
        """What the core is to stay near of; None: nothing.

        memory: of the run that begins.
        """
        if not (self.counts and self.coherent):
            return None
        change = self.found.memory.change
        same = self.found.memory.data == memory.data
        change.likeness = 1.0 if same else _core.likeness_in_time
        return change
