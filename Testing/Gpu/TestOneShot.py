# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Rehearses the one call on a machine with a GPU (one-shot.sh), with stubs for its programs.

The call finds nothing but the tools of a bare machine on its PATH. It is killed in the middle of
several steps and at random moments: what had been printed and measured by then has to be in its
folder, and the step in which it was killed has to be named.
"""

import os
import pathlib
import random
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
sys.path.insert(0, str(HERE))

import outcome  # noqa: E402
from bare_machine import CORE, STUB, TOOLS, write_cuda_tools, write_stub  # noqa: E402

FILES = {
    "summary.md", "Gpu.json", "Gpu.md", "tests.log", "benchmark.log", "profile.log",
    "sanitizers.log"}

# Adds a scene with its first figure, before it may hang; the others follow.
BENCHMARK = """#!{python}
import json, os, subprocess, sys
words = sys.argv[1:]
if "--help" in words:
    sys.exit()
output = words[words.index("--output") + 1]
whole = json.load(open("{results}"))
scene = whole["scenes"].pop(0)
if "--files" in words:
    scene["scene"] = os.path.basename(words[words.index("--files") + 1]).split(".")[0]
else:
    scene["nodes"] = int(words[words.index("--sizes") + 1])
    scene["scene"] = words[words.index("--scenes") + 1] + " along x" * ("--along-x" in words)
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


# Does not start, as a program whose library is absent.
BROKEN = "#!/absent/{name}\n"
# Builds the targets that it is told: those that are in the folder `spare`.
CMAKE = """#!{bash}
[[ $1 == --build ]] || exit 0
while [[ $1 != --target ]]; do shift; done
shift
for name in "$@"; do cp "{spare}/$name" "{bin}"; done
"""


class TestOneShot(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.root = pathlib.Path(self.folder.name)
        self.state = self.root / "state"
        self.out = self.root / "out"
        self.tools = self.root / "tools"
        self.bin = self.root / "bin"
        for place in (self.state, self.tools, self.bin, self.root / "scenes"):
            place.mkdir()
        shutil.copytree(HERE, self.root / "Testing/Gpu", ignore=shutil.ignore_patterns("cuda"))
        shutil.copytree(ROOT / "Testing/Benchmarks/pages", self.root / "Testing/Benchmarks/pages")
        for name in TOOLS:
            (self.tools / name).symlink_to(shutil.which(name))
        (self.tools / "python3").symlink_to(sys.executable)
        write_cuda_tools(self.tools, self.state)
        for name in ("test_gpu", *(f"test_core_{name}" for name in CORE)):
            write_stub(self.bin / name, STUB, state=self.state)
        write_stub(self.root / "bench", STUB, state=self.state)
        write_stub(self.bin / "limpid_bench_gpu", BENCHMARK, hang=self.root / "bench",
                   results=ROOT / "Documentation/Benchmarks/Gpu.json")
        (self.root / "scenes/skull.scene.json").write_text("{}")
        self.pack()

    def tearDown(self):
        (self.state / "stop").touch()
        self.folder.cleanup()

    def pack(self):
        carried = self.root / "build-gpu-carry"
        carried.mkdir(exist_ok=True)
        with tarfile.open(carried / "carry.tar.xz", "w:xz") as archive:
            for name in ("bin", "scenes"):
                archive.add(self.root / name, name)

    def begin(self, hangs, *seconds):
        """Starts the call; the stub whose name and arguments contain `hangs` does not end."""
        (self.state / "hangs").write_text(hangs)
        return subprocess.Popen(
            ["bash", str(self.root / "Testing/Gpu/one-shot.sh"), str(self.out), *seconds],
            env={"PATH": str(self.tools), "TMPDIR": str(self.root)},
            start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def kill(self, call):
        if call.poll() is None:
            os.killpg(call.pid, signal.SIGKILL)
            call.wait()
        self.assertEqual(outcome.faults(self.out), [])

    def kill_in(self, step, hangs, log=None, line=None):
        """Kills the call in a step, while that stub hangs, once `line` of it is in `log`."""
        call = self.begin(hangs)
        while not (self.state / "hanging").exists():
            self.assertIsNone(call.poll(), f"It ended before {hangs}.")
            time.sleep(0.05)
        deadline = time.monotonic() + 20  # It comes through pipes, on a machine that may be busy.
        while line and line not in self.text(log) and time.monotonic() < deadline:
            time.sleep(0.05)
        self.kill(call)
        if line:
            self.assertIn(line, self.text(log))
        self.assertIn(step, outcome.unfinished(self.out))

    def text(self, name):
        return outcome.text(self.out, name)

    def scenes(self):
        return outcome.json.loads(self.text("Gpu.json"))["scenes"]

    def results(self):
        return {name: result for name, result, _ in outcome.steps(self.out)}

    def test_takes_every_step(self):
        self.assertEqual(self.begin("nothing hangs").wait(), 0)
        self.assertEqual({path.name for path in self.out.iterdir()}, FILES)
        for result in ("FAILED", "STOPPED", "not run", "not finished"):
            self.assertNotIn(result, self.text("summary.md"))
        self.assertEqual(outcome.faults(self.out), [])
        self.assertIn("| status 0, 10 programs, 1 scenes |", self.text("summary.md"))
        self.assertEqual(len(self.scenes()), 8)
        self.assertIn("--along-x", self.text("benchmark.log"))
        self.assertIn("skull.scene.json", self.text("benchmark.log"))
        self.assertIn("--scenes waves", self.text("benchmark.log"))
        for name in CORE:
            self.assertIn(f"test_core_{name}: [       OK ]", self.text("tests.log"))

    def test_keeps_the_first_figure_of_a_scene(self):
        self.kill_in("bench_onion-256", "bench --scenes onion --sizes 256 --append",
                     "benchmark.log", "bench began")
        self.assertEqual(len(self.scenes()), 1)
        self.assertIn("seconds", self.scenes()[0]["policy"])
        self.assertIn("missing", self.scenes()[0]["frame"])
        self.assertIn("| latencies | done", self.text("summary.md"))

    def test_keeps_earlier_scenes(self):
        self.kill_in("bench_onion-472", "bench --scenes onion --sizes 472")
        self.assertGreater(len(self.scenes()), 2)
        self.assertIn("missing", self.scenes()[-1]["frame"])
        self.assertTrue(all("seconds" in scene["frame"] for scene in self.scenes()[:-1]))
        self.assertIn("## onion, 256", self.text("Gpu.md"))

    def test_keeps_what_tests_said(self):
        self.kill_in("tests", "test_gpu |", "tests.log", "test_gpu began")
        self.assertEqual(len(self.scenes()), 1)

    def test_keeps_what_tests_of_the_core_said(self):
        self.kill_in("test_core_stress", "test_core_stress |", "tests.log", "test_core_stress: [")

    def test_keeps_what_the_profiler_said(self):
        self.kill_in("profile", "ncu ", "profile.log", "ncu began")

    def test_keeps_what_sanitizers_said(self):
        self.kill_in("initcheck", "compute-sanitizer --tool initcheck", "sanitizers.log",
                     "===== initcheck")
        self.assertIn("| memcheck | done", self.text("summary.md"))

    def test_keeps_what_ended_before_a_random_moment(self):
        for _ in range(2):
            calls = random.randint(1, 45)
            with self.subTest(calls=calls):
                shutil.rmtree(self.out, ignore_errors=True)
                (self.state / "calls").write_text("")
                call = self.begin("nothing hangs")
                while call.poll() is None and self.calls() < calls:
                    time.sleep(random.uniform(0, 0.02))
                self.kill(call)

    def calls(self):
        return (self.state / "calls").read_text().count("\n")

    def test_ends_when_a_step_takes_all_time(self):
        self.assertEqual(self.begin("--append", "16").wait(), 1)
        self.assertEqual(outcome.faults(self.out), [])
        self.assertEqual(outcome.unfinished(self.out), [])
        self.assertIn("STOPPED", self.results()["bench_onion-256"])
        self.assertIn("not run: no time was left", self.results()["memcheck"])

    def test_leaves_out_what_no_file_can_hold(self):
        write_stub(self.bin / "test_gpu", STUB + "head -c 20000000 /dev/zero | tr '\\0' x\n",
                   state=self.state)
        self.pack()
        self.kill_in("memcheck", "compute-sanitizer --tool memcheck --error")
        self.assertIn("bytes more are left out", self.text("tests.log"))

    def break_program(self, name):
        spare = self.root / "spare"
        shutil.copytree(self.bin, spare)
        write_stub(self.bin / name, BROKEN)
        self.pack()
        write_stub(self.tools / "cmake", CMAKE, spare=spare, bin=self.root / "build-gpu/bin")
        (self.tools / "g++").symlink_to(shutil.which("true"))

    def test_builds_what_does_not_start(self):
        for name in ("limpid_bench_gpu", "test_core_modes"):
            with self.subTest(name):
                self.tearDown()
                self.setUp()
                self.break_program(name)
                self.assertEqual(self.begin("nothing hangs").wait(), 0)
                self.assertEqual(outcome.faults(self.out), [])
                said = [(step, result) for step, result in self.results().items()
                        if step.startswith(f"programs ({name} does not start: ")]
                self.assertEqual(len(said), 1)
                self.assertIn("built here", said[0][1])
                self.assertEqual(len(self.scenes()), 8)
                self.assertIn("status 0", self.results()["test_core_modes"])

    def test_says_that_it_cannot_build(self):
        self.break_program("test_gpu")
        (self.tools / "cmake").unlink()
        self.assertEqual(self.begin("nothing hangs").wait(), 1)
        self.assertIn("FAILED: not built here, either", self.text("summary.md"))
        self.assertIn("no nvcc or no cmake", self.text("build.log"))


if __name__ == "__main__":
    unittest.main()
