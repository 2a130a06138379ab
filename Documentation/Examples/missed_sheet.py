# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Draws scenes without and with what their pictures miss painted over them: a row per scene.

  pvpython missed_sheet.py --plugin Limpid.so --output SHEET.png [FILE.scene.json ...]

Ordinary, optimised, and optimised without protection of what is important. Without scenes: the
embedded phantom. Prints how much of each picture is painted, in percent: pixels that the paint
changes by more than a twentieth, and by more than a quarter of the range of a channel.
"""

import os
import sys

import numpy as np
from paraview import simple

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import optimize_scene  # pylint: disable=wrong-import-position
import sheet  # pylint: disable=wrong-import-position

SIZE = 1.9  # of a picture [inches]
WAYS = (("ordinary", {"Method": "Ordinary"}),
        ("optimized", {"Method": "Optimized"}),
        ("without protection", {"Method": "Optimized", "ProtectImportance": 0}))


def pictures(scene):
    """Titles and pictures, without and with what is missed; prints how much is painted."""
    view = optimize_scene.make_view(scene)
    display = optimize_scene.show(scene, view)
    for title, settings in WAYS:
        for name, value in settings.items():
            setattr(display, name, value)
        pair = []
        for missed in (0, 1):
            display.ShowMissed = missed
            pair.append(sheet.picture_of(view))
        display.UpdatePropertyInformation()
        change = np.abs(pair[1] - pair[0]).max(axis=2)
        print("| {} | {} | {:.1f} | {:.1f} | {:.1f} |".format(
            scene.title, title, 100 * display.VisibleFraction, 100 * (change > 0.05).mean(),
            100 * (change > 0.25).mean()), flush=True)
        yield "{}: {:.1f} % visible".format(title, 100 * display.VisibleFraction), pair[0]
        yield "what it misses", pair[1]
    simple.Delete(view)


if __name__ == "__main__":
    sheet.draw(sheet.parser().parse_args(), 2 * len(WAYS), SIZE, pictures)
