# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What the plots of the benchmarks have in common: colours, axes, files."""

import os

import matplotlib
import numpy as np

matplotlib.use("Agg")

from PIL import Image  # pylint: disable=wrong-import-position
from matplotlib import pyplot  # pylint: disable=wrong-import-position
from matplotlib.ticker import (  # pylint: disable=wrong-import-position
    FuncFormatter,
    LogLocator,
    NullFormatter,
)

# Colours of Okabe and Ito, which people with any colour vision can tell apart.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY, GRAY = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#666666")
DOTS = 110  # per inch
COLORS_OF_PICTURE = 255
pyplot.rcParams.update({
    "font.size": 9, "axes.titlesize": 10, "axes.labelsize": 9, "legend.fontsize": 7.5,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "grid.color": "#e4e4e4", "grid.linewidth": 0.6, "lines.linewidth": 1.4,
    "lines.markersize": 5, "legend.frameon": False, "axes.axisbelow": True,
})


def percent(value, _=None):
    return f"{100 * value:g} %"


def plain(value, _=None):
    return f"{value:g}"


def logarithmic(axis, across, up, *, as_percent=True):
    axis.set(xscale="log", yscale="log", xlabel=across, ylabel=up)
    axis.margins(x=0.08, y=0.1)
    axis.autoscale()
    for along, form in ((axis.xaxis, plain), (axis.yaxis, percent if as_percent else plain)):
        low, high = along.get_view_interval()
        if high < 30 * low:
            along.set_major_locator(LogLocator(subs=(1, 2, 5)))
        along.set_major_formatter(FuncFormatter(form))
        along.set_minor_formatter(NullFormatter())


def make_room(axis, share):
    """For a legend at the bottom: the data keeps the rest of the axis."""
    low, high = axis.get_ylim()
    axis.set_ylim(bottom=low * (low / high) ** (share / (1 - share)))


def save(figure, folder, name):
    """As a picture of few colours, a third of the bytes."""
    path = os.path.join(folder, name)
    figure.set_facecolor("white")
    figure.set_dpi(DOTS)
    figure.canvas.draw()
    pixels = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3])
    few = pixels.quantize(COLORS_OF_PICTURE, dither=Image.Dither.NONE)
    few.save(path, optimize=True)
    pyplot.close(figure)
    print(path)
