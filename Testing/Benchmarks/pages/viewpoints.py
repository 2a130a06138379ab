# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How long a search for viewpoints takes, and how far its scores are from the truth."""

from markdown import arrow, fixed, head, ms, noise, percent, significant, sizes, table


def page(measured):
    scenes = measured["scenes"]
    rows = [{**scene, **field} for scene in scenes for field in scene["fields"]]

    def time(part, text=ms):
        return lambda r: text(r["seconds"][part])

    names = [("scene", lambda r: r["scene"]), ("field", lambda r: r["field"])]
    searches = [
        *names, ("nodes", lambda r: sizes(r["nodes"])),
        ("not empty", lambda r: percent(r["filled"], 1)), ("setup [ms]", time("setup")),
        ("score [ms]", time("score")), ("score and slope [ms]", time("slope")),
        ("slope / score", lambda r: fixed(r["seconds"]["slope"] / r["seconds"]["score"], 1)),
        (f"{scenes[0]['directions']} directions [s]", time("directions", significant)),
        ("climbs [s]", time("climbs", significant)), ("search [s]", time("search", significant)),
        ("evaluations", lambda r: r["evaluations"]),
        ("visible, worst → best", lambda r: arrow(r["worst"], r["best"])),
        ("spread", lambda r: percent(r["spread"]["search"]))]
    densities = list(names)
    for n, density in enumerate(rows[0]["densities"]):
        densities += [
            (f"ρ = {significant(density['ray_density'], 2)}: score [ms]",
             lambda r, n=n: ms(r["densities"][n]["seconds"])),
            ("mean error", lambda r, n=n: percent(r["densities"][n]["mean_error"], 3)),
            ("largest", lambda r, n=n: percent(r["densities"][n]["largest_error"], 3))]
    few = scenes[0]["timed_directions"]
    return head("Viewpoints", measured) + f"""
## A search

Cameras are at three radii, with one ray per voxel and axis and {measured['machine']['threads']} \
threads. The numbers are wall times, medians of {measured['options']['repeats']:g} runs. Score, and score \
and slope, process one direction after the other; the mean over {few} is given. Search is the setup, \
{scenes[0]['directions']} directions, and climbs from the best.
{table(rows, searches)}{noise([r['spread']['search'] for r in rows], 0.2)}## Run time against error

S of {few} directions is compared with the march of Testing/Reference. The march uses double precision, \
{significant(measured['options']['march-rays'], 2)} rays per voxel and axis, four Gauss points in \
every piece of a cell, and no code of the sweeps. ρ is the number of rays per voxel and axis of the \
sweep. Times are as above.
""" + table(rows, densities)
