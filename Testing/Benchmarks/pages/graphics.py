# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Pictures drawn by OpenGL against those of the processor."""

from markdown import fixed, head, ms, percent, significant, table

NAMES = {"base": "ordinary", "shaded": "with light", "optimized": "optimised",
         "shadows": "with light, optimised", "missed": "with missed structures"}


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
Pictures of {measured['size']} × {measured['size']} pixels drawn by {renderer} (`DrawOn`) are compared \
with those of {still(rows[0], 'processor')}. The table has their differences in levels of 255 (mean, share of \
the pixels above 4, largest), and the time of a picture after everything else is done [ms]. If OpenGL \
is software, such as llvmpipe, these times only show why *Auto* does not use it.
""" + table(rows, [("scene", lambda row: f"{row[0]}, {NAMES[row[1]]}"),
                   ("mean", lambda row: fixed(still(row, "mean"), 4)),
                   ("above 4", lambda row: percent(still(row, "above_4"), 3)),
                   ("largest", lambda row: fixed(still(row, "largest"))),
                   ("processor", lambda row: ms(still(row, "processor_seconds"))),
                   ("OpenGL", lambda row: ms(still(row, "opengl_seconds")))]) + """
The next table has the uploads. *First* and *step* are bytes per point of the first picture and of the \
largest step of an optimisation, both with shadows (2 for the extinction, 4 where it was added to, and 2 \
for the shadows, in changed bricks of 32³ points). *Rest* and *turn* are the total bytes of a picture at \
rest and of one after a turn. The light is fixed, because a light that moves with the camera would \
change the shadows.
""" + table(list(scenes), [("scene", str),
                           *[(key, lambda name, key=key: significant(upload(name, key)))
                             for key in ("first", "step")],
                           *[(key, lambda name, key=key: str(upload(name, key)))
                             for key in ("rest", "turn")]]) + """
The next table has frames of 1920 × 1080 pixels while the camera turns by one degree per frame, with \
shadows and the optimisation: median and longest [ms]. The processor draws coarser frames, so that they \
take 100 ms.
""" + table(list(scenes), [("scene", str),
                           *[(f"{label}, {key}", lambda name, device=device, key=key:
                              motion(name, device, key))
                             for device, label in (("processor", "processor"),
                                                   ("opengl", "OpenGL"))
                             for key in ("median", "longest")]])
