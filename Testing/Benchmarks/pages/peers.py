# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Limpid beside others' programs: pictures, values and gradients."""

import peers_pictures
from markdown import deviation, fixed, head, noise, percent, plural, significant, table

COMMAND = "bash Testing/Benchmarks/peers/run.sh"
DIRECTIONS = ("important", "unimportant", "wave")
TIMES = ("value_cpu", "gradient_cpu")
CAMERA = """
## Value and gradient, the camera alone

The table has S of the camera (Eq. (32)) of the onion scene and its derivative by the extinction of
every node. Mitsuba can be made to compute this term, too. {threads}. *Error of S* is relative to the
march. *Error of slopes* compares the derivatives along three directions with central differences of the
march. It is the length of the error over their length. For Mitsuba, both are root mean squares of
{repeats} evaluations with new random numbers. *Noise* is that of the derivative at single nodes, over
the derivative. *CPU to Limpid's error* is the time to reach the error of Limpid: that of S by values,
that of slopes by values and gradients. It assumes that errors fall with the root of the number of
rays. The second number is the ratio to Limpid's time.
{table}
**Missing features of Mitsuba.** Its media have no emission. So `prbvolpath`, its integrator
for derivatives of media, uses a point light at the eye and half the extinction. Light on the way there
and back then has the transmittance of one way. An albedo of importance times the fourth power of the
distance makes the radiance equal to the desired integral. `emission` is a short integrator for this
page (`Testing/Benchmarks/peers/emission.py`), as a user of Mitsuba would write it. It has the same
collisions, importance times distance squared as emission, and no search for lights. Both are Monte
Carlo estimates. Mitsuba gets rays only where the importance is positive, one in each pixel, which
stratifies them. It has the light's term only by a second such run, no regularisation, no solver,
and one majorant for the whole volume. Empty space is therefore crossed in steps of the densest matter.

**Additional features of Mitsuba.** It computes multiple scattering of any order. Its derivative is
that of its own estimate, as with PyTorch. Limpid's is the derivative of the integral, taken at the
nodes ([Deviations.md](../Deviations.md), D1 and D8). Along these directions, it is further from the
differences than that of PyTorch.
"""


def mebibytes(count):
    return significant(count / 2**20)


def rows_of(results):
    return [{**row, "nodes": result["nodes"], "name": f"{result['nodes']}³, {row['program']}",
             "peers": result["rows"]} for result in results for row in result["rows"]]


def truth_table(measured):
    """One row of each size and family of programs: parts and skips change no digit shown."""
    rows = {}
    for row in rows_of(measured):
        name = row["name"].split(", ")
        rows.setdefault((row["nodes"], name[1]), {**row, "name": ", ".join(name[:2])})

    def slope(direction):
        return lambda r: (f"{r['slopes'][direction]:.5f} "
                          f"({deviation(1 + r['slope_deviations'][direction], 1)})")

    return table(rows.values(), [
        ("nodes, program", lambda r: r["name"]), ("S", lambda r: fixed(r["S"], 7)),
        ("to the march", lambda r: deviation(1 + r["S_deviation"], 1, 3)),
        ("S, light, to the march", lambda r: deviation(1 + r["S_light_deviation"], 1, 3)),
        *((f"derivative, {name}", slope(name)) for name in DIRECTIONS)])


def time_table(results):
    return table(rows_of(results), [
        ("nodes, program", lambda r: r["name"]),
        *((heading, lambda r, key=key: significant(1000 * r[key])) for heading, key in zip(
            ("value [CPU ms]", "value and gradient [CPU ms]"), TIMES)),
        ("spread", lambda r: percent(r["gradient_spread"])),
        ("wall clock [ms]", lambda r: significant(1000 * r["gradient_seconds"])),
        ("memory kept [MiB]", lambda r: mebibytes(r["kept_bytes"])),
        ("peak [MiB]", lambda r: mebibytes(r["peak_bytes"]))])


def ratio_table(results):
    """PyTorch's numbers as multiples of Limpid's, which are the first two rows of each size."""
    def ratio(key, which):
        return lambda r: significant(r[key] / r["peers"][which][key])

    return table([row for row in rows_of(results) if "PyTorch" in row["name"]], [
        ("nodes, program", lambda r: r["name"]),
        *((heading, ratio(key, 0)) for heading, key in zip(
            ("value", "value and gradient"), TIMES)),
        *((heading, ratio(key, 1)) for heading, key in zip(
            ("skips off: value", "value and gradient"), TIMES)),
        ("peak memory", ratio("peak_bytes", 0))])


def in_short(results):
    """A sentence for all sizes."""
    time_ratios, plain_ratios, memory_ratios = [], [], []
    for result in results:
        ours, off = result["rows"][:2]
        peers = result["rows"][2:]
        fastest = min(peers, key=lambda row: row["gradient_cpu"])
        time_ratios.append(fastest["gradient_cpu"] / ours["gradient_cpu"])
        plain_ratios.append(fastest["gradient_cpu"] / off["gradient_cpu"])
        memory_ratios.append(min(row["peak_bytes"] for row in peers) / ours["peak_bytes"])
    return (f"The fastest variant takes {span(time_ratios)} times as long for a value and gradient, "
            f"{span(plain_ratios)} times with skips off. The smallest variant needs "
            f"{span(memory_ratios)} times the memory.")


def span(values):
    low, high = significant(min(values), 2), significant(max(values), 2)
    return low if low == high else f"{low} to {high}"


def device_section(name, results):
    text = f"\n### {name}\n{time_table(results)}"
    text += noise([row["gradient_spread"] for row in rows_of(results)], 0.2)
    if results[0]["device"] != "cpu":
        return text + "Limpid on this device: not measured.\n"
    if not any("PyTorch" in row["program"] for row in rows_of(results)):
        return text
    return text + ("The table has PyTorch's CPU time and memory as multiples of Limpid's. "
                   f"{in_short(results)}\n{ratio_table(results)}")


def sections(measured):
    """Results by heading, in the order of their measurement."""
    found = {}
    for result in measured:
        name = f"CPU, {plural(result['threads'], 'thread')}"
        if result["device"] != "cpu":
            name = result["rows"][0]["build"]["device"]
        found.setdefault(name, []).append(result)
    return found


def until(row, ours, seconds, error):
    """CPU seconds until a program by random numbers errs as little as Limpid: its error falls with
    the root of its time."""
    return row[seconds] * (row[error] / ours[error]) ** 2


def camera_table(measured):
    rows = [{**row, "ours": result["rows"][0]}
            for result, row in zip((r for r in measured for _ in r["rows"]), rows_of(measured))]

    def random(cell):
        return lambda r: cell(r) if "noise" in r else ""

    def equal(seconds, error):
        def cell(row):
            needed = until(row, row["ours"], seconds, error)
            return f"{significant(needed, 2)} s, {significant(needed / row['ours'][seconds], 2)} ×"
        return random(cell)

    return table(rows, [
        ("nodes, program", lambda r: r["name"]),
        ("error of S", lambda r: percent(r["S_error"], 3)),
        ("of slopes", lambda r: percent(r["slope_error"], 2)),
        ("noise", random(lambda r: percent(r["noise"]))),
        ("value [CPU ms]", lambda r: significant(1000 * r["value_cpu"])),
        ("value and gradient [CPU ms]", lambda r: significant(1000 * r["gradient_cpu"])),
        ("spread", lambda r: percent(r["gradient_spread"])),
        ("peak [MiB]", lambda r: mebibytes(r["peak_bytes"])),
        ("CPU to Limpid's error: value", equal("value_cpu", "S_error")),
        ("value and gradient", equal("gradient_cpu", "slope_error"))])


def camera_section(measured):
    return CAMERA.format(threads=plural(measured[0]["threads"], "thread").capitalize() + " each",
                         repeats=measured[0]["repeats"], table=camera_table(measured))


def page(numbers):
    measured = numbers["measured"]
    builds = list(dict.fromkeys(
        row["build"]["name"] for row in rows_of(measured + numbers["camera"])))
    facts = builds + numbers["pictures"]["versions"]
    text = head("Peers", {"machine": {**numbers["machine"], "facts": facts}}, COMMAND)
    if numbers["absent"]:
        text += f"\n**Not installed and therefore not measured: {', '.join(numbers['absent'])}.**\n"
    text += peers_pictures.section(numbers["pictures"])
    text += camera_section(numbers["camera"])
    text += f"\n## The whole energy, values and derivatives\n{truth_table(measured)}"
    text += "".join(device_section(*section) for section in sections(measured).items())
    if all(result["device"] == "cpu" for result in measured):
        text += "\n### GPU\n\nNot measured.\n"
    return text
