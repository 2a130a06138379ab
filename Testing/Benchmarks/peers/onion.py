# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The onion scene (BoxScene::FillOnion in Testing/Core/BoxScene.h; energy.py has the formula)."""

import math

import numpy as np

RADIUS = math.sqrt(3.0)  # of the box [-1, 1]^3
MAJORANT = 20 / RADIUS
REGULARIZATION, VIEW, LIGHT = 1e-3, 10.0, 1.0  # p, q, r
CAMERA = RADIUS * np.array([0.9, 1.3, -3.0])
LAMP = RADIUS * np.array([-1.0, 3.0, -0.7])
CORE = np.array([0.1, -0.1, 0.15])
EVALUATED = np.float32(0.8)  # of the base extinction: so no term is zero


def onion(nodes):
    """Base extinction and importance of the onion scene as float32, indices (z, y, x)."""
    axis = np.linspace(-1.0, 1.0, nodes)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij", sparse=True)
    to_centre = np.sqrt(x**2 + y**2 + z**2)
    to_core = np.sqrt((x - CORE[0]) ** 2 + (y - CORE[1]) ** 2 + (z - CORE[2]) ** 2)
    shell = np.exp(-(((to_centre - 0.75) / 0.12) ** 2))
    value = 0.5 * shell + np.exp(-((to_core / 0.35) ** 2))
    extinction = np.where(value < 0.02, 0.0, MAJORANT * np.minimum(1.0, value))
    importance = np.clip(1.6 - 4 * to_core, 0.0, 1.0)
    return extinction.astype(np.float32), importance.astype(np.float32)


def directions(extinction, importance):
    """Shares of the base extinction: of what is important, of what is not, and a wave."""
    base = extinction.astype(np.float64)
    axis = np.linspace(-1.0, 1.0, base.shape[0])
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij", sparse=True)
    return {
        "important": base * importance,
        "unimportant": base * (1.0 - importance),
        "wave": base * np.sin(3 * (x + 2 * y - z)),
    }
