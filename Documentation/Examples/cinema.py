# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""A Cinema database of a phantom as Optimized Volume: pictures of cameras round it, each optimised for
its camera, and how much of the important structures each of them shows.

  pvpython cinema.py Limpid.so FOLDER.cdb [--phi 8] [--theta 5]

FOLDER.cdb/data.csv has a row per picture, as viewers of Cinema (specification D) read it. Without a
display: xvfb-run pvpython ...
"""

import argparse
import csv
import os

from paraview.simple import *

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("plugin", help="Limpid.so")
parser.add_argument("folder", help="of the database")
parser.add_argument("--phi", type=int, default=8, help="cameras round the vertical axis")
parser.add_argument("--theta", type=int, default=5, help="heights of cameras, the poles left out")
parser.add_argument("--size", type=int, default=400, help="width and height of a picture in pixels")
parser.add_argument("--resolution", type=int, default=64, help="points of the phantom along an axis")
arguments = parser.parse_args()
LoadPlugin(os.path.abspath(arguments.plugin), remote=False, ns=globals())

head = OcclusionPhantom(Scene="Head", Resolution=arguments.resolution)
view = CreateView("RenderView")
view.ViewSize = [arguments.size, arguments.size]
view.OrientationAxesVisibility = 0
display = Show(head, view)
ColorBy(display, ("POINTS", "Scalars"))
display.SetRepresentationType("Optimized Volume")
display.ImportanceArray = ["POINTS", "Importance"]


def look(phi, theta):
    """Turns a camera on the x axis by phi about the z axis, and by 90 - theta up [degrees]."""
    camera = view.GetActiveCamera()
    camera.SetPosition(1, 0, 0)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp(0, 0, 1)
    ResetCamera(view)
    camera.Azimuth(phi)
    camera.Elevation(90 - theta)


os.makedirs(arguments.folder, exist_ok=True)
with open(os.path.join(arguments.folder, "data.csv"), "w", encoding="utf-8", newline="") as table:
    rows = csv.writer(table)
    rows.writerow(["phi", "theta", "visible", "visible_before", "FILE"])
    for i in range(arguments.phi):
        for j in range(arguments.theta):
            phi, theta = 360 * i / arguments.phi, 180 * (j + 1) / (arguments.theta + 1)
            picture = f"phi_{phi:05.1f}_theta_{theta:05.1f}.png"
            look(phi, theta)
            SaveScreenshot(os.path.join(arguments.folder, picture), view, ImageResolution=view.ViewSize)
            rows.writerow([phi, theta, f"{display.VisibleFraction:.4f}",
                           f"{display.BaseVisibleFraction:.4f}", picture])
print(f"Wrote {arguments.phi * arguments.theta} pictures and data.csv to {arguments.folder}")
if display.Messages:
    print(display.Messages)
