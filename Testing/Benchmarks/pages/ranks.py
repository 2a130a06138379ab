# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How long processes take that optimise an image together, what memory, and what they say."""

from markdown import fixed, head, percent, table

LATENCY = 5e-6  # of a message [s]
BANDWIDTH = 10e9  # of a rank [bytes/s]
THREADS = 16  # of a rank
EFFICIENCY = 0.8  # of these threads


def counts(counted):
    """Of the ranks that have most, an iteration in the middle: messages, bytes, waits."""
    return counted["steps"][len(counted["steps"]) // 2]


def threads_each(row):
    """Of a backend's name: "CPU, 2 threads, ..."."""
    return int(row["backend"].split(", ")[1].split()[0])


def uneven(counted):
    """Work of the rank that has most on a slice, over the mean: of camera and light together."""
    return (counted["uneven"]["camera"] + counted["uneven"]["light"]) / 2


def model(nodes, ranks, counted, seconds_per_node):
    """Seconds of an iteration on nodes^3 by so many ranks: work, waits, bytes. As many rows of rays
    to a rank as in the counted scene, whose bands and slices are so much larger."""
    largest = max(counted["nodes"])
    rows = ranks * largest / nodes
    alike = min(counted["counts"], key=lambda one: abs(one["ranks"] - rows))
    scale = nodes / largest
    most = counts(alike)
    work = nodes ** 3 * seconds_per_node / (ranks * THREADS * EFFICIENCY) * uneven(alike)
    # Rows are longer and there are more slices of them; what is exchanged whole is shared by ranks.
    volume = nodes ** 3 * 8 / ranks
    halo = max(most["bytes"] - 8 * counted["filled"] / alike["ranks"], 0) * scale ** 2
    return work, most["waits"] * scale * LATENCY, (volume + halo) / BANDWIDTH


def model_table(counted, seconds_per_node):
    rows = [(nodes, ranks) for nodes in (1024, 2048) for ranks in (8, 32, 128, 512)
            if nodes / ranks >= 4]

    def cell(row, part):
        return fixed(1e3 * model(*row, counted, seconds_per_node)[part], 0)

    return table(rows, [
        ("nodes", lambda row: f"{row[0]}³"), ("ranks", lambda row: str(row[1])),
        ("work [ms]", lambda row: cell(row, 0)), ("waits [ms]", lambda row: cell(row, 1)),
        ("bytes [ms]", lambda row: cell(row, 2)),
        ("efficiency", lambda row: percent(
            row[0] ** 3 * seconds_per_node / (row[1] * THREADS * EFFICIENCY) /
            sum(model(*row, counted, seconds_per_node))))])


def page(measured):
    text = head("Ranks", measured, "python3 Testing/Benchmarks/ranks.py --all") + """
The filter runs one optimisation on MPI processes (*ranks*). Each has a slab of the image and is bound to one processor, as
long as there are enough. The first row is one process with one thread, the second one with all threads. The tables have medians
of the iterations over the runs, their sum, and the time of the whole filter, including arrays of transmittance. Efficiency is
the time of one thread over the total time of all threads. It is given for an iteration in which no memory is used for the
first time (*steady*: the fourth) and for all iterations. Growth is the peak resident memory of the first rank beyond its
initial memory. It includes its piece of the image and the results. With more processes than processors, times are meaningless.

A rank's memory has two parts. The first consists of its pieces of fields and the nodes that an iteration needs: those beside
its bands of camera and light, or beside those of the camera alone, or a slab. The first of these choices that takes at most
1.35 times a share is used, because it is the fastest. The second part is two-dimensional: images of the rays that it has or
reads, images of nine times as many rays for the arrays of transmittance, slices of fields of other ranks, and plans, which are
whole on every rank.
"""
    for name, rows in measured["scenes"].items():
        one = rows[0]

        def efficiency(row, seconds_of):
            return percent(seconds_of(one) / seconds_of(row) / (row["ranks"] * threads_each(row)))

        def steady(row):
            return row["iterations"][3]

        def total(row):
            return sum(row["iterations"])

        text += f"\n## {name}\n\n" + table(rows, [
            ("ranks", lambda row: str(row["ranks"])),
            ("threads each", lambda row: str(threads_each(row))),
            ("iterations [ms]", lambda row: ", ".join(fixed(1e3 * s, 0) for s in row["iterations"])),
            ("sum [s]", lambda row: fixed(total(row), 3)),
            ("filter [s]", lambda row: fixed(row["seconds"], 2)),
            ("efficiency, steady", lambda row: efficiency(row, steady)),
            ("efficiency, all", lambda row: efficiency(row, total)),
            ("growth [MB]", lambda row: fixed(row["growth"], 0)),
            ("same score", lambda row: "yes" if row["score"] == one["score"] else "no")])
        counted = measured["counted"][name]
        text += f"""
`limpid_count_ranks` counts the communication of ranks in an iteration in the middle, for the rank with \
the largest number. A rank waits where it needs data of others. Uneven is the largest work of a rank \
over the mean, if all wait for each other on every slice. Held is the largest memory of a rank for a \
field, in whole pages, over its share of all nodes.

""" + table(counted["counts"], [
            ("ranks", lambda row: str(row["ranks"])),
            ("messages", lambda row: str(counts(row)["messages"])),
            ("MB", lambda row: fixed(counts(row)["bytes"] / 1e6, 2)),
            ("waits", lambda row: str(counts(row)["waits"])),
            ("uneven, camera", lambda row: fixed(row["uneven"]["camera"], 2)),
            ("uneven, light", lambda row: fixed(row["uneven"]["light"], 2)),
            ("held", lambda row: fixed(row["held"], 2))])
        seconds_per_node = steady(one) / float(counted["filled"])
        text += f"""
**A model, not measured**: The scene has {fixed(1e9 * seconds_per_node, 0)} ns of work per filled node in \
an iteration, as above with one thread, and is filled everywhere. Ranks have {THREADS} threads, and \
{percent(EFFICIENCY)} of their time is work. There are {fixed(1e6 * LATENCY, 0)} µs per wait and \
{fixed(BANDWIDTH / 1e9, 0)} GB/s per rank. Bands are as uneven as those above with as many rows. Work and \
communication do not overlap.

""" + model_table(counted, seconds_per_node)
    return text
