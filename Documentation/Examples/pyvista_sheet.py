# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Draws scenes before and after with PyVista, and after by limpid.render: a column per scene.

  python3 pyvista_sheet.py SHEET.jpg [FILE.scene.json ...]

It needs the Python package of Plugin/Wheel with PyVista, no ParaView, and an X server, if only a
virtual one. Without scenes: PyVista's wavelet.
"""

import os
import sys

import numpy as np
import pyvista

import limpid

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import picture_grid  # pylint: disable=wrong-import-position
from scene_file import SceneFile  # pylint: disable=wrong-import-position

SIZE = 270  # of a picture [pixels]
BACKGROUND = (0.08, 0.08, 0.1)
ROWS = ("before\nPyVista", "after\nPyVista", "after, lit and shadowed\nlimpid.render")

WAVELET = {
    "title": "Wavelet",
    "data": {"array": "RTData"},
    "color_tf": [[37, 0.25, 0.4, 0.7], [160, 0.8, 0.8, 0.75], [210, 0.9, 0.55, 0.2],
                 [277, 0.8, 0.1, 0.1]],
    "extinction_tf": [[37, 0], [90, 0], [150, 0.25], [277, 0.6]],
    "importance_tf": [[205, 0], [240, 1]],
    "camera": {"position": [45, -60, 30], "focal_point": [0, 0, 0], "view_up": [0, 0, 1],
               "view_angle": 30},
    "light": {"position": [-20, -80, 70]}}


def scenes(paths):
    """Descriptions, as scene files have them, each with its image."""
    for path in paths:
        file = SceneFile(path).check()
        yield file.description, pyvista.read(file.image_path())
    if not paths:
        yield WAVELET, pyvista.Wavelet()


def picture_by_pyvista(scene, image, extinction):
    """A volume of PyVista's in the scene's colors, with the opacities of an extinction [1/length]:
    red, green, blue, (SIZE, SIZE, 3), from 0 to 1."""
    scalars = np.asarray(image[scene["data"]["array"]], dtype=float)
    values, *channels = np.transpose(scene["color_tf"])
    # On this distance the densest matter is nearly opaque, so that a byte has steps enough.
    distance = 3 / max(extinction for _, extinction in scene["extinction_tf"])
    rgba = [np.interp(scalars, values, channel) for channel in channels]
    rgba.append(-np.expm1(-extinction.ravel(order="F") * distance))
    volume = image.copy(deep=False)
    volume["rgba"] = np.round(255 * np.column_stack(rgba)).astype(np.uint8)

    plotter = pyvista.Plotter(off_screen=True, window_size=(SIZE, SIZE))
    plotter.background_color = BACKGROUND
    actor = plotter.add_volume(volume, scalars="rgba", opacity_unit_distance=distance,
                               mapper="gpu", shade=True, ambient=0.5, diffuse=0.8, specular=0.2)
    actor.prop.interpolation_type = "linear"
    actor.mapper.auto_adjust_sample_distances = False
    actor.mapper.sample_distance = 0.5 * min(image.spacing)
    actor.mapper.SetUseJittering(True)  # no grain of wood where samples lie
    camera = scene["camera"]
    plotter.camera.position = camera["position"]
    plotter.camera.focal_point = camera["focal_point"]
    plotter.camera.up = camera["view_up"]
    plotter.camera.view_angle = camera["view_angle"]
    plotter.reset_camera_clipping_range()
    picture = plotter.screenshot(return_img=True)
    plotter.close()
    return picture[..., :3] / 255


def picture_by_limpid(scene, image, extinction):
    """What picture_by_pyvista returns, but lit and shadowed."""
    rgba = limpid.render(image, scalars=scene["data"]["array"], color_function=scene["color_tf"],
                         extinction_function=scene["extinction_tf"], extinction=extinction,
                         camera=scene["camera"], light=scene["light"]["position"],
                         width=SIZE, height=SIZE) / 255
    alpha = rgba[..., 3:]
    return alpha * rgba[..., :3] + (1 - alpha) * BACKGROUND


def column(scene, image):
    """The pictures of a scene, each with a line of words, and its title."""
    array = scene["data"]["array"]
    found = limpid.optimize(image, scalars=array, extinction_function=scene["extinction_tf"],
                            importance_function=scene["importance_tf"], camera=scene["camera"],
                            light=scene["light"]["position"])
    print(f"{scene['title']}: {found}", flush=True)
    nodes = np.transpose(scene["extinction_tf"])
    base = np.interp(np.asarray(image[array], dtype=float), *nodes)
    before = f"{100 * found.base_visible_fraction:.1f} % visible"
    after = f"{100 * found.visible_fraction:.1f} % visible"
    return [(picture_by_pyvista(scene, image, base), before),
            (picture_by_pyvista(scene, image, found.extinction), after),
            (picture_by_limpid(scene, image, found.extinction), "")], scene["title"]


def main(sheet, *paths):
    columns, titles = zip(*(column(scene, image) for scene, image in scenes(paths)))
    figure = picture_grid.compose(list(zip(*columns)), heads=titles, names=ROWS)
    picture_grid.save(figure, sheet)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
