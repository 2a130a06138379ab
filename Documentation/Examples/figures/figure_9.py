# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Fig. 9: S of all directions on both hemispheres, with the best and the worst view.

  pvpython figure_9.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]
"""

import os
import tempfile

import studio
import sphere_sheet
import viewpoints

DIRECTIONS = 642


def make(run):
    views = {}
    with tempfile.TemporaryDirectory() as folder:
        folders = []
        for scene in run.scenes():
            folders.append(os.path.join(folder, scene.name))
            search, named = viewpoints.explore(scene, 12 if run.quick else DIRECTIONS, folders[-1])
            views[scene.title] = {
                "best": named["viewpoint 1"]["VisibilityScore"],
                "worst": named["worst view"]["VisibilityScore"],
                "seconds": search.FieldData["Seconds"].GetRange()[0]}
            studio.delete_all_but(scene.source)
        return {"views": views,
                "pictures": [run.save(sphere_sheet.sheet_of(folders), "figure-9.jpg")]}


def caption(numbers):
    views = numbers["views"]
    seconds = [view["seconds"] for view in views.values()]
    return ("Ratio of S in the best direction to S in the worst, for the importance alone: {}. {}"
            "A search takes {:.1f} "
            "to {:.1f} s.").format(
                ", ".join("{} {:.2f}".format(title, view["best"] / view["worst"])
                          for title, view in views.items()),
                studio.load_warning(numbers), min(seconds), max(seconds))


if __name__ == "__main__":
    studio.main(__file__, __doc__)
