# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Replays what TestPresets.py traced, in pvpython, for the display of a phantom: it gets the same
# weights. The trace has one line for each change in the panel, however far the slider was dragged,
# and names no preset.

import json
import os
import re
import sys

from paraview import simple

THRESHOLDS = [0.0003, 0.0316, 100.0]  # of the preset, and of the slider before it was dragged

simple.LoadPlugin(os.path.abspath("../Limpid.so"), remote=False, ns=globals())
view = simple.CreateView("RenderView")
simple.AssignViewToLayout(view)
display = simple.Show(OcclusionPhantom(Resolution=16), view)
display.SetRepresentationType("Optimized Volume")
with open("../trace.py", encoding="utf-8") as file:
    trace = file.read()
exec(compile(trace, "trace.py", "exec"))

with open("../traced.json", encoding="utf-8") as file:
    expected = json.load(file)
found = {name: getattr(display, name) for name in expected}
print(f"The trace replayed: {found}.")
if found != expected:
    sys.exit(f"The story ended with {expected}. Read trace.py.")
lines = [f"{name} = {value}" for name, value in
         re.findall(r"\b(\w*Weight|ClearingThreshold|ProtectImportance|Preset) ?= ?([^\s,)]+)",
                    trace)]
wanted = ["ProtectImportance = 0.1"] + [f"ClearingThreshold = {threshold}" for threshold in
                                        THRESHOLDS + [expected["ClearingThreshold"]]]
if sorted(lines) != sorted(wanted):
    sys.exit(f"The trace says {lines} (one line for each change). It should say {wanted}.")
