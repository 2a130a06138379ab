# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The page of energy_torch.py."""

import os
import sys
import time

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
NOISY = 0.2  # spread of a program's times above which they are preliminary
DIRECTIONS = ("important", "unimportant", "wave")


def shown(word):
    """A word of the command without places of this machine: from the repository's root, or a
    name."""
    if not os.path.isabs(word):
        return word
    return os.path.relpath(word, ROOT) if word.startswith(ROOT + os.sep) else os.path.basename(word)


def machine():
    model = "unknown"
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                model = line.split(": ", 1)[1].strip()
                break
    return {"command": " ".join(["python3", *map(shown, sys.argv)]), "processor": model,
            "cores": len(os.sched_getaffinity(0)),
            "date": time.strftime("%Y-%m-%d"), "load": os.getloadavg()[0]}


def table(headings, rows):
    lines = ["| " + " | ".join(headings) + " |"]
    lines.append("| --- |" + " ---: |" * (len(headings) - 1))
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def significant(value, digits=3):
    """So many digits, never in powers of ten."""
    text = f"{value:#.{digits}g}"
    return (f"{float(text):.0f}" if "e" in text else text.rstrip("."))


def percent(value, decimals=3):
    return f"{100 * value:+.{decimals}f} %"


def mebibytes(count):
    return significant(count / 2**20)


def truth_rows(results):
    """One row of each size and family of programs: parts and skips change no digit shown."""
    rows = {}
    for result in results:
        for row in result["rows"]:
            name = row["program"].split(",")[0]
            rows.setdefault((result["nodes"], name), [
                f"{result['nodes']}³, {name}", f"{row['S']:.7f}",
                percent(row["S_deviation"]), percent(row["S_light_deviation"]),
                *(f"{row['slopes'][one]:.5f} ({percent(row['slope_deviations'][one], 2)})"
                  for one in DIRECTIONS)])
    return list(rows.values())


def time_rows(results):
    rows = []
    for result in results:
        for row in result["rows"]:
            rows.append([
                f"{result['nodes']}³, {row['program']}",
                *(significant(1000 * row[key])
                  for key in ("value_seconds", "gradient_seconds", "gradient_shortest")),
                f"{100 * row['gradient_spread']:.0f} %",
                mebibytes(row["kept_bytes"]), mebibytes(row["peak_bytes"])])
    return rows


def ratio_rows(results):
    rows = []
    for result in results:
        ours, off = result["rows"][:2]
        for row in result["rows"][2:]:
            rows.append([
                f"{result['nodes']}³, {row['program']}",
                *(significant(row[key] / other[key])
                  for other in (ours, off)
                  for key in ("value_seconds", "gradient_seconds", "gradient_shortest")),
                significant(row["peak_bytes"] / ours["peak_bytes"])])
    return rows


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
    text = f"## {name}\n\n"
    text += table(["nodes, program", "value [ms]", "value and gradient [ms]", "shortest", "spread",
                   "memory kept [MiB]", "peak [MiB]"], time_rows(results)) + "\n"
    noise = max(row["gradient_spread"] for result in results for row in result["rows"])
    if noise > NOISY:
        text += (f"**Times of the same evaluation lay up to {100 * noise:.0f} % apart: the machine "
                 "was busy, and the times are preliminary.**\n\n")
    if results[0]["device"] != "cpu":
        return text + "Limpid on this device: not measured.\n\n"
    text += f"PyTorch's time and memory as multiples of Limpid's. {in_short(results)}\n\n"
    return text + table(["nodes, program", "value", "value and gradient", "shortest",
                         "skips off: value", "value and gradient", "shortest", "peak memory"],
                        ratio_rows(results)) + "\n"


def sections(measured):
    """Results by heading, in the order of their measurement."""
    found = {}
    for result in measured:
        threads = f"{result['threads']} thread{'s' if result['threads'] > 1 else ''}"
        name = f"CPU, {threads}"
        if result["device"] != "cpu":
            name = result["rows"][0]["build"]["device"]
        found.setdefault(name, []).append(result)
    return found


def page(about, measured):
    """The page as Markdown."""
    text = "# Peers\n\nWhat the tables mean is in [README.md](README.md).\n\n"
    text += f"    {about['command']}\n\n"
    text += (f"* processor: {about['processor']}, {about['cores']} cores visible\n"
             f"* date: {about['date']}\n"
             f"* load average before the start: {about['load']:.2f}\n")
    builds = dict.fromkeys(row["build"]["name"] for result in measured for row in result["rows"])
    text += "".join(f"* {build}\n" for build in builds) + "\n"
    text += "## Values and derivatives\n\n"
    text += table(["nodes, program", "S", "to the march", "S, light, to the march",
                   *(f"derivative, {name}" for name in DIRECTIONS)], truth_rows(measured)) + "\n"
    for name, results in sections(measured).items():
        text += device_section(name, results)
    if all(result["device"] == "cpu" for result in measured):
        text += "## GPU\n\nNot measured.\n"
    return text
