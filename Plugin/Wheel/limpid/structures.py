# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Structures: labels of a segmentation as importance."""

from __future__ import annotations

import collections.abc
import dataclasses
from typing import Any

import numpy as np

from . import _core
from .arguments import number_between, warn, whole_number
from .fields import Layout
from .given import Array, Singles

LARGEST = 2 ** 63 - 1
MOST = 2 ** 16 - 1  # rows of 16 bits


def importance_by_label(given: Any) -> dict[int, float]:
    """What is given as the importance of structures, checked: {label: importance}."""
    if not isinstance(given, collections.abc.Mapping):
        raise ValueError("structures are given, and importance is of the type "
                         f"{type(given).__name__} (it says how important each structure is). Give "
                         "a mapping, like {3: 1, 7: 0.5}.")
    return {whole_number("A label of importance", label, -LARGEST, LARGEST,
                         "labels are whole numbers", "Give a label of the structures."):
            number_between(f"The importance of the structure {label}", share, 0, 1,
                           "it is a share", "Give a number from 0 to 1.")
            for label, share in given.items()}


def targets_by_label(given: Any, structures: Any) -> dict[int, float]:
    """What is given as the targets of structures, checked: {label: share}."""
    if given is None:
        return {}
    if structures is None:
        raise ValueError("targets are given, and structures are not (a target is the share of a "
                         "structure that should be visible). Give structures, the labels.")
    if not isinstance(given, collections.abc.Mapping):
        raise ValueError(f"targets are of the type {type(given).__name__} (each structure has its "
                         "own). Give a mapping, like {3: 0.95}.")
    return {whole_number("A label of targets", label, -LARGEST, LARGEST,
                         "labels are whole numbers", "Give a label of the structures."):
            number_between(f"The target of the structure {label}", share, 0, 1, "it is a share",
                           "Give a number from 0 to 1.")
            for label, share in given.items()}


def settings_for(structures: Any, core_settings: _core.Settings) -> _core.Settings:
    """The core's settings for a scene of these structures; None: it has none. Labels have no noise
    to smooth."""
    if structures is not None:
        core_settings.importance_smoothing = _core.ImportanceSmoothing.off
    return core_settings


@dataclasses.dataclass(frozen=True, eq=False)
class Segmentation:
    """Structures, and which of them each point belongs to."""

    table: list[Any]  #: (label, name, importance, target or None), empty names stand for labels
    rows: Array  #: uint16, like a field: number of the structure, from 1 on; 0: none of them

    @classmethod
    def of(cls, labels: Array, given: Any, targets: dict[int, float],
           layout: Layout) -> Segmentation:
        """That of an array of labels.

        labels: an array of whole numbers; NaN is none.
        given: {label: importance}; others have none. None: structures with targets are important,
            and if there are none, all labels but 0 are one structure.
        targets: {label: share that should be visible}.
        """
        is_any = given is None and not targets
        if is_any:
            warn("structures are given without importance: all labels but 0 are equally important. "
                 "Give that of the structures that matter, like importance={3: 1, 7: 0.5}.")
            table: list[Any] = [(1, "all labels", 1.0, None)]
        else:
            shares = dict.fromkeys(targets, 1.0) if given is None else importance_by_label(given)
            table = [(label, "", shares.get(label, 0.0), targets.get(label))
                     for label in sorted({*shares, *targets})]
        if len(table) > MOST:
            raise ValueError(f"There are {len(table)} structures (results have at most {MOST}). "
                             "Give the importance of those that matter.")
        known = np.array([label for label, *_ in table], dtype=np.int64)
        rows = layout.empty(labels.shape, np.uint16)
        for values, slab in layout.slabs(labels, rows):
            whole = whole_numbers(values)
            if is_any:
                slab[...] = whole != 0
            else:
                row = np.searchsorted(known, whole)
                is_known = (row < len(known)) & (np.append(known, 0)[row] == whole)
                slab[...] = np.where(is_known, row + 1, 0)
        return cls(table, rows)

    def importance(self, layout: Layout) -> Singles:
        """The importance of each point, float32 of that layout."""
        of_rows = np.array([0] + [share for _, _, share, _ in self.table], dtype=np.float32)
        result = layout.empty(self.rows.shape)
        for rows, slab in layout.slabs(self.rows, result):
            slab[...] = of_rows[rows]
        return result


@dataclasses.dataclass(frozen=True)
class StructureShares:
    """What is seen of a structure, as shares of what the data have of it.

    Attributes
    ----------
    label : int
        Its label in the segmentation.
    importance : float
        Its importance, as given [0, 1].
    target : float or None
        Its target, as given [0, 1]; None: it has none.
    weight : float
        The importance that was used, with which the targets are met [0, 1].
    visible : float
        Share whose light reaches the camera [0, 1].
    base_visible : float
        The same share through the base extinction [0, 1].
    removed : float
        Share that was removed [0, 1].
    attainable : float
        The most that `visible` could be from this camera, whatever is cleared [0, 1].
    hidden_by : dict of int or None to float
        Share that each structure hides, by its label, None for other matter [0, 1]; empty if there
        are more than 256 structures.
    """

    label: int
    importance: float
    target: float | None
    weight: float
    visible: float
    base_visible: float
    removed: float
    attainable: float
    hidden_by: dict[int | None, float]

    def as_header(self) -> list[Any]:
        """What a file has of it."""
        values = [getattr(self, field.name) for field in dataclasses.fields(self)]
        return [*values[:-1], list(self.hidden_by.items())]

    @classmethod
    def from_header(cls, row: list[Any]) -> StructureShares:
        """That of a file."""
        names = [field.name for field in dataclasses.fields(cls)]
        values = dict(zip(names, row))
        return cls(**{**values, "hidden_by": dict(map(tuple, values["hidden_by"]))})

    @classmethod
    def all_of(cls, segmentation: Segmentation, found: list[Any]) -> dict[int, StructureShares]:
        """By label; `found`: rows as the core has them."""
        labels = [label for label, *_ in segmentation.table]
        return {label: cls(label, importance, target, weight, visible, base_visible, removed,
                           attainable, dict(zip([None, *labels], hidden)))
                for (label, _, importance, target),
                (weight, visible, base_visible, removed, attainable, hidden)
                in zip(segmentation.table, found)}


def whole_numbers(values: Array) -> Array:
    """Labels as int64, of which NaN is 0. Raises ValueError if one is no whole number."""
    if values.dtype.kind != "f":
        return values.astype(np.int64)
    known = np.where(np.isnan(values), 0, values)
    wrong = known[~(known == np.floor(known))]
    if wrong.size:
        raise ValueError(f"structures have the value {wrong[0]:g} (labels are whole numbers; "
                         "interpolation between them makes structures up). Give an array of "
                         "labels; resample it by nearest neighbour.")
    return known.astype(np.int64)
