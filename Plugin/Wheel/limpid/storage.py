# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Results in files: npz archives of numpy, of which one member, "limpid", is a header in JSON."""

from __future__ import annotations

import abc
import json
import os
import zipfile
from typing import Any, Callable, ClassVar, Mapping, TypeVar, Union

import numpy as np
import numpy.typing as npt

VERSION = 1  # of the format
HEADER = "limpid"

Path = Union[str, "os.PathLike[str]"]
Arrays = Mapping[str, npt.NDArray[Any]]
Loaded = TypeVar("Loaded")

#: How each kind of result is made of its header and its arrays.
READERS: dict[str, Callable[[dict[str, Any], Arrays], Any]] = {}


def reads(kind: str) -> Callable[[Callable[[dict[str, Any], Arrays], Loaded]],
                                 Callable[[dict[str, Any], Arrays], Loaded]]:
    """Decorates what makes results of that kind of a header and arrays."""
    def register(reader: Callable[[dict[str, Any], Arrays], Loaded]) \
            -> Callable[[dict[str, Any], Arrays], Loaded]:
        READERS[kind] = reader
        return reader
    return register


class Saved(abc.ABC):
    """A result that has a file format."""

    KIND: ClassVar[str]

    @abc.abstractmethod
    def _contents(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """The header, of what JSON can have, and the arrays; None is left out."""

    def save(self, path: Path, *, compress: bool = True) -> None:
        """Writes the result to a file that `load` reads.

        The file is an archive of numpy (npz): the arrays with the names of the attributes, and a
        header in JSON named "limpid" with all numbers.

        Parameters
        ----------
        path : str or os.PathLike
            The name of the file, as it is; an existing file is replaced.
        compress : bool, default True
            Whether to compress the arrays, which takes longer.

        Raises
        ------
        OSError
            The file cannot be written.
        """
        header, arrays = self._contents()
        text = json.dumps({"kind": self.KIND, "version": VERSION, **header})
        there = {name: array for name, array in arrays.items() if array is not None}
        store = np.savez_compressed if compress else np.savez
        with open(path, "wb") as file:
            store(file, **{HEADER: np.array(text), **there})


def load(path: Path) -> Any:
    """Reads a result from a file that `Optimization.save` or `Viewpoints.save` has written.

    The file is an archive of numpy, which ``numpy.load`` opens, too. Its member "limpid" is a text
    in JSON with the numbers, and the others are arrays with the names and units of the attributes.
    Nothing in it is executed.

    Parameters
    ----------
    path : str or os.PathLike
        The name of the file.

    Returns
    -------
    Optimization or Viewpoints
        What was saved. An optimisation can be `previous` of another one for a warm start, but not
        for temporal coherence: the change that this needs is not in the file.

    Raises
    ------
    ValueError
        The file has no result, or one of a later version.
    OSError
        The file cannot be read.

    Examples
    --------
    >>> found.save("found.npz")
    >>> again = load("found.npz")
    """
    nothing = ValueError(f"{os.fspath(path)} is not a result of limpid (it cannot be read). Give a "
                         "file that save has written.")
    try:
        archive = np.load(path, allow_pickle=False)
    except (ValueError, EOFError, zipfile.BadZipFile):
        raise nothing from None
    if not isinstance(archive, np.lib.npyio.NpzFile):
        raise nothing
    with archive:
        if HEADER not in archive.files:
            raise nothing
        header = json.loads(str(archive[HEADER]))
        if header["version"] > VERSION:
            raise ValueError(f"{os.fspath(path)} has the version {header['version']} of the format "
                             f"(this package reads those up to {VERSION}). Install a newer limpid.")
        arrays = {name: archive[name] for name in archive.files if name != HEADER}
    return READERS[header["kind"]](header, arrays)
