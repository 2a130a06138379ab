# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Pictures drawn by OpenGL against those of the processor."""

from markdown import fixed, head, ms, percent, significant, table

NAMES = {"base": "as it is", "shaded": "with light", "optimized": "optimised",
         "shadows": "with light, optimised", "missed": "with what is missed"}


def page(measured):
    scenes = measured["scenes"]
    rows = [(name, look) for name in scenes for look in NAMES]

    def still(row, key):
        return scenes[row[0]]["stills"][row[1]][key]

    def upload(name, key):
        return scenes[name]["uploads"][key]

    def motion(name, device, key):
        return ms(scenes[name]["motion"][device][key])

    renderer = still(rows[0], "opengl")
    return head("Graphics", measured, "python3 Testing/Benchmarks/graphics.py") + f"""
Pictures of {measured['size']} × {measured['size']} pixels that are drawn by {renderer} (`DrawOn`), \
against those of {still(rows[0], 'processor')}: their differences in levels of 255 (mean, share of \
the pixels above 4, largest), and the time of a picture with everything else done [ms]. If OpenGL \
is software, as llvmpipe is, these times only say why *Auto* leaves it alone.
""" + table(rows, [("scene", lambda row: f"{row[0]}, {NAMES[row[1]]}"),
                   ("mean", lambda row: fixed(still(row, "mean"), 4)),
                   ("above 4", lambda row: percent(still(row, "above_4"), 3)),
                   ("largest", lambda row: fixed(still(row, "largest"))),
                   ("processor", lambda row: ms(still(row, "processor_seconds"))),
                   ("OpenGL", lambda row: ms(still(row, "opengl_seconds")))]) + """
Uploads: bytes per point of the first picture and of the largest step of an optimisation, both with \
shadows (2 of the extinction, 4 where it was added to, and 2 of the shadows, in bricks of 32³ \
points that have changed), and bytes in all of a picture at rest and of one after a turn, with a \
light that stays where it is: one that moves with the camera has other shadows.
""" + table(list(scenes), [("scene", str),
                           *[(key, lambda name, key=key: significant(upload(name, key)))
                             for key in ("first", "step")],
                           *[(key, lambda name, key=key: str(upload(name, key)))
                             for key in ("rest", "turn")]]) + """
Frames of 1920 × 1080 pixels while the camera turns by one degree a frame, with shadows and the \
optimisation: median and longest [ms]. The processor draws coarser frames, so that they take 100 ms.
""" + table(list(scenes), [("scene", str),
                           *[(f"{label}, {key}", lambda name, device=device, key=key:
                              motion(name, device, key))
                             for device, label in (("processor", "processor"),
                                                   ("opengl", "OpenGL"))
                             for key in ("median", "longest")]])
