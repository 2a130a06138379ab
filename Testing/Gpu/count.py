# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Puts together what count.sh has counted: python3 count.py FOLDER FILE.json"""

import json
import os
import re
import subprocess
import sys
import time

REGISTERS = 65536  # of a multiprocessor of sm_90, given to warps in blocks of 8 per thread
MOST_THREADS = 2048
SWEEPS = {"BackwardTiles": "the policy's sweep",
          "KeptE1E": "the derivative's sweep that counts scores, too",
          "SweptSlabs": "the derivative's sweep",
          "DrawnPixelILNS_11CompositingE0ELb1ELb1ELb1E":
              "a picture's ray, lit, with the overlay and colors of structures",
          "DrawnPixelILNS_11CompositingE0ELb1ELb1E": "a picture's ray, lit, with the overlay"}
WAIT = "LD.E.STRONG.GPU"  # how all threads of a launch wait for each other
KINDS = {"loads": ("LDG",), "stores": ("STG",),
         "generic": ("LD", "ST"),  # of memory that the compiler does not know the kind of
         "spilled": ("LDL", "STL"), "branches": ("BRA",),
         "of double precision": ("DADD", "DMUL", "DFMA", "DSETP")}


def instructions(path):
    """The instructions of each kernel, by name, without padding."""
    found = {}
    name = None
    with open(path, encoding="utf-8") as file:
        for line in file:
            function = re.search(r"Function : (\S+)", line)
            if function:
                name = function.group(1)
                found[name] = []
            code = re.match(r"\s+/\*[0-9a-f]{4,}\*/\s+(?:@!?U?P\w+\s+)?([A-Z][\w.]*)", line)
            if code and name and code.group(1) != "NOP":
                found[name].append(code.group(1))
    return found


def usage(path):
    """Registers, and bytes of memory of a thread's own, by name."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    return {name: (int(registers), int(stack)) for name, registers, stack in
            re.findall(r"Function (\S+):\s+REG:(\d+) STACK:(\d+)", text)}


def counts(parts):
    """What happens how often: the processor's times say nothing about a GPU."""
    return [{key: value for key, value in part.items() if key != "seconds"} for part in parts]


def kernel(name, codes, used):
    sweep = next((text for part, text in SWEEPS.items() if part in name), None)
    registers, stack = used
    row = {"kernel": sweep or name, "instructions": len(codes), "registers": registers,
           "stack": stack}
    for kind, starts in KINDS.items():
        row[kind] = sum(code.split(".")[0] in starts and not code.startswith(WAIT)
                        for code in codes)
    row["threads"] = min(MOST_THREADS, REGISTERS // (32 * (-(-registers // 8) * 8)) * 32)
    return row


def main():
    folder, output = sys.argv[1:]
    with open(os.path.join(folder, "launches.json"), encoding="utf-8") as file:
        scene = json.load(file)["scenes"][0]
    with open(os.path.join(folder, "tiles.json"), encoding="utf-8") as file:
        tiles = json.load(file)["scenes"]
    codes = instructions(os.path.join(folder, "counted.sass"))
    used = usage(os.path.join(folder, "registers.txt"))
    version = subprocess.run(["nvcc", "--version"], check=True, stdout=subprocess.PIPE, text=True)
    measured = {
        "date": time.strftime("%Y-%m-%d"), "scene": scene["scene"], "nodes": scene["nodes"],
        "compiler": re.search(r"release [\d.]+", version.stdout).group(),
        "iteration": counts(scene["policy"]["parts"]), "frame": counts(scene["frame"]["parts"]),
        "iterations": scene["frame"]["iterations"], "plan": scene["plan"]["seconds"],
        "tiles": tiles,
        "kernels": sorted((kernel(name, codes[name], used[name]) for name in codes
                           if not name.startswith("_Z") or any(part in name for part in SWEEPS)),
                          key=lambda row: row["kernel"])}
    with open(output, "w", encoding="utf-8") as file:
        file.write(json.dumps(measured, indent=1) + "\n")


if __name__ == "__main__":
    main()
