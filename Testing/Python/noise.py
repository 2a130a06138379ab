# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Noisy values, [z][y][x], and how noisy they are."""

import numpy as np

NOISE = 0.09  # standard deviation


def noisy_ball():
    """A ball of 1 in one of 0.5 in nothing, with Rician noise."""
    z, y, x = np.mgrid[-19.5:19.5:40j, -19.5:19.5:40j, -19.5:19.5:40j]
    radius = np.sqrt(x ** 2 + y ** 2 + z ** 2)
    clean = np.where(radius < 7, 1, np.where(radius < 17, 0.5, 0))
    parts = np.random.default_rng(3).normal(0, NOISE, (2, *clean.shape))
    return np.hypot(clean + parts[0], parts[1])


def speck_share(values, begin, end):
    """The share of the importance of a ramp above the eighth largest of 26 neighbours."""
    wide = np.pad(values, 1, mode="edge")
    around = [wide[k:k + values.shape[0], j:j + values.shape[1], i:i + values.shape[2]]
              for k, j, i in np.ndindex(3, 3, 3) if (k, j, i) != (1, 1, 1)]
    eighth = np.sort(around, axis=0)[-8]
    own, others = (np.clip((of - begin) / (end - begin), 0, 1) for of in (values, eighth))
    return np.maximum(own - others, 0).sum() / own.sum()
