# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What it costs to optimise on a coarser grid than that of the data."""

from markdown import fixed, head, percent, significant, table

RESOLUTIONS = ("full", "half", "quarter")


def page(measured):
    scenes = measured["scenes"]
    rows = [(name, resolution) for name in scenes for resolution in RESOLUTIONS]

    def of(row, key):
        return scenes[row[0]][row[1]][key]

    def gain(row):
        """Of S over the base, relative to that at full resolution."""
        full = scenes[row[0]]["full"]
        return (of(row, "score") - of(row, "before")) / (full["score"] - full["before"])

    return head("Control", measured, "python3 Testing/Benchmarks/control.py") + f"""
With `ControlResolution`, the change of the extinction is computed at every second or fourth point \
along each axis, and drawn with the data at full resolution. The table has the filter's scores from \
the camera of the pictures below, all measured at the points of the data. *Visible* is the visible \
share of the important structures, *could be* the largest possible share. *Gain* is that of S over the \
base, relative to full resolution. *Time* is that of a whole run, with all arrays of the result. \
*Apart* is the mean difference of the display's pictures of {measured['size']} × {measured['size']} \
pixels from those at full resolution, in levels of 255. The last column is the share of pixels that \
differ by more than 30.
""" + table(rows, [("scene", lambda row: f"{row[0]}, {row[1]}"),
                   ("visible", lambda row: percent(of(row, "fraction"), 2)),
                   ("could be", lambda row: percent(of(row, "attainable"), 2)),
                   ("S", lambda row: significant(of(row, "score"))),
                   ("gain", lambda row: fixed(gain(row), 3)),
                   ("time [s]", lambda row: significant(of(row, "seconds"))),
                   ("apart", lambda row: fixed(of(row, "apart"), 2)),
                   ("above 30", lambda row: percent(of(row, "above_30"), 2))]) + f"""
Full, half and quarter resolution: {", ".join(scenes)}.

![Pictures at full, half and quarter resolution](Plots/control.jpg)
"""
