# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Replays what TestOptimizedVolume.py traced, in pvpython: the picture must be the same.

import sys

import pictures
from paraview import simple

with open("trace.py", encoding="utf-8") as file:
    exec(compile(file.read(), "trace.py", "exec"))

view = simple.GetActiveView()
traced = pictures.read("traced.png")
replayed = pictures.take(view, [traced.shape[1], traced.shape[0]])
pictures.write("replayed.png", replayed)
mean, p99 = pictures.difference(traced, replayed)
print(f"The trace replayed: mean absolute difference {mean:.3f}, 99th percentile {p99:.1f}.")
if mean > 0.05:
    sys.exit("The replayed picture is another one: compare traced.png and replayed.png.")
