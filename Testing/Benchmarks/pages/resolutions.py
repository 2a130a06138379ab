# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The paper's Fig. 10 for Limpid: resolution of the world against that of the rays."""

from markdown import fixed, head, ms, significant, table

COLUMNS = [
    ("nodes along each axis", lambda p: "all" if p["coarsening"] == 1 else f"1/{p['coarsening']}"),
    ("rays per node", lambda p: significant(p["ray_density"], 2)),
    ("whole run [ms]", lambda p: ms(p["seconds"])),
    ("F (march)", lambda p: fixed(p["F"])),
    ("S (march)", lambda p: significant(p["S"], 5)),
    ("picture, rms difference from the last [of 255]",
     lambda p: significant(p["rms_difference"], 2))]


def page(measured):
    text = head("Resolutions", measured) + f"""
The policy runs on fewer nodes and with more or fewer rays, for camera and light. The numbers are \
medians of {measured['options']['repeats']:g} runs, each with resampling to and from the coarse grid.
"""
    for scene in measured["scenes"]:
        text += f"\n## {scene['name']}\n{table(scene['pictures'], COLUMNS)}"
    return text
