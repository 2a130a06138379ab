# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Peak memory of the filters, beyond their input and in bytes per point: what the messages of
# Filters/Memory.h say. One run, in a process of its own, with PYTHONPATH as for Testing/Python:
#   python3 Testing/Benchmarks/filter_memory.py 512 vtkExtinctionOptimizer Solver=1 Mode=1
# What does not fit is refused with a message: put "ulimit -v <KiB>" before it.

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Python"))

from limpid import vtkLimpidFilters  # noqa: E402

from images import filter_on, phantom  # noqa: E402


def bytes_in(key):
    with open("/proc/self/status") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith(key))


def main():
    points, name, *settings = sys.argv[1:]
    filter_ = filter_on(phantom(8), getattr(vtkLimpidFilters, name))
    if name == "vtkViewpointSearch":
        filter_.SetNumberOfDirections(12)
    filter_.SetMaximumIterations(3)
    filter_.SetIterationsPerLevel(1, 1, 2)
    for setting in settings:
        key, value = setting.split("=")
        getattr(filter_, "Set" + key)(int(value))
    filter_.Update()  # its threads are there
    filter_.SetInputData(phantom(int(points)))
    with open("/proc/self/clear_refs", "w") as file:
        file.write("5")  # forgets the peak so far
    before = bytes_in("VmRSS")
    filter_.Update()
    print(*(filter_.messages["ErrorEvent"] or
            [f"{(bytes_in('VmHWM') - before) / int(points) ** 3:.1f} bytes per point"]))


if __name__ == "__main__":
    main()
