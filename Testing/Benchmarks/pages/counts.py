# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What a GPU would have to do, counted without one."""

from markdown import age_of, fixed, plural, significant, table

COPIES = ("upload", "download", "copy", "set to zero")


def launch_table(parts, heading):
    launches = [part for part in parts if part["label"] not in COPIES]
    total = {"label": "all", **{key: sum(part[key] for part in launches)
                                for key in ("launches", "waits")}}
    return table([*launches, total], [
        (heading, lambda p: p["label"]), ("launches", lambda p: significant(p["launches"])),
        ("waits of the grid", lambda p: significant(p["waits"]))])


def copy_table(parts, heading):
    return table([part for part in parts if part["label"] in COPIES], [
        (heading, lambda p: p["label"]), ("how often", lambda p: significant(p["launches"])),
        ("bytes", lambda p: fixed(p["copied"]))])


def tiles_table(scenes):
    sweeps = ("policy sweep", "derivative", "transmittance")
    return table(scenes, [
        ("scene", lambda s: s["scene"]), ("points", lambda s: " × ".join(map(str, s["nodes"]))),
        *((sweep, lambda s, sweep=sweep: f"{s[sweep]['active'] / s[sweep]['visited']:.3f} of "
           f"{s[sweep]['visited']:.0f} ({s[sweep]['all']:.0f})") for sweep in sweeps),
        ("shadows write [GB]", lambda s: f"{s['shadows_written'] / 1e9:.2f}")])


def page(measured):
    slices = measured["nodes"]
    return f"""# Counts

What a GPU would have to do, counted without one, by

    bash Testing/Gpu/count.sh

* compiler: nvcc, {measured['compiler']}, for sm_90
* date: {measured['date']}
{age_of(measured['date'])}
Nothing here was measured on a GPU. Launches, waits and bytes are those of the processor in the role
of a GPU, which runs the same launches; instructions are the compiler's output.

## An iteration

Of the policy, {measured['scene']}, {slices}³: {slices} slices. *Waits*: how often all threads of a
launch wait for each other. Numbers are means over iterations; where one was taken back, the next one
begins with optical depths.
{launch_table(measured['iteration'], 'launch')}{copy_table(measured['iteration'], 'copy')}
## A frame of the display

After the camera has moved: {plural(measured['iterations'], 'iteration')}, shadows, and a picture
of 64 × 64 pixels (16 384 bytes). What goes to the device are outlines of the rays' plans, a number per slice
and per ray of an axis; the plans are made there. The outlines of camera and light take
{1e3 * measured['plan']:.1f} ms on this machine's processor.
{launch_table(measured['frame'], 'launch')}{copy_table(measured['frame'], 'copy')}
## Tiles

Share of the visited tiles of rays and voxels that have something to do, of how many are visited (and
how many there are); for the original extinction. *Policy sweep*: from the camera. *Derivative*:
from the light. *Transmittance*: shadows, whose tiles are listed anew for each extinction. Their rays
have something to do where they meet any extinction, and, near the sides of the box, on every slice
behind that; their voxels, where anything dims them. *Shadows write*: bytes to memory or cache, values of rays between slabs among them.
{tiles_table(measured['tiles'])}
## A ray on a slice, a voxel

Kernels of one ray step or one voxel each, with the policy's usual settings: scores counted, nothing
weighed. *Inside*: what nearly all take, rays that cross the layer from front to back and voxels far
from the sides of the box. Else **all paths together**, of which none takes all: rays that enter or
leave in the layer and rays that cross it, voxels near the sides and voxels inside. *Threads*: how
many a multiprocessor holds with so many registers; *stack*: bytes of memory of a thread's own, into
which the compiler moves what finds no register; *spilled*: instructions that do so, or fetch it back;
*generic*: loads and stores of memory that the compiler does not know the kind of, without the one
with which all threads wait for each other.
""" + table(measured["kernels"], [
        ("kernel", lambda k: k["kernel"]), ("instructions", lambda k: k["instructions"]),
        *((kind, lambda k, kind=kind: k[kind])
          for kind in ("loads", "stores", "generic", "spilled", "branches", "of double precision",
                       "registers", "threads", "stack"))])
