# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What one extinction for all views of an orbit shows."""

from markdown import fixed, head, percent, significant, table


def page(measured):
    scenes = list(measured["scenes"])

    def of(name, key):
        return measured["scenes"][name][key]

    def times(name, key, other):
        return fixed(of(name, key) / of(name, other), 2)

    return head("Orbits", measured, "python3 Testing/Benchmarks/orbits.py") + f"""
The table has the mean S over {measured['views']} views round the y axis, 20 degrees above the horizon \
and three radii away, with a fixed light. *Ordinary* is the unchanged volume, *each* an optimum for each \
view, and *one* one extinction for all (`Views` is *Orbit*). Sweeps are those of one camera. Time is the \
time of the run for all views, relative to the total time of the runs for each view. Both include \
everything in the filter.
""" + table(scenes, [("scene", str),
                     *[(heading, lambda name, key=key: significant(of(name, key), 4))
                       for heading, key in (("ordinary", "ordinary"), ("each", "single"),
                                            ("one", "joint"))],
                     ("one / each", lambda name: percent(of(name, "joint") / of(name, "single"))),
                     ("one / ordinary", lambda name: times(name, "joint", "ordinary")),
                     ("sweeps", lambda name: str(of(name, "iterations"))),
                     ("time", lambda name: times(name, "joint_seconds", "single_seconds"))])
