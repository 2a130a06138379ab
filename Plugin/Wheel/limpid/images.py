# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Results as data sets of PyVista, which is loaded for them alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Mapping

import numpy as np
import numpy.typing as npt

from .grid import Grid

if TYPE_CHECKING:
    import pyvista


def loaded_pyvista() -> Any:
    """The module. Raises ImportError with what to do if it is not installed."""
    try:
        import pyvista as module
    except ImportError as error:
        raise ImportError("PyVista is not installed (the result is one of its data sets). Install "
                          "it: pip install pyvista.") from error
    return module


def image_of(grid: Grid, active: str, fields: Mapping[str, npt.NDArray[Any]],
             field_data: Mapping[str, Any]) -> pyvista.ImageData:
    """An image of PyVista.

    active: the name of its active scalars.
    fields: of shape grid.shape, by their names. Not copied if x is fastest in memory.
    field_data: numbers and texts, by their names.
    """
    image: pyvista.ImageData = loaded_pyvista().ImageData(
        dimensions=grid.shape, spacing=np.abs(grid.spacing), origin=grid.origin,
        direction_matrix=grid.direction * np.sign(grid.spacing))
    for name, field in fields.items():
        image.point_data[name] = field.ravel(order="F")
    for name, value in field_data.items():
        image.field_data[name] = [value]
    image.set_active_scalars(active)
    return image
