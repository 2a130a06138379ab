# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Lets autodoc read the Python package from its sources, without building its extension module."""

import pathlib
import shutil
import sys

import conf

sys.path.append(str(conf.ROOT / "Plugin" / "cmake"))
import settings  # pylint: disable=wrong-import-position

SOURCES = conf.ROOT / "Plugin" / "Wheel" / "limpid"


def prepare(app, config):
    """Copies the package, with settings.py made from the table of settings."""
    folder = pathlib.Path(app.doctreedir).parent / "python"
    package = folder / "limpid"
    shutil.rmtree(package, ignore_errors=True)
    shutil.copytree(SOURCES, package)
    for template in package.glob("*.in"):
        settings.main(template, template.with_suffix(""))
    sys.path.insert(0, str(folder))
    config.autodoc_mock_imports = ["limpid._core"]


def setup(app):
    app.connect("config-inited", prepare)
    return {"parallel_read_safe": True}
