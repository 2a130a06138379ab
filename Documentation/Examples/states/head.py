# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# File > Load State: a head with vessels and a tumour inside, and on the right as it is without
# Limpid. Turn them: their cameras are linked.

from paraview.simple import *

head = OcclusionPhantom(registrationName="Head", Scene="Head", Resolution=128)

colors = GetColorTransferFunction("Scalars")
colors.ColorSpace = "RGB"
colors.RGBPoints = [0.0, 0.2, 0.15, 0.2, 0.15, 0.75, 0.5, 0.55, 0.4, 0.87, 0.66, 0.53,
                    0.65, 0.95, 0.92, 0.8, 0.75, 0.8, 0.2, 0.15, 0.85, 0.75, 0.05, 0.1,
                    0.93, 0.3, 0.7, 0.3, 1.0, 0.1, 0.8, 0.35]
GetOpacityTransferFunction("Scalars").Points = [
    0.0, 0.0, 0.5, 0.0, 0.05, 0.0, 0.5, 0.0, 0.15, 0.25, 0.5, 0.0, 1.0, 0.6, 0.5, 0.0]

layout = CreateLayout("Head")
views = [CreateView("RenderView"), CreateView("RenderView")]
layout.SplitHorizontal(0, 0.5)
for place, (view, method) in enumerate(zip(views, ("Optimized", "Ordinary"))):
    AssignViewToLayout(view, layout, 1 + place)
    view.CameraPosition = [1.5, -3.6, 1.2]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    display = Show(head, view, "UniformGridRepresentation")
    ColorBy(display, ("POINTS", "Scalars"))
    display.SetRepresentationType("Optimized Volume")
    display.ImportanceArray = ["POINTS", "Importance"]
    display.ScalarOpacityUnitDistance = 0.1
    display.Method = method
AddCameraLink(views[0], views[1], "Head")
SetActiveView(views[0])
SetActiveSource(head)
RenderAllViews()
