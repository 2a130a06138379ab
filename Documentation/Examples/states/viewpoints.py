# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# File > Load State: a flame in the sphere of its viewpoints. The sphere's panel has buttons that go
# to the best view, the next and the worst.

from paraview.simple import *

flame = OcclusionPhantom(registrationName="Flame", Scene="Flame", Resolution=96)
search = ViewpointSearch(registrationName="Viewpoints", Input=flame, ExtinctionSource="Array")
search.ExtinctionArray = ["POINTS", "BaseExtinction"]
search.ImportanceArray = ["POINTS", "Importance"]

view = CreateView("RenderView")
AssignViewToLayout(view, CreateLayout("Viewpoints"))
display = Show(flame, view, "UniformGridRepresentation")
ColorBy(display, ("POINTS", "Scalars"))
display.SetRepresentationType("Optimized Volume")
display.ImportanceArray = ["POINTS", "Importance"]
display.ExtinctionSource = "Array"
display.ExtinctionArray = ["POINTS", "BaseExtinction"]
sphere = Show(search, view, "GeometryRepresentation")
sphere.SetRepresentationType("Wireframe")
ColorBy(sphere, ("POINTS", "NormalizedScore"))
SetActiveView(view)
SetActiveSource(search)
ResetCamera(view)
Render(view)
