# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Plots of time and memory against voxels, of threads, and of what is left out."""

import numpy as np
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter, NullLocator
from matplotlib.ticker import PercentFormatter

from scaling import SMALLEST_FITTED, efficiency, fit_exponents, skipped
from plot_style import BLUE, GRAY, GREEN, ORANGE, PURPLE, RED, SKY, plain, pyplot, save

STEPS = {
    "policy iteration": (BLUE, "o"),
    "Adam iteration": (ORANGE, "s"),
    "setup": (GREEN, "^"),
    "first pass": (SKY, "D"),
    "score of a direction": (PURPLE, "v"),
}
SERIES = {  # line, and what is drawn of it
    "dense": ("-", list(STEPS)),
    "onion": (":", list(STEPS)),
    "dense, skips off": ("--", ["policy iteration"]),
}
COLORS = [BLUE, ORANGE, GREEN, RED, PURPLE, SKY, GRAY]  # of real scenes
MARKERS = "os^DvPX"
MOST_BYTES = 36  # per voxel, on the dense scene
LEAST_EFFICIENCY = 0.9


def sizes_of(entries, scene):
    return sorted((e for e in entries if e["scene"] == scene), key=lambda e: e["side"])


def show_sizes(axis, entries):
    """Ticks on the volumes that were measured."""
    sides = sorted({e["side"] for e in entries})
    axis.set_xscale("log")
    axis.xaxis.set_major_locator(FixedLocator([side**3 for side in sides]))
    axis.xaxis.set_minor_locator(NullLocator())
    axis.set_xticklabels([f"{side}³" for side in sides])
    axis.set_xlabel("voxels")


def exponent_of(measured, scene, step):
    """As text; empty where too few sizes were measured."""
    exponent = fit_exponents(measured["sizes"], scene)["exponents"][step]
    return f"{exponent:.2f}" if exponent > 0 else ""


def draw_fit(axis, sizes, step, exponent, color):
    """The fitted power, through the middle of what it was fitted to."""
    fitted = [s for s in sizes if s["side"] >= SMALLEST_FITTED]
    x = np.log([s["side"] ** 3 for s in fitted])
    y = np.log([s["seconds"][step] for s in fitted])
    line = np.exp(y.mean() + float(exponent) * (x - x.mean()))
    axis.plot(np.exp(x), 1e3 * line, color=color, linewidth=4, alpha=0.2)


def plot_time(measured, folder):
    figure, axes = pyplot.subplot_mosaic([["total", "each"], ["key", "key"]], figsize=(11, 5.6),
                                         layout="constrained",
                                         gridspec_kw={"height_ratios": [1, 0.16]})
    total, each, key = axes["total"], axes["each"], axes["key"]
    for step, (color, marker) in STEPS.items():
        for scene, (line, steps) in SERIES.items():
            sizes = sizes_of(measured["sizes"], scene)
            if step not in steps or not sizes:
                continue
            voxels = np.array([s["side"] ** 3 for s in sizes])
            seconds = np.array([s["seconds"][step] for s in sizes])
            exponent = exponent_of(measured, scene, step)
            label = f"{step}, {scene}" + (f": e = {exponent}" if exponent else "")
            style = {"color": color, "marker": marker, "linestyle": line, "markersize": 4}
            total.plot(voxels, 1e3 * seconds, label=label, **style)
            each.plot(voxels, 1e9 * seconds / voxels, **style)
            if exponent and scene == "dense":
                draw_fit(total, sizes, step, exponent, color)
    for axis, label in ((total, "time [ms]"), (each, "time per voxel [ns]")):
        axis.set_yscale("log")
        axis.yaxis.set_major_formatter(FuncFormatter(plain))
        axis.yaxis.set_minor_formatter(NullFormatter())
        axis.set_ylabel(label)
        show_sizes(axis, measured["sizes"])
    total.set_title(f"time ∝ voxels$^e$, fitted from {SMALLEST_FITTED}³ on")
    each.set_title("the same per voxel: level where e = 1")
    key.set_axis_off()
    key.legend(*total.get_legend_handles_labels(), loc="center", ncol=4, handlelength=3)
    threads = measured["machine"]["threads"]
    figure.suptitle(f"Time against voxels, {threads} threads", fontsize=12)
    save(figure, folder, "scaling-time.png")


def plot_memory(measured, folder):
    figure, axis = pyplot.subplots(figsize=(6.2, 3.8), layout="constrained")
    for (scene, (line, _)), color, marker in zip(SERIES.items(), (BLUE, ORANGE, GREEN), "os^"):
        volumes = sizes_of(measured["memory"], scene)
        if not volumes:
            continue
        axis.plot([v["voxels"] for v in volumes], [v["bytes"] / v["voxels"] for v in volumes],
                  color=color, marker=marker, linestyle=line, label=scene)
    axis.axhline(MOST_BYTES, color="black", linewidth=1, linestyle="--")
    axis.text(0.99, MOST_BYTES, f"at most {MOST_BYTES} on the dense scene", ha="right", va="bottom",
              transform=axis.get_yaxis_transform(), fontsize=8)
    axis.set(ylim=(0, None), ylabel="bytes per voxel beyond the input",
             title="Peak memory of a default run")
    axis.legend(loc="lower left")
    show_sizes(axis, measured["memory"])
    save(figure, folder, "scaling-memory.png")


def plot_threads(measured, folder):
    results = measured["threads"]
    threads = results[0]["times"][-1]["threads"]
    figure, axis = pyplot.subplots(figsize=(0.95 * len(results) + 2.2, 4.2), layout="constrained")
    width = 0.14
    for number, (step, (color, marker)) in enumerate(STEPS.items()):
        places = np.arange(len(results)) + width * (number - (len(STEPS) - 1) / 2)
        axis.plot(places, [efficiency(r, step) for r in results], marker, color=color, label=step)
    axis.axhline(LEAST_EFFICIENCY, color="black", linewidth=1, linestyle="--")
    axis.axhline(1, color=GRAY, linewidth=0.8)
    axis.set_xticks(np.arange(len(results)))
    axis.set_xticklabels([f"{r['scene']}\n{' × '.join(str(n) for n in r['nodes'])}\n"
                          f"{r['cores']:.2f} cores" for r in results], fontsize=7)
    axis.set(xlim=(-0.6, len(results) - 0.4), ylim=(0, None))
    axis.yaxis.set_major_formatter(PercentFormatter(1))
    axis.set(ylabel="parallel efficiency",
             title=f"Time on one thread over {threads} × time on {threads} threads")
    axis.legend(loc="lower left", ncol=3)
    save(figure, folder, "scaling-threads.png")


def time_saved(result, part):
    return 1 - result["skips on"]["seconds"][part] / result["skips off"]["seconds"][part]


def plot_skips(measured, folder):
    results = sorted(measured["skips"], key=lambda r: skipped(r)["samples"])
    figure, (bars, points) = pyplot.subplots(1, 2, figsize=(11, 4.4), layout="constrained",
                                             gridspec_kw={"width_ratios": [1.5, 1]})
    columns = (
        ("voxels skipped", lambda r: skipped(r)["voxels"], SKY, ""),
        ("samples skipped", lambda r: skipped(r)["samples"], BLUE, ""),
        ("time saved, iteration", lambda r: time_saved(r, "later"), ORANGE, "//"),
        ("time saved, whole run", lambda r: time_saved(r, "whole"), RED, "//"),
    )
    width = 0.2
    for number, (label, value, color, hatch) in enumerate(columns):
        places = np.arange(len(results)) + width * (number - 1.5)
        bars.bar(places, [value(r) for r in results], width, color=color, hatch=hatch,
                 edgecolor="white", linewidth=0.5, label=label)
    bars.set_xticks(np.arange(len(results)))
    bars.set_xticklabels([r["scene"] for r in results], fontsize=7.5)
    bars.grid(False, axis="x")
    bars.set(ylim=(0, 1), ylabel="share of what skips off take",
             title="Work left out and time saved")
    bars.legend(loc="upper left", ncol=2)

    axis = points
    axis.plot([0, 1], [0, 1], color=GRAY, linewidth=0.8)
    axis.axhline(0.5, color="black", linewidth=1, linestyle="--")
    axis.text(0.02, 0.51, "2 × faster", fontsize=8)
    for number, result in enumerate(results):
        axis.plot([skipped(result)["samples"]], [time_saved(result, "later")],
                  MARKERS[number % len(MARKERS)], color=COLORS[number % len(COLORS)],
                  markersize=7, label=result["scene"])
    axis.legend(loc="lower right")
    axis.set(xlim=(0, 1), ylim=(0, 1), xlabel="share of samples skipped",
             ylabel="time saved in an iteration", title="On the line, time follows samples")
    for each in (bars.yaxis, points.xaxis, points.yaxis):
        each.set_major_formatter(PercentFormatter(1))
    save(figure, folder, "scaling-skips.png")


def plot(measured, folder, _):
    for part, draw in (("sizes", plot_time), ("memory", plot_memory), ("threads", plot_threads),
                       ("skips", plot_skips)):
        if measured[part]:
            draw(measured, folder)
