# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Arrays that say which of their axes is x: those of xarray, and images of SimpleITK. The package
knows neither library."""

from __future__ import annotations

import sys
from typing import Any, Sequence

import numpy as np

from .given import Array

XYZ = ("x", "y", "z")


def has_named_axes(array: Any) -> bool:
    """Whether it is a DataArray of xarray."""
    return all(hasattr(array, name) for name in ("dims", "coords", "shape"))


def is_simple_itk(image: Any) -> bool:
    """Whether it is an image of SimpleITK."""
    return all(hasattr(image, name) for name in (
        "GetSize", "GetSpacing", "GetOrigin", "GetDirection", "GetNumberOfComponentsPerPixel"))


def has_shape(given: Any) -> bool:
    """Whether it is an array of any kind that tells where the points of a volume are."""
    return hasattr(given, "shape") or is_simple_itk(given)


def axes_of(array: Any) -> tuple[int, ...] | None:
    """The axes of an array that are x, y and z, and the others behind them; None: it does not say.
    Raises ValueError where names of axes do not tell."""
    if is_simple_itk(array):
        if array.GetDimension() != 3:
            raise ValueError(f"The image of SimpleITK has {array.GetDimension()} dimensions (a "
                             "volume has three axes). Give an image with three.")
        return (2, 1, 0, 3)[:3 + (array.GetNumberOfComponentsPerPixel() > 1)]
    if not has_named_axes(array):
        return None
    names = [str(name).lower() for name in array.dims]
    if any(names.count(axis) != 1 for axis in XYZ):
        raise ValueError(f"The array has the dims {tuple(array.dims)} (x, y and z cannot be "
                         "identified). Rename them with array.rename(...), or give array.values, "
                         "indexed [x, y, z].")
    return (*(names.index(axis) for axis in XYZ),
            *(axis for axis, name in enumerate(names) if name not in XYZ))


def values_of(array: Any) -> Array:
    """An array as numpy has it, in the order of its own axes."""
    if is_simple_itk(array):
        library = sys.modules[type(array).__module__.partition(".")[0]]
        return np.asarray(library.GetArrayViewFromImage(array))
    return np.asarray(array)


def placement_of(array: Any) -> dict[str, Any]:
    """What an array says of spacing, origin and direction, see Grid; what it does not say is
    missing. Raises ValueError where its points are not evenly spaced."""
    if is_simple_itk(array):
        return {"spacing": array.GetSpacing(), "origin": array.GetOrigin(),
                "direction": np.reshape(array.GetDirection(), (3, 3))}
    if not has_named_axes(array):
        return {}
    names = [array.dims[axis] for axis in (axes_of(array) or ())[:3]]
    if not any(name in array.coords for name in names):
        return {}
    first, step = zip(*(first_and_step(name, array) for name in names))
    return {"spacing": step, "origin": first}


def first_and_step(name: Any, array: Any) -> tuple[float, float]:
    """Where the points along an axis begin, and their distance; without coordinates 0 and 1."""
    if name not in array.coords:
        return 0.0, 1.0
    try:
        positions = np.asarray(array.coords[name], dtype=float)
    except (TypeError, ValueError):
        positions = np.array([np.nan])
    steps = np.diff(positions)
    mean = steps.mean() if len(steps) else 1.0
    if not (np.isfinite(mean) and mean > 0 and np.abs(steps - mean).max(initial=0) <= 1e-3 * mean):
        raise ValueError(f"The coordinates of the array along {name!r} are not ascending numbers "
                         "at even steps (rays are traced through evenly spaced points). Sort or "
                         f"interpolate it, for instance with array.sortby({name!r}), or leave them "
                         f"out with array.drop_vars({name!r}).")
    return float(positions[0]), float(mean)


def odd_one(values: Any) -> int | None:
    """Which of three numbers differs from the other two, which are alike; None: there is none."""
    values = np.asarray(values, dtype=float)
    for axis in range(3):
        one, other = np.delete(values, axis)
        alike = abs(one - other) <= 1e-6 * abs(one)
        if alike and abs(values[axis] - one) > 1e-6 * abs(one):
            return axis
    return None


def doubt_about_axes(shape: Sequence[int], spacing: Sequence[float]) -> str | None:
    """What to say where a spacing seems to be that of the axes in another order; None: nothing.

    Scanners make slices of as many columns as rows, which are as far apart, and another number of
    slices.
    """
    of_shape, of_spacing = odd_one(shape), odd_one(spacing)
    if of_shape is None or of_spacing is None or of_shape == of_spacing:
        return None
    return (f"The array has the shape {tuple(shape)}, in which {XYZ[of_shape]} differs, and the "
            f"spacing {tuple(float(step) for step in spacing)}, in which {XYZ[of_spacing]} differs "
            "(arrays are indexed [x, y, z], those of SimpleITK, scikit-image and DICOM files [z, "
            "y, x]: the volume may be distorted). Give array.transpose(2, 1, 0), which is not a "
            "copy, or the spacing in the order of the axes.")
