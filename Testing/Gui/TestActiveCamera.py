# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs in ParaView's window before the events of TestActiveCamera.xml, which press the button "Use
# Camera of Active View" and then Apply. What the filter got must then be the view's camera.

from paraview.simple import *

NAMES = ["CameraPosition", "CameraFocalPoint", "CameraViewUp", "CameraViewAngle",
         "CameraParallelProjection", "CameraParallelScale"]


def differences(seen, view):
    """The properties of the filter that are not the view's: names and both values."""
    wanted = {name: view.GetProperty(name).GetData() for name in NAMES}
    wanted["CameraAspectRatio"] = view.ViewSize[0] / view.ViewSize[1]
    got = {name: seen.GetProperty(name).GetData() for name in wanted}
    return [f"{name}: {got[name]!r}, the view's is {wanted[name]!r}"
            for name in wanted if got[name] != wanted[name]]


def main():
    phantom = OcclusionPhantom(Resolution=16)
    phantom.UpdatePipeline()
    view = GetActiveViewOrCreate("RenderView")
    seen = ExtinctionOptimizer(Input=phantom, ExtinctionSource="Array")
    seen.ExtinctionArray = ["POINTS", "BaseExtinction"]
    seen.UpdatePipeline()
    Show(seen, view)
    SetActiveSource(seen)
    Render(view)  # the first time it resets the camera

    # Thirds, tenths and square roots: digits that get lost wherever a value is shortened.
    view.CameraPosition = [4 / 3, -5 / 7, 3.1]
    view.CameraFocalPoint = [0.1, -0.2, 1 / 9]
    view.CameraViewUp = [0.1, 0.7, 0.3 ** 0.5]
    view.CameraViewAngle = 100 / 3
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 2 ** 0.5
    Render(view)
    if len(differences(seen, view)) != len(NAMES) + 1:  # the aspect ratio is no property of a view
        print("some property of the filter is the view's before the button is pressed")
        return

    # Apply sends one property after the other, so all but the last report may be differences.
    def report(*_):
        different = differences(seen, view)
        print("; ".join(different) if different else "The filter has the camera of the view.",
              flush=True)

    seen.SMProxy.AddObserver("UpdateEvent", report)


main()
