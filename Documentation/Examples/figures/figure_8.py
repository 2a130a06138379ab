# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Fig. 8: methods beside each other, each scene from its own camera.

  pvpython figure_8.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]

Methods without shadows of their own are drawn lit, with T_L = 1, as in the paper; columns with a star
have shadows. The weights of Ament 2017 are those with the highest S of all that table_methods.py tries.
"""

import studio

PIXELS = 148
METHODS = ("Ordinary", "Viola 2004", "Marchesin 2010", "Ament 2017", "Optimized")
AMENT = {"AmentExponent": 3, "AmentOccluders": 3000, "AmentLightOccluders": 3000}
COLUMNS = [(method, {"Method": method, "Shade": 1, "Shadows": 0}) for method in METHODS] + \
    [(method + "*", {"Method": method, "Shade": 1, "Shadows": 1})
     for method in ("Ament 2017", "Optimized")]


def compare(run, view, name):
    """A sheet of all scenes and methods, and their numbers."""
    rows, scores = [], {}
    for scene in run.scenes():
        row, scores[scene.title] = [], {}
        with studio.Stage(scene, run.pixels(PIXELS)) as stage:
            stage.set(**AMENT)
            stage.look(studio.viewpoint_of(scene, view))
            for head, settings in COLUMNS:
                picture, numbers = stage.draw(**settings)
                row.append((picture, studio.score_text(numbers)))
                scores[scene.title][head] = numbers
        rows.append(row)
    figure = studio.picture_grid.compose(rows, [head for head, _ in COLUMNS],
                                         studio.names_of(scores))
    return {"scores": scores, "pictures": [run.save(figure, name)]}


def make(run):
    return compare(run, "own", "figure-8.jpg")


def placed(numbers, place, key):
    """Which methods have the highest, the second, ... of a number, and in which scenes."""
    found = {}
    for title, scores in numbers["scores"].items():
        order = sorted(METHODS, key=lambda method, scores=scores: -scores[method][key])
        found.setdefault(order[place], []).append(title)
    most = max(found, key=lambda method: len(found[method]))
    return ", ".join("{} in {}".format(method, len(titles) if method == most else "; ".join(titles))
                     for method, titles in found.items())


def caption(numbers):
    return ("In {} scenes, highest S: {}; second: {}. Largest visible share: {}; second: {}.").format(
        len(numbers["scores"]), *(placed(numbers, place, key)
                                  for key in ("VisibilityScore", "VisibleFraction")
                                  for place in (0, 1)))


if __name__ == "__main__":
    studio.main(__file__, __doc__)
