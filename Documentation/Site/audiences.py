# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Makes the tables of contents from the lists of links on pages, so that these stay plain Markdown:

* Documentation/README.md: one table per section, of the first link of each item;
* the README of another folder: one table, of its links to pages of that folder.
"""

import pathlib
import re

HEADING = r"^## (.+)$"
ITEM = r"^\* .*?\]\(([\w./-]+\.md)\)"
LINK = r"\]\(([\w-]+\.md)(?:#[^)]*)?\)"


def table(pages, caption=None):
    """A hidden toctree."""
    options = [":hidden:", *([f":caption: {caption}"] if caption else [])]
    return "\n".join(["```{toctree}", *options, "", *dict.fromkeys(pages), "```", ""])


def with_contents(name, text):
    """The text of a page with its tables of contents."""
    if pathlib.PurePath(name).name != "README":
        return text
    if name != "Documentation/README":
        pages = re.findall(LINK, text)
        return f"{text}\n{table(pages)}" if pages else text
    first, *sections = re.split(HEADING, text, flags=re.M)
    parts = [first]
    for title, section in zip(sections[::2], sections[1::2]):
        pages = re.findall(ITEM, section, re.M)
        parts += [f"## {title}", section, *([table(pages, title)] if pages else [])]
    return "\n".join(parts)


def read(_, name, source):
    source[0] = with_contents(name, source[0])


def setup(app):
    app.connect("source-read", read)
    return {"parallel_read_safe": True}
