# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Types of arguments, for annotations. The package knows none of the libraries whose images and
arrays it takes, so that these are Any."""

from __future__ import annotations

from typing import Any, Callable, Sequence, Union

import numpy as np
import numpy.typing as npt

#: An image of PyVista, VTK or SimpleITK, a DataArray of xarray, or an array of scalars.
VolumeLike = Any

#: An array with one number per point, or the name of an array of the image.
FieldLike = Any

#: A limpid.Camera or Viewpoint, a camera of PyVista or VTK, (position, focal point, view up), or a
#: mapping.
CameraLike = Any

#: A limpid.Light, a light of PyVista, a position, or a mapping.
LightLike = Any

#: Three numbers.
Vector = Union[Sequence[float], npt.NDArray[Any]]

#: Rows of numbers: nodes of a function, or vectors.
Rows = Union[Sequence[Sequence[float]], npt.NDArray[Any]]

#: What is called with the share of the work that is done, and a text; True: a progress bar.
Progress = Union[bool, Callable[[float, str], object], None]

Array = npt.NDArray[Any]
Mask = npt.NDArray[np.bool_]
Floats = npt.NDArray[np.float64]
Singles = npt.NDArray[np.float32]
Picture = npt.NDArray[np.uint8]  #: (height, width, 4), red, green, blue, alpha, top row first
