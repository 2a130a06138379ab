# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Times the energy of Eq. (21) and its gradient: PyTorch, Mitsuba 3, and Limpid.

    python3 energy.py [--limpid PROGRAM] [--nodes N ...] [--threads N ...] [--repeats N]
      [--devices cpu cuda] [--without PACKAGE ...] [--output FILE.json]
    python3 energy.py --check [--limpid PROGRAM] [--nodes N ...]

Needs numpy, the program limpid_energy of a release build with tests, and Linux, and measures torch
and mitsuba if they are there. run.sh calls it and says what is not. No test runs it.

The scene is a formula (BoxScene::FillOnion in Testing/Core/BoxScene.h, onion.py here): N
nodes along each axis of the box [-1, 1]^3, R = sqrt(3) half its diagonal, r the distance from its
centre, s the distance from (0.1, -0.1, 0.15),

    value = exp(-((r - 0.75) / 0.12)^2) / 2 + exp(-(s / 0.35)^2),
    base extinction = 20 / R min(1, value), 0 where value < 0.02,
    importance = 1.6 - 4 s, at least 0 and at most 1,

camera and light at R (0.9, 1.3, -3) and R (-1, 3, -0.7). The energy is evaluated at 0.8 times the
base extinction, so that no term is zero. All programs evaluate in turns and one at a time; the
first round warms up. Testing/Benchmarks/pages makes the page. --check compares scenes, energies and
derivatives instead of times.
"""

import argparse
import importlib.util
import os
import statistics
import sys
import time

import programs

sys.path.append(os.path.join(programs.HERE, "..", "pages"))
import machine  # noqa: E402 pylint: disable=wrong-import-position

VIEW, LIGHT = 10.0, 1.0  # weights in the energy
INTEGRATORS = ("prbvolpath", "emission")


def is_there(package, arguments):
    return package not in arguments.without and importlib.util.find_spec(package) is not None


def root_mean_square(values):
    return statistics.fmean(value**2 for value in values) ** 0.5


def energies(arguments, nodes, device, threads):
    """The programs to compare on a device, Limpid first."""
    chosen = []
    if device == "cpu":
        chosen += [programs.limpid(arguments.limpid, nodes, threads),
                   programs.limpid(arguments.limpid, nodes, threads, skips=False)]
    if is_there("torch", arguments):
        chosen += [programs.torch(nodes, threads, device, sampler, parts)
                   for sampler in ("planes", "trilinear") for parts in arguments.parts]
    return chosen


def camera_terms(arguments, nodes, threads):
    """The programs to compare on the camera's term alone, Limpid first."""
    chosen = [programs.limpid(arguments.limpid, nodes, threads, skips, camera_only=True)
              for skips in (True, False)]
    if is_there("torch", arguments):
        chosen += [programs.torch(nodes, threads, sampler=sampler, camera_only=True)
                   for sampler in ("planes", "trilinear")]
    if is_there("mitsuba", arguments):
        chosen += [programs.mitsuba(nodes, threads, integrator, pixels)
                   for integrator in INTEGRATORS for pixels in arguments.pixels]
    return chosen


def memory_and_builds(chosen):
    """Of a process each, one after the other, started for this alone."""
    found = []
    for program in chosen:
        with program:
            found.append({"program": program.name, "memory": program.memory(),
                          "build": program.ask("build")})
    return found


def rounds(chosen, repeats):
    """Answers by program and command, in turns."""
    answers = [{"value": [], "gradient": [], "slopes": []} for _ in chosen]
    for program in chosen:
        program.__enter__()
        program.ask("plan")
    try:
        for repeat in range(-1, repeats):
            for program, taken in zip(chosen, answers):
                for command, laps in taken.items():
                    time.sleep(0.05)  # idle threads of the last one stop spinning
                    lap = program.ask(command)
                    if repeat >= 0:
                        laps.append(lap)
        noise = [program.ask("noise")["share"] if "Mitsuba" in program.name else None
                 for program in chosen]
    finally:
        for program in chosen:
            program.__exit__()
    return answers, noise


def slope_error(slopes, truth):
    """Length of the error of the derivatives along all directions, over theirs."""
    error = sum((slopes[name] - value) ** 2 for name, value in truth.items())
    return (error / sum(value**2 for value in truth.values())) ** 0.5


def row_of(result, answers, truth):
    """Numbers of one program on one size and device; of random numbers, errors are root mean
    squares over the rounds."""
    energy, slopes = answers["gradient"][-1], answers["slopes"][-1]
    memory = result["memory"]
    row = {"program": result["program"], "build": result["build"], "kept_bytes": memory["kept"],
           "peak_bytes": memory["peak"], "S": -energy["view"] / VIEW,
           "S_light": -energy["light"] / LIGHT, "slopes": slopes}
    row["S_deviation"] = energy["view"] / truth["energy"]["view"] - 1
    if truth["energy"]["light"]:
        row["S_light_deviation"] = energy["light"] / truth["energy"]["light"] - 1
    row["slope_deviations"] = {name: slopes[name] / value - 1
                               for name, value in truth["slopes"].items()}
    row["S_error"] = root_mean_square(
        answer["view"] / truth["energy"]["view"] - 1 for answer in answers["gradient"])
    row["slope_error"] = root_mean_square(
        slope_error(found, truth["slopes"]) for found in answers["slopes"])
    for command in ("value", "gradient"):
        laps = [answer["seconds"] for answer in answers[command]]
        cores = [answer["cpu"] for answer in answers[command]]
        row[f"{command}_seconds"] = statistics.median(laps)
        row[f"{command}_cpu"] = statistics.median(cores)
        row[f"{command}_spread"] = (max(cores) - min(cores)) / statistics.median(cores)
    return row


def measure(arguments, chosen, truth):
    """A row of each program."""
    print(f"{len(chosen)} programs: {chosen[0].command}", file=sys.stderr, flush=True)
    results = memory_and_builds(chosen)
    rows = []
    for result, answers, noise in zip(results, *rounds(chosen, arguments.repeats)):
        row = row_of(result, answers, truth)
        if noise is not None:
            row["noise"] = noise
        rows.append(row)
    return {"march": truth, "rows": rows}


def measure_all(arguments):
    sizes = arguments.nodes or [64, 96, 128]
    most = max(arguments.threads)
    truths = {nodes: programs.march(arguments.limpid, nodes, most) for nodes in sizes}
    measured = []
    for device in arguments.devices:
        if device == "cuda" and not has_gpu(arguments):
            continue  # the page says so
        for threads in arguments.threads if device == "cpu" else arguments.threads[-1:]:
            measured += [
                {"nodes": nodes, "device": device, "threads": threads,
                 **measure(arguments, energies(arguments, nodes, device, threads), truths[nodes])}
                for nodes in sizes]
    camera = []
    for nodes in sorted({sizes[0], sizes[-1]}):
        truth = programs.march(arguments.limpid, nodes, most, camera_only=True)
        chosen = camera_terms(arguments, nodes, arguments.threads[0])
        camera.append({"nodes": nodes, "threads": arguments.threads[0],
                       "repeats": arguments.repeats,
                       **measure(arguments, chosen, truth)})
    return {"measured": measured, "camera": camera}


def has_gpu(arguments):
    if not is_there("torch", arguments):
        return False
    import torch  # pylint: disable=import-outside-toplevel; takes seconds, --help does not

    return torch.cuda.is_available()


def parsed():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--limpid", default=os.path.join("build", "bin", "limpid_energy"),
                        help="the program limpid_energy (default: %(default)s)")
    parser.add_argument("--nodes", type=int, nargs="+", help="along each axis (default: 64 96 128; "
                        "of the check: 32 64)")
    parser.add_argument("--threads", type=int, nargs="+", default=[1],
                        help="of every program, one after the other (default: 1)")
    parser.add_argument("--repeats", type=int, default=5, help="timed rounds (default: 5)")
    parser.add_argument("--parts", type=int, nargs="+", default=[1, 4],
                        help="PyTorch: groups of rays, one after the other (default: 1 4)")
    parser.add_argument("--pixels", type=int, nargs="+", default=[256, 512],
                        help="Mitsuba: of the picture's side, a ray each (default: 256 512)")
    parser.add_argument("--devices", nargs="+", default=["cpu", "cuda"], choices=["cpu", "cuda"])
    parser.add_argument("--without", nargs="*", default=[], help="packages to leave out")
    parser.add_argument("--output", help="file for all numbers; default: standard output")
    parser.add_argument("--check", action="store_true", help="compare results instead of times")
    return parser.parse_args()


def main():
    arguments = parsed()
    if arguments.check:
        if not is_there("torch", arguments):
            sys.exit(f"{sys.executable} does not find torch (it is what Limpid is checked against)."
                     " Run this with the python3 of an environment that has it, see run.sh.")
        import check  # pylint: disable=import-outside-toplevel; needs numpy

        good = check.run(arguments.limpid, arguments.nodes or [32, 64], max(arguments.threads))
        sys.exit(0 if good else 1)
    facts = machine.facts()
    machine.save({"machine": facts, **measure_all(arguments)}, arguments.output)


if __name__ == "__main__":
    main()
