#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Measures builds by several compilers in turns, on one thread and in CPU time, which other
programs on the machine disturb least.

  python3 Testing/Benchmarks/compilers.py "NAME=BUILD FOLDER" ... [--scene SCENE.scene.json]
    [--rounds 7] [--output Documentation/Benchmarks/Compilers.json]

The first build is what others are compared with. All have limpid_bench. The page is made from the
numbers by

  python3 Testing/Benchmarks/pages/make.py Documentation/Benchmarks --pages compilers
"""

import argparse
import json
import os
import statistics
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "pages"))
import machine  # pylint: disable=wrong-import-position

UNITS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
PICTURES = {"unlit": "rays, no light", "lit": "rays, light", "shadowed": "rays, light and shadows"}


def bench(folder, *options):
    """What a program writes."""
    program = os.path.join(folder, "bin", "limpid_bench")
    done = subprocess.run([program, *options], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def sweeps(folder, scene):
    """CPU seconds of passes and iterations by what they are."""
    found = bench(folder, "kernels", "--quick", "--threads", "1", "--largest", "64", scene)
    wanted = {}
    for entry in found["benchmarks"]:
        kind, *name = entry["run_name"].split("/threads:")[0].split("/")
        once = kind == "kernel" or name[-1] not in ("dense", "onion")  # these are kernels, too
        if kind != "stream" and once and "32³" not in name[-1]:
            label = " of ".join(["iteration"] * (kind == "iteration") + name)
            wanted[label] = entry["cpu_time"] * UNITS[entry["time_unit"]]
    return found["machine"]["compiler"], wanted


def pictures(folder, scene):
    """CPU seconds of the rays of a picture."""
    found = bench(folder, "rendering", "--parts", "rays", "--repeats", "1", "--threads", "1",
                  scene)["scenes"][0]
    return {f"{text} of {found['scene']}": found["rays"]["base"][key + "_cpu"]
            for key, text in PICTURES.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("builds", nargs="+", metavar="NAME=FOLDER")
    parser.add_argument("--scene", required=True)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--output")
    options = parser.parse_args()
    measured = {"machine": machine.facts(), "rounds": options.rounds}
    builds = [dict(zip(("name", "folder"), build.split("=", 1))) for build in options.builds]
    times = [{} for _ in builds]
    for turn in range(options.rounds):
        print(f"round {turn + 1}", file=sys.stderr)
        for build, seconds in zip(builds, times):
            build["compiler"], found = sweeps(build["folder"], options.scene)
            found.update(pictures(build["folder"], options.scene))
            for label, value in found.items():
                seconds.setdefault(label, []).append(value)
    measured["builds"] = [
        {"name": build["name"], "compiler": build["compiler"],
         "seconds": {label: statistics.median(all_of) for label, all_of in seconds.items()},
         "spread": {label: (max(all_of) - min(all_of)) / statistics.median(all_of)
                    for label, all_of in seconds.items()}}
        for build, seconds in zip(builds, times)]
    machine.save(measured, options.output)


if __name__ == "__main__":
    main()
