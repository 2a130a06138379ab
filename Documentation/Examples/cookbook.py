# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Runs the Python of pages in pvpython, section by section, and makes a sheet of the pictures.

  python3 cookbook.py --plugin Limpid.so --output FOLDER [--data FOLDER] [--sheet SHEET.jpg] PAGE.md...

The code blocks before the first section begin the script of each section that has any. A section
that reads files which are not in the folder of data is skipped. Without a display: xvfb-run python3 ...
"""

import argparse
import glob
import os
import pathlib
import re
import subprocess
import time

BLOCK = r"^```python\n(.*?)^```$"
FILES = r'"([\w/-]+\.(?:vti|nii\.gz))"'


def scripts(page):
    """Pairs of a title and a script."""
    text = pathlib.Path(page).read_text(encoding="utf-8")
    start, *sections = re.split(r"^## (.+)$", text, flags=re.M)
    first = re.findall(BLOCK, start, re.M | re.S)
    for title, section in zip(sections[::2], sections[1::2]):
        blocks = re.findall(BLOCK, section, re.M | re.S)
        if blocks:
            yield title, "\n".join(first + blocks)


def prepare(folder, plugin, data):
    """Makes what scripts expect: the build folder and the files of data."""
    def link(path, target):
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.is_symlink():
            path.symlink_to(target)

    link(folder / "build/lib/Limpid/Limpid.so", pathlib.Path(plugin).resolve())
    for file in glob.glob(os.path.join(data, "**", "*"), recursive=True) if data else []:
        if re.search(r"\.(vti|nii\.gz)$", file):
            link(folder / os.path.basename(file), os.path.abspath(file))


def run(pvpython, folder, title, script):
    """Runs a script in a folder. Returns the pictures that it has made."""
    missing = [file for file in re.findall(FILES, script) if not (folder / file).exists()]
    if missing:
        print(f"{title}: skipped, {', '.join(missing)} is not there", flush=True)
        return []
    begin = time.time()
    (folder / "section.py").write_text(script, encoding="utf-8")
    subprocess.run([pvpython, "section.py"], cwd=folder, check=True)
    made = sorted((path for path in folder.glob("*.png") if path.stat().st_mtime >= begin),
                  key=lambda path: path.stat().st_mtime)
    print(f"{title}: {len(made)} pictures in {time.time() - begin:.0f} s", flush=True)
    return made


def write_sheet(path, pictures, size=190, across=4):
    """A sheet of all pictures."""
    import numpy  # pylint: disable=import-outside-toplevel
    import picture_grid  # pylint: disable=import-outside-toplevel
    from PIL import Image  # pylint: disable=import-outside-toplevel

    def cell(name):
        picture = Image.open(name).convert("RGB")
        edge = min(picture.size)
        left, top = (picture.width - edge) // 2, (picture.height - edge) // 2
        picture = picture.crop((left, top, left + edge, top + edge)).resize((size, size))
        return numpy.asarray(picture), name.name

    cells = [cell(name) for name in pictures]
    rows = [cells[first:first + across] for first in range(0, len(cells), across)]
    picture_grid.save(picture_grid.compose(rows), path)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--data", default="")
    parser.add_argument("--sheet")
    parser.add_argument("--pvpython", default="pvpython")
    parser.add_argument("--only", help="sections whose titles have these words")
    parser.add_argument("pages", nargs="+")
    arguments = parser.parse_args()
    folder = pathlib.Path(arguments.output).resolve()
    prepare(folder, arguments.plugin, arguments.data)
    pictures, count = [], 0
    for title, script in [script for page in arguments.pages for script in scripts(page)]:
        if not arguments.only or arguments.only in title:
            pictures += run(arguments.pvpython, folder, title, script)
            count += 1
    if arguments.sheet:  # of movies no frames
        write_sheet(arguments.sheet, [path for path in pictures
                                      if not re.search(r"\d{4}\.png$", path.name)])
    print(f"{count} sections, {len(pictures)} pictures in {folder}")


if __name__ == "__main__":
    main()
