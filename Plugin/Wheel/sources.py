# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Builds the Python package by scikit-build-core. The package is made of the whole repository, so a
source distribution has, beside the project file, what is needed of it in a folder `source`."""

import io
import pathlib
import tarfile

from scikit_build_core import build
from scikit_build_core.build import *  # pylint: disable=wildcard-import,unused-wildcard-import

HERE = pathlib.Path(__file__).resolve().parent
UNPACKED = HERE / "source"  # in a source distribution
REPOSITORY = UNPACKED if UNPACKED.is_dir() else HERE.parents[1]

#: Of the repository.
NEEDED = ("CMakeLists.txt", "LICENSE", "Plugin/Wheel", "Plugin/cmake", "cuda")
#: Beside the folder `source`, with the project file and what scikit-build-core makes of it, PKG-INFO.
BESIDE = ("LICENSE", "README.md", "sources.py")


def needed_files():
    """Files below REPOSITORY, in a fixed order."""
    for name in NEEDED:
        path = REPOSITORY / name
        for file in [path] if path.is_file() else sorted(path.rglob("*")):
            if file.is_file() and "__pycache__" not in file.parts:
                yield file


def moved(project):
    """The text of the project file for a source distribution."""
    return project.replace('"../..', '"source')


def build_sdist(sdist_directory, config_settings=None):
    """A source distribution with the core. Returns the name of the file."""
    name = build.build_sdist(sdist_directory, config_settings)
    path = pathlib.Path(sdist_directory, name)
    top = pathlib.PurePosixPath(name[:-len(".tar.gz")])
    with tarfile.open(path) as made:
        metadata = made.getmember(str(top / "PKG-INFO"))
        text = made.extractfile(metadata).read()
    # LICENSE is a link to that of the repository.
    with tarfile.open(path, "w:gz", dereference=True) as archive:
        archive.addfile(metadata, io.BytesIO(text))
        project = archive.gettarinfo(HERE / "pyproject.toml", str(top / "pyproject.toml"))
        text = moved((HERE / "pyproject.toml").read_text(encoding="utf-8")).encode()
        project.size = len(text)
        archive.addfile(project, io.BytesIO(text))
        for file in BESIDE:
            archive.add(HERE / file, str(top / file))
        for file in needed_files():
            archive.add(file, str(top / "source" / file.relative_to(REPOSITORY).as_posix()))
    return name
