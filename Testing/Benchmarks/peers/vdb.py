# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""vdb_render of OpenVDB for the head of head.py.

It draws a density by the coefficients of its options: with scatter 1 and absorb 0 the density is
the extinction per voxel, and without gain its shadows are exact transmittances. Its light is
directional, here along the line from the light to the middle of the volume, and white. There is no
switch for shadows: with steps longer than the volume shadow rays are set up and find no sample.
"""

import importlib.util
import shutil
import subprocess
import sys

import numpy as np

PROGRAM = "vdb_render"
CUTOFF = 3 / 1024**2  # of the sum of squares of three transmittances: Limpid's 1 / 1024 each
NO_SHADOW = 1e9  # voxels
STARTER = """
import resource, subprocess, sys, time
start = time.perf_counter()
subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(time.perf_counter() - start, used.ru_utime + used.ru_stime, used.ru_maxrss)
"""


def missing():
    """What is not there, as a person would install it."""
    found = [] if shutil.which(PROGRAM) else ["libopenvdb-tools"]
    return found + ([] if importlib.util.find_spec("pyopenvdb") else ["python3-openvdb"])


def version():
    import pyopenvdb  # pylint: disable=import-outside-toplevel; may not be there

    return "OpenVDB " + ".".join(map(str, pyopenvdb.LIBRARY_VERSION))


def write_grid(head, path):
    import pyopenvdb  # pylint: disable=import-outside-toplevel; may not be there

    grid = pyopenvdb.FloatGrid()
    grid.name = "density"
    # Strides are not heeded, so the last axis must be the fastest in memory.
    grid.copyFromArray(np.ascontiguousarray(head.extinction() * np.float32(head.spacing)))
    spacing, origin = head.spacing, head.image.GetOrigin()
    grid.transform = pyopenvdb.createLinearTransform(
        [[spacing, 0, 0, 0], [0, spacing, 0, 0], [0, 0, spacing, 0], [*origin, 1]])
    pyopenvdb.write(path, grids=[grid])


def command(head, grid, picture, size, **options):
    """With the camera and the light of the head as they are."""
    camera = head.camera
    options = {"translate": camera.GetPosition(), "lookat": camera.GetFocalPoint(),
               "up": camera.GetViewUp(), "fov": [camera.GetViewAngle()],
               "light": [*head.light.GetPosition(), 1, 1, 1], "absorb": [0, 0, 0],
               "scatter": [1, 1, 1], "gain": [0], **{k: [v] for k, v in options.items()}}
    words = [PROGRAM, grid, picture, "-res", f"{size}x{size}"]
    for name, values in options.items():
        words += [f"-{name}", ",".join(f"{value:.9g}" for value in values)]
    return words


def run(words):
    """Seconds, those of all cores together, and the bytes at the peak, of a process. A small
    process starts it: what a large one has counts for what it starts."""
    starter = subprocess.run([sys.executable, "-S", "-c", STARTER, *words], check=False,
                             stdout=subprocess.PIPE)
    if starter.returncode != 0:
        raise SystemExit(f"{' '.join(words)} failed (it draws the peer's picture). What it said "
                         "stands above.")
    wall, cores, kibibytes = map(float, starter.stdout.split()[-3:])
    return wall, cores, 1024 * int(kibibytes)


def read_picture(path):
    """Of a binary PPM: rows from the top, colours from 0 to 255."""
    with open(path, "rb") as file:
        _, size, _ = (file.readline() for _ in range(3))
        columns, rows = map(int, size.split())
        return np.frombuffer(file.read(), np.uint8).reshape(rows, columns, 3).astype(float)
