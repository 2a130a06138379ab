# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Fig. 7: one extinction for camera and light, or one for each, with the importance beside them.

  pvpython figure_7.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]

The presets are the paper's, since only that is the minimum of Eq. (21). Energies are those of the
fields that the filter finds, in units of length^2: F_p is summed over the nodes here, F_q and F_r are
those that the filter reports of a given extinction before its first iteration.
"""

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy

import studio
from markdown import significant, table

PIXELS = 215
HEADS = ("ordinary volume rendering", "importance", "separate extinctions", "joint extinction")
REGULARIZATION = 1e-3  # p, as it comes; q and r are 10 and 1


def pictures(scene, pixels):
    """Pictures with texts, in the order of HEADS."""
    with studio.Stage(studio.importance_scene(scene), pixels) as stage:
        importance, _ = stage.draw(Method="Ordinary")
    row = []
    with studio.Stage(scene, pixels) as stage:
        for settings in ({"Method": "Ordinary"},
                         {"Method": "Optimized", "Preset": "Paper", "Mode": "Separate"},
                         {"Mode": "Joint"}):
            picture, numbers = stage.draw(**settings)
            row.append((picture, studio.score_text(numbers)))
    return [row[0], (importance, ""), *row[1:]]


class Fields:
    """What the filter finds, and energies of any of it."""

    def __init__(self, scene):
        self.scene = scene
        self.joint = self.found("Joint", "Extinction")
        self.camera, self.light = self.found("Separate", "Extinction", "LightExtinction")

    def found(self, mode, *names):
        optimizer = studio.filter_of(self.scene, Mode=mode)
        optimizer.UpdatePipeline()
        points = studio.image_of(optimizer).GetPointData()
        fields = [vtk_to_numpy(points.GetArray(name)).astype(float) for name in names]
        self.base = vtk_to_numpy(points.GetArray("BaseExtinction")).astype(float)
        simple.Delete(optimizer)
        return fields if len(fields) > 1 else fields[0]

    def regularization(self, extinction):
        """F_p of Eq. (22), for lengths in half diagonals of the box, as the filter has it."""
        image = studio.image_of(self.scene.source)
        radius = image.GetLength() / 2
        return (REGULARIZATION * radius / 2 * np.prod(image.GetSpacing())
                * ((extinction - self.base) ** 2).sum())

    def visibility(self, extinction):
        """F_q and F_r of Eqs. (23) and (24)."""
        found = studio.visibility_of(self.scene, extinction)
        return found["ViewEnergy"], found["LightEnergy"]

    def energies(self):
        joint_view, joint_light = self.visibility(self.joint)
        view, own_light = self.visibility(self.camera)
        _, light = self.visibility(self.light)
        return {"joint": {"p": self.regularization(self.joint), "q": joint_view, "r": joint_light},
                "separate": {"p": self.regularization(self.camera),
                             "p of the light": self.regularization(self.light),
                             "q": view, "r": light, "r through the camera's": own_light}}


def make(run):
    rows, energies = [], {}
    for scene in run.scenes():
        rows.append(pictures(scene, run.pixels(PIXELS)))
        energies[scene.title] = Fields(scene).energies()
    figure = studio.picture_grid.compose(rows, HEADS, studio.names_of(energies))
    return {"energies": energies, "pictures": [run.save(figure, "figure-7.jpg")]}


def caption(numbers):
    rows = []
    for title, energy in numbers["energies"].items():
        joint, separate = energy["joint"], energy["separate"]
        rows.append({"title": title, "joint": joint["p"] + joint["q"] + joint["r"],
                     "pair": separate["p"] + separate["p of the light"] + separate["q"]
                     + separate["r"],
                     "one": separate["p"] + separate["q"] + separate["r through the camera's"],
                     "parts": (joint, separate)})

    def cell(value):
        return significant(value, 5)

    def light(key, of):
        return lambda row: "{:.2f}".format(row["parts"][1][key] / row["parts"][of]["r"])

    return table(rows, [
        ("scene", lambda r: r["title"]), ("F, joint", lambda r: cell(r["joint"])),
        ("F, separate", lambda r: cell(r["pair"])),
        ("F, camera's for both", lambda r: cell(r["one"])),
        ("F_q, joint", lambda r: cell(r["parts"][0]["q"])),
        ("F_q, separate", lambda r: cell(r["parts"][1]["q"])),
        ("F_r, joint", lambda r: cell(r["parts"][0]["r"])),
        ("F_r, separate", lambda r: cell(r["parts"][1]["r"])),
        ("light through the camera's extinction, separate / joint", light("r through the camera's", 0))])


if __name__ == "__main__":
    studio.main(__file__, __doc__)
