# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# How long whoever aborts a filter may have to wait: the longest times between two questions whether
# to go on, and where they were, beside the time of an iteration. With PYTHONPATH as for
# Testing/Python:
#   python3 Testing/Benchmarks/abort_latency.py 200 vtkExtinctionOptimizer Solver=1

import pathlib
import re
import statistics
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Python"))

from limpid import vtkLimpidFilters  # noqa: E402

from images import filter_on, phantom  # noqa: E402


def main():
    points, name, *settings = sys.argv[1:]
    filter_ = filter_on(phantom(int(points)), getattr(vtkLimpidFilters, name))
    for setting in settings:
        key, value = setting.split("=")
        getattr(filter_, "Set" + key)(int(value))
    questions = []
    filter_.AddObserver("ProgressEvent", lambda *_: questions.append(
        (time.perf_counter(), filter_.GetProgressText() or "")))
    start = time.perf_counter()
    filter_.Update()
    end = time.perf_counter()
    print(*filter_.messages["ErrorEvent"])
    times = [start] + [asked for asked, _ in questions] + [end]
    gaps = sorted(((after - before, text) for before, after, (_, text)
                   in zip(times, times[1:], questions + [(end, "")])), reverse=True)
    first = {}
    for asked, text in questions:
        number = re.match(r"Iteration (\d+)", text)
        if number and "resolution" not in text:
            first.setdefault(int(number.group(1)), asked)
    iterations = [first[n + 1] - first[n] for n in first if n + 1 in first]
    print(f"{end - start:.2f} s in all, {len(questions)} questions; longest waits [ms]:")
    for gap, text in gaps[:4]:
        print(f"  {1000 * gap:.0f}  {text}")
    if iterations:
        print(f"an iteration takes {1000 * statistics.median(iterations):.0f} ms")


if __name__ == "__main__":
    main()
