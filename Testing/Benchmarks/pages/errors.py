# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Run time against error, setting by setting."""

from fronts import equal_errors, fronts_of, seconds_of, short_of_best
from markdown import fixed, head, mebibytes, ms, percent, short_percent, significant, sizes, table


def small(value):
    return significant(value, 2)


def share(value):
    return "0 %" if value == 0 else short_percent(value)


def signed(value):
    return ("−" if value < 0 else "+") + share(abs(value))


def fronts_section(scenes):
    rows = [{"scene": scene["name"], **facts} for scene in scenes for facts in fronts_of(scene)]
    return """
## Is the default worth its time?

A setting is on the Pareto front if no other is both faster and better. *Rival* is the setting with \
the largest common gain in time and error. *Factor* is this gain, the smaller one of the two: with \
time and error divided by it, the default would be on the front. Errors of an iteration are compared \
with the time of a policy iteration by rays, final results with that of a whole run of either solver. \
Errors below the uncertainty of the reference count as this uncertainty, and shortfalls below \
0.001 % as 0.001 %. The solvers minimise F. S is a part of F. A single pass ignores the light and \
gains more S and less F.
""" + table(rows, [
        ("scene", lambda r: r["scene"]), ("error", lambda r: r["measure"]),
        ("among", lambda r: r["among"]), ("default: time [ms]", lambda r: ms(r["seconds"])),
        ("error", lambda r: (small if r["measure"] == "rms error of T" else share)(r["error"])),
        ("rival", lambda r: r["rival"] or "–"), ("factor", lambda r: fixed(r["factor"], 2)),
        ("on the front or within 10 %", lambda r: "yes" if r["factor"] <= 1.1 else "**no**")])


def equal_section(scenes):
    rows = [{"scene": scene["name"], **equal} for scene in scenes for equal in equal_errors(scene)]

    def cheapest(solver):
        def cell(text):
            return lambda r: text(r) if r[solver] else "–"

        return [(f"Limpid, {solver} [ms]", cell(lambda r: ms(r[solver][0]))),
                ("rays", cell(lambda r: small(r[solver][1]))),
                ("ratio", cell(lambda r: fixed(r["grid_seconds"] / r[solver][0])))]

    return """
## The paper's grids at equal error

An Adam iteration, camera and light, on the paper's perspective grids (`Testing/PaperScheme`) of \
several resolutions is compared with Limpid's cheapest iterations at full resolution whose S is at \
least as accurate. Process, threads and compiler flags are the same, in float32. The finest grids are \
those that fit into the limits of memory and time. *Interpolated* is between the two neighbouring \
resolutions, linear in the logarithms of error and time. Error of S is the larger of those of the \
base extinction and of the default result.
""" + table(rows, [
        ("scene", lambda r: r["scene"]),
        ("samples per voxel", lambda r: small(r["samples_per_voxel"])
         if r["samples_per_voxel"] else "interpolated"),
        ("error of S", lambda r: share(r["error"])),
        ("paper's grids [ms]", lambda r: ms(r["grid_seconds"])),
        *cheapest("Adam"), *cheapest("policy")])


def iterations_section(scene):
    def time(solver):
        return lambda r: ms(seconds_of(scene, solver, r["ray_density"]))

    limpid = [{**s, "who": "Limpid", "rays": s["ray_density"], "policy": time("policy")(s),
               "Adam": time("Adam")(s), "volume": share(s["error_slope"]),
               "ray": share(s["error_slope_ray"])} for s in scene["sweeps"]]
    grids = [{**g, "who": "paper's grids", "rays": g["samples_per_voxel"], "policy": "–",
              "Adam": ms(g["seconds"]), "volume": "–", "ray": share(g["error_slope"])}
             for g in scene["paper_grids"]]
    return "### Iterations\n" + table(limpid + grids, [
        ("", lambda r: r["who"]), ("rays or samples per voxel", lambda r: small(r["rays"])),
        ("policy iteration [ms]", lambda r: r["policy"]),
        ("Adam iteration [ms]", lambda r: r["Adam"]),
        ("S, base", lambda r: signed(r["error_S_base"])),
        ("S, optimised", lambda r: signed(r["error_S_optimized"])),
        ("T_V, rms", lambda r: small(r["rms_T_view"])),
        ("T_L, rms", lambda r: small(r["rms_T_light"])),
        ("slopes, Volume", lambda r: r["volume"]), ("slopes, Ray", lambda r: r["ray"])])


SKIPS = [("solver", lambda t: t["solver"]), ("rays", lambda t: small(t["ray_density"])),
         ("skips", lambda t: "on" if t["skip"] else "off"), ("threads", lambda t: t["threads"]),
         ("iteration [ms]", lambda t: ms(t["seconds"])), ("timed", lambda t: t["timed"])]
SHADOWS = [("", lambda s: "nodes"), ("rays", lambda s: small(s["ray_density"])),
           ("T_V, rms", lambda s: small(s["rms_T_view"])),
           ("T_L, rms", lambda s: small(s["rms_T_light"])),
           ("one sweep [ms]", lambda s: ms(s["seconds"]))]
QUADRATURES = [("rule", lambda q: q["rule"]), ("steps per layer", lambda q: q["steps"]),
               ("S, base", lambda q: signed(q["error_S_base"])),
               ("S, optimised", lambda q: signed(q["error_S_optimized"])),
               ("time [ms]", lambda q: ms(q["seconds"]))]


def runs_section(scene, cuda):
    columns = [
        ("setting", lambda r: r["name"]), ("whole run [s]", lambda r: significant(r["seconds"])),
        ("repeats", lambda r: r["repeats"]), ("spread", lambda r: percent(r["spread"])),
        ("iterations", lambda r: r["iterations"]), ("F (march)", lambda r: fixed(r["F"])),
        ("short of the best", lambda r: share(short_of_best(scene, r, "F"))),
        ("S (march)", lambda r: significant(r["S"], 6)),
        ("short of the best", lambda r: share(short_of_best(scene, r, "S"))),
        ("peak memory [MiB]", lambda r: mebibytes(r["bytes"]))]
    text = "### Whole runs\n" + table(scene["runs"], columns)
    if cuda != "measured":
        text = text[:-1] + "| CUDA | not measured |" + " – |" * (len(columns) - 2) + "\n\n"
    return text


def scene_section(scene):
    reference = scene["reference"]
    skips = [t for t in scene["iterations"]
             if not t["skip"] or t["threads"] == 1 or t["ray_density"] == 1]
    return f"""
## {scene['name']}

{sizes(scene['nodes'])} nodes. Reference: {small(reference['rays_per_voxel'])} rays per voxel and \
axis, S {significant(reference['S_base'], 6)} (base) and \
{significant(reference['S_optimized'], 6)} (default result); with two thirds of the rays it changes \
by at most {share(reference['uncertainty'])}. T at {reference['voxels']} voxels. Measured in \
{fixed(scene['seconds'])} s.

""" + iterations_section(scene) + "### Skips and threads\n" + table(skips, SKIPS) \
        + "### Transmittance for shadows\n" + table(scene["shadows"], SHADOWS) \
        + "### Quadrature\n" + table(scene["quadratures"], QUADRATURES) \
        + runs_section(scene, scene["cuda"])


def page(measured):
    scenes = measured["scenes"]
    cuda = scenes[0]["cuda"].replace("not measured: ", "not measured (", 1)
    command = "bash Testing/Benchmarks/run.sh --pages errors"
    return head("Run time against error", measured, command) + f"""
The reference is the march of Testing/Reference, in double precision, without code of the sweeps. \
Rays and samples are per voxel and axis. Quadrature uses a simple scorer with two rays per voxel and \
axis (one in scenes above 4 million voxels), without skips. CUDA: {cuda}{')' if '(' in cuda else ''}. \
[Thick.md](Thick.md) covers media that stop most light from one node to the next, as with ParaView's \
default opacity.
""" + fronts_section(scenes) + equal_section(scenes) + "".join(map(scene_section, scenes))
