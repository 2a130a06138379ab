# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Real scenes for a machine without VTK (Testing/Scenes/PackedVolume.cxx reads them).

    python3 pack-scenes.py DATA FOLDER

Writes FOLDER/NAME.scene.json and FOLDER/NAME.packed for each scene of DATA: nodes, spacing, origin
and range of the values, then the values, as 16 bits of that range.
"""

import json
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Scenes"))

from scene_values import read_scene  # noqa: E402


def pack(path, folder):
    scene, image, values = read_scene(path)
    values = values.astype(float)
    low, high = values.min(), values.max()
    scene["data"]["file"] = scene["name"] + ".packed"
    (folder / path.name).write_text(json.dumps(scene))
    with open(folder / scene["data"]["file"], "wb") as packed:
        numpy.array(image.GetDimensions(), "<i4").tofile(packed)
        numpy.array([*image.GetSpacing(), *image.GetOrigin(), low, high], "<f8").tofile(packed)
        numpy.round((values - low) / (high - low) * 65535).astype("<u2").tofile(packed)


def main(data, folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for path in sorted(pathlib.Path(data).glob("*.scene.json")):
        pack(path, folder)


if __name__ == "__main__":
    main(*sys.argv[1:])
