# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Numbers, tables and heads of the pages."""

import math

NOISY = 0.25  # spread above which a median is less certain
BUSY = 0.25  # load per core before the start, above which times are preliminary

# The day on which times and results of runs last changed by more than rounding: rays across long
# images and thick layers, the drawing and its shadows, policy sweeps. Older pages say so.
RESULTS_CHANGED = "2026-11-28"


def fixed(value, decimals=0):
    return f"{value:.{decimals}f}"


def significant(value, digits=3):
    """So many digits, never in powers of ten."""
    if value == 0 or not math.isfinite(value):
        return fixed(value)
    before = math.floor(math.log10(abs(value))) + 1
    return fixed(value, max(0, digits - before))


def ms(seconds):
    return significant(1e3 * seconds)


def percent(share, decimals=0):
    return f"{100 * share:.{decimals}f} %"


def short_percent(share):
    return significant(100 * share, 2) + " %"


def deviation(value, truth, decimals=2):
    return f"{100 * (value - truth) / abs(truth):+.{decimals}f} %"


def sizes(nodes):
    return " × ".join(map(str, nodes))


def arrow(before, after):
    return f"{100 * before:.1f} → {percent(after, 1)}"


def mebibytes(count):
    return fixed(count / 2**20, 1)


def plural(count, word):
    return f"{count} {word}" + ("" if count == 1 else "s")


def table(rows, columns):
    """`columns`: pairs of a heading and what makes a row's cell; the first column has names."""
    lines = [[heading for heading, _ in columns], ["---"] + ["---:"] * (len(columns) - 1)]
    lines += [[str(cell(row)) for _, cell in columns] for row in rows]
    return "\n" + "".join("| " + " | ".join(line) + " |\n" for line in lines) + "\n"


def noise(spreads, limit=NOISY):
    """Says in how many rows times lie far apart, if in any."""
    apart = sum(spread > limit for spread in spreads)
    if not apart:
        return ""
    return (f"In {apart} of {len(spreads)} rows, times differ by more than {percent(limit)}. One slow "
            "run is enough for that; the median hardly depends on it.\n\n")


def age_of(date):
    """A paragraph that says so if a page is older than the code; empty if it is not."""
    if date >= RESULTS_CHANGED:
        return ""
    return (f"\n**Not measured since {date}; times and results changed until {RESULTS_CHANGED}. "
            "The command above measures them again.**\n")


def head(title, measured, command=None):
    """Title, the page's command, what it was measured with and on."""
    machine = measured["machine"]
    command = command or f"bash Testing/Benchmarks/run.sh --pages {title.lower()}"
    threads = f", {machine['threads']} threads used" if "threads" in machine else ""
    text = (f"# {title}\n\n[README.md](README.md) explains the tables. The command of this page is "
            f"`{command}`. Its numbers are from\n\n    {machine['command']}\n\n"
            f"* processor: {machine['processor']}, {machine['cores']} cores visible{threads}\n")
    if "compiler" in machine:
        text += f"* compiler: {machine['compiler']}, build type {machine['build_type']}\n"
    text += "".join(f"* {fact}\n" for fact in machine.get("facts", []))
    text += (f"* date: {machine['date']}\n"
             f"* load average before the start: {machine['load_before']:.2f}\n")
    if machine["load_before"] > BUSY * machine["cores"]:
        text += ("\n**The machine was not idle: times are preliminary.** Scores, energies and "
                 "memory do not depend on the load.\n")
    text += age_of(machine["date"])
    if "load_after" in machine:
        text += (f"\nLoad average at the end: {machine['load_after']:.2f}, including "
                 "this program.\n")
    return text
