# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Fields as the core reads them: float32, dense, one order of axes for all fields of a scene."""

from __future__ import annotations

from typing import Any, Callable, Iterator, Mapping, Sequence

import numpy as np

from .arguments import warn
from .given import Array, Mask, Singles

SLAB = 1 << 20  # points that are converted at a time: what is needed meanwhile stays small


class Layout:
    """An order of axes in memory.

    The core has the first axis of its grid fastest in memory. It does not mind which of x, y and z
    that is, so arrays of any dense order are used where they are, and the grid's axes are permuted.

    order: the axes, fastest in memory first: (0, 1, 2) is Fortran's order and VTK's, (2, 1, 0) C's.
    """

    def __init__(self, order: Sequence[int] = (0, 1, 2)) -> None:
        self.order = tuple(order)

    @classmethod
    def of(cls, array: Array) -> Layout | None:
        """That of an array with three axes; None if there are gaps between its values."""
        layout = cls(sorted(range(3), key=lambda axis: array.strides[axis]))
        return layout if layout.fits(array) else None

    @classmethod
    def for_all(cls, arrays: Sequence[Array]) -> Layout:
        """That of the first array which can be used as it is, else of the first dense one."""
        layouts = [(array.dtype != np.float32, cls.of(array)) for array in arrays]
        dense = [(copied, layout) for copied, layout in layouts if layout]
        return min(dense, key=lambda pair: pair[0])[1] if dense else cls()

    def fits(self, array: Array) -> bool:
        """Whether an array has this order, without gaps."""
        return bool(array.transpose(self.order).flags.f_contiguous)

    def empty(self, shape: tuple[int, ...], dtype: Any = np.float32) -> Array:
        """An array of this order, its values not set."""
        return self.shaped(np.empty(int(np.prod(shape)), dtype=dtype), shape)

    def flat(self, array: Array) -> Array:
        """The values of an array of this order as they lie in memory, not copied."""
        return array.transpose(self.order).reshape(-1, order="F")

    def shaped(self, values: Array, shape: tuple[int, ...]) -> Array:
        """Values as they lie in memory as an array of that shape, not copied."""
        permuted = values.reshape([shape[axis] for axis in self.order], order="F")
        return permuted.transpose(np.argsort(self.order))

    def slabs(self, *arrays: Array) -> Iterator[tuple[Array, ...]]:
        """Parts of arrays of one shape, the same part of each, that lie together in memory."""
        permuted = [array.transpose(self.order) for array in arrays]
        columns, rows, slices = permuted[0].shape
        step = max(1, SLAB // (columns * rows))
        for first in range(0, slices, step):
            yield tuple(array[..., first:first + step] for array in permuted)


def converted(array: Array, layout: Layout) -> Singles:
    """The array itself if it is float32 of that layout, else a copy that is."""
    if array.dtype == np.float32 and layout.fits(array):
        return array
    copy = layout.empty(array.shape)
    with np.errstate(over="ignore"):  # too large for single precision: infinite
        copy[...] = array
    return copy


def mapped(array: Array, function: Callable[[Array], Array], layout: Layout) -> Singles:
    """A new field: function(value) of each value, NaN where a value is not finite.

    function: takes and returns arrays of float64.
    """
    result = layout.empty(array.shape)
    table = table_of_values(array.dtype, function)
    for values, slab in layout.slabs(array, result):
        if table is not None:
            slab[...] = table[values.view(f"u{array.itemsize}")]
        else:
            slab[...] = function(values)
            if array.dtype.kind == "f":
                slab[~np.isfinite(values)] = np.nan
    return result


def table_of_values(dtype: np.dtype[Any], function: Callable[[Array], Array]) -> Array | None:
    """function(value) of each value that 8 or 16 bits can have, in the order of these bits read as
    an unsigned number; None for other types."""
    if dtype.kind not in "iu" or dtype.itemsize > 2 or not dtype.isnative:
        return None
    bits = np.arange(1 << 8 * dtype.itemsize, dtype=f"u{dtype.itemsize}")
    return function(bits.view(dtype)).astype(np.float32)


def are_within(array: Array, most: float) -> bool:
    """Whether no value is negative, above `most`, or NaN."""
    with np.errstate(invalid="ignore"):
        return bool(array.min() >= 0 and array.max() <= most)


def emptied(field: Singles, mask: Mask | None) -> Singles:
    """A field that is 0 where a mask says that there is no value; None: there is one everywhere.
    The array that is given is not changed."""
    if mask is None:
        return field
    copy = field.copy(order="K")
    copy[mask] = 0
    return copy


def corrected(extinction: Singles, importance: Singles,
              layout: Layout) -> tuple[Singles, Singles]:
    """Both fields of a scene with values that can be used, as the filters have them: a point with
    NaN, infinity or a negative extinction is empty, importance is moved into [0, 1], and there is
    a warning. Arrays in which all is well are returned themselves; others are not changed.

    extinction, importance: of that layout.
    """
    if are_within(extinction, float(np.finfo(np.float32).max)) and are_within(importance, 1):
        return extinction, importance
    extinction, importance = extinction.copy(order="K"), importance.copy(order="K")
    invalid = negative = clamped = 0
    for mu, g in layout.slabs(extinction, importance):
        is_invalid = ~(np.isfinite(mu) & np.isfinite(g))
        is_negative = ~is_invalid & (mu < 0)
        is_empty = is_invalid | is_negative
        mu[is_empty] = 0
        g[is_empty] = 0
        invalid += int(np.count_nonzero(is_invalid))
        negative += int(np.count_nonzero(is_negative))
        clamped += int(np.count_nonzero((g < 0) | (g > 1)))
        np.clip(g, 0, 1, out=g)
    warn_of_points({
        "a NaN or an infinite value (the scene is undefined there) and are treated as empty. "
        "Replace these values if they should count.": invalid,
        "a negative extinction (it would amplify light) and are treated as empty. Give an "
        "extinction of zero or more.": negative,
        "an importance outside [0, 1] (the energy is not defined there) and are clamped to this "
        "range. Map the values to importance with importance_function.": clamped}, extinction.size)
    return extinction, importance


def warn_of_points(counts: Mapping[str, int], total: int) -> None:
    """One warning for all that is wrong with some points: texts and how many points each is of."""
    texts = [f"{count} of {total} points have {what}" for what, count in counts.items() if count]
    warn(" ".join(texts))
