# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""A machine for rehearsals of the one call (one-shot.sh): its tools, and stubs for those of CUDA.

Stubs append their name and arguments to STATE/calls. One whose name and arguments contain the text
in STATE/hangs makes the file STATE/hanging and does not end until there is a file STATE/stop.
"""

import pathlib
import shutil
import sys

TOOLS = (
    "awk", "basename", "bash", "cat", "chmod", "cp", "cut", "dd", "dirname", "env", "find", "free",
    "grep", "head", "ldd", "mkdir", "mktemp", "mv", "nproc", "rm", "sed", "setsid", "sleep", "sort",
    "stat", "tail", "tar", "tee", "timeout", "tr", "uname", "uniq", "wc", "xz")
CORE = ("backends", "closed_form", "invariance", "modes", "stress", "input", "progressive",
        "renderer")

STUB = """#!{bash}
echo "[       OK ] {name} began"
echo "{name} $*" >> "{state}/calls"
if [[ "{name} $*|" == *"$(cat "{state}/hangs")"* ]]; then
  : > "{state}/hanging"
  while [[ -d {state} && ! -e {state}/stop ]]; do sleep 0.1; done
  exit 1
fi
"""
# Makes a program that prints its name.
COMPILER = """
while (($# > 0)) && [[ $1 != -o ]]; do shift; done
(($# > 0)) || exit 0
printf '#!{bash}\\necho latencies\\n' > "$2" && chmod +x "$2"
"""
# Runs the first of its arguments that is a program.
WRAPPER = """
while (($# > 0)) && [[ ! -x $1 ]]; do shift; done
exec "$@"
"""


def write_stub(path, text, **places):
    """Writes a program of one of these texts. Places: `state`, and others that the text has."""
    path.write_text(text.format(
        name=path.name, bash=shutil.which("bash"), python=sys.executable, **places))
    path.chmod(0o755)


def write_cuda_tools(folder, state):
    """nvcc, ncu, compute-sanitizer and nvidia-smi that do nothing but call others."""
    folder = pathlib.Path(folder)
    write_stub(folder / "nvcc", STUB + COMPILER, state=state)
    for name in ("ncu", "compute-sanitizer"):
        write_stub(folder / name, STUB + WRAPPER, state=state)
    write_stub(folder / "nvidia-smi", STUB, state=state)
