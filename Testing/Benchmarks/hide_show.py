# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# A dense volume of 16 bits that is hidden and shown again: what stays in memory, and what the next
# picture takes, of the same view and of one after a turn. With PYTHONPATH as for Testing/Python:
#   bash Testing/with-display.sh python3 Testing/Benchmarks/hide_show.py 256 [TIMES]
# Prints a line of JSON.

import json
import statistics
import sys
import time

import large_display
import volume_views


def main():
    points, times = int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 100
    image = large_display.dense(points)
    before = large_display.bytes_in("VmRSS")
    mapper, look = large_display.mapper_and_look()
    view = volume_views.View((1024, 1024))
    volume = view.add(image, look, mapper)
    view.look()
    view.interact(False)

    def show():
        start = time.perf_counter(), time.process_time()
        volume.VisibilityOn()
        view.window.Render()
        while not mapper.GetConverged():
            view.window.Render()
        return time.perf_counter() - start[0], time.process_time() - start[1]

    def hide():
        volume.VisibilityOff()
        view.window.Render()
        return (large_display.bytes_in("VmRSS") - before) / points ** 3

    first = show()
    shown = (large_display.bytes_in("VmRSS") - before) / points ** 3
    hidden, again = [hide()], []
    for _ in range(times):
        again.append(show())
        hidden.append(hide())
    view.camera.Azimuth(5)
    turned = show()
    print(json.dumps({
        "points": points, "first [s, CPU s]": [round(value, 2) for value in first],
        "again [s, CPU s]": [round(statistics.median(values), 3) for values in zip(*again)],
        "turned meanwhile [s, CPU s]": [round(value, 2) for value in turned],
        "shown [bytes a point]": round(shown, 2),
        "hidden once, ten times, at the end [bytes a point]":
            [round(hidden[min(index, times)], 2) for index in (0, 10, times)]}))


if __name__ == "__main__":
    main()
