# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How long pictures take, stage by stage."""

from markdown import fixed, head, ms, noise, percent, sizes, table

SCENE = ("scene", lambda s: s["scene"])
STAGES = {"scalars [ms]": "scalars", "functions, extinction [ms]": "functions",
          "shadow volume [ms]": "shadow", "gradient, bricks [ms]": "gradient and bricks",
          "rays [ms]": "rays"}
FRAMES = {"optimisation [ms]": "optimisation", "extinction, shadow volume [ms]": "shadow",
          "rays [ms]": "rays", "frame [ms]": "frame"}
ORDINARY = "Ordinary"


def times(part, names):
    return [(heading, lambda s, key=key: ms(s[part]["seconds"][key]))
            for heading, key in names.items()]


def page(measured):
    scenes = measured["scenes"]
    rays = [{"scene": scene["scene"], "extinction": extinction, **of}
            for scene in scenes for extinction, of in scene["rays"].items()]

    def time(key):
        return lambda r: ms(r[key])

    methods = sorted(scenes[0]["methods"]["seconds"], key=lambda name: name != ORDINARY)

    def by_method(name, over_ordinary):
        def cell(s):
            seconds = s["methods"]["seconds"]
            return fixed(seconds[name] / (seconds[ORDINARY] if over_ordinary else 1), 2)
        return (f"{name} / {ORDINARY}" if over_ordinary else f"{name} [CPU s]", cell)

    size, moving = scenes[0]["pixels"], scenes[0]["moving_pixels"]
    return head("Rendering", measured) + f"""
## A still picture, stage by stage

The picture has {size} × {size} pixels and shows the optimised extinction with light and shadows. All \
stages start from nothing.
""" + table(scenes, [
        SCENE, ("nodes", lambda s: sizes(s["nodes"])), *times("still", STAGES),
        ("all [ms]", lambda s: ms(sum(s["still"]["seconds"].values()))),
        ("spread of rays", lambda s: percent(s["still"]["spread"]["rays"]))]) + noise(
            [s["still"]["spread"]["rays"] for s in scenes], 0.2) + """
## Rays

The rays are those of the same picture. Seconds of the processor are those of all threads, which other \
programs on the machine disturb less. The last three columns have the time with shadows, without skips \
and without early ends of rays; the samples per second of that; and the share of its time that skips \
save.
""" + table(rays, [
        SCENE, ("extinction", lambda r: r["extinction"]),
        ("samples on all rays [millions]", lambda r: fixed(1e-6 * r["samples"])),
        ("empty pixels", lambda r: percent(r["empty_share"])), ("unlit [ms]", time("unlit")),
        ("lit [ms]", time("lit")), ("with shadows [ms]", time("shadowed")),
        ("unlit [CPU s]", lambda r: fixed(r["unlit_cpu"], 2)),
        ("with shadows [CPU s]", lambda r: fixed(r["shadowed_cpu"], 2)),
        ("every sample taken [ms]", time("every_sample")),
        ("[million samples/s]", lambda r: fixed(1e-6 * r["samples"] / r["every_sample"])),
        ("time left out", lambda r: percent(1 - r["shadowed"] / r["every_sample"]))]) + """
## Methods

Each method draws the same picture as the display does, in turns, without the work that is done once \
for a view. The methods of 2004 and 2010 are shaded but have no shadows.
""" + table(scenes, [
        SCENE, *(by_method(name, False) for name in methods),
        *(by_method(name, True) for name in methods[1:])]) + f"""
## A moving frame

The frames have {moving} × {moving} pixels, light and shadows. There are {scenes[0]['frames']} frames, 2 \
degrees apart, with {ms(scenes[0]['preview_seconds'])} ms for one pass of the optimisation. The numbers \
are medians.
""" + table(scenes, [
        SCENE, ("optimised on", lambda s: sizes(s["moving"]["nodes"])), *times("moving", FRAMES),
        ("longest frame [ms]", lambda s: ms(s["moving"]["longest"]))]) + """
## Few rays, or a sweep

A picture can be composited by a sweep from slice to slice and warped to the screen. It then has the \
rays of the sweep, here one per voxel and axis. The table compares it with casting the same number of \
rays through pixels, for the base extinction without light. The sweep sums extinction and importance \
only. Colours and light would be added.
""" + table(scenes, [
        SCENE, ("rays", lambda s: s["few_rays"]["rays"]),
        ("one sweep [ms]", lambda s: ms(s["few_rays"]["sweep"])),
        ("as many pixels cast [ms]", lambda s: ms(s["few_rays"]["cast"])),
        ("sweep / cast", lambda s: fixed(s["few_rays"]["sweep"] / s["few_rays"]["cast"], 1))])
