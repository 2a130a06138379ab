# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What is to be optimised or searched: a base extinction and an importance over a grid."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np

from . import _core
from .arguments import warn, whole_number
from .fields import Layout, converted, corrected, emptied, mapped
from .functions import ExtinctionFunction, ExtinctionOfOpacity, PiecewiseLinear
from .given import Array, Floats, Mask, Rows, Singles
from .grid import Grid
from .structures import Segmentation
from .volume import Volume


@dataclasses.dataclass(frozen=True, eq=False)
class Scene:
    """Fields of shape grid.shape, float32, in the layout."""

    source: Volume
    grid: Grid
    layout: Layout
    base_extinction: Singles  #: >= 0 [1/length]
    importance: Singles  #: [0, 1]
    majorant: float  #: upper bound of Eq. (25), of the function; 0: that of the data [1/length]
    unit_distance: float  #: of opacities [length]
    data: tuple[Array, ...]  #: arrays that extinction and importance were made from
    segmentation: Segmentation | None = None  #: None: importance is given otherwise

    def in_core(self) -> tuple[_core.Grid, Singles, Singles]:
        """Grid, base extinction and importance as the core takes them; the arrays are views."""
        return (self.grid.in_core(self.layout.order), self.layout.flat(self.base_extinction),
                self.layout.flat(self.importance))

    def flat(self, role: str, given: Any) -> Singles | None:
        """A further field, an array or a name, as the core takes it; None: there is none."""
        if given is None:
            return None
        return self.layout.flat(converted(self.source.field(role, given), self.layout))

    def structures_in_core(self) -> tuple[list[Any] | None, Array | None]:
        """Structures and the row of each point as the core takes them; None: there are none."""
        if self.segmentation is None:
            return None, None
        return self.segmentation.table, self.layout.flat(self.segmentation.rows)

    def as_given(self, values: Singles) -> Singles:
        """A field as the core has it as the volume itself is, see Volume.as_given; not copied."""
        return self.source.as_given(self.layout.shaped(values, self.grid.shape))

    def warn_of_nothing_to_see(self, consequence: str) -> None:
        """A warning if no extinction could show anything; `consequence`: what comes of it."""
        largest = self.largest_extinction()
        if largest > 0 and self.importance.max() > 0:
            return
        what = ("no structure is important" if largest > 0 else
                "without extinction nothing is visible")
        warn(f"The largest extinction is {largest:g}, and {what} ({consequence}). Check the "
             "importance and the extinction.")

    def largest_extinction(self) -> float:
        """The majorant of Eq. (25) [1/length]; 0 where nothing absorbs."""
        largest = float(self.base_extinction.max())
        return max(largest, self.majorant) if largest > 0 else 0.0


def unit_distance_of(given: Any, grid: Grid) -> float:
    """The distance on which opacities hold [length]."""
    if given is None:
        return grid.cell_length()
    if not (isinstance(given, (int, float, np.number)) and 0 < given < math.inf):
        raise ValueError(f"unit_distance is {given!r} (it is the distance over which opacities "
                         "apply). Give a length above zero, or None for the mean length of a cell.")
    return float(given)


def extinction_function_of(extinction_function: Rows | None, opacity_function: Rows | None,
                           unit_distance: float) -> ExtinctionFunction | None:
    """The extinction of a scalar [1/length]; None: neither function is given."""
    if extinction_function is not None and opacity_function is not None:
        raise ValueError("extinction_function and opacity_function are given (each defines the "
                         "extinction of a scalar). Give one of them.")
    if extinction_function is not None:
        return PiecewiseLinear("extinction_function", extinction_function)
    if opacity_function is not None:
        opacity = PiecewiseLinear("opacity_function", opacity_function, most=1.0)
        return ExtinctionOfOpacity(opacity, unit_distance)
    return None


def ramp_of(scalars: Array, mask: Mask | None, unit_distance: float) -> ExtinctionFunction:
    """The filters' default: opacities on a straight line from 0 to 1 over the finite scalars.

    mask: where there is no scalar; None: nowhere.
    """
    finite = np.isfinite(scalars) if mask is None else np.isfinite(scalars) & ~mask
    # Integers have no infinity to begin with.
    most, least = (np.inf, -np.inf) if scalars.dtype.kind == "f" else (scalars.max(), scalars.min())
    low = float(scalars.min(where=finite, initial=most))
    high = float(scalars.max(where=finite, initial=least))
    nodes = [[low, 0.0], [high, 1.0]] if high > low else [[0.0, 0.0]]
    return ExtinctionOfOpacity(PiecewiseLinear("opacity_function", nodes), unit_distance)


def eighth_largest_neighbours(scalars: Array, mask: Mask | None, places: Array) -> Floats:
    """Of each place (i, j, k), the eighth largest scalar of its 26 neighbours; on the border, its
    nodes stand for those beyond. mask: where there is no scalar; None: nowhere."""
    neighbours = np.empty((27, len(places)))
    last = np.array(scalars.shape) - 1
    for number, offset in enumerate(np.ndindex(3, 3, 3)):
        at = tuple(np.clip(places + np.subtract(offset, 1), 0, last).T)
        none = ~np.isfinite(scalars[at]) if mask is None else ~np.isfinite(scalars[at]) | mask[at]
        neighbours[number] = np.where(none, -np.inf, scalars[at])
    neighbours[13] = -np.inf  # the place itself
    return np.ascontiguousarray(np.partition(neighbours, 27 - 8, axis=0)[27 - 8])


def assumed_importance(scalars: Array, mask: Mask | None) -> list[list[float]]:
    """Nodes of an importance of the scalars where nobody has said what is important, as the display
    has it: the largest few per cent. There is a warning. Raises ValueError if nothing stands out.

    mask: where there is no scalar; None: nowhere.
    """
    nodes = None if mask is None else np.flatnonzero(~mask.ravel(order="F"))
    count = scalars.size if nodes is None else nodes.size
    step = max(1, count // _core.most_samples_of_quantiles) | 1  # odd: meets all columns
    nodes = np.arange(0, count, step) if nodes is None else nodes[::step]
    places = np.stack(np.unravel_index(nodes, scalars.shape, order="F"), 1)
    samples = scalars[tuple(places.T)].astype(float)
    ordered = np.sort(samples[np.isfinite(samples)])
    ramp = _core.starting_importance(ordered)
    if ramp is None:
        raise ValueError("No importance is set, and all scalars are equal (no important structures "
                         "can be derived from them). Give an importance, or an "
                         "importance_function.")
    above = np.isfinite(samples) & (samples > ramp[0])
    eighths = eighth_largest_neighbours(scalars, mask, places[above])
    ramp = _core.clean_importance(ramp, ordered, samples[above], eighths)
    warn(f"No importance is set: the largest scalars are taken as important, from {ramp[0]:g} (0) "
         f"to {ramp[1]:g} (1) (what is cleared depends on this). Give "
         f"importance_function=[[{ramp[0]:g}, 0], [{ramp[1]:g}, 1]] if that is right, or an "
         "importance.")
    return [[ramp[0], 0.0], [ramp[1], 1.0]]


def scene_of(volume: Any, scalars: Any = None, importance: Any = None,
             importance_function: Rows | None = None, extinction: Any = None,
             extinction_function: Rows | None = None, opacity_function: Rows | None = None,
             unit_distance: Any = None, spacing: Any = None, origin: Any = None,
             direction: Any = None, importance_component: int | None = None,
             structures: Any = None, layout: Layout | None = None,
             targets: dict[int, float] | None = None) -> Scene:
    """A Scene from the arguments that optimize documents. Raises ValueError.

    layout: that the fields are wanted in; None: the one that takes fewest copies.
    """
    if importance_component is not None:
        importance_component = whole_number(
            "importance_component", importance_component, -1, 2 ** 31 - 1,
            "components are numbered from 0",
            "Give one of these, or -1 for the length of the tuple.")
    shares = importance if structures is not None else None
    importance = structures if structures is not None else importance
    source = Volume(volume, [scalars, extinction, importance], spacing, origin, direction)
    distance = unit_distance_of(unit_distance, source.grid)
    function = extinction_function_of(extinction_function, opacity_function, distance)
    if extinction is not None and function is not None:
        raise ValueError("extinction and a function of the scalars are given (both define the base "
                         "extinction). Give one of them.")
    if structures is not None and importance_function is not None:
        raise ValueError("structures and importance_function are given (both define the "
                         "importance). Give one of them.")

    own_extinction = extinction is not None
    mu = source.field("extinction", extinction) if own_extinction else \
        source.field("scalar", scalars)
    assumes = importance is None and importance_function is None and \
        not source.has_array("Importance") and (scalars is not None or volume is not None)
    if assumes or importance is None and importance_function is not None:
        g = source.field("scalar", scalars, component=importance_component)
    else:
        role = "importance" if structures is None else "structure"
        g = source.field(role, importance, "Importance", importance_component)
    if assumes:
        importance_function = assumed_importance(g, source.mask)
    data = (mu, g)
    layout = layout or Layout.for_all(data)

    majorant = function.largest() if function else 0.0
    if own_extinction:
        mu = converted(mu, layout)
    else:
        mu = mapped(mu, function or ramp_of(mu, source.mask, distance), layout)
    segmentation = None
    if structures is not None:
        segmentation = Segmentation.of(g, shares, targets or {}, layout)
        g = segmentation.importance(layout)
    elif importance_function is None:
        g = converted(g, layout)
    else:
        g = mapped(g, PiecewiseLinear("importance_function", importance_function, -math.inf,
                                      math.inf), layout)
    mu, g = corrected(emptied(mu, source.mask), emptied(g, source.mask), layout)
    return Scene(source, source.grid, layout, mu, g, majorant, distance, data, segmentation)
