# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Structures: labels of a segmentation as importance."""

import collections.abc

import numpy as np

from . import _core
from .arguments import number_between, warn, whole_number

LARGEST = 2 ** 63 - 1


def importance_by_label(given):
    """What is given as the importance of structures, checked: {label: importance}."""
    if not isinstance(given, collections.abc.Mapping):
        raise ValueError("structures are given, and importance is of the type "
                         f"{type(given).__name__} (it says how important each structure is). Give a "
                         "mapping, like {3: 1, 7: 0.5}.")
    return {whole_number("A label of importance", label, -LARGEST, LARGEST,
                         "labels are whole numbers", "Give a label of the structures."):
            number_between(f"The importance of the structure {label}", share, 0, 1,
                           "it is a share", "Give a number from 0 to 1.")
            for label, share in given.items()}


def settings_for(structures, core_settings):
    """The core's settings for a scene of these structures; None: it has none. Labels have no noise
    to smooth."""
    if structures is not None:
        core_settings.importance_smoothing = _core.ImportanceSmoothing.off
    return core_settings


def importance_of(labels, given, layout):
    """The importance of each point, float32 of that layout.

    labels: an array of whole numbers; NaN is none.
    given: {label: importance}; labels that are not in it have none. None: all but 0 are important.
    """
    if given is None:
        warn("structures are given without importance: all labels but 0 are equally important. "
             "Give that of the structures that matter, like importance={3: 1, 7: 0.5}.")
        known = shares = None
    else:
        pairs = sorted(importance_by_label(given).items())
        known = np.array([label for label, _ in pairs], dtype=np.int64)
        shares = np.array([share for _, share in pairs] + [0], dtype=np.float32)
    result = layout.empty(labels.shape)
    for values, slab in layout.slabs(labels, result):
        whole = whole_numbers(values)
        if known is None:
            slab[...] = whole != 0
        else:
            rows = np.searchsorted(known, whole)
            is_known = np.append(known, 0)[rows] == whole
            slab[...] = shares[np.where(is_known & (rows < len(known)), rows, len(known))]
    return result


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
