# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Energy and gradient by PyTorch's automatic differentiation, beside Limpid's."""

from markdown import deviation, fixed, head, percent, plural, significant, table

COMMAND = ("python3 Testing/Benchmarks/peers/energy_torch.py "
           "--output Documentation/Benchmarks/Peers.json")
NOISY = 0.2  # spread of a program's times above which they are preliminary
DIRECTIONS = ("important", "unimportant", "wave")
TIMES = ("value_seconds", "gradient_seconds", "gradient_shortest")


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
            ("value [ms]", "value and gradient [ms]", "shortest"), TIMES)),
        ("spread", lambda r: percent(r["gradient_spread"])),
        ("memory kept [MiB]", lambda r: mebibytes(r["kept_bytes"])),
        ("peak [MiB]", lambda r: mebibytes(r["peak_bytes"]))])


def ratio_table(results):
    """PyTorch's numbers as multiples of Limpid's, which are the first two rows of each size."""
    def ratio(key, which):
        return lambda r: significant(r[key] / r["peers"][which][key])

    return table([row for row in rows_of(results) if "PyTorch" in row["name"]], [
        ("nodes, program", lambda r: r["name"]),
        *((heading, ratio(key, 0)) for heading, key in zip(
            ("value", "value and gradient", "shortest"), TIMES)),
        *((heading, ratio(key, 1)) for heading, key in zip(
            ("skips off: value", "value and gradient", "shortest"), TIMES)),
        ("peak memory", ratio("peak_bytes", 0))])


def in_short(results):
    """A sentence for all sizes."""
    time_ratios, plain_ratios, memory_ratios = [], [], []
    for result in results:
        ours, off = result["rows"][:2]
        peers = result["rows"][2:]
        fastest = min(peers, key=lambda row: row["gradient_shortest"])
        time_ratios.append(fastest["gradient_shortest"] / ours["gradient_shortest"])
        plain_ratios.append(fastest["gradient_shortest"] / off["gradient_shortest"])
        memory_ratios.append(min(row["peak_bytes"] for row in peers) / ours["peak_bytes"])
    return (f"Its fastest takes {span(time_ratios)} times as long for a value and gradient, "
            f"{span(plain_ratios)} times with skips off (by the shortest times), and its smallest "
            f"{span(memory_ratios)} times the memory.")


def span(values):
    low, high = significant(min(values), 2), significant(max(values), 2)
    return low if low == high else f"{low} to {high}"


def device_section(name, results):
    text = f"\n## {name}\n{time_table(results)}"
    spread = max(row["gradient_spread"] for row in rows_of(results))
    if spread > NOISY:
        text += (f"**Times of the same evaluation lay up to {percent(spread)} apart: the machine "
                 "was busy, and the times are preliminary.**\n\n")
    if results[0]["device"] != "cpu":
        return text + "Limpid on this device: not measured.\n"
    return text + ("PyTorch's time and memory as multiples of Limpid's. "
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


def page(numbers):
    measured = numbers["measured"]
    builds = list(dict.fromkeys(row["build"]["name"] for row in rows_of(measured)))
    text = head("Peers", {"machine": {**numbers["machine"], "facts": builds}}, COMMAND)
    text += f"\n## Values and derivatives\n{truth_table(measured)}"
    text += "".join(device_section(*section) for section in sections(measured).items())
    if all(result["device"] == "cpu" for result in measured):
        text += "\n## GPU\n\nNot measured.\n"
    return text
