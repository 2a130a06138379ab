# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Rehearses the one call on a machine with a GPU (one-shot.sh) without one, with its real programs.

    python3 Testing/Gpu/rehearse.py DATA [--kills 8] [--beside 2] [--seed 1] [--limits]

The processor simulates the device. The programs are built in build-rehearsal/ and packed with the
scenes of DATA. The call runs in a chroot that has a copy of the working tree and what a bare
machine has, with stubs for the tools of CUDA: once to its end, then some times until it is killed
at a random second. Each time its folder must have what every step that ended had found, readable,
and must name the steps that were running. With --limits also with programs that neither end nor let
themselves be interrupted: the call must end within its time.
Needs Linux, unshare, and what build and pack.sh need.
"""

import argparse
import concurrent.futures
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))

import outcome  # noqa: E402
from bare_machine import TOOLS, write_cuda_tools  # noqa: E402

SECONDS = 520
# Works for the smallest scene and where it is asked what it can; else it neither ends nor stops.
ENDLESS = """#!/usr/bin/bash
case "$*" in *--help* | *--gtest_list_tests* | *smoke.json*) exit ;; esac
trap '' TERM
echo "endless: $*"
while :; do sleep 1000; done
"""
PLACES = """
set -e
mount --rbind /proc "$0/proc"
mount --rbind /dev "$0/dev"
exec chroot "$0" /usr/bin/env -i PATH=/usr/bin {setting} \\
  bash /limpid/Testing/Gpu/one-shot.sh /out {seconds}
"""


def run(*command, **options):
    subprocess.run([str(word) for word in command], check=True, **options)


def build():
    """Returns the folder of the programs."""
    folder = ROOT / "build-rehearsal"
    run("cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DLIMPID_ENABLE_VTK=OFF",
        "-DLIMPID_ENABLE_CUDA=OFF", "-DLIMPID_BUILD_TESTING=ON", stdout=subprocess.DEVNULL)
    run("cmake", "--build", folder, "--parallel", os.cpu_count(), "--target", "rehearsal_programs",
        stdout=subprocess.DEVNULL)
    return folder / "rehearsal"


def libraries(program):
    """Files that a program needs to start."""
    listed = subprocess.run(["ldd", program], capture_output=True, text=True, check=False).stdout
    words = [word for line in listed.splitlines() for word in line.split()]
    return [word for word in words if word.startswith("/")]


def copy_file(path, machine):
    """Copies a file, not a link, to where it is found here; links of /lib and /bin are there."""
    path = pathlib.Path(path)
    place = path if str(path).startswith("/usr/") else pathlib.Path("/usr", *path.parts[1:])
    target = machine / place.relative_to("/")
    if not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(path.resolve(), target)


def copy_python(machine):
    """The interpreter and its own library, without packages."""
    library = pathlib.Path(sysconfig.get_paths()["stdlib"])
    ignored = shutil.ignore_patterns("*-packages", "test", "idlelib", "ensurepip", "__pycache__")
    shutil.copytree(library, machine / library.relative_to("/"), ignore=ignored)
    interpreter = machine / "usr/bin/python3"
    shutil.copy2(pathlib.Path(sys.executable).resolve(), interpreter)
    for program in (interpreter, *machine.glob("usr/lib/python3*/lib-dynload/*.so")):
        for file in libraries(program):
            if not file.startswith(str(machine)):
                copy_file(file, machine)


def copy_tree(target):
    """The working tree as it travels: without what git ignores."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target / name)


def make_machine(machine, program):
    """A folder to chroot into: tools, Python, the libraries of a compiler that `program`
    needs, stubs for CUDA, the working tree."""
    for place in ("usr/bin", "usr/lib", "usr/lib64", "tmp", "out", "proc", "dev", "state"):
        (machine / place).mkdir(parents=True)
    for name in ("bin", "lib", "lib64"):
        (machine / name).symlink_to(f"usr/{name}")
    for name in TOOLS:
        path = shutil.which(name)
        copy_file(path, machine)
        for file in libraries(path):
            copy_file(file, machine)
    copy_python(machine)
    for file in libraries(program):
        if "tbb" not in file:  # a package of ours, which is packed
            copy_file(file, machine)
    write_cuda_tools(machine / "usr/bin", "/state")
    (machine / "state/hangs").write_text("nothing hangs")
    copy_tree(machine / "limpid")


class Call:
    """A call on a machine of its own, a copy of `machine` that shares its files."""

    def __init__(self, machine, name, rehearsal=True):
        self.machine = machine.parent / name
        shutil.copytree(machine, self.machine, symlinks=True, copy_function=os.link)
        self.out = self.machine / "out"
        self.rehearsal = rehearsal

    def begin(self):
        setting = "LIMPID_ONE_SHOT_REHEARSAL=1" if self.rehearsal else ""
        self.start = time.monotonic()
        self.process = subprocess.Popen(
            ["unshare", "--user", "--map-root-user", "--mount", "--pid", "--fork", "--kill-child",
             "bash", "-c", PLACES.format(setting=setting, seconds=SECONDS), self.machine],
            start_new_session=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)

    def finish(self, second=None):
        """Waits for its end, or kills it and all that it started. Returns the commands that ran."""
        running = []
        try:
            self.process.wait(None if second is None else second)
        except subprocess.TimeoutExpired:
            running = self.running()
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()
        self.took = time.monotonic() - self.start
        return running

    def running(self):
        """Commands whose time is limited, that is, of steps."""
        found = []
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                words = (process / "cmdline").read_text().split("\0")[:-1]
                if os.readlink(process / "root") == str(self.machine) and words[:1] == ["timeout"]:
                    found.append(" ".join(words[3:]))
            except OSError:  # it has ended
                continue
        return found

    def faults(self, running):
        """Faults of its folder: what is absent, and steps that ran and are not named."""
        wrong = outcome.faults(self.out)
        unfinished = outcome.unfinished(self.out)
        recent = [name for name, _, end in outcome.steps(self.out)
                  if end is not None and end >= int(self.took) - 2]
        logs = "".join(outcome.text(self.out, file.name) for file in self.out.glob("*.log"))
        for command in running:
            names = [name for name in (*unfinished, *recent)
                     if f"===== {name}: {command}\n" in logs or command.endswith(f"/{name}")]
            if not names:
                wrong.append(f"{command} ran and is not named among {unfinished}.")
        return wrong


def report(name, call, wrong):
    steps = outcome.steps(call.out)
    scenes = {id(scene) for scene in outcome.scenes(call.out).values()}
    ended = len([name for name, _, end in steps if end is not None])
    print(f"{name}: {call.took:.0f} s, {ended} steps ended, {len(scenes)} scenes measured, "
          f"not finished: {', '.join(outcome.unfinished(call.out)) or 'none'}; "
          f"{'; '.join(wrong) or 'all results are there'}", flush=True)
    return not wrong


def in_time(name, call):
    """Lets a call come to its end. Returns whether it did in its time, and left all."""
    call.begin()
    call.finish()
    wrong = call.faults([])
    if call.took > SECONDS:
        wrong.append(f"It took more than {SECONDS} s.")
    print(outcome.text(call.out, "summary.md"))
    return report(name, call, wrong)


def to_the_end(machine):
    call = Call(machine, "whole")
    return in_time("whole", call), call.took


def killed(machine, number, second):
    call = Call(machine, f"killed-{number}")
    call.begin()
    running = call.finish(second)
    return report(f"killed {number}", call, call.faults(running))


def endless(machine, programs):
    """Every step needs its whole limit."""
    call = Call(machine, "endless", rehearsal=False)
    carried = call.machine / "limpid/build-gpu-carry/carry.tar.xz"
    carried.unlink()  # a link to that of the other calls
    packed = call.machine / "packed"
    for folder in ("bin", "scenes"):
        (packed / folder).mkdir(parents=True)
    for program in programs:
        (packed / "bin" / program.name).write_text(ENDLESS)
        (packed / "bin" / program.name).chmod(0o755)
    for number in range(7):
        (packed / f"scenes/{number}.scene.json").write_text("{}")
    with tarfile.open(carried, "w:xz") as archive:
        for folder in ("bin", "scenes"):
            archive.add(packed / folder, folder)
    return in_time("endless", call)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", help="folder of the scenes")
    parser.add_argument("--kills", type=int, default=8)
    parser.add_argument("--beside", type=int, default=2, help="calls at a time")
    parser.add_argument("--seed", type=int, default=1, help="of the seconds of the kills")
    parser.add_argument("--limits", action="store_true", help="also with programs that do not end")
    options = parser.parse_args()
    start = time.monotonic()
    built = build()
    with tempfile.TemporaryDirectory() as folder:
        machine = pathlib.Path(folder).resolve() / "machine"
        make_machine(machine, built / "test_gpu")
        carry = machine / "limpid/build-gpu-carry"
        run("bash", HERE / "pack.sh", options.data,
            env={**os.environ, "LIMPID_GPU_PROGRAMS": str(built), "LIMPID_GPU_CARRY": str(carry)})
        print(f"built and packed after {time.monotonic() - start:.0f} s", flush=True)
        with concurrent.futures.ThreadPoolExecutor(options.beside) as calls:
            others = concurrent.futures.ThreadPoolExecutor(1)
            limits = [others.submit(endless, machine, list(built.iterdir()))] * options.limits
            good, took = to_the_end(machine)
            chance = random.Random(options.seed)
            kills = [calls.submit(killed, machine, number, chance.uniform(0, took))
                     for number in range(1, options.kills + 1)]
            right = [good, *(kill.result() for kill in (*kills, *limits))]
    print(f"{right.count(True)} of {len(right)} calls left all, "
          f"{time.monotonic() - start:.0f} s in all")
    return 0 if all(right) else 1


if __name__ == "__main__":
    sys.exit(main())
