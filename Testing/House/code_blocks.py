# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The code blocks of the pages. TestCodeBlocks.py has which test runs which."""

import re
from typing import NamedTuple

import house

README = "README.md"
WHEEL_README = "Plugin/Wheel/README.md"
INSTALL = "Documentation/Install.md"
VTK = "Documentation/Vtk.md"

#: Languages of code; other fences hold drawings, or directives of Sphinx such as {glossary}.
LANGUAGES = ("cmake", "cpp", "python", "sh")


class Block(NamedTuple):
    language: str
    text: str


def pages():
    """All Markdown files."""
    top = [path for path in house.top_files() if path.suffix == ".md"]
    return sorted(map(str, top + house.files("*.md")))


def blocks(path):
    """All code blocks of a Markdown file."""
    fences = re.findall(r"^```([^\n]*)\n(.*?)^```$", house.text(path), re.MULTILINE | re.DOTALL)
    return [Block(*fence) for fence in fences if fence[0] in LANGUAGES]


def block(path, start):
    """The text of the block that begins with some words."""
    text, = [each.text for each in blocks(path) if each.text.startswith(start)]
    return text
