# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Fig. 1b: the importance of every scene, drawn as an ordinary volume.

  pvpython figure_1b.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]
"""

import studio

ACROSS = 4  # scenes in a row
PIXELS = 260


def make(run):
    cells, shares = [], {}
    for scene in run.scenes():
        with studio.Stage(studio.importance_scene(scene), run.pixels(PIXELS)) as stage:
            picture, _ = stage.draw(Method="Ordinary")
        shares[scene.title] = studio.importance_of(scene).mean()
        cells.append((picture, "{}\n{:.1f} % of the volume is important".format(
            scene.title, 100 * shares[scene.title])))
    rows = [cells[first:first + ACROSS] for first in range(0, len(cells), ACROSS)]
    return {"shares": shares,
            "pictures": [run.save(studio.picture_grid.compose(rows), "figure-1b.jpg")]}


def caption(numbers):
    return "Mean of the importance over the volume: " + ", ".join(
        "{} {:.1f} %".format(title, 100 * share)
        for title, share in numbers["shares"].items()) + "."


if __name__ == "__main__":
    studio.main(__file__, __doc__)
