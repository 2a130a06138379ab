# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What the filter shows below a memory limit, where it sweeps the data once after a coarser grid, beside full
# resolution: the scenes of LIMPID_TEST_DATA with their own functions and with ParaView's default ramp of
# opacities. With PYTHONPATH as for Testing/Python:
#   python3 Testing/Benchmarks/swept.py [BYTES]
# BYTES: of memory per point for the control grid; 8, the default, are enough for half resolution. Prints rows
# of the table in Documentation/Benchmarks/LargeImages.md.

import sys
import time

from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction

import steadiness


def optimizer_for(scene, ramp):
    optimizer = steadiness.optimizer_for(scene)
    optimizer.AutomaticPlacementOn()
    optimizer.RemoveAllResultArrays()
    optimizer.AddResultArray("Extinction")
    if ramp:
        low, high = scene[0].GetPointData().GetScalars().GetRange()
        opacity = vtkPiecewiseFunction()
        opacity.AddPoint(low, 0)
        opacity.AddPoint(high, 1)
        optimizer.SetScalarOpacityFunction(opacity)
        optimizer.SetScalarOpacityUnitDistance(0)
    return optimizer


def found_by(optimizer):
    start = time.perf_counter()
    optimizer.Update()
    seconds = time.perf_counter() - start
    fields = optimizer.GetOutput().GetFieldData()
    return {"seconds": seconds, **{name: fields.GetArray(name).GetValue(0) for name in (
        "VisibilityScore", "BaseVisibilityScore", "VisibleFraction", "ControlFactor")}}


def gain(found):
    return found["VisibilityScore"] - found["BaseVisibilityScore"]


def main():
    of_control = float(sys.argv[1]) if len(sys.argv) > 1 else 8
    for name in steadiness.all_scenes():
        scene = steadiness.load(name)
        for ramp in (False, True):
            full = found_by(optimizer_for(scene, ramp))
            limited = optimizer_for(scene, ramp)
            points = scene[0].GetNumberOfPoints()
            of_slices = min(1600 / points ** (1 / 3), 17)  # see vtkExtinctionOptimizerInternals.cxx
            limited.SetMemoryLimit(points * (4 + of_slices + of_control) * 1e-6)
            swept = found_by(limited)
            print(f"| {name}{', ramp' if ramp else ''} | 1/{swept['ControlFactor']} "
                  f"| {100 * gain(swept) / gain(full):.1f} % | {100 * full['VisibleFraction']:.2f} % "
                  f"| {100 * swept['VisibleFraction']:.2f} % | {full['seconds']:.2f} | {swept['seconds']:.2f} |",
                  flush=True)


if __name__ == "__main__":
    main()
