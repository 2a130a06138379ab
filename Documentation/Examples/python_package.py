# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The Python package with numpy alone, on generated data.

  python3 python_package.py [FOLDER]

writes pictures before and after, the best view, and the result into FOLDER (python-package).
It needs the Python package of Plugin/Wheel. `mypy --strict` has no complaints about it.
"""

from __future__ import annotations

import pathlib
import sys
from typing import Any

import numpy as np
import numpy.typing as npt

import limpid

#: Nodes [scalar, extinction], [scalar, importance] and [scalar, red, green, blue].
EXTINCTION = [[0.0, 0.0], [0.2, 0.0], [0.4, 8.0], [0.55, 20.0], [0.7, 4.0], [1.0, 6.0]]  # [1/length]
IMPORTANCE = [[0.7, 0.0], [0.8, 1.0]]
COLORS = [[0.0, 0.3, 0.4, 0.7], [0.5, 0.75, 0.72, 0.65], [0.7, 0.95, 0.6, 0.2],
          [1.0, 0.85, 0.1, 0.1]]


def phantom(count: int = 64) -> npt.NDArray[np.float32]:
    """A ring and a ball in an opaque shell, in a cube from -1 to 1.

    Parameters
    ----------
    count : int, default 64
        Points along each axis.

    Returns
    -------
    numpy.ndarray of float32, shape (count, count, count)
        Scalars from 0 to 1, indexed [x, y, z].
    """
    x, y, z = np.meshgrid(*3 * [np.linspace(-1, 1, count)], indexing="ij")
    radius = np.sqrt(x * x + y * y + z * z)
    from_ring = np.hypot(np.hypot(x, y) - 0.42, z)
    values = 0.55 * np.exp(-((radius - 0.8) / 0.06) ** 2)  # the shell
    values = np.maximum(values, 0.95 * np.exp(-(from_ring / 0.1) ** 4))
    return np.maximum(values, 0.85 * np.exp(-(radius / 0.17) ** 4)).astype(np.float32)


def placement(count: int) -> dict[str, Any]:
    """Where the points of the phantom are: spacing and origin [length]."""
    return {"spacing": 3 * (2 / (count - 1),), "origin": (-1.0, -1.0, -1.0)}


def picture(scalars: npt.NDArray[np.float32], camera: limpid.Camera | limpid.Viewpoint,
            extinction: npt.NDArray[np.float32] | None = None,
            size: int = 400) -> npt.NDArray[np.uint8]:
    """The phantom, drawn by Limpid; without an extinction as the transfer functions have it."""
    return limpid.render(scalars, **placement(len(scalars)), color_function=COLORS,
                         extinction_function=EXTINCTION, extinction=extinction, camera=camera,
                         width=size, height=size)


def main(folder: pathlib.Path) -> limpid.Optimization:
    """Finds what hides the ring and the ball, and writes what that changes into the folder."""
    folder.mkdir(exist_ok=True)
    scalars = phantom()
    scene = {**placement(len(scalars)), "extinction_function": EXTINCTION,
             "importance_function": IMPORTANCE}
    camera = limpid.Camera(position=(4.0, 2.5, 3.0), focal_point=(0.0, 0.0, 0.0))

    found = limpid.optimize(scalars, camera=camera, progress=True, **scene)
    print(found)
    (folder / "before.png").write_bytes(limpid.png(picture(scalars, camera)))
    (folder / "after.png").write_bytes(limpid.png(picture(scalars, camera, found.extinction)))

    views = limpid.viewpoints(scalars, number_of_directions=162, progress=True, **scene)
    best: limpid.Viewpoint = views[0]
    print(views)
    there = limpid.optimize(scalars, camera=best, view_weight=20.0, **scene)
    (folder / "best_view.png").write_bytes(limpid.png(picture(scalars, best, there.extinction)))

    found.save(folder / "found.npz")
    again: limpid.Optimization = limpid.load(folder / "found.npz")
    return again


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "python-package"))
