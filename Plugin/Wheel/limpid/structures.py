# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Structures: labels of a segmentation as importance."""

import collections.abc
import dataclasses

import numpy as np

from . import _core
from .arguments import number_between, warn, whole_number

LARGEST = 2 ** 63 - 1
MOST = 2 ** 16 - 1  # rows of 16 bits


def importance_by_label(given):
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


def targets_by_label(given, structures):
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


def settings_for(structures, core_settings):
    """The core's settings for a scene of these structures; None: it has none. Labels have no noise
    to smooth."""
    if structures is not None:
        core_settings.importance_smoothing = _core.ImportanceSmoothing.off
    return core_settings


@dataclasses.dataclass(frozen=True, eq=False)
class Segmentation:
    """Structures, and which of them each point belongs to."""

    table: list  #: (label, name, importance, target or None), empty names stand for labels
    rows: np.ndarray  #: uint16, like a field: number of the structure, from 1 on; 0: none of them

    @classmethod
    def of(cls, labels, given, targets, layout):
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
            table = [(1, "all labels", 1.0, None)]
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

    def importance(self, layout):
        """The importance of each point, float32 of that layout."""
        of_rows = np.array([0] + [share for _, _, share, _ in self.table], dtype=np.float32)
        result = layout.empty(self.rows.shape)
        for rows, slab in layout.slabs(self.rows, result):
            slab[...] = of_rows[rows]
        return result


@dataclasses.dataclass(frozen=True)
class StructureShares:
    """What is seen of a structure, as shares of what the data have of it [0, 1]."""

    label: int
    importance: float  #: as given
    target: float  #: as given; None: there is none
    weight: float  #: the importance that was used, with which the targets are met
    visible: float  #: its light reaches the camera
    base_visible: float  #: the same through the base extinction
    removed: float
    attainable: float  #: the most that `visible` could be from this camera, whatever is cleared
    hidden_by: dict  #: by label, None for other matter; empty for more than 256 structures

    @classmethod
    def all_of(cls, segmentation, found):
        """By label; `found`: rows as the core has them."""
        labels = [label for label, *_ in segmentation.table]
        return {label: cls(label, importance, target, *shares, dict(zip([None, *labels], hidden)))
                for (label, _, importance, target), (*shares, hidden)
                in zip(segmentation.table, found)}


def whole_numbers(values):
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
