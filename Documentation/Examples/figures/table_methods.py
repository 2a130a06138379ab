# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""S of all methods from all sides: where is the optimised extinction not the one with the highest S?

  pvpython table_methods.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]

By the filter, all of the volume counts. Optimized is as the display has it, Optimized (Paper) as the
paper does: without protection of what is important and without smoothing.
"""

from paraview import simple

import studio
from markdown import table

METHODS = ("Ordinary", "Viola 2004", "Marchesin 2010", "Ament 2017", "Optimized")
DISPLAY = {"ProtectImportance": 1, "ImportanceSmoothing": "Median", "Smoothness": 0.2}
PAPER = {"ProtectImportance": 0, "ImportanceSmoothing": "Off", "Smoothness": 0}
COLUMNS = [(method, {"Method": method, **DISPLAY}) for method in METHODS] + \
    [("Optimized (Paper)", {"Method": "Optimized", **PAPER})]
FOUND = ("VisibilityScore", "VisibleFraction")


def scores_of(scene):
    """By views and columns."""
    optimizer = studio.filter_of(scene)
    scores = {}
    for view in studio.VIEWS:
        studio.look_through(optimizer, scene, studio.viewpoint_of(scene, view))
        scores[view] = {}
        for head, settings in COLUMNS:
            for name, value in settings.items():
                setattr(optimizer, name, value)
            optimizer.UpdatePipeline()
            scores[view][head] = {name: optimizer.FieldData[name].GetRange()[0] for name in FOUND}
    simple.Delete(optimizer)
    return scores


def make(run):
    return {"scores": {scene.title: scores_of(scene) for scene in run.scenes()}}


def highest(scores, heads, key="VisibilityScore"):
    return max(heads, key=lambda head: scores[head][key])


def failures(numbers, optimized, key):
    """Scenes and views in which one of the methods is above the optimised extinction."""
    found = []
    for title, views in numbers["scores"].items():
        for view, scores in views.items():
            best = highest(scores, METHODS[:-1] + (optimized,), key)
            if best != optimized:
                found.append("{}, {} ({} {:+.1f} %)".format(
                    title, view, best, 100 * (scores[best][key] / scores[optimized][key] - 1)))
    return found


def caption(numbers):
    rows = [{"title": title, "view": view, "scores": scores}
            for title, views in numbers["scores"].items() for view, scores in views.items()]

    def cell(head):
        def text(row):
            found = row["scores"][head]
            words = "{}, {:.1f}".format(studio.significant(found["VisibilityScore"], 4),
                                        100 * found["VisibleFraction"])
            best = highest(row["scores"], row["scores"])
            return "**{}**".format(words) if head == best else words
        return text

    lines = []
    for optimized in ("Optimized", "Optimized (Paper)"):
        for key, words in (("VisibilityScore", "S"), ("VisibleFraction", "visible share")):
            above = failures(numbers, optimized, key)
            lines.append("* *{}* has not the highest {} in {} of {} views{}{}.".format(
                optimized, words, len(above), len(rows), ": " if above else "", "; ".join(above)))
    return table(rows, [("scene, view", lambda r: "{}, {}".format(r["title"], r["view"])),
                        *((head, cell(head)) for head, _ in COLUMNS)]) + "\n".join(lines)


if __name__ == "__main__":
    studio.main(__file__, __doc__)
