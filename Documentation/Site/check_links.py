# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Checks the links of the site: those within it lead to files and anchors that exist; those to
other sites are listed in external-links.txt.

  python3 check_links.py FOLDER
"""

import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """The anchors and links of a page."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links = set(), set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.anchors |= {values[name] for name in ("id", "name") if values.get(name)}
        self.links |= {values[name] for name in ("href", "src") if values.get(name)}


def broken(path, link, pages):
    """Whether a link of a page leads nowhere."""
    target, _, anchor = link.partition("#")
    file = (path.parent / urllib.parse.unquote(target.split("?")[0])).resolve() if target else path
    if not file.is_file():
        return True
    return bool(anchor) and file in pages and urllib.parse.unquote(anchor) not in pages[file].anchors


def main(folder):
    pages = {path: Page(path) for path in sorted(pathlib.Path(folder).resolve().rglob("*.html"))}
    external, failures, count = set(), [], 0
    for path, page in pages.items():
        for link in sorted(page.links):
            if urllib.parse.urlsplit(link).scheme:
                external |= {link} if link.startswith("http") else set()
                continue
            count += 1
            if broken(path, link, pages):
                failures.append(f"{path.relative_to(pathlib.Path(folder).resolve())}: {link}")
    listed = pathlib.Path(folder, "external-links.txt")
    listed.write_text("".join(f"{link}\n" for link in sorted(external)), encoding="utf-8")
    print(f"{len(pages)} pages, {count} internal links, {len(failures)} broken; {len(external)} external "
          f"links, listed in {listed}")
    if failures:
        sys.exit("\n".join(["These links lead nowhere:"] + failures))


if __name__ == "__main__":
    main(*sys.argv[1:])
