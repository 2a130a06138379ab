# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Programs that answer the commands of README.md, one process each."""

import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


class Program:
    """A process that has made its scene and waits for commands."""

    def __init__(self, name, command, device="cpu"):
        self.name = name
        self.device = device
        self.command = command
        self.process = None

    def __enter__(self):
        try:
            self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE,
                                            stdout=subprocess.PIPE, text=True)
        except OSError as error:
            raise SystemExit(f"{self.command[0]} cannot be started ({error.strerror}). Build the "
                             "target limpid_energy and name it with --limpid.") from error
        self.answer("its start")
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()

    def ask(self, command):
        try:
            print(command, file=self.process.stdin, flush=True)
        except BrokenPipeError:
            pass  # the missing answer tells
        return self.answer(command)

    def answer(self, command):
        line = self.process.stdout.readline()
        if not line:
            raise SystemExit(f"{self.name} ended instead of answering \"{command}\" (what it said "
                             "stands above). Nothing more can be measured.")

        def refuse(number):
            raise SystemExit(f"{self.name} answered {number} to \"{command}\" (no page could be "
                             "made of it). Find out where it comes from.")

        return json.loads(line, parse_constant=refuse)

    def memory(self):
        """Bytes that a plan keeps, and that an evaluation with it has at its peak; the process with
        the scene's three arrays apart. Call it before any other command."""
        before = self.resident("VmRSS")
        self.ask("plan")
        if self.device != "cpu":
            return self.ask("memory")
        kept = self.resident("VmRSS") - before
        with open(f"/proc/{self.process.pid}/clear_refs", "w", encoding="ascii") as file:
            file.write("5")  # forgets the peak so far
        self.ask("gradient")
        return {"kept": kept, "peak": self.resident("VmHWM") - before}

    def resident(self, key):
        """A line of /proc/PID/status, such as "VmHWM:   1234 kB" [byte]."""
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as file:
            for line in file:
                if line.startswith(key + ":"):
                    return 1024 * int(line.split()[1])
        raise SystemExit(f"/proc has no {key} of a process (memory is read there). This takes "
                         "Linux.")


def limpid(path, nodes, threads, skips=True, derivative="volume", camera_only=False):
    flags = [flag for flag, on in (("--skips-off", not skips),
                                   ("--derivative-ray", derivative == "ray"),
                                   ("--camera-only", camera_only)) if on]
    return Program("Limpid" if skips else "Limpid, skips off",
                   [path, "--onion", str(nodes), "--threads", str(threads), *flags])


def march(path, nodes, threads, camera_only=False):
    """Energy and derivatives by the reference."""
    rays = 3  # per voxel and axis
    with limpid(path, nodes, threads, camera_only=camera_only) as program:
        return {"energy": program.ask(f"march {rays}"), "slopes": program.ask(f"difference {rays}")}


def torch(nodes, threads, device="cpu", sampler="planes", parts=1, precision="float32",
          camera_only=False):
    name = f"PyTorch, {sampler}" + (f", {parts} parts" if parts > 1 else "")
    return Program(name, [
        sys.executable, "-B", os.path.join(HERE, "serve_torch.py"), "--onion", str(nodes),
        "--threads", str(threads), "--device", device, "--sampler", sampler, "--parts", str(parts),
        "--precision", precision, *(["--camera-only"] if camera_only else [])], device)


def mitsuba(nodes, threads, integrator, pixels):
    return Program(f"Mitsuba, {integrator}, {pixels}² rays", [
        sys.executable, "-B", os.path.join(HERE, "serve_mitsuba.py"), "--onion", str(nodes),
        "--threads", str(threads), "--integrator", integrator, "--pixels", str(pixels)])
