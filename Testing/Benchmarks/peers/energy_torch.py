# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Times the energy of Eq. (21) and its gradient: PyTorch's automatic differentiation, and Limpid.

    python3 energy_torch.py [--limpid PROGRAM] [--nodes N ...] [--threads N ...] [--repeats N]
      [--devices cpu cuda] [--output FILE.json]
    python3 energy_torch.py --check [--limpid PROGRAM] [--nodes N ...]

Needs the packages torch and numpy (`pip install torch numpy`, best in a virtual environment), the
program limpid_energy of a release build with tests, and Linux. No test runs it.

The scene is a formula (BoxScene::FillOnion in Testing/Core/BoxScene.h, ray_energy.onion here): N
nodes along each axis of the box [-1, 1]^3, R = sqrt(3) half its diagonal, r the distance from its
centre, s the distance from (0.1, -0.1, 0.15),

    value = exp(-((r - 0.75) / 0.12)^2) / 2 + exp(-(s / 0.35)^2),
    base extinction = 20 / R min(1, value), 0 where value < 0.02,
    importance = 1.6 - 4 s, at least 0 and at most 1,

camera and light at R (0.9, 1.3, -3) and R (-1, 3, -0.7). The energy is evaluated at 0.8 times the
base extinction, so that no term is zero. All programs evaluate in turns and one at a time; the
first round warms up. Testing/Benchmarks/pages makes the page. --check compares scenes, energies and derivatives instead of times.
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


def require_packages():
    missing = [name for name in ("torch", "numpy") if importlib.util.find_spec(name) is None]
    if missing:
        sys.exit(f"{sys.executable} does not find {' and '.join(missing)} (the peer is made with "
                 "them). Make a virtual environment, \"pip install torch numpy\" in it, and run "
                 "this with its python3.")


def competitors(arguments, nodes, device, threads):
    """The programs to compare on a device, Limpid first."""
    chosen = []
    if device == "cpu":
        chosen += [programs.limpid(arguments.limpid, nodes, threads),
                   programs.limpid(arguments.limpid, nodes, threads, skips=False)]
    for sampler in ("planes", "trilinear"):
        chosen += [programs.torch(nodes, threads, device, sampler, parts)
                   for parts in arguments.parts]
    return chosen


def memory_and_slopes(chosen):
    """Of a process each, one after the other, started for this alone."""
    found = []
    for program in chosen:
        with program:
            result = {"program": program.name, "memory": program.memory()}
            result["energy"] = program.ask("gradient")
            result["slopes"] = program.ask("slopes")
            result["build"] = program.ask("build")
            found.append(result)
    return found


def times(chosen, repeats):
    """Seconds of values and of gradients by program, in turns."""
    taken = [{"value": [], "gradient": []} for _ in chosen]
    for program in chosen:
        program.__enter__()
        program.ask("plan")
    try:
        for repeat in range(-1, repeats):
            for program, seconds in zip(chosen, taken):
                for command, laps in seconds.items():
                    time.sleep(0.05)  # idle threads of the last one stop spinning
                    lap = program.ask(command)["seconds"]
                    if repeat >= 0:
                        laps.append(lap)
    finally:
        for program in chosen:
            program.__exit__()
    return taken


def row_of(result, seconds, truth):
    """Numbers of one program on one size and device."""
    slopes = result["slopes"]
    row = {"program": result["program"], "build": result["build"],
           "S": -result["energy"]["view"] / VIEW, "S_light": -result["energy"]["light"] / LIGHT,
           "kept_bytes": result["memory"]["kept"], "peak_bytes": result["memory"]["peak"],
           "slopes": slopes}
    row["S_deviation"] = result["energy"]["view"] / truth["energy"]["view"] - 1
    row["S_light_deviation"] = result["energy"]["light"] / truth["energy"]["light"] - 1
    row["slope_deviations"] = {name: slopes[name] / value - 1
                               for name, value in truth["slopes"].items()}
    for command, laps in seconds.items():
        row[f"{command}_seconds"] = statistics.median(laps)
        row[f"{command}_shortest"] = min(laps)
        row[f"{command}_spread"] = (max(laps) - min(laps)) / statistics.median(laps)
    return row


def measure(arguments, nodes, device, threads, truth):
    """All rows of a size on a device."""
    print(f"{nodes}^3, {device}, threads: {threads}", file=sys.stderr, flush=True)
    chosen = competitors(arguments, nodes, device, threads)
    results = memory_and_slopes(chosen)
    rows = [row_of(result, seconds, truth)
            for result, seconds in zip(results, times(chosen, arguments.repeats))]
    return {"nodes": nodes, "device": device, "threads": threads, "march": truth, "rows": rows}


def measure_all(arguments):
    sizes = arguments.nodes or [64, 96, 128]
    truths = {nodes: programs.march(arguments.limpid, nodes, max(arguments.threads))
              for nodes in sizes}
    measured = []
    for device in arguments.devices:
        if device == "cuda" and not has_gpu():
            continue  # the page says so
        for threads in arguments.threads if device == "cpu" else arguments.threads[-1:]:
            measured += [measure(arguments, nodes, device, threads, truths[nodes])
                         for nodes in sizes]
    return measured


def has_gpu():
    import torch  # pylint: disable=import-outside-toplevel; takes seconds, --help does not

    return torch.cuda.is_available()


def parsed():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--limpid", default=os.path.join("build", "bin", "limpid_energy"),
                        help="the program limpid_energy (default: %(default)s)")
    parser.add_argument("--nodes", type=int, nargs="+", help="along each axis (default: 64 96 128; "
                        "of the check: 32 64)")
    parser.add_argument("--threads", type=int, nargs="+", default=[len(os.sched_getaffinity(0))],
                        help="of every program, one after the other (default: all)")
    parser.add_argument("--repeats", type=int, default=7, help="timed rounds (default: 7)")
    parser.add_argument("--parts", type=int, nargs="+", default=[1, 4],
                        help="PyTorch: groups of rays, one after the other (default: 1 4)")
    parser.add_argument("--devices", nargs="+", default=["cpu", "cuda"], choices=["cpu", "cuda"])
    parser.add_argument("--output", help="file for all numbers; default: standard output")
    parser.add_argument("--check", action="store_true", help="compare results instead of times")
    return parser.parse_args()


def main():
    arguments = parsed()
    require_packages()
    if arguments.check:
        import check  # pylint: disable=import-outside-toplevel; needs numpy

        good = check.run(arguments.limpid, arguments.nodes or [32, 64], max(arguments.threads))
        sys.exit(0 if good else 1)
    facts = machine.facts()
    machine.save({"machine": facts, "measured": measure_all(arguments)}, arguments.output)


if __name__ == "__main__":
    main()
