# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Plots of error against time, of convergence and of the paper's scheme at equal error."""

import math

import numpy as np
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter

from fronts import DEFAULT_DENSITY, equal_errors, largest_error, seconds_of, short_of_best
from plot_style import BLUE, GRAY, GREEN, ORANGE, PURPLE, RED, SKY
from plot_style import logarithmic, make_room, percent, plain, pyplot, save

POLICY = {"color": BLUE, "marker": "o", "label": "Limpid, policy"}
ADAM = {"color": ORANGE, "marker": "s", "label": "Limpid, Adam"}
GRIDS = {"color": RED, "marker": "^", "label": "paper's grids, Adam"}
RULES = {
    "left Riemann": {"color": RED, "marker": "^"},
    "trapezoid": {"color": ORANGE, "marker": "s"},
    "conservative linear": {"color": GREEN, "marker": "D"},
    "two Gauss points": {"color": BLUE, "marker": "o"},
}
RUNS = {
    "iterations": ("iterations", BLUE, "o"),
    "ray density": ("rays", SKY, "D"),
    "grid": ("rays and iterations", SKY, "d"),
    "derivative": ("derivative Ray", PURPLE, "P"),
    "resolution": ("fewer nodes", GREEN, "v"),
    "solver": ("Adam", ORANGE, "s"),
    "levels": ("Adam, other levels or rays", ORANGE, "x"),
}
BAR = 100  # the paper's grids over Limpid, at equal error
LEAST = 1e-5  # what is closer to the best is drawn here


def by_rays(scene, error, solver="policy"):
    """Points of Limpid's iterations: time [ms], error, and how many rays."""
    return [(1e3 * seconds_of(scene, solver, s["ray_density"]) or math.nan, error(s),
             s["ray_density"]) for s in scene["sweeps"]]


def by_time(entries, error, key):
    return [(1e3 * entry["seconds"], error(entry), entry[key]) for entry in entries]


def draw(axis, points, *, numbers=0, above=False, **style):
    """A line; `numbers`: texts at every point, every second ..."""
    axis.plot([x for x, _, _ in points], [y for _, y, _ in points], **style)
    for x, y, number in points[::numbers] if numbers else ():
        axis.annotate(f"{number:g}", (x, y), textcoords="offset points",
                      xytext=(0, 6 if above else -12), ha="center", fontsize=6.5,
                      color=style["color"])


def draw_front(axis, points):
    """A stair along the points (time, error) that no other is faster and better than."""
    front = []
    for x, y, *_ in sorted(points):
        if not front or y < front[-1][1]:
            front += [(x, front[-1][1] if front else y), (x, y)]
    axis.plot(*zip(*front[1:]), color=GRAY, linewidth=4, alpha=0.25, solid_capstyle="butt",
              label="Pareto front", zorder=1)


def draw_default(axis, points, number=DEFAULT_DENSITY, label="default"):
    for x, y, *_ in (p for p in points if p[2] == number):
        axis.plot([x], [y], "*", color="black", markersize=12, label=label, zorder=5)


def draw_scores(axis, scene):
    points = by_rays(scene, largest_error)
    draw(axis, points, numbers=1, **POLICY)
    draw_front(axis, points)
    draw_default(axis, points)
    draw(axis, by_rays(scene, largest_error, "Adam"), **ADAM)
    draw(axis, by_time(scene["paper_grids"], largest_error, "samples_per_voxel"), numbers=2,
         above=True, **GRIDS)
    logarithmic(axis, "time of an iteration [ms]", "error of S")
    uncertain = scene["reference"]["uncertainty"]
    if uncertain > axis.get_ylim()[0]:
        axis.axhspan(axis.get_ylim()[0], uncertain, color="#f2f2f2", zorder=0)
    axis.set_title("Visibility score, by rays or samples per voxel")
    axis.legend()


def draw_transmittances(axis, scene):
    for key, line, name in (("rms_T_view", "-", "camera"), ("rms_T_light", "--", "light")):
        def error(entry, key=key):
            return entry[key]

        for points, color, marker, who in (
                (by_rays(scene, error), BLUE, "o", "Limpid, policy"),
                (by_time(scene["shadows"], error, "ray_density"), GREEN, "D",
                 "Limpid, for shadows"),
                (by_time(scene["paper_grids"], error, "samples_per_voxel"), RED, "^",
                 "paper's grids")):
            draw(axis, points, linestyle=line, color=color, marker=marker, label=f"{who}: {name}")
    draw_default(axis, by_rays(scene, lambda s: s["rms_T_view"]))
    draw_default(axis, by_time(scene["shadows"], lambda s: s["rms_T_view"], "ray_density"), 3, None)
    logarithmic(axis, "time of an iteration, or of a sweep for shadows [ms]", "rms error of T",
                as_percent=False)
    axis.set_title("Transmittance at voxels")
    make_room(axis, 0.25)
    axis.legend(loc="lower left", ncol=2, handlelength=1.6, columnspacing=1)


def draw_slopes(axis, scene):
    volume = by_rays(scene, lambda s: s["error_slope"])
    draw(axis, volume, **{**POLICY, "label": "Volume"})
    draw(axis, by_rays(scene, lambda s: s["error_slope_ray"]), color=PURPLE, marker="P",
         label="Ray (Eqs. 19, 20 as printed)")
    draw(axis, by_time(scene["paper_grids"], lambda g: g["error_slope"], "samples_per_voxel"),
         numbers=2, above=True, **{**GRIDS, "label": "paper's grids"})
    draw_default(axis, volume)
    logarithmic(axis, "time of an iteration [ms]", "relative error")
    axis.set_title("Derivative of S along three directions")
    make_room(axis, 0.18)
    axis.legend(loc="lower left", ncol=2)


def draw_quadratures(axis, scene):
    for rule, style in RULES.items():
        results = [q for q in scene["quadratures"] if q["rule"] == rule]
        draw(axis, by_time(results, largest_error, "steps"), numbers=1, label=rule, **style)
    logarithmic(axis, "time of S, simple scorer [ms]", "error of S")
    axis.set_title("Quadrature, by steps per layer")
    axis.legend()


def best_or_percent(value, _=None):
    return "best" if value <= LEAST else percent(value)


def draw_runs(axis, scene, key, title):
    """What whole runs reach, over their time. Returns the entries of a legend."""
    runs = [r for r in scene["runs"] if r["threads"] != 1]
    points = [(1e3 * r["seconds"], max(LEAST, short_of_best(scene, r, key)), r["name"])
              for r in runs]
    draw_front(axis, points)
    draw_default(axis, points, "default")
    labels = set()
    for run, point in zip(runs, points):
        if run["group"] in RUNS:
            label, color, marker = RUNS[run["group"]]
            axis.plot(*point[:2], marker, color=color, label=None if label in labels else label)
            labels.add(label)
    logarithmic(axis, "time of a whole run [ms]", "short of the best")
    axis.set_ylim(bottom=LEAST / 1.5)
    axis.yaxis.set_major_formatter(FuncFormatter(best_or_percent))
    axis.set_title(title)
    return axis.get_legend_handles_labels()


def plot_scene(scene, machine, folder):
    figure, axes = pyplot.subplot_mosaic(
        [["S", "T", "slopes"], ["F", "final S", "quadrature"], ["legend", "legend", "nothing"]],
        figsize=(13, 8), layout="constrained", gridspec_kw={"height_ratios": [1, 1, 0.1]})
    draw_scores(axes["S"], scene)
    draw_transmittances(axes["T"], scene)
    draw_slopes(axes["slopes"], scene)
    draw_runs(axes["F"], scene, "F", "F, which a whole run minimises")
    handles, labels = draw_runs(axes["final S"], scene, "S",
                                "S alone, of which a run gives some for the light")
    draw_quadratures(axes["quadrature"], scene)
    for empty in ("legend", "nothing"):
        axes[empty].set_axis_off()
    axes["legend"].legend(handles, labels, ncol=5, loc="center")
    nodes = " × ".join(str(n) for n in scene["nodes"])
    figure.suptitle(f"{scene['name']} ({nodes} nodes, {machine['threads']} threads): "
                    "error against time, lower left is better", fontsize=12)
    save(figure, folder, f"error-{scene['name']}.png")


def plot_convergence(scenes, folder):
    figure, axes = pyplot.subplots(len(scenes), 2, figsize=(10, 1.75 * len(scenes) + 0.6),
                                   layout="constrained", squeeze=False)
    for row, scene in zip(axes, scenes):
        for name, style in (("default", POLICY), ("Adam", ADAM)):
            run = next(r for r in scene["runs"] if r["name"] == name)
            history = np.array(run["history_iteration_level_seconds_S_F"], dtype=float)
            last = history[-1, 3]
            if name == "default":
                for axis in row:
                    axis.axhspan(0.99 * last, 1.01 * last, color="#dddddd", linewidth=0)
            for axis, column, factor in ((row[0], 0, 1), (row[1], 2, 1e3)):
                x = factor * history[:, column]
                axis.plot(x, history[:, 3], color=style["color"], linewidth=1.2,
                          label=style["label"])
                coarse = history[:, 1] > 0
                axis.plot(x[~coarse], history[~coarse, 3], style["marker"], markersize=2.5,
                          color=style["color"])
                axis.plot([x[-1]], [last], style["marker"], markersize=6, color=style["color"])
        row[0].set_xscale("symlog", linthresh=1)
        row[0].set_xlim(left=0)
        row[1].set_xscale("log")
        row[1].xaxis.set_major_locator(LogLocator(subs=(1, 3)))
        for axis in row:
            axis.set_ylim(bottom=0)
            axis.xaxis.set_major_formatter(FuncFormatter(plain))
            axis.xaxis.set_minor_formatter(NullFormatter())
        row[0].set_ylabel(f"{scene['name']}\nS [length²]")
    axes[0, 0].legend(loc="lower right")
    axes[0, 0].set_title("over iterations")
    axes[0, 1].set_title("over time, setup included")
    axes[-1, 0].set_xlabel("iteration")
    axes[-1, 1].set_xlabel("time [ms]")
    save(figure, folder, "convergence.png")


def plot_equal_error(scenes, folder):
    figure, axes = pyplot.subplots(1, 2, figsize=(13, 4.4), layout="constrained", sharey=True)
    colors = [BLUE, ORANGE, GREEN, RED, PURPLE, SKY, GRAY]
    markers = "os^DvPX"
    for axis, solver in zip(axes, ("Adam", "policy")):
        for number, scene in enumerate(scenes):
            points = [e for e in equal_errors(scene) if e["samples_per_voxel"] and e[solver]]
            axis.plot([e["error"] for e in points],
                      [e["grid_seconds"] / e[solver][0] for e in points],
                      color=colors[number % 7], marker=markers[number % 7],
                      linestyle="-" if scene["voxels"] > 1e6 else ":",
                      label=f"{scene['name']} ({scene['voxels'] / 1e6:.1f} M voxels)")
        logarithmic(axis, "error of S that neither exceeds",
                    "time of an iteration: paper's grids / Limpid", as_percent=False)
        axis.xaxis.set_major_locator(FixedLocator([0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1]))
        axis.xaxis.set_major_formatter(FuncFormatter(percent))
        axis.invert_xaxis()
        axis.axhline(BAR, color="black", linewidth=1, linestyle="--")
        axis.text(0.02, BAR * 1.08, f"{BAR} ×", transform=axis.get_yaxis_transform(), fontsize=8)
        axis.set_title(f"against Limpid's {solver} iteration")
    axes[1].set_ylabel("")
    axes[1].legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    save(figure, folder, "equal-error.png")


def plot(measured, folder, _):
    for scene in measured["scenes"]:
        plot_scene(scene, measured["machine"], folder)
    plot_convergence(measured["scenes"], folder)
    plot_equal_error(measured["scenes"], folder)
