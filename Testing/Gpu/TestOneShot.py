# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Rehearses the one call on a machine with a GPU (one-shot.sh), with stubs for its programs.

The call finds nothing but the tools of a bare machine on its PATH. It is killed in the middle of
several steps: what had been printed and measured by then has to be in its folder.
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import time
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TOOLS = (
    "awk", "basename", "bash", "cat", "chmod", "cp", "cut", "dirname", "find", "free", "grep", "head",
    "ldd", "mkdir", "mktemp", "mv", "nproc", "rm", "sed", "sleep", "sort", "stat", "tail", "tar",
    "tee", "timeout", "tr", "uname", "uniq", "wc", "xz")
FILES = {
    "summary.md", "Gpu.json", "Gpu.md", "build.log", "tests.log", "benchmark.log", "profile.log",
    "sanitizers.log"}
CORE = ("backends", "closed_form", "invariance", "modes", "stress", "input", "progressive",
        "renderer")

# Prints; then either goes on, or says that it is in the middle and waits to be killed.
STUB = """#!{bash}
echo "[       OK ] {name} began"
echo "{name} $*" >> "{state}/calls"
if [[ "{name} $*|" == *"$(cat "{state}/hangs")"* ]]; then
  : > "{state}/hanging"
  for ((n = 0; n < 600; ++n)); do [[ -e {state}/stop ]] && exit 1; sleep 0.1; done
fi
"""
COMPILER = """
while (($# > 0)) && [[ $1 != -o ]]; do shift; done
(($# > 0)) || exit 0
printf '#!{bash}\\necho latencies\\n' > "$2" && chmod +x "$2"
"""
WRAPPER = """
while (($# > 0)) && [[ ! -x $1 ]]; do shift; done
exec "$@"
"""
# Adds a scene with its first figure, before it may hang; the others follow.
BENCHMARK = """#!{python}
import json, os, subprocess, sys
words = sys.argv[1:]
if "--help" in words:
    sys.exit()
output = words[words.index("--output") + 1]
whole = json.load(open("{results}"))
scene = whole["scenes"].pop(0)
earlier = "--append" in words and os.path.exists(output)
whole["scenes"] = json.load(open(output))["scenes"] if earlier else []
figures = {{key: value for key, value in scene.items() if isinstance(value, dict)}}
for rest in (True, False):
    for key in figures:
        scene[key] = figures[key] if key == "policy" or not rest else {{"missing": "No time."}}
    if rest:
        whole["scenes"].append(scene)
    with open(output + ".part", "w") as file:
        json.dump(whole, file)
    os.replace(output + ".part", output)
    if rest and subprocess.run(["{hang}", *words]).returncode:
        sys.exit(1)
"""


class TestOneShot(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        self.state = self.root / "state"
        self.out = self.root / "out"
        tools = self.root / "tools"
        for place in (self.state, tools, self.root / "bin", self.root / "scenes"):
            place.mkdir()
        shutil.copytree(HERE, self.root / "Testing/Gpu", ignore=shutil.ignore_patterns("cuda"))
        shutil.copytree(ROOT / "Testing/Benchmarks/pages", self.root / "Testing/Benchmarks/pages")
        for name in TOOLS:
            (tools / name).symlink_to(shutil.which(name))
        (tools / "python3").symlink_to(sys.executable)
        self.write(tools / "nvcc", STUB + COMPILER)
        for name in ("ncu", "compute-sanitizer"):
            self.write(tools / name, STUB + WRAPPER)
        self.write(tools / "nvidia-smi", STUB)
        for name in ("test_gpu", *(f"test_core_{name}" for name in CORE)):
            self.write(self.root / "bin" / name, STUB)
        self.write(self.root / "bench", STUB)
        self.write(self.root / "bin/limpid_bench_gpu", BENCHMARK)
        (self.root / "scenes/skull.scene.json").write_text("{}")
        carried = self.root / "build-gpu-carry"
        carried.mkdir()
        with tarfile.open(carried / "carry.tar.xz", "w:xz") as archive:
            for name in ("bin", "scenes"):
                archive.add(self.root / name, name)

    def tearDown(self):
        (self.state / "stop").touch()
        self.folder.cleanup()

    def write(self, path, text):
        path.write_text(text.format(
            name=path.name, state=self.state, bash=shutil.which("bash"), python=sys.executable,
            results=ROOT / "Documentation/Benchmarks/Gpu.json", hang=self.root / "bench"))
        path.chmod(0o755)

    def begin(self, hangs):
        """Starts the call; the stub whose name and arguments contain `hangs` does not end."""
        (self.state / "hangs").write_text(hangs)
        return subprocess.Popen(
            ["bash", str(self.root / "Testing/Gpu/one-shot.sh"), str(self.out)],
            env={"PATH": str(self.root / "tools"), "TMPDIR": str(self.root)},
            start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def kill_in(self, hangs, log=None, line=None):
        """Kills the call while that stub hangs, once `line`, which it has printed, is in `log`."""
        call = self.begin(hangs)
        while not (self.state / "hanging").exists():
            self.assertIsNone(call.poll(), f"It ended before {hangs}.")
            time.sleep(0.05)
        deadline = time.monotonic() + 20  # It comes through pipes, on a machine that may be busy.
        while line and line not in self.text(log) and time.monotonic() < deadline:
            time.sleep(0.05)
        os.killpg(call.pid, signal.SIGKILL)
        call.wait()
        if line:
            self.assertIn(line, self.text(log))

    def text(self, name):
        path = self.out / name
        return path.read_text() if path.exists() else ""

    def scenes(self):
        return json.loads(self.text("Gpu.json"))["scenes"]

    def test_takes_every_step(self):
        self.assertEqual(self.begin("nothing hangs").wait(), 0)
        self.assertEqual({path.name for path in self.out.iterdir()}, FILES)
        for result in ("FAILED", "STOPPED", "not run"):
            self.assertNotIn(result, self.text("summary.md"))
        self.assertIn("| status 0, 10 programs, 1 scenes |", self.text("summary.md"))
        self.assertEqual(len(self.scenes()), 8)
        self.assertIn("--along-x", self.text("benchmark.log"))
        self.assertIn("skull.scene.json", self.text("benchmark.log"))
        self.assertIn("--scenes waves", self.text("benchmark.log"))
        for name in CORE:
            self.assertIn(f"test_core_{name}: [       OK ]", self.text("tests.log"))

    def test_keeps_the_first_figure_of_a_scene(self):
        self.kill_in("bench --scenes onion --sizes 256 --append", "benchmark.log", "bench began")
        self.assertEqual(len(self.scenes()), 1)
        self.assertIn("seconds", self.scenes()[0]["policy"])
        self.assertIn("missing", self.scenes()[0]["frame"])
        self.assertIn("| latencies | done", self.text("summary.md"))

    def test_keeps_earlier_scenes(self):
        self.kill_in("bench --scenes onion --sizes 472")
        self.assertGreater(len(self.scenes()), 2)
        self.assertIn("missing", self.scenes()[-1]["frame"])
        self.assertTrue(all("seconds" in scene["frame"] for scene in self.scenes()[:-1]))
        self.assertIn("## onion, 256", self.text("Gpu.md"))

    def test_keeps_what_tests_said(self):
        self.kill_in("test_gpu |", "tests.log", "test_gpu began")
        self.assertEqual(len(self.scenes()), 1)

    def test_keeps_what_tests_of_the_core_said(self):
        self.kill_in("test_core_stress", "tests.log", "test_core_stress began")

    def test_keeps_what_the_profiler_said(self):
        self.kill_in("ncu ", "profile.log", "ncu began")

    def test_keeps_what_sanitizers_said(self):
        self.kill_in(
            "compute-sanitizer --tool initcheck", "sanitizers.log", "compute-sanitizer began")
        self.assertIn("| memcheck | done", self.text("summary.md"))


if __name__ == "__main__":
    unittest.main()
