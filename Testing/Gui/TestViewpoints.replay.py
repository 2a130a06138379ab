# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Replays what TestViewpoints.py traced, in pvpython: the view must end with the story's camera.

import json
import os
import sys

from paraview import simple

simple.LoadPlugin(os.path.abspath("../Limpid.so"), remote=False, ns=vars(simple))
with open("../trace.py", encoding="utf-8") as file:
    exec(compile(file.read(), "trace.py", "exec"))

view = simple.GetActiveView()
with open("../camera.json", encoding="utf-8") as file:
    wanted = json.load(file)
different = []
for name, value in wanted.items():
    got = list(view.GetProperty(name))
    if max(abs(a - b) for a, b in zip(got, value)) > 4 * sys.float_info.epsilon:
        different.append(f"{name} is {got}, not {value}")
if different:
    sys.exit(f"The trace leads to another camera: {'; '.join(different)}. Read trace.py.")
print("The trace leads to the same camera.")
