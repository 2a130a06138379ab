# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Sphinx makes the documentation site of the Markdown pages as they are, where they are: the source
folder is the repository. Documentation/build.sh calls it."""

import pathlib
import re
import sys

SITE = pathlib.Path(__file__).resolve().parent
ROOT = SITE.parents[1]
sys.path[:0] = [str(SITE)]

project = "Limpid"
author = "Limpid developers"
copyright = author  # pylint: disable=redefined-builtin
release = re.search(r"project\(Limpid\s+VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]

root_doc = "Documentation/README"
include_patterns = ["CHANGELOG.md", "CONTRIBUTING.md", "Documentation/**.md", "Plugin/**.md", "Testing/**.md",
                    "cuda/README.md"]

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon",
              "audiences", "cpp_headers", "python_package"]
myst_heading_anchors = 4  # links such as Page.md#a-heading, as GitHub has them
myst_enable_extensions = ["deflist"]  # of the glossary

html_theme = "furo"
html_title = f"Limpid {release}"
html_copy_source = False
html_show_sourcelink = False
