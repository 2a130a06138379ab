# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Which files first_pictures.sh opens, in a ParaView that only writes down what it is told.

import pathlib
import sys
import tempfile
import unittest

import scripts

STORY = """
from unittest.mock import MagicMock
Frames = MagicMock()
live = say = MagicMock()
def screenshot(path):
    open(path, "w").close()
"""
PARAVIEW = r"""
from unittest.mock import MagicMock
simple = MagicMock()
def open_file(path):
    with open("opened", "a") as file:
        file.write(path + "\n")
simple.OpenDataFile = open_file
simple.Show.return_value.VisibleFraction = simple.Show.return_value.BaseVisibleFraction = 0.5
simple.SaveScreenshot = lambda path, *_, **__: open(path, "w").close()
"""


class TestFirstPictures(unittest.TestCase):
    def test_names_of_files_may_have_spaces(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            repository = scripts.Repository(folder, "first_pictures.sh", "first_pictures.py")
            repository.replace(scripts.EXAMPLES / "in_window.sh", f"""
                mkdir -p "$2"
                cd "$2"
                LIMPID_OUTPUT="$PWD" '{sys.executable}' -B "$3" """)
            repository.replace(scripts.EXAMPLES / "story.py", STORY)
            repository.replace(scripts.EXAMPLES / "paraview.py", PARAVIEW)
            # Reads the first file that it is given, writes the last one.
            repository.replace_program("convert", 'cat "$1" > "${@: -1}"')
            repository.replace_program("montage", 'printf "%s\\n" "$@" | grep "^cut-" > "${@: -1}"')
            files = [folder / "my data/a head.vti", folder / "plain.vti"]
            for file in files:
                repository.write(file, "")

            repository.run("first_pictures.sh", folder, folder / "pictures", *files, cwd=folder)

            pictures = folder / "pictures"
            self.assertEqual((pictures / "opened").read_text().splitlines(), list(map(str, files)))
            self.assertEqual(
                (pictures / "first-pictures.jpg").read_text().splitlines(),
                [f"cut-{file.stem}-{way}.png" for file in files for way in ("ordinary", "optimized")])
            self.assertEqual(list(pictures.glob("cut-*")), [])


if __name__ == "__main__":
    unittest.main()
