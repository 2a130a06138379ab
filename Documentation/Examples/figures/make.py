# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Makes all figures, and puts their captions into the gallery.

  pvpython make.py --plugin Limpid.so --output FOLDER [--gallery Gallery.md] [--only figure_8 ...]
    [--scale 0.5] [--quick] [FILE.scene.json ...]

Captions stand in the gallery between <!-- figure_8 --> and <!-- end -->; all else there is written by
hand. --captions: only these, from the numbers that figures.json has.
"""

import importlib
import json
import re
import time

import studio

FIGURES = ("figure_1b", "figure_5", "figure_6", "figure_7", "figure_8", "figure_9", "figure_10",
           "table_1", "supplement_weights", "supplement_views")
STUDIES = ("table_methods",)  # more than the paper has: only if they are named
MARK = r"(<!-- {} -->\n)(.*?)(<!-- end -->)"


def write_captions(path, numbers):
    """Into the gallery, of the figures that have numbers."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for name, found in numbers.items():
        caption = "{}\n\n*By `all.sh --only {}` in {:.0f} s, {:.0f} s of all cores together{}.*\n".format(
            importlib.import_module(name).caption(found).strip(), name, found["seconds"],
            found["of_cores"],
            ", without {}".format(", ".join(found["absent"])) if found["absent"] else "")
        text, places = re.subn(MARK.format(name), lambda match, caption=caption: "".join(
            (match[1], caption, match[3])), text, flags=re.DOTALL)
        if places != 1:
            raise SystemExit("{} has {} places for {} (its caption belongs in one). Write "
                             "<!-- {} --> and <!-- end --> there.".format(path, places, name, name))
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def main():
    parser = studio.parser(__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--gallery", help="page with places for captions")
    parser.add_argument("--only", nargs="+", choices=FIGURES + STUDIES, default=FIGURES, metavar="NAME")
    parser.add_argument("--captions", action="store_true", help="no figures, captions only")
    arguments = parser.parse_args()
    run = studio.start(arguments)
    begin = time.perf_counter()
    if arguments.captions:
        with open(run.path("figures.json"), encoding="utf-8") as file:
            numbers = json.load(file)
    else:
        numbers = studio.make(run, arguments.only)
    if arguments.gallery:
        write_captions(arguments.gallery, numbers)
    print("{} figures in {:.0f} s: {}".format(
        len(arguments.only), time.perf_counter() - begin, arguments.output))


if __name__ == "__main__":
    main()
