# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Entries of Google Benchmark: streams through memory, passes of an iteration, sweeps and rows."""

import re

from markdown import fixed, head, ms, noise, percent, plural, significant, sizes, table

UNITS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
STREAMS = ("read", "copy", "triad", "memcpy")
OF_FLOOR = STREAMS[:3]  # compiled as the sweeps are
PER_FILLED = 4 * 13  # bytes: policy sweep 7 fields, derivative 6, at all nodes that are not empty


def gather(measured):
    """Entries by kind, their names apart, with seconds and spread."""
    found = {}
    for entry in measured["benchmarks"]:
        words = [w for w in entry["run_name"].split("/") if ":" not in w and w != "real_time"]
        threads = int(re.search(r"threads:(\d+)", entry["run_name"]).group(1))
        one = found.setdefault((*words, threads), {
            "kind": words[0], "names": words[1:], "threads": threads, "spread": 0,
            "item": entry.get("label", "sample")})
        seconds = entry["real_time"] * UNITS[entry["time_unit"]]
        if entry.get("aggregate_name") == "spread":
            one["spread"] = entry["real_time"]
            continue
        one["least" if entry.get("aggregate_name") == "least" else "seconds"] = seconds
        one.update({key: entry[key] for key in ("items", "bytes") if key in entry})
    kinds = {kind: [] for kind in ("stream", "iteration", "pass", "kernel")}
    names = list(dict.fromkeys(key[:-1] for key in found))
    for key in sorted(found, key=lambda key: (names.index(key[:-1]), key[-1])):
        one = found[key]
        one.setdefault("least", one.get("seconds"))  # a single repetition
        kinds[one["kind"]].append(one)
    return kinds


def fastest_stream(streams, threads):
    """In memory with so many threads [bytes/s]."""
    return max((s["bytes"] / s["least"] for s in streams if s["threads"] == threads
                and s["names"][1] == "memory" and s["names"][0] in OF_FLOOR), default=float("nan"))


def iterations(measured):
    """Scene by scene and by threads: the iteration, its passes and its floor [s]."""
    kinds = gather(measured)
    results = []
    for scene in measured["scenes"]:
        for whole in (i for i in kinds["iteration"] if i["names"] == [scene["scene"]]):
            passes = sorted((p for p in kinds["pass"] if p["names"][-1] == scene["scene"]
                             and p["threads"] == whole["threads"]),
                            key=lambda p: p["names"], reverse=True)
            rate = fastest_stream(kinds["stream"], whole["threads"])
            for one in (whole, *passes):
                one["floor"] = one["bytes"] / rate
            results.append({**scene, **whole, "passes": passes})
    return results


def megabytes(count):
    return significant(count / 1e6)


def streams_section(streams):
    rows = {}
    for stream in streams:
        kind, place = stream["names"]
        rows.setdefault((place, stream["threads"]), {})[kind] = stream
    order = ("L1", "L2", "L3", "memory")
    chosen = sorted(rows.items(), key=lambda row: (row[0][1], order.index(row[0][0])))
    return """
## Memory throughput

The numbers are the fastest of several rounds of plain loops over arrays of floats, compiled in the \
same way as the row kernels: read (sum of an array), copy (one to another), triad (a sum of two to a \
third), and the library's memcpy. Bytes count every array once. Every thread has arrays of its own; \
KiB is their total.
""" + table(chosen, [
        ("arrays are in", lambda r: r[0][0]), ("threads", lambda r: r[0][1]),
        ("[KiB]", lambda r: fixed(r[1]["read"]["bytes"] / 1024)),
        *((f"{kind} [GB/s]", lambda r, kind=kind:
           significant(r[1][kind]["bytes"] / r[1][kind]["least"] / 1e9)) for kind in STREAMS)])


def passes_section(result):
    """The passes, their sum, and the iteration of the solver."""
    whole = {key: result[key] for key in ("bytes", "floor", "seconds")}
    rows = [{**p, "name": p["names"][0]} for p in result["passes"]]
    sum_of = {**whole, "seconds": sum(p["seconds"] for p in result["passes"]), "items": 0}
    rows += [{**sum_of, "name": "all passes"},
             {**whole, "name": "iteration of the solver", "items": 0}]

    def of_samples(text):
        return lambda r: text(r) if r["items"] else ""

    return (f"\n### {result['scene']}, {sizes(result['nodes'])}, "
            f"{plural(result['threads'], 'thread')}\n" + table(rows, [
                ("pass", lambda r: r["name"]), ("[MB]", lambda r: megabytes(r["bytes"])),
                ("[byte/filled voxel]", lambda r: significant(r["bytes"] / result["filled"])),
                ("floor [ms]", lambda r: ms(r["floor"])),
                ("measured [ms]", lambda r: ms(r["seconds"])),
                ("measured / floor", lambda r: fixed(r["seconds"] / r["floor"], 1)),
                ("samples [10⁶]", of_samples(lambda r: significant(r["items"] / 1e6))),
                ("[ns/sample]", of_samples(lambda r: significant(
                    1e9 * r["seconds"] / r["items"])))]))


def floors_section(results):
    text = """
## A policy iteration and its floor

An iteration has camera and light at full resolution. The floor is the number of bytes over the fastest \
stream in memory with as many threads. Bytes are counted, not measured: every field once for each pass \
that reads or writes it, with 4 bytes per node, at the nodes that the pass visits. Rays and tables stay \
in caches and do not count. Samples are rays times layers.
""" + table(results, [
        ("scene", lambda r: r["scene"]), ("threads", lambda r: r["threads"]),
        ("filled", lambda r: percent(r["filled"] / r["voxels"])),
        ("[MB]", lambda r: megabytes(r["bytes"])),
        ("as for a GPU [MB]", lambda r: megabytes(PER_FILLED * r["filled"])),
        ("floor [ms]", lambda r: ms(r["floor"])), ("measured [ms]", lambda r: ms(r["seconds"])),
        ("measured / floor", lambda r: fixed(r["seconds"] / r["floor"], 1)),
        ("spread", lambda r: percent(r["spread"]))]) + """\
Filled are nodes with extinction or importance. *As for a GPU* counts bytes as the page on the GPU does, \
at every filled node, with or without rays. The next tables have the passes, as medians:
"""
    return text + "".join(map(passes_section, results))


def kernels_section(kernels):
    def call(kernel):
        seconds = kernel["seconds"]
        return significant(1e9 * seconds) + " ns" if seconds < 1e-4 else ms(seconds) + " ms"

    return """
## Kernels

The numbers are medians by Google Benchmark. Small volumes, and rows of 256 columns, stay in caches. \
Bytes are those that a kernel reads and writes, each array once.
""" + table(kernels, [
        ("kernel", lambda k: k["names"][0]), ("threads", lambda k: k["threads"]), ("call", call),
        ("item", lambda k: k["item"]),
        ("[10⁶ items/s]", lambda k: significant(k["items"] / k["seconds"] / 1e6)),
        ("[GB/s]", lambda k: significant(k["bytes"] / k["seconds"] / 1e9)),
        ("spread", lambda k: percent(k["spread"]))])


def page(measured):
    kinds = gather(measured)
    results = iterations(measured)
    warning = noise([r["spread"] for r in results])
    return (head("Kernels", measured) + ("\n" + warning[:-1] if warning else "")
            + streams_section(kinds["stream"]) + floors_section(results)
            + kernels_section(kinds["kernel"]))
