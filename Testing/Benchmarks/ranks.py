# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How long processes take that optimise an image together, and what memory.

  mpiexec -n RANKS pvbatch --symmetric Testing/Benchmarks/ranks.py [--runs 5] [SCENE...]

  python3 Testing/Benchmarks/ranks.py --all [--output Documentation/Benchmarks/Ranks.json] [SCENE...]

The second calls the first for 1 process with one thread and with all, and for 2, 4 and 8 processes,
each bound to a processor as far as there are enough, and limpid_count_ranks (--counter PROGRAM) for
2 to 32. SCENE: a name in LIMPID_TEST_DATA, visible_male by default. PYTHONPATH as for Testing/Python. Then, for the page:
  python3 Testing/Benchmarks/pages/make.py Documentation/Benchmarks --pages ranks
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import time

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "Python"), str(HERE / "pages")]


def status(key):
    """Memory of this process [MB]."""
    with open("/proc/self/status") as lines:
        return next(int(line.split()[1]) for line in lines if line.startswith(key)) / 1024


def measure(name, runs):
    """By every process: of iterations the medians over runs [s]; of the first run the growth [MB]."""
    import orbits
    import steadiness
    from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
    from vtkmodules.vtkParallelCore import vtkMultiProcessController

    controller = vtkMultiProcessController.GetGlobalController()
    rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
    image, *rest = steadiness.load(name)
    whole, center, image_length = image.GetExtent(), image.GetCenter(), image.GetLength()
    if ranks > 1:
        layers = whole[5] + 1
        image.Crop([*whole[:4], layers * rank // ranks,
                    layers * (rank + 1) // ranks - 1])
    source = vtkTrivialProducer()
    source.SetOutput(image)
    source.SetWholeExtent(*whole)
    iterations, all_seconds, growth = [], [], None
    for _ in range(runs):
        optimizer = orbits.optimizer_for((image, *rest))
        optimizer.SetCameraFocalPoint(center)
        optimizer.SetCameraPosition(center[0] + image_length, center[1], center[2] - image_length)
        optimizer.SetInputConnection(source.GetOutputPort())
        before = status("VmRSS")
        with open("/proc/self/clear_refs", "w") as peak:
            peak.write("5")
        controller.Barrier()
        start = time.perf_counter()
        optimizer.UpdatePiece(rank, ranks, 0)
        all_seconds.append(time.perf_counter() - start)
        growth = growth or status("VmHWM") - before
        seconds = optimizer.GetConvergence().GetColumnByName("Seconds")
        iterations.append(np.diff([seconds.GetValue(i)
                                   for i in range(seconds.GetNumberOfTuples())]))
    return {"ranks": ranks, "iterations": np.median(iterations, axis=0).tolist(),
            "seconds": float(np.median(all_seconds)), "growth": growth,
            "backend": optimizer.GetOutput().GetFieldData().GetAbstractArray("Backend").GetValue(0),
            "score": optimizer.GetOutput().GetFieldData().GetArray("VisibilityScore").GetValue(0)}


def count(name, counter):
    """What ranks say to each other, by limpid_count_ranks."""
    scene = os.path.join(os.environ["LIMPID_TEST_DATA"], name + ".scene.json")
    ranks = [str(ranks) for ranks in (2, 4, 8, 16, 32)]
    return json.loads(subprocess.run([counter, scene, *ranks], check=True, capture_output=True,
                                     text=True).stdout)


def measure_all(scenes, runs, counter):
    import machine
    cores = os.cpu_count()
    measured = {"machine": machine.facts(), "scenes": {}, "counted": {}}
    for name in scenes:
        measured["counted"][name] = count(name, counter)
        rows = measured["scenes"].setdefault(name, [])
        for ranks, bound in ((1, "core"), (1, "none"), (2, "core"), (4, "core"), (8, "core")):
            bound = bound if ranks <= cores else "none"
            command = ["mpiexec", "--oversubscribe", "--bind-to", bound, "-n", str(ranks), "pvbatch",
                       "--symmetric", __file__, "--runs", str(runs), name]
            run = subprocess.run(command, capture_output=True, text=True)
            results = [line[7:] for line in run.stdout.splitlines() if line.startswith("RESULT ")]
            if not results:
                sys.exit(run.stderr)
            rows.append(json.loads(results[0]))
            print(name, rows[-1], file=sys.stderr)
    return measured


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--counter", default="build/bin/limpid_count_ranks")
    parser.add_argument("--output")
    options = parser.parse_args()
    scenes = options.scenes or ["visible_male"]
    if options.all:
        import machine
        machine.save(measure_all(scenes, options.runs, options.counter), options.output)
        return
    for name in scenes:
        result = measure(name, options.runs)
        from vtkmodules.vtkParallelCore import vtkMultiProcessController
        if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == 0:
            print("RESULT " + json.dumps(result), flush=True)


if __name__ == "__main__":
    main()
