# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Replays what TestMovie.py traced, in pvpython: the animation must go the same way.

import json
import os
import sys

import numpy as np
from paraview import simple

simple.LoadPlugin(os.path.abspath("../Limpid.so"), remote=False, ns=vars(simple))
with open("../trace.py", encoding="utf-8") as file:
    exec(compile(file.read(), "trace.py", "exec"))

view = simple.GetActiveView()
scene = simple.GetAnimationScene()
with open("../cameras.json", encoding="utf-8") as file:
    wanted = json.load(file)
if scene.NumberOfFrames != len(wanted):
    sys.exit(f"The trace makes {scene.NumberOfFrames} frames, not {len(wanted)}. Read trace.py.")
player = scene.GetClientSideObject()
player.SetOverrideStillRender(True)  # the cameras matter here, not the pictures
for number, camera in enumerate(wanted):
    player.SetSceneTime(number / (len(wanted) - 1))
    view.SMProxy.SynchronizeCameraProperties()
    got = [view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp]
    if not np.allclose(got, camera, atol=1e-6):
        sys.exit(f"Frame {number} of the trace is {got}, not {camera}. Read trace.py.")
print(f"The trace makes the same movie ({len(wanted)} frames).")
