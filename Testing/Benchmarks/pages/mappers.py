# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Limpid's mapper beside VTK's own."""

from markdown import fixed, head, noise, table

COMMAND = ("bash Testing/with-display.sh /usr/bin/python3 Testing/Benchmarks/rendering_mappers.py "
           "--output Documentation/Benchmarks/Mappers.json NAME.scene.json ...")
REFERENCE = "vtkFixedPointVolumeRayCastMapper, shaded"


def milliseconds(key):
    return lambda row: fixed(1e3 * row[1][key])


def still_table(scene):
    reference = scene["still"][REFERENCE]

    def ratio(key):
        return lambda row: fixed(row[1][key] / reference[key], 2)

    return table(scene["still"].items(), [
        ("still pictures [ms]", lambda row: row[0]), ("median", milliseconds("median")),
        ("shortest", milliseconds("shortest")), ("longest", milliseconds("longest")),
        ("all cores", milliseconds("cores")), ("of fixed point, shaded", ratio("median")),
        ("all cores", ratio("cores"))])


def moving_table(scene, learning):
    return table(scene["moving"].items(), [
        ("moving, lit, shadows [ms]", lambda row: row[0]), ("first frame", milliseconds("first")),
        (f"longest of the next {learning - 1}", milliseconds("learning")),
        ("median after", milliseconds("median")), ("longest after", milliseconds("longest"))])


def difference_table(scenes):
    columns = [("scene", lambda s: s["scene"])]
    for n, difference in enumerate(scenes[0]["differences"]):
        where = f", {difference['azimuth']}°, {difference['elevation']}°"
        columns.append((difference["mapper"] + (where if n % 2 == 0 else ""), lambda s, n=n: (
            f"{s['differences'][n]['all']:.2f} ({s['differences'][n]['covered']:.2f})")))
    return table(scenes, columns)


def page(measured):
    scenes, size = measured["scenes"], measured["size"]
    warning = noise([t["spread"] for s in scenes for t in s["still"].values()], 0.2)
    text = head("Mappers", measured, COMMAND) + ("\n" + warning[:-1] if warning else "")
    for scene in scenes:
        text += f"\n## {scene['scene']}, {size} x {size}\n" + still_table(scene)[:-1]
        text += moving_table(scene, measured["learning"])
    return text + ("\n## Mean absolute difference of unlit pictures, of all (of covered) pixels "
                   f"[1/255]\n{difference_table(scenes)}")
