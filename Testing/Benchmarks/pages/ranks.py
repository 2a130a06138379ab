# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How long processes take that optimise an image together, and what memory."""

from markdown import fixed, head, percent, table


def page(measured):
    text = head("Ranks", measured, "python3 Testing/Benchmarks/ranks.py --all") + """
One optimisation by the filter, by processes of MPI (*ranks*) that each have a slab of the image, bound to one processor each
as long as there are enough; the first row is one process with one thread, the second one with all. Medians of the iterations
over the runs, their sum, and everything in the filter, arrays of transmittance included. Efficiency: one thread's time over
that of so many threads' together, of an iteration in which nothing is touched for the first time (*steady*: the fourth) and
of all iterations. Growth: resident memory of the first rank at its peak, above what it has before, its piece of the image and
the results among it. More processes than processors say nothing about time.

A rank's memory has two parts: fields, of which it has the nodes beside its bands of camera and light, and what is
two-dimensional and whole on every rank: images of rays, plans and, for the arrays of transmittance, those of nine times as
many rays.
"""
    for name, rows in measured["scenes"].items():
        one = rows[0]

        def efficiency(row, seconds_of):
            threads = row["ranks"] * int(row["backend"].split(", ")[1].split()[0])
            return percent(seconds_of(one) / seconds_of(row) / threads)

        def steady(row):
            return row["iterations"][3]

        def total(row):
            return sum(row["iterations"])

        text += f"\n## {name}\n\n" + table(rows, [
            ("ranks", lambda row: str(row["ranks"])),
            ("threads each", lambda row: row["backend"].split(", ")[1].split()[0]),
            ("iterations [ms]", lambda row: ", ".join(fixed(1e3 * s, 0) for s in row["iterations"])),
            ("sum [s]", lambda row: fixed(total(row), 3)),
            ("filter [s]", lambda row: fixed(row["seconds"], 2)),
            ("efficiency, steady", lambda row: efficiency(row, steady)),
            ("efficiency, all", lambda row: efficiency(row, total)),
            ("growth [MB]", lambda row: fixed(row["growth"], 0)),
            ("same score", lambda row: "yes" if row["score"] == one["score"] else "no")])
    return text
