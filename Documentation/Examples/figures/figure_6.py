# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Fig. 6: the score S of several views, of ordinary volume rendering and of the optimised one.

  pvpython figure_6.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]
"""

import studio

VIEWS = ("own", "right", "opposite")
METHODS = ("Ordinary", "Optimized")
PIXELS = 172


def make(run):
    rows, scores = [], {}
    for scene in run.scenes():
        row, scores[scene.title] = [], {}
        with studio.Stage(scene, run.pixels(PIXELS)) as stage:
            for view in VIEWS:
                stage.look(studio.viewpoint_of(scene, view))
                for method in METHODS:
                    picture, numbers = stage.draw(Method=method)
                    row.append((picture, studio.score_text(numbers)))
                scores[scene.title][view] = numbers
        rows.append(row)
    heads = ["{}\n{} view".format(method.lower(), view) for view in VIEWS for method in METHODS]
    figure = studio.picture_grid.compose(rows, heads, studio.names_of(scores))
    return {"scores": scores, "pictures": [run.save(figure, "figure-6.jpg")]}


def caption(numbers):
    gains = [view["VisibilityScore"] / view["BaseVisibilityScore"]
             for views in numbers["scores"].values() for view in views.values()]
    fractions = [(view["BaseVisibleFraction"], view["VisibleFraction"])
                 for views in numbers["scores"].values() for view in views.values()]
    return ("S rises by a factor of {:.1f} to {:.1f}, in {} of {} views. The visible share "
            "of the important structures rises from {:.1f}–{:.1f} % to {:.1f}–{:.1f} %.").format(
                min(gains), max(gains), sum(gain > 1 for gain in gains), len(gains),
                *(100 * edge([pair[place] for pair in fractions])
                  for place in (0, 1) for edge in (min, max)))


if __name__ == "__main__":
    studio.main(__file__, __doc__)
