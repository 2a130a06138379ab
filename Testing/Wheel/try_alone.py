# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Tries the wheel for other machines in an environment with numpy alone: it computes, and its oneTBB
is the one inside the package. Testing/wheel.sh runs it."""

import importlib.metadata
import pathlib
import sys

import limpid

import phantom


def main():
    found = limpid.optimize(phantom.scalars(), **phantom.SCENE)
    assert found.visible_fraction > found.base_visible_fraction, found
    print(found)

    site = pathlib.Path(limpid.__file__).resolve().parents[1]
    loaded = {pathlib.Path(line.split()[-1]) for line in
              pathlib.Path("/proc/self/maps").read_text(encoding="utf-8").splitlines()
              if "libtbb" in line}
    assert loaded and all(site in path.parents for path in loaded), loaded
    wheel = importlib.metadata.distribution("limpid").read_text("WHEEL")
    tags = [line.partition(": ")[2] for line in wheel.splitlines() if line.startswith("Tag: ")]
    print(f"Python {sys.version.split()[0]}, {' and '.join(tags)}, with",
          " and ".join(sorted(path.name for path in loaded)))


if __name__ == "__main__":
    main()
