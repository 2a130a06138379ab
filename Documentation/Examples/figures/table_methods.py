# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""S of all methods from all sides: where is the optimised extinction not the one with the highest S?

  pvpython table_methods.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]

By the filter, all of the volume counts. Optimized is as the display has it, Optimized (Paper) as the
paper does: by the presets Default and Paper. Ament 2017 depends on its
weights, so several are tried from the scenes' own cameras.
"""

from paraview import simple

from figure_8 import AMENT, METHODS
import studio
from markdown import table

OCCLUDERS = (30, 300, 3000, 30000)  # q of Ament 2017
EXPONENTS = (1, 3)  # its lambda
COLUMNS = [(method, {"Method": method, "Preset": "Default"}) for method in METHODS] + \
    [("Optimized (Paper)", {"Method": "Optimized", "Preset": "Paper"})]
FOUND = ("VisibilityScore", "VisibleFraction")


def found(optimizer):
    optimizer.UpdatePipeline()
    return {name: optimizer.FieldData[name].GetRange()[0] for name in FOUND}


def ament_scores(scene):
    """S by exponents and weights, of the scene's own camera."""
    optimizer = studio.filter_of(scene, Method="Ament 2017")
    scores = []
    for exponent in EXPONENTS:
        optimizer.AmentExponent = exponent
        scores.append([])
        for occluders in OCCLUDERS:
            optimizer.AmentOccluders = occluders
            scores[-1].append(found(optimizer)["VisibilityScore"])
    simple.Delete(optimizer)
    return scores


def scores_of(scene):
    """By views and columns."""
    optimizer = studio.filter_of(scene, **AMENT)
    scores = {}
    for view in studio.VIEWS:
        studio.look_through(optimizer, scene, studio.viewpoint_of(scene, view))
        scores[view] = {}
        for head, settings in COLUMNS:
            for name, value in settings.items():
                setattr(optimizer, name, value)
            scores[view][head] = found(optimizer)
    simple.Delete(optimizer)
    return scores


def make(run):
    scores, weights = {}, {}
    for scene in run.scenes():
        scores[scene.title] = scores_of(scene)
        weights[scene.title] = ament_scores(scene)
    return {"scores": scores, "weights": weights}


def highest(scores, heads, key="VisibilityScore"):
    return max(heads, key=lambda head: scores[head][key])


def failures(numbers, optimized, key):
    """Scenes and views in which one of the methods is above the optimised extinction."""
    above = []
    for title, views in numbers["scores"].items():
        for view, scores in views.items():
            best = highest(scores, METHODS[:-1] + (optimized,), key)
            if best != optimized:
                above.append("{}, {} ({} {:+.1f} %)".format(
                    title, view, best, 100 * (scores[best][key] / scores[optimized][key] - 1)))
    return above


def ament_table(numbers):
    """S of the weights, as shares of that of Optimized (Paper)."""
    best = {title: views["own"]["Optimized (Paper)"]["VisibilityScore"]
            for title, views in numbers["scores"].items()}

    def cell(row, column):
        return lambda r: "{:.2f}".format(r["scores"][row][column] / best[r["title"]])

    rows = [{"title": title, "scores": scores} for title, scores in numbers["weights"].items()]
    return table(rows, [("scene", lambda r: r["title"])] + [
        ("λ {:g}, q {:g}".format(exponent, occluders), cell(row, column))
        for row, exponent in enumerate(EXPONENTS) for column, occluders in enumerate(OCCLUDERS)])


def caption(numbers):
    rows = [{"title": title, "view": view, "scores": scores}
            for title, views in numbers["scores"].items() for view, scores in views.items()]

    def cell(head):
        def text(row):
            score = row["scores"][head]
            words = "{}, {:.1f}".format(studio.significant(score["VisibilityScore"], 4),
                                        100 * score["VisibleFraction"])
            return "**{}**".format(words) if head == highest(row["scores"], row["scores"]) else words
        return text

    lines = []
    for optimized in ("Optimized", "Optimized (Paper)"):
        for key, words in (("VisibilityScore", "highest S"),
                           ("VisibleFraction", "largest visible share")):
            above = failures(numbers, optimized, key)
            lines.append("* *{}* has the {} in {} of {} views{}{}.".format(
                optimized, words, len(rows) - len(above), len(rows),
                "; not in " if above else "", "; ".join(above)))
    return "{}{}\n\nAment 2017, S over that of *Optimized (Paper)*, from the scenes' own cameras:\n{}".format(
        table(rows, [("scene, view", lambda r: "{}, {}".format(r["title"], r["view"])),
                     *((head, cell(head)) for head, _ in COLUMNS)]), "\n".join(lines),
        ament_table(numbers))


if __name__ == "__main__":
    studio.main(__file__, __doc__)
