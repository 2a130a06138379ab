# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How time and memory grow with voxels, how they shrink with threads, and what skipping saves."""

import math

from markdown import fixed, head, mebibytes, ms, noise, percent, significant, sizes, table
from solvers import READY, WHOLE, off_and_on, spread

STEPS = ("setup", "first pass", "policy iteration", "Adam iteration", "score of a direction")
SMALLEST_FITTED = 64  # nodes along each axis
SCENE = ("scene", lambda e: e["scene"])
SPREAD = ("spread", lambda e: percent(e["spread"]["policy iteration"]))


def slope(x, y):
    """Of a straight line by least squares; 0 for fewer than two points."""
    mean_x, mean_y = sum(x) / max(1, len(x)), sum(y) / max(1, len(y))
    below = sum((a - mean_x) ** 2 for a in x)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / below if below > 0 else 0.0


def fit_exponents(entries, scene):
    """Fits of time = factor * voxels^exponent by step; 0: not measured."""
    fitted = [e for e in entries if e["scene"] == scene and e["side"] >= SMALLEST_FITTED]
    exponents = {}
    for step in STEPS:
        timed = [e for e in fitted if e["seconds"].get(step, 0) > 0]
        exponents[step] = slope([3 * math.log(e["side"]) for e in timed],
                                [math.log(e["seconds"][step]) for e in timed])
    sides = [e["side"] for e in fitted] or [0]
    return {"scene": scene, "smallest": min(sides), "largest": max(sides), "exponents": exponents}


def fits_of(entries):
    return [fit_exponents(entries, scene) for scene in dict.fromkeys(e["scene"] for e in entries)]


def efficiency(result, step):
    """Time on one thread over the product of threads and time on all."""
    one, most = result["times"][0], result["times"][-1]
    return one["seconds"][step] / (most["threads"] * most["seconds"][step])


def skipped(result):
    """Shares of voxels and samples that are left out, the latter for camera, light and both."""
    def share(taken, everything):
        return 1 - taken / everything if everything > 0 else 0

    eyes = [result["camera samples"], result["light samples"]]
    return {"voxels": share(result["touched"], result["voxels"]),
            "camera": share(eyes[0]["taken"], eyes[0]["all"]),
            "light": share(eyes[1]["taken"], eyes[1]["all"]),
            "samples": share(sum(e["taken"] for e in eyes), sum(e["all"] for e in eyes))}


def time_columns():
    return [(f"{step} [ms]", lambda e, step=step: ms(e["seconds"][step])
             if e["seconds"].get(step, 0) > 0 else "") for step in STEPS]


def sizes_section(measured):
    entries = measured["sizes"]
    return f"""
## Time against voxels

The numbers are wall times, medians of {measured['options']['repeats']:g} rounds through all sizes (of \
three at most from 300³ on), with {measured['machine']['threads']} threads. Policy iteration (from the \
third on) and Adam iteration have camera and light at full resolution. Score is one of several \
directions. Spread is the slowest minus the fastest policy iteration, over the median.
""" + table(entries, [SCENE, ("nodes", lambda e: f"{e['side']}³"), *time_columns(), SPREAD]) + f"""\
The next table has the exponent e of time ∝ voxels^e, by least squares in the logarithms, for sizes \
from {SMALLEST_FITTED}³ on:
""" + table(fits_of(entries), [
        SCENE, ("sizes", lambda f: f"{f['smallest']}³ … {f['largest']}³"),
        *((step, lambda f, step=step: fixed(f["exponents"][step], 3)
           if f["exponents"][step] > 0 else "") for step in STEPS)])


def memory_section(measured):
    return """
## Memory against voxels

The numbers are the peak resident memory of a default run to the end (policy, camera and light), from \
the solver's constructor on, minus the memory that was resident before. The two arrays of the input \
(8 bytes a voxel) are not included, the result is. Every run has a process of its own.
""" + table(measured["memory"], [
        SCENE, ("nodes", lambda v: f"{v['side']}³"),
        ("beyond the input [MiB]", lambda v: mebibytes(v["bytes"])),
        ("[byte/voxel]", lambda v: fixed(v["bytes"] / v["voxels"], 1))])


def threads_section(measured):
    results = measured["threads"]
    rows = [{**result, **times} for result in results for times in result["times"]]
    return f"""
## Threads

The numbers are wall times, medians of {measured['options']['repeats']:g} rounds, with the numbers of \
threads in turns in one process. Efficiency is the time on one thread over the product of threads and \
time on all. Cores is the same for plain arithmetic, times the threads: the cores that the machine \
provided at the same time.
""" + table(rows, [SCENE, ("nodes", lambda r: sizes(r["nodes"])),
                   ("threads", lambda r: r["threads"]), *time_columns(), SPREAD]) + "Parallel efficiency:\n" + table(results, [
                       SCENE, ("threads", lambda r: r["times"][-1]["threads"]),
                       *((step, lambda r, step=step: percent(efficiency(r, step)))
                         for step in STEPS),
                       ("cores", lambda r: fixed(r["cores"], 2))])


def skips_section(measured):
    def share(key):
        return lambda r: percent(r[key] / r["voxels"], 1)

    def samples(eye):
        key = f"{eye} samples"
        return [(f"samples, {eye} [10⁶]: taken", lambda r: significant(r[key]["taken"] / 1e6)),
                ("all", lambda r: significant(r[key]["all"] / 1e6)),
                ("skipped", lambda r: percent(skipped(r)[eye], 1))]

    return """
## Skipped work and saved time

The numbers are counted in the plans of the sweeps. Voxels are nodes that no ray of camera or light \
reads and no iteration can change. Samples are rays times layers, relative to the same with \
SkipUnneeded off.
""" + table(measured["skips"], [
        SCENE, ("not empty", share("filled")), ("read by camera", share("read by camera")),
        ("read by light", share("read by light")),
        ("voxels skipped", lambda r: percent(skipped(r)["voxels"], 1)), *samples("camera"),
        *samples("light"),
        ("samples skipped", lambda r: percent(skipped(r)["samples"], 1))]) + f"""\
The next table has default runs to the end with skips on and off in turns, with \
{measured['machine']['threads']} threads, medians of {measured['options']['repeats']:g}, after a warm-up \
of each:
""" + table(measured["skips"], [
        SCENE, *off_and_on([("iteration [ms]", "later", ms), READY, WHOLE], lambda r: r),
        ("spread", lambda r: percent(spread(r)))])


def spreads(measured):
    return ([e["spread"]["policy iteration"] for e in measured["sizes"] if e["side"] >= 128]
            + [spread(r) for r in measured["skips"]])


def lacks_cores(measured):
    return any(r["cores"] < 0.9 * r["times"][-1]["threads"] for r in measured["threads"])


def page(measured):
    text = head("Scaling", measured) + """
Onion is a core in a shell, and the corners of the box are empty. Dense is the same in a haze that \
leaves no voxel empty. The core is important. With skips off, voxels that the scene does not need are \
also computed, as if everything were important.
"""
    if warning := noise(spreads(measured)):
        text += "\n" + warning[:-1]
    if lacks_cores(measured):
        text += "\n**There were fewer cores than threads: times are preliminary.**\n"
    parts = (("sizes", sizes_section), ("memory", memory_section), ("threads", threads_section),
             ("skips", skips_section))
    return text + "".join(section(measured) for part, section in parts if measured[part])
