# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Fig. 10: fewer nodes of the world grid (columns), and more or fewer rays (rows).

  pvpython figure_10.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]

Columns: the data, and so the extinction, at every fourth, every second, and every node along each
axis, by means. Rows: rays per node, which is what Limpid has instead of a grid in view space. S is that
of the nodes of the data, on which the change found on the coarse ones is interpolated, as a share of
the highest.
"""

import dataclasses

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy

import studio

SCENES = ("phantom", "visible_male")
STEPS = (4, 2, 1)
DENSITIES = (0.25, 0.5, 1, 2)
PIXELS = 270


def along_axes(field, matrices):
    """A field with a matrix applied along every axis."""
    for axis, matrix in enumerate(matrices):
        field = np.moveaxis(np.tensordot(matrix, field, axes=(1, axis)), 0, axis)
    return field


def hats(places, nodes):
    """Values of the hats of nodes 0, 1, ... at some places: a row per place."""
    return np.maximum(0, 1 - np.abs(np.subtract.outer(places, np.arange(nodes))))


def restricted(field, step):
    """Means over the hats of every step-th node."""
    def means(nodes):
        weights = hats(np.arange(nodes) / step, (nodes - 1) // step + 1).T
        return weights / weights.sum(axis=1, keepdims=True)

    return along_axes(field, map(means, field.shape))


def prolonged(field, step, shape):
    """Linearly between the coarse nodes; beyond the last one its value."""
    return along_axes(field, [hats(np.minimum(np.arange(nodes) / step, coarse - 1), coarse)
                              for nodes, coarse in zip(shape, field.shape)])


def fields_of(image, names):
    shape = image.GetDimensions()[::-1]
    return {name: vtk_to_numpy(image.GetPointData().GetArray(name)).astype(float).reshape(shape)
            for name in names}


def coarse_scene(scene, step):
    """The scene with all of its fields on every step-th node."""
    image = studio.image_of(scene.source)
    fields = fields_of(image, (scene.array, scene.extinction_array))
    fields["FigureImportance"] = studio.importance_of(scene).reshape(image.GetDimensions()[::-1])
    fields = {name: restricted(field, step) for name, field in fields.items()}
    coarse = studio.vtkImageData()
    coarse.SetDimensions(*fields[scene.array].shape[::-1])
    coarse.SetOrigin(image.GetPoint(0))
    coarse.SetSpacing([step * spacing for spacing in image.GetSpacing()])
    source = studio.source_of(studio.copied(
        coarse, **{name: field.ravel() for name, field in fields.items()}))
    return dataclasses.replace(scene, source=source, importance_array="FigureImportance",
                               importance=[])


def score(scene, coarse, step, density):
    """S on the nodes of the data, where the share that is kept and the extinction that is added, as
    found on the coarse grid, are interpolated."""
    optimizer = studio.filter_of(coarse, RayDensity=density)
    optimizer.UpdatePipeline()
    found = fields_of(studio.image_of(optimizer), ("Extinction", "BaseExtinction"))
    simple.Delete(optimizer)
    base = fields_of(studio.image_of(scene.source), [scene.extinction_array])[scene.extinction_array]
    coarse_base = found["BaseExtinction"]
    kept = np.divide(found["Extinction"], coarse_base, out=np.ones_like(coarse_base),
                     where=coarse_base > 0)
    added = np.maximum(found["Extinction"] - coarse_base, 0)
    extinction = base * prolonged(np.minimum(kept, 1), step, base.shape)
    extinction += prolonged(added, step, base.shape)
    extinction = np.minimum(extinction, studio.majorant_of(scene))
    return studio.visibility_of(scene, extinction.ravel())["VisibilityScore"]


def pictures(scene, pixels):
    """Pictures and S by density and step."""
    found = {}
    for step in STEPS:
        coarse = coarse_scene(scene, step)
        with studio.Stage(coarse, pixels) as stage:
            for density in DENSITIES:
                picture, _ = stage.draw(Preset="Paper", RayDensity=density)
                found[density, step] = picture, score(scene, coarse, step, density)
        simple.Delete(coarse.source)
    return found


def make(run):
    scores, saved = {}, []
    heads = ["every {}node".format({4: "fourth ", 2: "second ", 1: ""}[step]) for step in STEPS]
    names = ["{:g} rays per node".format(density) for density in DENSITIES]
    for scene in run.scenes(SCENES):
        found = pictures(scene, run.pixels(PIXELS))
        best = max(of_scene for _, of_scene in found.values())
        rows = [[(found[density, step][0], "S {:.1f} %".format(
            100 * found[density, step][1] / best)) for step in STEPS] for density in DENSITIES]
        saved.append(run.save(studio.picture_grid.compose(rows, heads, names),
                              "figure-10-{}.jpg".format(scene.name)))
        scores[scene.title] = [[found[density, step][1] for step in STEPS]
                               for density in DENSITIES]
    return {"scores": scores, "pictures": saved}


def caption(numbers):
    sentences = []
    for title, scores in numbers["scores"].items():
        best = max(map(max, scores))
        sentences.append(
            "{}: half the nodes along each axis reach {:.1f} % of S, a quarter {:.1f} % (one ray per "
            "node); half the rays reach {:.1f} %, a quarter {:.1f} % (all nodes).".format(
                title, *(100 * share / best for share in (
                    scores[2][1], scores[2][0], scores[1][2], scores[0][2]))))
    return " ".join(sentences)


if __name__ == "__main__":
    studio.main(__file__, __doc__)
