# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Connects to a pvserver with the plugin on this machine, shows a phantom there as Optimized Volume and
saves the picture.

    pvpython test_server.py PLUGIN PORT PICTURE
"""

import sys

from paraview import simple

plugin, port, picture = sys.argv[1:]
simple.Connect("localhost", int(port))
simple.LoadPlugin(plugin, remote=False, ns=vars(simple))  # the server has loaded its own
view = simple.CreateView("RenderView")
view.ViewSize = [400, 400]
view.RemoteRenderThreshold = 0  # the server draws
head = simple.OcclusionPhantom(Resolution=64, Scene="Head")
display = simple.Show(head, view)
simple.ColorBy(display, ("POINTS", "Scalars"))
display.SetRepresentationType("Optimized Volume")
display.ImportanceArray = ["POINTS", "Importance"]
simple.ResetCamera(view)
simple.SaveScreenshot(picture, view)

after, before = display.VisibleFraction, display.BaseVisibleFraction
print(f"Visible: {100 * after:.1f} % of the important structures, {100 * before:.1f} % before")
if not 1 >= after > before > 0:
    sys.exit("The server does not let more of the important structures be seen.")
