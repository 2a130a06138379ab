# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Writes what Testing/releases.sh has found on a release into Documentation/Compatibility.md.

    python3 Testing/releases_page.py DOCUMENTATION FOLDERS RELEASE

FOLDERS has, for each release, RELEASE-versions, RELEASE-commands and the release's own root folder
with the clone in which ctest ran. What was found on other releases stays: it is in
Compatibility.json beside the page.
"""

import collections
import datetime
import json
import pathlib
import re
import subprocess
import sys

RELEASES = ("bookworm", "trixie", "sid")
VERSIONS = ("ParaView", "VTK", "Qt", "g++", "clang", "CMake", "Python")
BEGIN = "<!-- written by Testing/releases.sh -->"
END = "<!-- end -->"

TEST = re.compile(r'^\d+/\d+ Testing: (?P<name>.+?)$(?P<text>.*?)^"(?P=name)" end time',
                  re.MULTILINE | re.DOTALL)
PASSED = re.compile(r"^Test (Passed\.|Pass Reason:)", re.MULTILINE)
SKIPPED_BY_PYTHON = re.compile(r"^\s*(\w+) \(.*?\).*? \.\.\. (?:.*\n)?skipped ['\"](.*)['\"]$",
                               re.MULTILINE)
SKIPPED_BY_GTEST = re.compile(r": Skipped\n(.+)$", re.MULTILINE)


class Results:
    """What ctest's log says: names of tests by how they ended, and reasons of what was skipped."""

    def __init__(self, log):
        self.passed, self.failed = [], []
        self.skipped = collections.defaultdict(list)  # names by reason
        for test in TEST.finditer(log):
            self._add(test["name"].split("  # GetParam")[0], test["text"])

    def _add(self, name, text):
        for reason in SKIPPED_BY_GTEST.findall(text):
            self.skipped[reason].append(name)
            return
        (self.passed if PASSED.search(text) else self.failed).append(name)
        for part, reason in SKIPPED_BY_PYTHON.findall(text):
            self.skipped[reason].append(f"{name}: {part}")


def lines_of(path):
    return path.read_text(encoding="utf-8").splitlines()


def found(folders, release):
    clone = folders / release / "limpid"
    log = clone / "build" / "Testing" / "Temporary" / "LastTest.log"
    results = Results(log.read_text(encoding="utf-8", errors="replace") if log.exists() else "")
    commit = subprocess.run(["git", "-C", str(clone), "rev-parse", "--short", "HEAD"], check=True,
                            capture_output=True, text=True).stdout.strip()
    commands = {}
    for line in lines_of(folders / f"{release}-commands"):
        name, code, seconds = line.split()
        commands[name] = {"code": int(code), "seconds": int(seconds)}
    return {
        "date": datetime.date.today().isoformat(),
        "commit": commit,
        "versions": dict(line.split(" ", 1) for line in lines_of(folders / f"{release}-versions")),
        "commands": commands,
        "passed": len(results.passed),
        "failed": results.failed,
        "skipped": dict(sorted(results.skipped.items())),
    }


def minutes(command):
    if command is None:
        return "not run"
    text = f"{command['seconds'] / 60:.0f} min"
    return text if command["code"] == 0 else f"**failed** ({text})"


def table(all_found):
    head = ["Debian", *VERSIONS, "`demo.sh`", "`run.sh`", "passed", "failed", "skipped", "core by clang",
            "commit, date"]
    rows = [head, ["---"] * len(head)]
    for release, one in all_found.items():
        commands = one["commands"]
        rows.append([
            f"{release} ({one['versions'].get('Debian', '?')})",
            *(one["versions"].get(name, "none") for name in VERSIONS),
            *(minutes(commands.get(name)) for name in ("demo", "tests")),
            str(one["passed"]), str(len(one["failed"])),
            str(sum(map(len, one["skipped"].values()))), minutes(commands.get("clang")),
            f"{one['commit']}, {one['date']}"])
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def details(all_found):
    parts = []
    for release, one in all_found.items():
        lines = [f"### {release}", ""]
        lines += [f"* failed: `{name}`" for name in one["failed"]]
        for reason, names in one["skipped"].items():
            listed = ", ".join(f"`{name}`" for name in names[:3])
            more = f" and {len(names) - 3} more" if len(names) > 3 else ""
            lines.append(f"* {reason} ({listed}{more})")
        if not one["failed"] and not one["skipped"]:
            lines.append("No test failed or was skipped.")
        parts.append("\n".join(lines))
    return "\n\n".join(parts)


def main(documentation, folders, release):
    data = documentation / "Compatibility.json"
    before = json.loads(data.read_text(encoding="utf-8")) if data.exists() else {}
    before[release] = found(folders, release)
    all_found = {name: before[name] for name in RELEASES if name in before}
    data.write_text(json.dumps(all_found, indent=1) + "\n", encoding="utf-8")

    page = documentation / "Compatibility.md"
    above, rest = page.read_text(encoding="utf-8").split(BEGIN)
    below = rest.split(END)[1]
    written = f"{table(all_found)}\n\n## Failed and skipped tests\n\n{details(all_found)}"
    page.write_text(f"{above}{BEGIN}\n\n{written}\n\n{END}{below}", encoding="utf-8")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3])
