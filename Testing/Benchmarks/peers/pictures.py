# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Times pictures of one volume by Limpid, VTK's two volume mappers, the same two of another VTK, and
vdb_render of OpenVDB.

    bash Testing/with-display.sh /usr/bin/python3 Testing/Benchmarks/peers/pictures.py \\
      [--nodes N] [--size N] [--repeats N] [--frames N] [--folder FOLDER] [--another-vtk PYTHON] \\
      [--output FILE.json]

Needs the Python package limpid on PYTHONPATH; run.sh finds it. vdb_render is drawn if it is there,
another VTK if the Python that has it is named, and the numbers say if not. Everything is drawn in turns. Limpid and VTK's mappers draw in this
process, from another camera each time, and the light goes with it, unless it rests; the first
picture, which prepares the volume, does not count. vdb_render is a process for each
picture, from which one with a single pixel is subtracted: reading, preparing and starting. What
takes longer than SLOW is drawn once, and counts.
"""

import argparse
import contextlib
import json
import os
import statistics
import subprocess
import sys

import numpy as np
from vtkmodules.vtkCommonCore import vtkVersion

import another_vtk
import vdb
from head import HERE, STEP, Head, volume_views

sys.path.append(os.path.join(HERE, "..", "pages"))
import machine  # noqa: E402 pylint: disable=wrong-import-position

Mapper = volume_views.vtkTransmittanceVolumeMapper
TURN = 0.37  # degrees between one timed picture and the next
SLOW = 15  # seconds of all cores
SMALLER = 4  # times along each side: what would be too slow
LEARNING = 5  # frames after which a mapper knows what a frame may cost
CAMERAS = (0, 70, 200)  # azimuth of the compared pictures [degrees]
WHITE = ((0, 1, 1, 1), (1, 1, 1, 1))


def limpid(method=Mapper.ORDINARY, shadows=False):
    mapper = volume_views.plain_mapper()
    mapper.SetMethod(method)
    if method != Mapper.ORDINARY:
        mapper.SetOptimization(Mapper.CONTINUOUS)
    mapper.SetShadows(shadows)
    return mapper


def scattering(head):
    """VTK's mapper with its own shadows: rays towards the light from every sample. In full size a
    picture takes minutes without a GPU, so there is a smaller one, and Limpid's beside it."""
    mapper = volume_views.gpu_mapper(STEP * head.spacing)
    mapper.SetVolumetricScatteringBlending(2.0)  # nothing but
    mapper.SetGlobalIlluminationReach(1.0)  # as far as the volume goes
    return mapper


class ByMapper:
    """A picture by a mapper of VTK; `rests`: the light stays where it is; `density`: see draw."""

    def __init__(self, head, mapper, shade=False, rests=False, density=1):
        self.head, self.mapper, self.shade, self.rests = head, mapper, shade, rests
        self.density = density

    def draw(self, number, _=None):
        self.head.look(TURN * number, 0.0 if self.rests else None)
        wall, cores = self.head.draw(self.mapper, self.shade, density=self.density)
        return {"seconds": wall, "cpu": cores}

    def shown(self):
        return self.head.picture()


class ByVdbRender:
    """A picture by vdb_render, in a file."""

    def __init__(self, head, folder, **options):
        self.head, self.options = head, {"step": STEP, **options}
        self.grid = os.path.join(folder, "head.vdb")
        self.file = os.path.join(folder, "vdb.ppm")

    def run(self, number, size):
        self.head.look(TURN * number)
        return vdb.run(vdb.command(self.head, self.grid, self.file, size, **self.options))

    def draw(self, number, size):
        start, start_cores, _ = self.run(number, 1)
        wall, cores, peak = self.run(number, size)
        return {"seconds": wall - start, "cpu": cores - start_cores, "peak": peak}

    def shown(self):
        return vdb.read_picture(self.file)


def kinds(head, folder, with_vdb, another=None):
    """Everything that is drawn, by name: without light, shaded, with shadows."""
    fixed_point = volume_views.fixed_point_mapper(STEP * head.spacing)
    gpu = volume_views.gpu_mapper(STEP * head.spacing)
    small = Head(head.nodes, head.size // SMALLER)
    dense = 1 / head.spacing  # times: extinction per length taken for that per voxel
    found = {
        "an empty window": ByMapper(head, None),
        "Limpid": ByMapper(head, limpid()),
        "Limpid, optimised for this picture": ByMapper(head, limpid(Mapper.OPTIMIZED)),
        "vtkFixedPointVolumeRayCastMapper": ByMapper(head, fixed_point),
        "vtkGPUVolumeRayCastMapper": ByMapper(head, gpu),
        "Limpid, shaded": ByMapper(head, limpid(), shade=True),
        "vtkFixedPointVolumeRayCastMapper, shaded": ByMapper(head, fixed_point, shade=True),
        "vtkGPUVolumeRayCastMapper, shaded": ByMapper(head, gpu, shade=True),
        "Limpid, shadows": ByMapper(head, limpid(shadows=True), shade=True),
        "Limpid, shadows, light at rest": ByMapper(head, limpid(shadows=True), True, rests=True),
        "Limpid, shadows, optimised for this picture":
            ByMapper(head, limpid(Mapper.OPTIMIZED, shadows=True), shade=True),
        "Limpid, shadows, small": ByMapper(small, limpid(shadows=True), shade=True),
        "vtkGPUVolumeRayCastMapper, shadows, small":
            ByMapper(small, scattering(small), shade=True),
        "Limpid, opaque": ByMapper(head, limpid(), density=dense),
        "Limpid, opaque, shadows": ByMapper(head, limpid(shadows=True), True, density=dense)}
    if with_vdb:
        found["vdb_render, no shadow samples"] = ByVdbRender(
            head, folder, shadowstep=vdb.NO_SHADOW, cutoff=vdb.CUTOFF)
        found["vdb_render, shadows"] = ByVdbRender(head, folder, cutoff=vdb.CUTOFF)
        found["vdb_render, shadows, its own cutoff"] = ByVdbRender(head, folder)
        found["vdb_render, opaque"] = ByVdbRender(
            head, folder, scatter=dense, shadowstep=vdb.NO_SHADOW, cutoff=vdb.CUTOFF)
        found["vdb_render, opaque, shadows"] = ByVdbRender(
            head, folder, scatter=dense, cutoff=vdb.CUTOFF)
    if another:
        found.update(another.kinds(TURN))
    return found


def times(drawn, arguments):
    """Of the pictures by name, all in turns; keeps the last one of each."""
    laps = {name: [] for name in drawn}
    done = set()
    for left in range(arguments.repeats, -1, -1):  # the first round warms up
        for number, (name, kind) in enumerate(drawn.items()):
            if name in done:
                continue
            lap = kind.draw(left, arguments.size)
            print(name, lap, file=sys.stderr, flush=True)
            if left < arguments.repeats or lap["cpu"] > SLOW:
                laps[name].append(lap)
            if lap["cpu"] > SLOW:
                done.add(name)
            if left == 0 or name in done:
                pixels = kind.shown().astype(np.uint8)
                np.save(os.path.join(arguments.folder, f"{number}.npy"), pixels)
    return {name: summary(of) for name, of in laps.items()}


def summary(laps):
    cores = [lap["cpu"] for lap in laps]
    found = {"cpu": statistics.median(cores), "cpu_longest": max(cores), "cpu_shortest": min(cores),
             "seconds": statistics.median(lap["seconds"] for lap in laps), "pictures": len(laps)}
    if "peak" in laps[0]:
        found["peak_bytes"] = max(lap["peak"] for lap in laps)
    return found


def peak_of(name, arguments):
    """Bytes that the first picture of a kind takes beyond what was there, in a process for it."""
    words = [sys.executable, "-B", __file__, "--nodes", str(arguments.nodes), "--size",
             str(arguments.size), "--peak", name]
    return int(subprocess.run(words, check=True, stdout=subprocess.PIPE).stdout.split()[-1])


def print_peak(name, arguments):
    """The answer to peak_of."""
    def status(key):
        with open("/proc/self/status", encoding="ascii") as file:
            return next(1024 * int(line.split()[1]) for line in file if line.startswith(key + ":"))

    kind = kinds(Head(arguments.nodes, arguments.size), "", False)[name]
    kind.head.draw(None)
    before = status("VmRSS")
    with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
        file.write("5")  # forgets the peak so far
    kind.draw(0)
    print(status("VmHWM") - before)


def difference(ours, theirs, **what):
    """Mean absolute difference of two pictures, of all and of covered pixels [1/255]."""
    covered = (ours.max(axis=2) > 0) | (theirs.max(axis=2) > 0)
    apart = np.abs(ours - theirs)
    return {**what, "all": apart.mean(), "covered": apart[covered].mean()}


def differences(head, drawn):
    """Of pictures that should be the same, from Limpid's."""
    found = []
    for azimuth in CAMERAS:
        head.look(azimuth)
        head.draw(drawn["Limpid"].mapper)
        ours = head.picture()
        for name in ("vtkFixedPointVolumeRayCastMapper", "vtkGPUVolumeRayCastMapper"):
            head.draw(drawn[name].mapper)
            found.append(difference(ours, head.picture(), peer=name, azimuth=azimuth))
    return found


def white_differences(arguments):
    """From vdb_render, in small: white, with a light from afar and none from all sides, scattered
    evenly."""
    size = arguments.size // SMALLER
    head = Head(arguments.nodes, size)
    head.colors = WHITE
    head.light.SetPositional(False)
    shadows = limpid(shadows=True)
    shadows.SetAmbient(0)
    shadows.SetSpecular(0)
    shadows.SetAnisotropy(0)
    shadows.SetShadowStrength(1)
    shadows.SetLightIntensity(0.5)  # its share with full shadows: what nothing hides is white
    found = []
    for name, mapper, step in (("no shadow samples", limpid(), vdb.NO_SHADOW),
                               ("shadow step 3", shadows, 3), ("shadow step 1", shadows, 1)):
        theirs = ByVdbRender(head, arguments.folder, shadowstep=step, cutoff=vdb.CUTOFF)
        theirs.run(0, size)
        head.draw(mapper)
        found.append(difference(head.picture(), theirs.shown(), peer=f"vdb_render, {name}",
                                azimuth=0))
    return found


def moving_times(head, frames, method):
    """Of the frames of an orbit with shadows and shading, turning by two degrees."""
    mapper = limpid(method, shadows=True)
    head.look()
    head.draw(mapper, shade=True)
    laps = []
    for frame in range(frames + LEARNING):
        head.look(2.0 * (frame + 1))
        laps.append(head.draw(mapper, shade=True, moving=True)[0])
    after = laps[LEARNING:]
    return {"first": laps[0], "learning": max(laps[1:LEARNING]),
            "median": statistics.median(after), "longest": max(after)}


def measure(arguments):
    head = Head(arguments.nodes, arguments.size)
    with contextlib.ExitStack() as stack:
        another = None
        if arguments.another_vtk:
            another = stack.enter_context(
                another_vtk.AnotherVtk(arguments.another_vtk, head, arguments.folder))
        return measure_beside(another, head, arguments)


def measure_beside(another, head, arguments):
    absent = vdb.missing()
    if not absent:
        vdb.write_grid(head, os.path.join(arguments.folder, "head.vdb"))
    drawn = kinds(head, arguments.folder, not absent, another)
    still = times(drawn, arguments)
    for name, of in still.items():
        if isinstance(drawn[name], ByMapper) and drawn[name].mapper is not None:
            of["peak_bytes"] = peak_of(name, arguments)
    versions = [f"VTK {vtkVersion.GetVTKVersion()}"] + ([] if absent else [vdb.version()])
    if another:
        versions.append(f"another VTK {another.version}")
    return {"nodes": arguments.nodes, "size": arguments.size, "step": STEP, "versions": versions,
            "still": still, "differences": differences(head, drawn),
            "white": [] if absent else white_differences(arguments), "learning": LEARNING,
            "moving": {"optimised": moving_times(head, arguments.frames, Mapper.OPTIMIZED),
                       "not optimised": moving_times(head, arguments.frames, Mapper.ORDINARY)}}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--nodes", type=int, default=256, help="of the volume, along each axis")
    parser.add_argument("--size", type=int, default=1024, help="width and height in pixels")
    parser.add_argument("--repeats", type=int, default=3, help="timed pictures of each kind")
    parser.add_argument("--frames", type=int, default=20, help="timed frames of the orbit")
    parser.add_argument("--folder", default=".", help="for the grid of vdb_render and pictures")
    parser.add_argument("--another-vtk", help="a Python with another VTK", metavar="PYTHON")
    parser.add_argument("--output", help="file to write; default: standard output")
    parser.add_argument("--peak", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.peak:
        print_peak(arguments.peak, arguments)
        return
    facts = machine.facts()
    machine.save({"machine": facts, "pictures": measure(arguments)}, arguments.output)


if __name__ == "__main__":
    main()
