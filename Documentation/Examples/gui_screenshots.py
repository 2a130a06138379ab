# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs in ParaView's window, started by gui_screenshots.sh: shows a scene as an optimised volume,
# before and after the optimisation, and turns it by the mouse.

import json
import math
import os
import subprocess

import story
from paraview import simple

OUTPUT = os.environ["LIMPID_OUTPUT"]
SCENE = os.environ["LIMPID_SCENE"]
WIDTH, HEIGHT = 1600, 1000


def xdotool(*arguments):
    """Presses and moves in the window while it lives."""
    process = subprocess.Popen(["xdotool", *map(str, arguments)])
    story.live_until(lambda: process.poll() is not None, 10)


def picture(view, name):
    simple.SaveScreenshot(os.path.join(OUTPUT, name + ".png"), view, ImageResolution=view.ViewSize)


def window(name):
    story.screenshot(os.path.join(OUTPUT, f"window-{name}.png"))


def open_phantom():
    source = simple.OcclusionPhantom(Resolution=128, Scene="Head")
    source.UpdatePipeline()
    return source, "Scalars", None


def open_scene():
    with open(SCENE, encoding="utf-8") as file:
        scene = json.load(file)
    source = simple.OpenDataFile(os.path.join(os.path.dirname(SCENE), scene["data"]["file"]))
    source.UpdatePipeline()
    return source, scene["data"]["array"], scene


def flat(points):
    return [value for point in points for value in point]


def color(scene, array):
    colors = simple.GetColorTransferFunction(array)
    colors.ColorSpace = "RGB"
    colors.RGBPoints = flat(scene["color_tf"])


def make_opaque(scene, array, display):
    """Extinction is linear between the nodes of a scene, opacity is not: so there are many."""
    unit = display.ScalarOpacityUnitDistance
    nodes = scene["extinction_tf"]
    points = []
    for (value, extinction), (next_value, next_extinction) in zip(nodes, nodes[1:]):
        for i in range(16):
            t = i / 16
            mu = (1 - t) * extinction + t * next_extinction
            points.append([(1 - t) * value + t * next_value, 1 - math.exp(-mu * unit), 0.5, 0])
    value, extinction = nodes[-1]
    points.append([value, 1 - math.exp(-extinction * unit), 0.5, 0])
    simple.GetOpacityTransferFunction(array).Points = flat(points)


def say_what_is_important(scene, array, display):
    display.ImportanceArray = ["POINTS", array]
    display.UseImportanceFunction = 1
    display.ImportanceFunction.Points = flat([value, g, 0.5, 0] for value, g in
                                             scene["importance_tf"])


def look(scene, view):
    if scene is None:
        view.CameraPosition, view.CameraFocalPoint = [1.9, -4.7, 1.5], [0, 0, 0]
        view.CameraViewUp, view.CameraViewAngle = [0, 0, 1], 30
        return
    camera = scene["camera"]
    view.CameraPosition, view.CameraFocalPoint = camera["position"], camera["focal_point"]
    view.CameraViewUp, view.CameraViewAngle = camera["view_up"], camera["view_angle"]


def main():
    window_id = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "ParaView"],
                               capture_output=True, text=True, check=True).stdout.split()[-1]
    xdotool("windowmove", window_id, 0, 0, "windowsize", window_id, WIDTH, HEIGHT)
    story.live(2)

    view = simple.GetActiveViewOrCreate("RenderView")
    source, array, scene = open_scene() if SCENE else open_phantom()
    display = simple.Show(source, view)
    simple.ColorBy(display, ("POINTS", array))
    simple.SetActiveSource(source)
    if scene:
        color(scene, array)
        make_opaque(scene, array, display)
        say_what_is_important(scene, array, display)
    display.Method = "Ordinary"
    display.SetRepresentationType("Optimized Volume")
    look(scene, view)
    simple.Render(view)
    frames = story.Frames(view)
    frames.settle(30)
    picture(view, "before")
    window("before")

    display.Method = "Optimized"
    simple.Render(view)
    frames.settle(60)
    picture(view, "after")
    window("after")
    story.say(f"renders {frames.all()}, of what is important {display.VisibleFraction} shows, "
              f"{display.BaseVisibleFraction} before")

    x, y = WIDTH * 0.6, HEIGHT * 0.55
    xdotool("mousemove", x, y, "mousedown", 1)
    for i in range(20):
        xdotool("mousemove", x + 10 * i, y - 2 * i)
    window("moving")
    xdotool("mouseup", 1)
    frames.settle(60)
    picture(view, "turned")
    window("turned")
    story.say(f"renders {frames.still} still, {frames.interactive} interactive")


try:
    main()
finally:
    os._exit(0)
