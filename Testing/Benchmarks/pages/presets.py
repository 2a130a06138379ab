# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What the presets show in thin and in dense data."""

from markdown import fixed, head, table

ORDER = ("Keep Context", "Default", "Strong Reveal")
KINDS = {"own": "the scene's own", "ramp": "ParaView's default"}


def page(measured):
    rows = [(scene, kind, row) for scene, kinds in measured["scenes"].items()
            for kind, found in kinds.items() for row in found]

    def share(row, preset, key="VisibleFraction"):
        return row[2]["presets"][preset][key]

    def is_ordered(row):
        shares = [share(row, preset) for preset in ORDER]
        return shares == sorted(shares)

    def column(preset):
        return preset, lambda row: fixed(100 * share(row, preset), 2)

    ordered = sum(map(is_ordered, rows))
    return head("Presets", measured, "python3 Testing/Benchmarks/presets.py") + f"""
The table has the visible share of the important structures in per cent, by the filter, with the \
scene's camera, light and importance, without optimisation (*before*) and with the presets. *Distance* \
is the unit distance of the opacity function, relative to that of the scene or, with ParaView's default \
opacity, to the length of a cell. The longer it is, the thinner are the data. In {ordered} of \
{len(rows)} rows *Keep Context*, *Default* and *Strong Reveal* show more in this order.
""" + table(rows, [("scene", lambda row: row[0]), ("opacity", lambda row: KINDS[row[1]]),
                   ("distance", lambda row: fixed(row[2]["distance"], 2)),
                   ("before", lambda row: fixed(
                       100 * share(row, "Default", "BaseVisibleFraction"), 2)),
                   *map(column, (*ORDER, "Paper")),
                   ("in order", lambda row: "yes" if is_ordered(row) else "**no**")])
