# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The representation Optimized Volume in a few lines: shows a phantom and saves a screenshot.

  pvpython optimized_volume.py Limpid.so optimized_volume.png

Without a display: xvfb-run pvpython ...
"""

import os
import sys

from paraview.simple import *

plugin, picture = sys.argv[1:]
LoadPlugin(os.path.abspath(plugin), remote=False, ns=globals())

# A head: skin, bone and brain around vessels and a tumour, and how important each of them is.
head = OcclusionPhantom(Scene="Head")
head.UpdatePipeline()

view = CreateView("RenderView")
view.ViewSize = [600, 600]
view.CameraPosition = [1.5, -3.6, 1.2]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 0, 1]

# Values of the materials with their colours, red green blue, and their opacities.
colors = GetColorTransferFunction("Scalars")
colors.ColorSpace = "RGB"
colors.RGBPoints = [0.0, 0.2, 0.15, 0.2, 0.15, 0.75, 0.5, 0.55, 0.4, 0.87, 0.66, 0.53,
                    0.65, 0.95, 0.92, 0.8, 0.75, 0.8, 0.2, 0.15, 0.85, 0.75, 0.05, 0.1,
                    0.93, 0.3, 0.7, 0.3, 1.0, 0.1, 0.8, 0.35]
opacities = GetOpacityTransferFunction("Scalars")
opacities.Points = [0.0, 0.0, 0.5, 0.0, 0.05, 0.0, 0.5, 0.0, 0.15, 0.25, 0.5, 0.0,
                    1.0, 0.6, 0.5, 0.0]

display = Show(head, view)
ColorBy(display, ("POINTS", "Scalars"))
display.SetRepresentationType("Optimized Volume")
display.ImportanceArray = ["POINTS", "Importance"]
display.ScalarOpacityUnitDistance = 0.1

SaveScreenshot(picture, view, ImageResolution=view.ViewSize)
print("Visible: {:.1f} % of the important structures, {:.1f} % without the optimisation".format(
    100 * display.VisibleFraction, 100 * display.BaseVisibleFraction))
if display.Messages:
    print(display.Messages)
