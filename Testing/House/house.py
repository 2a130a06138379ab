# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The files of the repository, for the tests that read them."""

import os
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = (".ci", ".github", "Documentation", "Filters", "Plugin", "Representations", "Testing", "cuda")


def files(*patterns, under=FOLDERS):
    """Paths, relative to ROOT, of the files in some folders whose names match any pattern."""
    found = []
    for folder in under:
        for path, folders, names in os.walk(ROOT / folder):
            folders[:] = [name for name in folders if name != "__pycache__"]
            found += [pathlib.Path(path, name).relative_to(ROOT) for name in names]
    matching = [path for path in found if any(path.match(pattern) for pattern in patterns)]
    return sorted(set(matching))


def top_files():
    """Paths, relative to ROOT, of the files at the top, those of tools and hosts among them."""
    return sorted(path.relative_to(ROOT) for path in ROOT.glob("*")
                  if path.is_file() and path.name != ".git")


def text(path):
    return (ROOT / path).read_text(encoding="utf-8")


def lines(path):
    """Pairs of a line's number and its text."""
    return enumerate(text(path).splitlines(), start=1)


def rows(path, heading):
    """The cells of the first table below a heading of a Markdown file, without the table's head."""
    below = text(path).split(heading, 1)[1]
    table = re.search(r"(?:^\|.*\n)+", below, re.MULTILINE).group(0)
    return [[cell.strip() for cell in line.strip("|").split("|")]
            for line in table.splitlines()[2:]]


def quoted(markdown):
    """What stands between backticks."""
    return re.findall(r"`([^`]+)`", markdown)


def tests():
    """The names of all tests, as ctest has them."""
    found = set()
    for path in files("Test*.cxx", under=["Testing"]):
        for suite, name in re.findall(r"^(?:TYPED_)?TEST(?:_[FP])?\((\w+),\s*(\w+)\)", text(path),
                                      re.MULTILINE):
            found.add(f"{suite}.{name}")
    for path in files("CMakeLists.txt", under=["Testing"]):
        found |= set(re.findall(r"NAME \"?(\w+\.\w+)", text(path)))
    for path in files("Test*.py", under=["Testing"]):
        found.add(f"{path.parent.name}.{path.stem}")
        found.add(f"ParaView.{path.stem}")
    return found
