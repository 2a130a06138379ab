# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether the documentation site has all pages, and can be built without a warning and without a link
that leads nowhere. The latter needs Sphinx: that of Documentation/build.sh, once this has run, that of
LIMPID_DOCS_PYTHON, or that of this Python."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import code_blocks
import house

sys.path.append(str(house.ROOT / "Documentation" / "Site"))
sys.dont_write_bytecode = True
import audiences  # pylint: disable=wrong-import-position
import check_links  # pylint: disable=wrong-import-position

#: Pages that are read elsewhere.
NOT_ON_SITE = {"README.md", ".github/CODE_OF_CONDUCT.md", ".github/PULL_REQUEST_TEMPLATE.md",
               ".github/SECURITY.md"}


def python_with_sphinx():
    candidates = [os.environ.get("LIMPID_DOCS_PYTHON"),
                  str(house.ROOT / "build" / "docs" / "venv" / "bin" / "python"), sys.executable]
    for python in candidates:
        if python and shutil.which(python) and subprocess.run(
                [python, "-c", "import sphinx, myst_parser, furo, numpy"], check=False,
                stderr=subprocess.DEVNULL).returncode == 0:
            return python
    return None


class TestSite(unittest.TestCase):
    def test_every_page_is_in_a_table_of_contents(self):
        listed = {"Documentation/README.md"}
        for page in code_blocks.pages():
            name = page.removesuffix(".md")
            for table in audiences.with_contents(name, house.text(page)).split("```{toctree}")[1:]:
                links = [line for line in table.split("```")[0].split() if line.endswith(".md")]
                listed |= {os.path.normpath(os.path.join(os.path.dirname(page), link)) for link in links}

        self.assertEqual(set(code_blocks.pages()) - NOT_ON_SITE - listed, set())

    def test_links_are_checked(self):
        with tempfile.TemporaryDirectory() as folder:
            page, other = (pathlib.Path(folder, name).resolve() for name in ("a.html", "b.html"))
            page.write_text('<p id="here"><a href="#here"></a><a href="b.html#there"></a></p>')
            other.write_text('<p id="elsewhere"></p>')
            pages = {path: check_links.Page(path) for path in (page, other)}

            broken = [link for link in ("#here", "b.html", "b.html#there", "c.html")
                      if check_links.broken(page, link, pages)]

        self.assertEqual(broken, ["b.html#there", "c.html"])

    def test_it_is_built_without_a_warning(self):
        python = python_with_sphinx()
        if not python:
            self.skipTest("There is no Sphinx: bash Documentation/build.sh installs it.")
        with tempfile.TemporaryDirectory() as folder:
            built = subprocess.run(
                ["bash", str(house.ROOT / "Documentation" / "build.sh"), folder + "/html"],
                env={**os.environ, "LIMPID_DOCS_PYTHON": python, "LIMPID_DOCS_WORK": folder}, text=True,
                check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            self.assertEqual(built.returncode, 0, built.stdout)
            self.assertRegex(built.stdout, r"\d+ pages, \d+ internal links, 0 broken")


if __name__ == "__main__":
    unittest.main()
