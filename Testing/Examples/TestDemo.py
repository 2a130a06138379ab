# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Which folders demo.sh gives to its scenes.

import pathlib
import tempfile
import unittest

import scripts


class TestDemo(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.repository = scripts.Repository(folder.name, "demo.sh")
        self.repository.replace("Testing/build.sh", "echo Limpid.so")
        # Writes down a scene and its folder: ... --output FOLDER --scene FILE
        self.repository.replace("Testing/with-display.sh", """
            if [[ "$*" == *optimize_scene.py* ]]; then printf '%s|%s\\n' "${@: -3:1}" "${@: -1}" >> shown; fi""")
        for name in ("scene_file.py", "contact_sheet.py", "sphere_sheet.py"):
            self.repository.replace(scripts.EXAMPLES / name, "import sys; open("
                                    f"'{name}.txt', 'w').write('|'.join(sys.argv[1:]))")

    def folders_of(self, *scenes):
        """The folder of every scene, in the order of the scenes."""
        arguments = [part for scene in scenes for part in ("--scene", scene)]
        self.repository.run("demo.sh", "out put", *arguments, cwd=self.folder)
        shown = [line.split("|") for line in (self.folder / "shown").read_text().splitlines()]
        self.assertEqual([scene for _, scene in shown], list(scenes))
        return [folder for folder, _ in shown]

    def test_scenes_of_one_file_name_have_folders_of_their_own(self):
        folders = self.folders_of("a/head.scene.json", "b/head.scene.json", "a/head.scene.json")

        self.assertEqual(folders, ["out put/head", "out put/head-2", "out put/head-3"])
        for sheet in ("contact_sheet", "sphere_sheet"):
            shown = (self.folder / f"{sheet}.py.txt").read_text().split("|")
            self.assertEqual(shown[1:], folders)

    def test_a_made_up_name_may_be_taken(self):
        self.assertEqual(
            self.folders_of("a/head-2.scene.json", "a/head.scene.json", "b/head.scene.json"),
            ["out put/head-2", "out put/head", "out put/head-3"])

    def test_names_may_have_spaces_and_stars(self):
        self.assertEqual(self.folders_of("a b/my head*.scene.json", "a b/my head.scene.json"),
                         ["out put/my head*", "out put/my head"])


if __name__ == "__main__":
    unittest.main()
