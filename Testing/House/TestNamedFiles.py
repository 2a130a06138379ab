# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether the files, members and tests that the documents name exist."""

import pathlib
import re
import unittest

import house

SOURCES = (".h", ".cxx", ".py", ".sh", ".cmake", ".xml")
MADE = ("build/", "demo-output/", "program/")


def documents():
    """All pages but those that programs write, which say what was true when they were made."""
    written = house.files("*.md")
    by_hand = [path for path in written
               if path.parent.name != "Benchmarks" or path.name == "README.md"]
    return [path for path in house.top_files() if path.suffix == ".md"] + by_hand


def anchors(page):
    """The anchors of a page's headings, as GitHub and the documentation site make them."""
    without_code = re.sub(r"^```.*?^```$", "", house.text(page), flags=re.MULTILINE | re.DOTALL)
    headings = re.findall(r"^#+ (.+)$", without_code, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in headings}


class TestNamedFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.files = house.files("*") + house.top_files()
        cls.names = {path.name for path in cls.files}
        cls.folders = {folder for path in cls.files for folder in path.parents}
        sources = house.files("*.h", "*.cxx", "*.module", under=[
            folder for folder in house.FOLDERS if folder != "Documentation"])
        cls.words = set(re.findall(r"\w+", "\n".join(house.text(path) for path in sources)))
        cls.tests = house.tests()

    def exists(self, name, document):
        places = [document.parent, pathlib.Path("."), pathlib.Path("cuda"), pathlib.Path("Testing")]
        return any((house.ROOT / place / name).exists() for place in places)

    def is_a_path(self, name):
        if name.startswith(MADE) or not re.fullmatch(r"[A-Za-z.][\w./-]*", name) or "/" not in name:
            return False
        first = pathlib.Path(name).parts[0]
        known = {part for folder in self.folders for part in folder.parts}
        return name.endswith(SOURCES + ("/", ".md")) or first in known

    def is_a_file(self, name):
        """Whether it looks like a name of a file, and not like NAME.py."""
        return (re.fullmatch(r"\w+\.\w+", name) and name.endswith(SOURCES)
                and not name.split(".")[0].isupper())

    def expect_all(self, mentions, exists):
        """Of pairs of a document and what it names, all exist."""
        missing = [f"{document} names {name}" for document, name in mentions
                   if not exists(document, name)]
        self.assertFalse(missing, "\n".join(["What is named does not exist."] + missing))

    def mentions(self, pattern):
        return [(document, found) for document in documents()
                for found in re.findall(pattern, house.text(document))]

    def words_in_quotes(self):
        return [(document, word) for document in documents()
                for word in " ".join(house.quoted(house.text(document))).split()]

    def test_links_lead_to_files(self):
        self.expect_all(self.mentions(r"\]\(([^)#]+)[^)]*\)"),
                        lambda document, name: (house.ROOT / document.parent / name).exists())

    def test_links_lead_to_headings(self):
        def exists(document, link):
            name, heading = link.split("#")
            page = house.ROOT / document.parent / name if name else house.ROOT / document
            return page.suffix != ".md" or heading in anchors(page)

        self.expect_all(self.mentions(r"\]\(([^)#:]*#[^)]+)\)"), exists)

    def test_pictures_are_on_pages_that_say_how_to_make_them(self):
        pages = documents()
        without = []
        for picture in house.files("*.png", "*.jpg", under=["Documentation/Pictures"]):
            shown = [house.text(page) for page in pages
                     if any((page.parent / link) == picture for link in
                            re.findall(r"!\[[^\]]*\]\(([^)]+)\)", house.text(page)))]
            if not any(re.search(r"Documentation/Examples/[\w/]+\.(sh|py) ", text) for text in shown):
                without.append(str(picture))
        self.assertFalse(without, "No page shows these pictures and the command that makes them.")

    def test_paths_exist(self):
        self.expect_all(self.words_in_quotes(), lambda document, name:
                        not self.is_a_path(name) or self.exists(name, document))

    def test_names_of_files_exist(self):
        self.expect_all(self.words_in_quotes(), lambda document, name:
                        not self.is_a_file(name) or name in self.names)

    def test_members_exist(self):
        self.expect_all(self.mentions(r"`(\w+::\w+)"), lambda document, name:
                        set(name.split("::")) <= self.words)

    def test_tests_exist(self):
        self.expect_all(self.mentions(r"`([A-Z]\w+\.[A-Z]\w+)`"), lambda document, name:
                        name in self.tests)


if __name__ == "__main__":
    unittest.main()
