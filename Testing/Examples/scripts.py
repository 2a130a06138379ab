# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The examples' scripts, in a repository where what they start is replaced."""

import os
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = pathlib.Path("Documentation/Examples")


class Repository:
    """A folder with copies of some examples, and replacements."""

    def __init__(self, folder, *examples):
        self.root = pathlib.Path(folder, "a repository")
        self.programs = pathlib.Path(folder, "programs")
        for name in examples:
            self.write(self.root / EXAMPLES / name, (ROOT / EXAMPLES / name).read_text())

    @staticmethod
    def write(path, text):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def replace(self, path, text):
        """A file of the repository."""
        self.write(self.root / path, text)

    def replace_program(self, name, text):
        """A program on the PATH, in bash."""
        self.write(self.programs / name, "#!/usr/bin/env bash\n" + text)
        (self.programs / name).chmod(0o755)

    def run(self, script, *arguments, cwd):
        path = os.pathsep.join([str(self.programs), os.environ["PATH"]])
        return subprocess.run(
            [shutil.which("bash"), self.root / EXAMPLES / script, *map(str, arguments)],
            cwd=cwd, env={**os.environ, "PATH": path}, check=True, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
