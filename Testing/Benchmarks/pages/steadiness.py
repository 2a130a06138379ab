# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How steady pictures are while a camera moves and time goes on."""

from markdown import deviation, fixed, head, percent, significant, table


def page(measured):
    scenes = list(measured["scenes"])
    values = list(enumerate(measured["coherence"]))

    def of(kind):
        return lambda name: measured["scenes"][name][kind]

    turn, time = of("turn"), of("time")

    def columns(heading, cell):
        return [(f"{heading} {value:g}", lambda name, i=i: cell(name, i)) for i, value in values]

    def beyond(name, i):
        return fixed(turn(name)["pixels"][i] - turn(name)["frozen"])

    def loss(kind):
        return lambda name, i: deviation(kind(name)["score"][i], kind(name)["score"][0])

    return head("Steadiness", measured, "python3 Testing/Benchmarks/steadiness.py") + f"""
## The camera turns

There are {measured['frames']} converged pictures of {measured['size']} × {measured['size']} pixels, \
{measured['degrees']:g} degree apart. The table has the mean number of pixels in which a channel changes \
by more than 30 of 255 from one picture to the next. *Off* is without optimization, *frozen* with the \
extinction of the first picture. The other columns have the number beyond *frozen*, by \
`TemporalCoherence`, with the display's defaults otherwise.
""" + table(scenes, [("scene", str), ("off", lambda name: fixed(turn(name)["off"])),
                     ("frozen", lambda name: fixed(turn(name)["frozen"])),
                     *columns("beyond it,", beyond)]) + """
The next table has the mean score of these pictures, relative to that without coherence:
""" + table(scenes, [("scene", str),
                     ("S", lambda name: significant(turn(name)["score"][0], 4)),
                     *columns("S,", loss(turn))[1:]]) + f"""
## Time goes on

The filter computes {measured['steps']} steps with its defaults, except for `TemporalCoherence`. The \
scalars move by a voxel every other step, and noise of 2 % of their range is new in every step. *Flips* \
is the mean share of filled nodes with two properties: their extinction changes by more than half the \
majorant from one step to the next, and by a quarter more than their base does. The mean score is \
relative to that without coherence:
""" + table(scenes, [("scene", str), *columns("flips,", lambda name, i: percent(
        time(name)["flips"][i], 2)), *columns("S,", loss(time))[1:]])
