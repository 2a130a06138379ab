# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Limpid's pictures beside those of VTK's mappers and of vdb_render."""

from markdown import fixed, mebibytes, significant, table

VTK = ("vtkFixedPointVolumeRayCastMapper", "vtkGPUVolumeRayCastMapper")
ANOTHER_VTK = tuple(f"another VTK, {mapper}" for mapper in VTK)
GROUPS = {  # by what light does; the first of each is what the others are compared with
    "without light": (
        "Limpid", "Limpid, optimised for this picture", *VTK, *ANOTHER_VTK,
        "vdb_render, no shadow samples", "an empty window"),
    "shaded": ("Limpid, shaded", *(f"{mapper}, shaded" for mapper in VTK + ANOTHER_VTK)),
    "with shadows": (
        "Limpid, shadows", "Limpid, shadows, light at rest",
        "Limpid, shadows, optimised for this picture", "vdb_render, shadows",
        "vdb_render, shadows, its own cutoff"),
    "with shadows, small": (
        "Limpid, shadows, small", "vtkGPUVolumeRayCastMapper, shadows, small"),
    "opaque": (
        "Limpid, opaque", "vdb_render, opaque", "Limpid, opaque, shadows",
        "vdb_render, opaque, shadows"),
}
ABILITIES = """
| | Limpid | VTK, fixed point | VTK, GPU mapper | vdb_render |
| --- | --- | --- | --- | --- |
| draws | scalars by transfer functions | the same | the same | a density, one colour |
| shading by gradients | yes | yes | yes | no |
| shadows | a shadow volume, kept while the light rests | no | rays to the light, optional | \
rays to the light |
| light | point, directional | the same | the same | directional |
| optimised extinction, derivative | yes | no | no | no |
| numbers | float32 | 15 bits | OpenGL's, here by llvmpipe without a GPU | float64 |
| a ray ends at a transmittance of | 1/1024 | 1/128 | 1/255 | 1/1024 here; its own: 0.04 |
| skips empty space | by bricks | by blocks of 4³ cells | no | by the tree of its grid |
"""
TEXT = """
The scene is the phantom of a head (vtkOcclusionPhantom) with {nodes}³ points, {size} × {size} pixels,
and a sample per voxel of each ray. Camera, light and functions are those of
`Documentation/Examples/scenes.py`. *Small* is a quarter of the size along each side. *Opaque* has per
voxel the extinction that is otherwise per unit of length, and is {dense} times as dense. *CPU* is the
time of all cores in seconds for one picture from another camera. The light moves with the camera unless
it rests. *Times Limpid's* is relative to the first row. *Pictures* is the number of pictures in the
median. *Peak* is the memory of a first picture beyond the initial memory, without the volume. For
vdb_render it is the whole process with its grid.
"""
NOTES = """
**Differences that could not be matched.** vdb_render has no transfer function. Its density is the
extinction per voxel (scatter 1, absorb 0, gain 0), so its optical depths are those of the others, and
its picture is white. Its light is directional. It has no switch for shadows. With a shadow step beyond
the volume, a ray to the light is still set up at every sample, but without samples along it. With
shadows it samples every third voxel, its default, from the first such step on. Limpid and VTK sample
every voxel. The rays of vdb_render are fast if they end at a surface. The rows *opaque* give it extinctions per
unit of length, which is another scene. Shading differs: VTK uses Phong shading at every sample, Limpid
single scattering (Eqs. (3)-(6)). By default Limpid draws 0.7 of a shadow, and 0.35 of its light comes
from all sides, so its pictures are brighter. A slow program draws one picture, including the
preparation of its first picture. VTK's shadows (VolumetricScatteringBlending 2,
GlobalIlluminationReach 1) are drawn in a quarter of the size along each side, and Limpid's beside them.
A picture in full size took more than four minutes of this processor and was stopped.

**OSPRay and Open VKL are not measured.** ParaView and VTK draw volumes by OSPRay if they were built
with it, and OSPRay samples volumes by Open VKL. No package of Debian 12, 13 or unstable, and none of
PyPI, has both (November 2026). Debian 12 has neither. Debian 13 and unstable have OSPRay 3.2.0
(`libospray3`), built with `OSPRAY_ENABLE_VOLUMES` off: there, `ospNewVolume` returns null. There is no
package of Open VKL. The wheel of VTK 9.6 on PyPI has no module RenderingRayTracing, and no package of
these releases depends on `libospray3`. conda-forge has both libraries; its channels were out of reach.
"""


def rows_of(pictures, names):
    still = pictures["still"]
    return [{"name": name, **still[name], "first": still[names[0]]["cpu"]}
            for name in names if name in still]


def time_table(pictures, names):
    return table(rows_of(pictures, names), [
        ("", lambda r: r["name"]), ("CPU [s]", lambda r: significant(r["cpu"])),
        ("shortest to longest", lambda r: (f"{significant(r['cpu_shortest'])} to "
                                           f"{significant(r['cpu_longest'])}")),
        ("pictures", lambda r: r["pictures"]), ("wall clock [s]",
                                                lambda r: significant(r["seconds"])),
        ("times Limpid's CPU", lambda r: significant(r["cpu"] / r["first"])),
        ("peak [MiB]",
         lambda r: mebibytes(r["peak_bytes"]) if "peak_bytes" in r else "not measured")])


def moving_table(pictures):
    def milliseconds(key):
        return lambda row: fixed(1e3 * row[1][key])

    return table(pictures["moving"].items(), [
        ("Limpid, moving, shadows [ms]", lambda row: row[0]),
        ("first frame", milliseconds("first")),
        (f"longest of the next {pictures['learning'] - 1}", milliseconds("learning")),
        ("median after", milliseconds("median")), ("longest after", milliseconds("longest"))])


def difference_table(pictures):
    return table(pictures["differences"] + pictures["white"], [
        ("Limpid's picture from that of", lambda d: d["peer"]),
        ("azimuth", lambda d: f"{d['azimuth']}°"), ("all pixels", lambda d: fixed(d["all"], 2)),
        ("covered pixels", lambda d: fixed(d["covered"], 2))])


def section(pictures):
    text = "\n## Pictures\n" + TEXT.format(dense=fixed((pictures["nodes"] - 1) / 2), **pictures)
    text += "\n![The pictures side by side](Plots/peers-pictures.png)\n"
    for heading, names in GROUPS.items():
        text += f"\n### {heading.capitalize()}\n{time_table(pictures, names)[:-1]}"
    text += "\n### Features\n" + ABILITIES + NOTES
    text += ("\n### Differences of the pictures\n\nThe table has mean absolute differences [1/255] of pictures "
             "without light. Those of vdb_render are small and white, with the light far away.\n"
             f"{difference_table(pictures)}")
    return text + f"### Moving\n{moving_table(pictures)}"
