# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Replays what TestOptimizedVolume.py traced, in pvpython, in a folder of its own below that of the
# story: the screenshots of the trace must be the same pictures.

import os
import sys

import pictures

NAMES = ["optimized.png", "turned.png", "changed.png"]

with open("../trace.py", encoding="utf-8") as file:
    exec(compile(file.read(), "trace.py", "exec"))

different = []
for name in NAMES:
    if not os.path.exists(name):
        sys.exit(f"The trace did not save {name} (the story did). Read trace.py.")
    mean, p99 = pictures.difference(pictures.read(os.path.join("..", name)), pictures.read(name))
    print(f"{name} replayed: mean absolute difference {mean:.3f}, 99th percentile {p99:.1f}.")
    if mean > 0.05:
        different.append(name)
if different:
    sys.exit(f"Replayed pictures are others: {', '.join(different)}. Compare with the story's.")
