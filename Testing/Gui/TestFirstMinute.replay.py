# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Replays what TestFirstMinute.py traced, in pvpython: the filter must have what it took there.

import json
import os
import sys

from paraview import simple

simple.LoadPlugin(os.path.abspath("../Limpid.so"), remote=False, ns=vars(simple))
with open("../trace.py", encoding="utf-8") as file:
    exec(compile(file.read(), "trace.py", "exec"))

optimizer = simple.FindSource("ExtinctionOptimizer1")
with open("../taken.json", encoding="utf-8") as file:
    wanted = json.load(file)
different = []
for name, value in wanted.items():
    got = optimizer.GetProperty(name).GetData()
    if name in ("ImportanceFunction", "ScalarOpacityFunction"):
        got = got.Points
    got = list(got) if isinstance(value, list) else got
    if got != value:
        different.append(f"{name} is {got}, not {value}")
if different:
    sys.exit(f"The trace makes another filter: {'; '.join(different)}. Read trace.py.")
print(f"The trace makes the same filter ({len(wanted)} properties).")
