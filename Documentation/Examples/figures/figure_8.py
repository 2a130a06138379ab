# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Fig. 8: methods beside each other, each scene from its own camera.

  pvpython figure_8.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]

Methods without shadows of their own are drawn lit, with T_L = 1, as in the paper; columns with a star
have shadows.
"""

import studio

PIXELS = 148
METHODS = ("Ordinary", "Viola 2004", "Marchesin 2010", "Ament 2017", "Optimized")
COLUMNS = [(method, {"Method": method, "Shade": 1, "Shadows": 0}) for method in METHODS] + \
    [(method + "*", {"Method": method, "Shade": 1, "Shadows": 1})
     for method in ("Ament 2017", "Optimized")]


def compare(run, view, name):
    """A sheet of all scenes and methods, and their numbers."""
    rows, scores = [], {}
    for scene in run.scenes():
        row, scores[scene.title] = [], {}
        with studio.Stage(scene, run.pixels(PIXELS)) as stage:
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


def ordered(scores, key="VisibilityScore"):
    """Names of the methods, highest first; the starred columns have the same extinction."""
    return sorted(METHODS, key=lambda method: -scores[method][key])


def caption(numbers):
    """Which methods come first, and in how many scenes."""
    lines = []
    for key, words in (("VisibilityScore", "the highest S"),
                       ("VisibleFraction", "the largest visible share")):
        wins = {}
        for title, scores in numbers["scores"].items():
            wins.setdefault(ordered(scores, key)[0], []).append(title)
        lines.append("Of the methods, {} has {}.".format(words, "; ".join(
            "{} in {} of {} scenes".format(method, len(titles), len(numbers["scores"]))
            + ("" if method == "Optimized" else " ({})".format(", ".join(titles)))
            for method, titles in wins.items())))
    return " ".join(lines)


if __name__ == "__main__":
    studio.main(__file__, __doc__)
