# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Transfer functions: of scalars, straight lines between nodes and constant outside."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from .given import Array, Floats, Rows

#: Largest opacity that has an extinction, as in the filters: -ln(1 - opacity) is infinite at 1.
LARGEST_OPACITY = 1 - 1e-6


class ExtinctionFunction(Protocol):
    """A function of the scalar [1/length]."""

    def __call__(self, values: Array) -> Array:
        """The extinction of scalars."""

    def range(self) -> tuple[float, float]:
        """Outside of it, the function is constant."""

    def largest(self) -> float:
        """Its largest extinction."""


class PiecewiseLinear:
    """A function of one number.

    name: of the argument, for messages.
    nodes: pairs [value, result], values ascending.
    least, most: of the results.
    """

    def __init__(self, name: str, nodes: Rows, least: float = 0.0,
                 most: float = float(np.finfo(np.float32).max)) -> None:
        table = table_of(name, nodes, 2)
        if not np.all((table[:, 1] >= least) & (table[:, 1] <= most)):
            wrong = table[~((table[:, 1] >= least) & (table[:, 1] <= most))][0]
            raise ValueError(f"{name} has the node {wrong.tolist()} (results must lie between "
                             f"{least:g} and {most:g}). Give results in that range.")
        self.positions, self.results = np.ascontiguousarray(table.T)

    def __call__(self, values: Array) -> Array:
        return np.asarray(np.interp(values, self.positions, self.results))

    def range(self) -> tuple[float, float]:
        """Outside of it, the function is constant."""
        return float(self.positions[0]), float(self.positions[-1])

    def largest(self) -> float:
        """Its largest result, wherever it has it."""
        return float(self.results.max())


def table_of(name: str, nodes: Rows, columns: int) -> Floats:
    """Nodes as an array of shape (n, columns), checked: finite, first column ascending."""
    try:
        table = np.asarray(nodes, dtype=float)
    except (TypeError, ValueError):
        table = np.empty(0)
    if table.ndim != 2 or table.shape[0] < 1 or table.shape[1] != columns:
        kind = {2: "[value, result]", 4: "[value, red, green, blue]"}[columns]
        raise ValueError(f"{name} is not a list of nodes {kind} (the volume is classified with "
                         f"it). Give nodes like {[0.0] * columns}.")
    if not np.all(np.isfinite(table)):
        raise ValueError(f"{name} has the node "
                         f"{table[~np.isfinite(table).all(axis=1)][0].tolist()} (functions are "
                         "defined on finite values). Give finite numbers.")
    if np.any(np.diff(table[:, 0]) < 0):
        at = int(np.argmax(np.diff(table[:, 0]) < 0))
        raise ValueError(f"{name} has the value {table[at + 1, 0]:g} after {table[at, 0]:g} (nodes "
                         "are interpolated in this order). Sort nodes by their values.")
    return table


class ExtinctionOfOpacity:
    """Extinction of what takes opacity(value) of the light on a distance: -ln(1 - opacity) over
    the distance, which inverts VTK's correction of opacities for the length of a step.

    opacity: a function of the scalar; results are moved into [0, LARGEST_OPACITY].
    unit_distance: [length].
    """

    def __init__(self, opacity: PiecewiseLinear, unit_distance: float) -> None:
        self.opacity = opacity
        self.unit_distance = unit_distance

    def __call__(self, values: Array) -> Array:
        return np.asarray(self._extinction(self.opacity(values)))

    def range(self) -> tuple[float, float]:
        """Outside of it, the function is constant."""
        return self.opacity.range()

    def largest(self) -> float:
        """Its largest extinction, wherever it has it [1/length]."""
        return float(self._extinction(self.opacity.largest()))

    def _extinction(self, opacity: Any) -> Any:
        return -np.log1p(-np.clip(opacity, 0.0, LARGEST_OPACITY)) / self.unit_distance
