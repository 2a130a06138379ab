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
`ControlResolution`: the change of the extinction is found at every second or fourth point along each \
axis, and drawn with the data at their own resolution. From the camera of the pictures below, the \
filter's scores, all measured at the points of the data. *Visible*: share of the important \
structures that is visible, of how much could be; *gain*: of S over the base, relative to full \
resolution; *time*: of a whole run, with all arrays of the result; *apart*: mean difference of the \
display's pictures of {measured['size']} × {measured['size']} pixels from those at full resolution, \
in levels of 255, and the share of pixels that differ by more than 30.
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
