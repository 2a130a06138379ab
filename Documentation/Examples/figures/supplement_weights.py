# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The supplement's study of the weights: q of the view in the columns, r of the light in the rows.

  pvpython supplement_weights.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]

With the preset Paper, so that nothing but Eq. (21) counts; p is 0.001.
"""

import studio

SCENES = ("phantom", "visible_male")
VIEW_WEIGHTS = (0, 0.1, 1, 10, 100)
LIGHT_WEIGHTS = (0, 1, 10, 100)
PIXELS = 200


def make(run):
    scores, saved = {}, []
    for scene in run.scenes(SCENES):
        rows, scores[scene.title] = [], []
        with studio.Stage(scene, run.pixels(PIXELS)) as stage:
            stage.display.Preset = "Paper"
            for light in LIGHT_WEIGHTS:
                row = [stage.draw(ViewWeight=view, LightWeight=light) for view in VIEW_WEIGHTS]
                rows.append([(picture, studio.score_text(numbers)) for picture, numbers in row])
                scores[scene.title].append([numbers["VisibilityScore"] for _, numbers in row])
        heads = ["q = {:g}".format(weight) for weight in VIEW_WEIGHTS]
        names = ["r = {:g}".format(weight) for weight in LIGHT_WEIGHTS]
        saved.append(run.save(studio.picture_grid.compose(rows, heads, names),
                              "supplement-weights-{}.jpg".format(scene.name)))
    return {"scores": scores, "pictures": saved}


def caption(numbers):
    sentences = []
    for title, scores in numbers["scores"].items():
        base, best = scores[0][0], max(map(max, scores))
        own = scores[LIGHT_WEIGHTS.index(1)][VIEW_WEIGHTS.index(10)]
        sentences.append(
            "{}: S rises from {} without any weight to {}; the paper's q = 10, r = 1 reach {:.1f} % of "
            "that; light alone, q = 0 and r = 1, reaches {:.1f} %.".format(
                title, *(studio.significant(score, 4) for score in (base, best)),
                100 * own / best, 100 * scores[LIGHT_WEIGHTS.index(1)][0] / best))
    return " ".join(sentences)


if __name__ == "__main__":
    studio.main(__file__, __doc__)
