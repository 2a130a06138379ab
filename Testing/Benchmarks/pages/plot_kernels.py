# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The plot of the passes of an iteration and of what their bytes would take."""

import numpy as np

from kernels import iterations
from plot_style import BLUE, GRAY, ORANGE, pyplot, save

PASSES = {
    "policy sweep, camera": BLUE,
    "depths and derivative, light": ORANGE,
}


def plot(measured, folder, _):
    threads = measured["machine"]["threads"]
    results = [r for r in iterations(measured) if r["threads"] == threads]
    height = 0.42 * len(results) + 1.2
    figure, (axis, key) = pyplot.subplots(2, 1, figsize=(8.5, height + 0.5), layout="constrained",
                                          gridspec_kw={"height_ratios": [height, 0.4]})
    places = np.arange(len(results))[::-1]
    start = np.zeros(len(results))
    for name, color in PASSES.items():
        lengths = 1e3 * np.array([sum(p["seconds"] for p in r["passes"] if p["names"][0] == name)
                                  for r in results])
        axis.barh(places, lengths, 0.62, left=start, color=color, label=name)
        start += lengths
    whole = 1e3 * np.array([r["seconds"] for r in results])
    axis.barh(places, np.maximum(0, whole - start), 0.62, left=start, color=GRAY, label="the rest")
    start = np.maximum(whole, start)
    for place, result, end in zip(places, results, start):
        floor = 1e3 * result["floor"]
        axis.plot([floor, floor], [place - 0.36, place + 0.36], color="black", linewidth=2.5,
                  label="floor of all passes" if place == places[0] else None)
        axis.text(end, place, f"  {end / floor:.1f} × floor", va="center", fontsize=8)
    axis.set_yticks(places)
    axis.set_yticklabels([f"{r['scene']} ({r['voxels'] / 1e6:.1f} M voxels)" for r in results])
    axis.grid(False, axis="y")
    axis.margins(x=0.14)
    axis.set(xlim=(0, None), xlabel="time of a policy iteration [ms]",
             title=f"Passes of an iteration, and what their bytes would take ({threads} threads)")
    key.set_axis_off()
    key.legend(*axis.get_legend_handles_labels(), loc="center", ncol=4)
    save(figure, folder, "kernels-floor.png")
