# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""A sheet of pictures, a row per scene, and the command line of scripts that make one."""

import argparse
import os
import tempfile

from paraview import simple

import scenes
from picture_grid import pyplot

DOTS = 110  # per inch
LETTER = 0.0081  # width of a letter [inches], of a size of one point


def parser():
    """Takes the plugin, the sheet, and scene files; without any, the scene is the embedded phantom."""
    result = argparse.ArgumentParser()
    result.add_argument("--plugin", required=True)
    result.add_argument("--output", required=True)
    result.add_argument("scenes", nargs="*")
    return result


def picture_of(view):
    """Rows from the top, columns, red green blue, from 0 to 1."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.png")
        simple.SaveScreenshot(path, view, ImageResolution=view.ViewSize)
        return pyplot.imread(path)[..., :3]


def draw(arguments, across, size, pictures):
    """Draws `across` pictures of `size` inches for every scene: pictures(scene) yields a title and a
    picture each."""
    simple.LoadPlugin(os.path.abspath(arguments.plugin), remote=False, ns=vars(simple))
    rows = [scenes.read_scene(simple, path) for path in arguments.scenes]
    rows = rows or [scenes.phantom_scene(simple)]
    figure, axes = pyplot.subplots(len(rows), across, squeeze=False, facecolor="white",
                                   figsize=(size * across, (size + 0.35) * len(rows)))
    for scene, row in zip(rows, axes):
        scene.source.UpdatePipeline()
        for axis, (title, picture) in zip(row, pictures(scene)):
            axis.set_axis_off()
            axis.imshow(picture)
            name = scene.title if axis is row[0] else ""
            axis.set_title("{}\n{}".format(name, title), pad=3, loc="left",
                           fontsize=min(6, size / LETTER / len(title)))
        simple.Delete(scene.source)
    figure.tight_layout(pad=0.4)
    figure.savefig(arguments.output, dpi=DOTS)
