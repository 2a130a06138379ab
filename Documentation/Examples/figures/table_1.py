# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Table 1: what an iteration, a picture and the memory cost, beside the paper's table.

  pvpython table_1.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]

On this machine's processor; rows of a GPU come from Documentation/Benchmarks/Gpu.json, if it is there.
"""

import ctypes
import json
import os
import statistics
import time

from paraview import simple

import studio
from markdown import ms, significant, sizes, table

PAPER = (("Rotating Mixer", "256 × 256 × 256", "447 + 63", 47, 9.2),
         ("Earth Mantle", "256 × 256 × 256", "448 + 65", 43, 9.2),
         ("Visible Human", "472 × 472 × 472", "793 + 371", 65, 21.2),
         ("Heptane Flame", "304 × 304 × 304", "530 + 104", 44, 11.2))
GPU = os.path.join(studio.ROOT, "Documentation", "Benchmarks", "Gpu.json")
PIXELS = 1024
REPEATS = 3
TURN = 0.37  # degrees between one timed picture and the next


def memory(key):
    """Of this process, by a name in its status [bytes]."""
    with open("/proc/self/status", encoding="utf-8") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith(key + ":"))


def peak_of(work):
    """Resident memory of some work beyond what was there before; None where it cannot be known."""
    try:
        ctypes.CDLL(None).malloc_trim(0)  # what is free would be taken without being counted
        with open("/proc/self/clear_refs", "w", encoding="utf-8") as file:
            file.write("5")
        before = memory("VmRSS")
        work()
        return memory("VmHWM") - before
    except (AttributeError, OSError):
        work()
        return None


def optimization(scene):
    """Seconds of the first and of later iterations and of a whole run, and memory."""
    optimizer = studio.filter_of(scene)
    peak = peak_of(optimizer.UpdatePipeline)
    found = simple.servermanager.Fetch(optimizer, idx=1)
    seconds = [found.GetValueByName(row, "Seconds").ToDouble()
               for row in range(found.GetNumberOfRows())]
    whole = optimizer.FieldData["Seconds"].GetRange()[0]
    simple.Delete(optimizer)
    return {"first": seconds[1] - seconds[0],
            "later": statistics.median(b - a for a, b in zip(seconds[1:], seconds[2:])),
            "whole": whole, "iterations": len(seconds) - 1, "peak": peak}


def picture(scene, pixels):
    """Seconds of a lit picture with shadows, of a camera that has moved and a light at rest."""
    seconds = []
    with studio.Stage(scene, pixels // studio.FINER) as stage:
        simple.Render(stage.view)
        stage.display.PauseOptimization = 1
        for repeat in range(REPEATS + 1):
            studio.viewpoints.look_from(
                stage.view, studio.viewpoint_of(scene, azimuth=TURN * repeat))
            stage.view.SMProxy.UpdateVTKObjects()
            begin = time.perf_counter()
            stage.view.SMProxy.StillRender()
            stage.view.GetRenderWindow().WaitForCompletion()
            seconds.append(time.perf_counter() - begin)
    return statistics.median(seconds[1:])


def gpu_rows():
    if not os.path.exists(GPU):
        return []
    with open(GPU, encoding="utf-8") as file:
        measured = json.load(file)
    return [{"scene": scene["scene"], "nodes": scene["nodes"], "device": measured["device"],
             **{key: scene[key].get("seconds") for key in ("policy", "run", "picture")},
             "peak": scene["policy"].get("device_memory")} for scene in measured["scenes"]]


def make(run):
    rows = [{"scene": scene.title, "nodes": studio.image_of(scene.source).GetDimensions(),
             **optimization(scene), "picture": picture(scene, run.pixels(PIXELS))}
            for scene in run.scenes()]
    return {"rows": rows, "gpu": gpu_rows()}


def megabytes(count):
    return "not measured" if count is None else significant(1e-6 * count)


def caption(numbers):
    here = table(numbers["rows"], [
        ("scene", lambda r: r["scene"]), ("nodes", lambda r: sizes(r["nodes"])),
        ("first iteration [ms]", lambda r: ms(r["first"])),
        ("later iterations [ms]", lambda r: ms(r["later"])),
        ("whole run [ms]", lambda r: "{} ({} iterations)".format(ms(r["whole"]), r["iterations"])),
        ("picture [ms]", lambda r: ms(r["picture"])),
        ("memory beyond the input [MB]", lambda r: megabytes(r["peak"]))])
    gpu = "CUDA: not measured."
    if numbers["gpu"]:
        def cell(key):
            return lambda r: ms(r[key]) if r[key] else "not measured"

        gpu = "{}:\n".format(numbers["gpu"][0]["device"]) + table(numbers["gpu"], [
            ("scene", lambda r: r["scene"]), ("nodes along x", lambda r: str(r["nodes"])),
            ("iteration [ms]", cell("policy")), ("whole run [ms]", cell("run")),
            ("picture [ms]", cell("picture")), ("device memory [MB]", lambda r: megabytes(r["peak"]))])
    paper = table(PAPER, [
        ("the paper's, RTX 4090", lambda r: r[0]), ("nodes", lambda r: r[1]),
        ("grid updates + optimization [ms]", lambda r: r[2]), ("rendering [ms]", lambda r: r[3]),
        ("memory [GB]", lambda r: r[4])])
    return "{}{}, {} cores:\n{}\n{}\n\n{}".format(
        studio.load_warning(numbers), numbers["processor"], numbers["cores"], here, gpu, paper)


if __name__ == "__main__":
    studio.main(__file__, __doc__)
