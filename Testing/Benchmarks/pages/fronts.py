# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Which settings are worth their time, and what the same error costs on the paper's grids."""

import math

from markdown import significant

BEST_ENOUGH = 1e-5  # what runs reach is as good as the best if it is so near: the march is no more
# exact
DEFAULT_DENSITY = 1
ROUND_ERRORS = (0.2, 0.1, 0.05, 0.02, 0.01)


def front_of(settings):
    """Names of the settings (name, seconds, error) that no other is faster than and at least as
    good, fastest first."""
    def beaten(one):
        return any(o[1] <= one[1] and o[2] <= one[2] and o[1:] != one[1:] for o in settings)

    front = [s for s in settings if not beaten(s)]
    return [name for name, _, _ in sorted(front, key=lambda s: s[1])]


def place_of_first(settings):
    """Where the first setting lies. With time and error divided by `factor` it would be on the
    front, but for the rival."""
    _, seconds, error = settings[0]
    place = {"seconds": seconds, "error": error, "rival": "", "factor": 1,
             "front": front_of(settings)}
    for name, of_time, of_error in settings:
        factor = min(seconds / of_time, error / of_error)
        if factor > place["factor"]:
            place.update(factor=factor, rival=name)
    return place


def largest_error(entry):
    """Of S, of the base extinction and of the optimised one."""
    return max(abs(entry["error_S_base"]), abs(entry["error_S_optimized"]))


def seconds_of(scene, solver, density):
    """An iteration's time at a number of rays, with skips and all threads; 0: not measured."""
    for time in scene["iterations"]:
        if (time["solver"], time["ray_density"]) == (solver, density) and time["skip"] \
                and time["threads"] != 1:
            return time["seconds"]
    return 0


def short_of_best(scene, run, key):
    """How far a run stays behind the best of all runs: in F, or in S alone [share of the best]."""
    values = [r[key] for r in scene["runs"]]
    if key == "F":
        return (run[key] - min(values)) / abs(min(values))
    return 1 - run[key] / max(values)


def front_of_sweeps(scene, measure, error):
    sweeps = sorted(scene["sweeps"], key=lambda s: s["ray_density"] != DEFAULT_DENSITY)
    settings = [(f"ρ = {significant(s['ray_density'], 2)}",
                 seconds_of(scene, "policy", s["ray_density"]), error(s)) for s in sweeps]
    return {"measure": measure, "among": "policy iterations by rays", **place_of_first(settings)}


def front_of_runs(scene, key):
    threads = scene["runs"][0]["threads"]
    settings = [(r["name"], r["seconds"], max(BEST_ENOUGH, short_of_best(scene, r, key)))
                for r in scene["runs"] if r["threads"] == threads]
    return {"measure": f"final {key}, short of the best", "among": "whole runs",
            **place_of_first(settings)}


def fronts_of(scene):
    """The default's place by errors (time of an iteration) and by what is reached (time of a whole
    run)."""
    uncertainty = scene["reference"]["uncertainty"]
    return [
        front_of_sweeps(scene, "error of S", lambda s: max(uncertainty, largest_error(s))),
        front_of_sweeps(scene, "rms error of T", lambda s: max(s["rms_T_view"], s["rms_T_light"])),
        front_of_sweeps(scene, "error of slopes", lambda s: s["error_slope"]),
        front_of_runs(scene, "F"), front_of_runs(scene, "S")]


def at_error(scene, samples, error, seconds):
    """The cheapest iterations whose S is at least so exact."""
    equal = {"samples_per_voxel": samples, "error": error, "grid_seconds": seconds}
    for solver in ("Adam", "policy"):
        exact = [(seconds_of(scene, solver, s["ray_density"]), s["ray_density"])
                 for s in scene["sweeps"] if largest_error(s) <= error]
        equal[solver] = min((e for e in exact if e[0] > 0), default=None)  # seconds, rays
    return equal


def equal_errors(scene):
    """At every resolution of the paper's grids, and at round errors between them, straight in the
    logarithms; the latter have no number of samples."""
    grids = [(largest_error(g), g["seconds"]) for g in scene["paper_grids"]]
    equal = [at_error(scene, g["samples_per_voxel"], *grid)
             for g, grid in zip(scene["paper_grids"], grids)]
    for error in ROUND_ERRORS:
        for (coarse, of_coarse), (fine, of_fine) in zip(grids, grids[1:]):
            if coarse >= error > fine:
                share = math.log(coarse / error) / math.log(coarse / fine)
                equal.append(at_error(scene, 0, error, of_coarse * (of_fine / of_coarse) ** share))
                break
    return equal
