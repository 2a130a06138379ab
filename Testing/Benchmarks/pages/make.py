# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Makes the pages of a folder from the numbers there, and draws their plots.

  python3 Testing/Benchmarks/pages/make.py FOLDER [--pages PAGE,...] [--no-plots]
    [--pictures FOLDER]

FOLDER/Errors.json becomes FOLDER/Errors.md and some of FOLDER/Plots. Without --pages: whatever has
numbers there. Plots need matplotlib (Debian: python3-matplotlib), those of resolutions and peers
the pictures that were drawn with their numbers.
"""

import argparse
import importlib
import json
import os

PAGES = ("errors", "resolutions", "scaling", "kernels", "solvers", "rendering", "viewpoints",
         "peers", "gpu", "counts", "compilers", "steadiness", "orbits", "presets", "ranks",
         "graphics", "control")
PLOTTED = (*PAGES[:4], "peers")


def read(folder, page):
    """The numbers of a page; None: there are none."""
    path = os.path.join(folder, page.capitalize() + ".json")
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def text_of(page, measured):
    return importlib.import_module(page).page(measured).rstrip("\n") + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="with the numbers, for the pages")
    parser.add_argument("--pages", default=",".join(PAGES), help="between commas")
    parser.add_argument("--no-plots", action="store_true")
    parser.add_argument("--pictures", help="folder of the pictures of resolutions")
    options = parser.parse_args()
    for page in options.pages.split(","):
        measured = read(options.folder, page)
        if measured is None:
            continue
        path = os.path.join(options.folder, page.capitalize() + ".md")
        text = text_of(page, measured)
        with open(path + ".part", "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(path + ".part", path)  # it is complete whenever this program ends
        print(path)
        if page in PLOTTED and not options.no_plots:
            plots = os.path.join(options.folder, "Plots")
            os.makedirs(plots, exist_ok=True)
            importlib.import_module(f"plot_{page}").plot(measured, plots, options.pictures)


if __name__ == "__main__":
    main()
