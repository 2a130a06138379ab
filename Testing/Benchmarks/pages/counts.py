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

This page counts the work of a GPU without one, by

    bash Testing/Gpu/count.sh

* compiler: nvcc, {measured['compiler']}, for sm_90
* date: {measured['date']}
{age_of(measured['date'])}
Nothing here was measured on a GPU. Launches, waits and bytes are those of the processor in the role
of a GPU, which runs the same launches; instructions are the compiler's output.

## An iteration

This is an iteration of the policy for {measured['scene']}, {slices}³, with {slices} slices. *Waits* is
the number of times that all threads of a launch wait for each other. Numbers are means over
iterations. After a refused iteration, the next one begins with optical depths.
{launch_table(measured['iteration'], 'launch')}{copy_table(measured['iteration'], 'copy')}
## A frame of the display

After the camera has moved, a frame has {plural(measured['iterations'], 'iteration')}, shadows, and a
picture of 64 × 64 pixels (16 384 bytes). The outlines of the rays' plans are uploaded to the device: a
number per slice and per ray of an axis. The plans are made there. The outlines of camera and light
take {1e3 * measured['plan']:.1f} ms on this machine's processor.
{launch_table(measured['frame'], 'launch')}{copy_table(measured['frame'], 'copy')}
## Tiles

The table has the share of the visited tiles of rays and voxels with work, the number of visited tiles,
and in parentheses the number of all tiles, for the original extinction. *Policy sweep* is from the
camera, *derivative* from the light. *Transmittance* is that of the shadows, whose tiles are listed
again for each extinction. Rays of shadows have work where they meet any extinction, and, near the
sides of the box, on every slice behind that. Voxels have work where they are dimmed. *Shadows write*
is the number of bytes to memory or cache, including values of rays between slabs.
{tiles_table(measured['tiles'])}
## A ray on a slice, a voxel

Each kernel is one ray step or one voxel, with the policy's usual settings: scores are counted, and
costs are not weighed. *Inside* is the usual path of nearly all: rays that cross the layer from front to
back, and voxels far from the sides of the box. The other rows have **all paths together**, of which no
thread takes all: rays that enter or leave in the layer and rays that cross it, voxels near the sides
and voxels inside. *Threads* is the number that a multiprocessor holds with so many registers. *Stack*
is the memory of a thread in bytes, into which the compiler moves values without a register. *Spilled*
counts the instructions that store or load these values. *Generic* counts loads and stores of memory
whose kind the compiler does not know, without the one with which all threads wait for each other.
""" + table(measured["kernels"], [
        ("kernel", lambda k: k["kernel"]), ("instructions", lambda k: k["instructions"]),
        *((kind, lambda k, kind=kind: k[kind])
          for kind in ("loads", "stores", "generic", "spilled", "branches", "of double precision",
                       "registers", "threads", "stack"))])
