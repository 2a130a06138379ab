# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether shaders keep to the language in whatever they are compiled for: drivers differ in what
else they take. Needs glslangValidator (Debian: glslang-tools)."""

import itertools
import re
import shutil
import subprocess
import unittest

import house

SHADER = house.ROOT / "Representations/Rendering/CastRays.glsl"
OUTPUTS = "out vec4 fragOutput0;\nout vec4 fragOutput1;\n"
VERSION = "#version 150\n"  # of the context that VTK asks for


class TestShaders(unittest.TestCase):
    def setUp(self):
        self.compiler = shutil.which("glslangValidator")
        if not self.compiler:
            self.skipTest("glslangValidator is not here: install glslang-tools")

    def test_of_rays_are_right_for_every_pair_of_needs(self):
        text = house.text(SHADER)
        names = sorted(set(re.findall(r"^#ifdef (\w+)", text, re.MULTILINE)) | {"SHADOWED"})
        self.assertGreater(len(names), 8)
        text = text.replace("//VTK::Output::Dec", OUTPUTS)
        text = re.sub(r"gl_FragData\[(\d)\]", r"fragOutput\1", text)  # as VTK does
        for needs in ((), *itertools.combinations(names, 1), *itertools.combinations(names, 2),
                      names):
            defined = "".join(f"#define {name}\n" for name in needs)
            result = subprocess.run([self.compiler, "--stdin", "-S", "frag"], text=True,
                                    input=VERSION + defined + text, capture_output=True)
            with self.subTest(needs=needs):
                self.assertEqual(result.returncode, 0, result.stdout)


if __name__ == "__main__":
    unittest.main()
