# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Optimises a small core in a shell by the installed Python package and looks at what came out."""

import sys

import limpid
import numpy as np

axis = np.linspace(-1, 1, 32)
radius = np.sqrt(sum(np.square(part) for part in np.meshgrid(axis, axis, axis, indexing="ij")))
scalars = np.where(radius < 0.3, 2, np.where((radius > 0.6) & (radius < 0.8), 1, 0))
found = limpid.optimize(scalars.astype(np.float32), spacing=[axis[1] - axis[0]] * 3,
                        extinction_function=[[0, 0], [1, 5], [2, 5]],
                        importance_function=[[1.5, 0], [2, 1]])

print(found)
if not 1 >= found.visible_fraction > found.base_visible_fraction > 0:
    sys.exit("The optimisation does not let more of the important structures be seen.")
