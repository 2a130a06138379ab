# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The code blocks of the two READMEs that people follow. TestCodeBlocks.py has which test runs which."""

import re
from typing import NamedTuple

import house

README = "README.md"
WHEEL_README = "Plugin/Wheel/README.md"


class Block(NamedTuple):
    language: str
    text: str


def blocks(path):
    """All code blocks of a Markdown file."""
    return [Block(*found) for found in
            re.findall(r"^```(\w*)\n(.*?)^```$", house.text(path), re.MULTILINE | re.DOTALL)]


def block(path, start):
    """The text of the block that begins with some words."""
    text, = [each.text for each in blocks(path) if each.text.startswith(start)]
    return text
