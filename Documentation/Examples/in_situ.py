# script-version: 2.0
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""A pipeline of Catalyst 2: of every step of a simulation, a picture of what is important in its image.

The simulation's channel "input" has a vtkImageData, of which each process gives its piece: they optimise and draw
together. In the environment:
  LIMPID_PLUGIN      the plugin's file
  LIMPID_COLOR       the point array that the volume is coloured by
  LIMPID_IMPORTANCE  the point array that says what is important (LIMPID_COLOR: its largest values)
  LIMPID_PICTURES    the folder of the pictures

A ParaView that draws by EGL or OSMesa needs no display, another one that of X. Testing/Python/simulation.py is a
simulation that uses this script.
"""

import os

from paraview import catalyst, simple
from paraview.modules.vtkRemotingCore import vtkProcessModule

if "LIMPID_PLUGIN" not in os.environ:
    raise RuntimeError("LIMPID_PLUGIN is not set (the pipeline draws with the plugin). Set it to the file Limpid.so.")
simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
COLOR = os.environ["LIMPID_COLOR"]
IMPORTANCE = os.environ.get("LIMPID_IMPORTANCE", "(Color Array)")
PICTURES = os.environ["LIMPID_PICTURES"]

options = catalyst.Options()
options.EnableCatalystLive = 0

producer = simple.TrivialProducer(registrationName="input")
view = simple.CreateRenderView(ViewSize=[400, 400])
view.OrientationAxesVisibility = 0
view.UseFXAA = 0  # it would smooth edges of what one process alone has drawn
display = None  # there is nothing to be shown before the first step


def show():
    shown = simple.Show(producer, view)
    shown.SetRepresentationType("Optimized Volume")
    simple.ColorBy(shown, ("POINTS", COLOR))
    shown.ImportanceArray = ["POINTS", IMPORTANCE]
    simple.ResetCamera(view)
    camera = simple.GetActiveCamera()
    camera.Azimuth(30)
    camera.Elevation(20)
    return shown


def catalyst_execute(info):
    global display
    producer.UpdatePipeline(info.time)
    view.ViewTime = info.time
    display = display or show()
    display.RescaleTransferFunctionToDataRange(False, True)
    simple.SaveScreenshot(os.path.join(PICTURES, f"step_{info.timestep:04d}.png"), view)
    if vtkProcessModule.GetProcessModule().GetPartitionId() == 0:
        print(f"step {info.timestep}: {100 * display.VisibleFraction:.1f} % of the important structures is visible "
              f"(was {100 * display.BaseVisibleFraction:.1f} %)", flush=True)
