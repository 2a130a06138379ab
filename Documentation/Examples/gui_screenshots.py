# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs in ParaView's window, started by gui_screenshots.sh: shows a scene as an optimised volume,
# before and after the optimisation and with more context, and turns it by the mouse.

import os
import subprocess
import traceback

import scenes
import story
from paraview import simple

OUTPUT = os.environ["LIMPID_OUTPUT"]
SCENE = os.environ["LIMPID_SCENE"]
PATIENCE = 120  # seconds
# Where ParaView puts the edges between pipeline browser, properties and view in a window of
# 1600 x 1000 pixels, and where they are dragged to.
RIGHT, BOTTOM = 295, 434
NEW_RIGHT, NEW_BOTTOM = 430, 240
PANEL = (NEW_RIGHT - 3, 965 - NEW_BOTTOM, 0, NEW_BOTTOM + 4)  # width, height, left, top


def xdotool(*arguments):
    """Presses and moves in the window while it lives."""
    process = subprocess.Popen(["xdotool", *map(str, arguments)])
    story.live_until(lambda: process.poll() is not None, 10)
    story.live(0.1)


def drag(start, end, steps=5):
    xdotool("mousemove", *start)
    xdotool("mousedown", 1)
    for i in range(1, steps + 1):
        xdotool("mousemove", *(int(a + (b - a) * i / steps) for a, b in zip(start, end)))
    xdotool("mouseup", 1)
    story.live(0.5)


def save(name, *crop):
    """The whole window, or width x height + left + top of it."""
    path = os.path.join(OUTPUT, name + ".png")
    story.screenshot(path)
    if crop:
        subprocess.run(["convert", path, "-crop", "{}x{}+{}+{}".format(*crop), "+repage", path],
                       check=True)


def save_panel(name, pages):
    """The properties, page by page."""
    xdotool("mousemove", 12, PANEL[3] + PANEL[1] // 2)
    xdotool("click", "--repeat", 80, "--delay", 10, 4)
    for page in range(pages):
        story.live(0.5)
        save(f"{name}-{page + 1}", *PANEL)
        xdotool("click", "--repeat", 7, "--delay", 30, 5)


def open_scene():
    """The scene, with a source as if a person had opened its file."""
    if not SCENE:
        return scenes.phantom_scene(simple)
    scene = scenes.read_scene(simple, SCENE)
    simple.Delete(scene.source)
    file = f"{scene.name}.vti"
    scene.source = simple.OpenDataFile(os.path.join(os.path.dirname(SCENE), file))
    simple.RenameSource(file, scene.source)
    return scene


def flat(rows):
    return [value for row in rows for value in row]


def show(scene, view):
    simple.SetActiveSource(None)  # a panel that is there already would not follow all changes
    scene.source.UpdatePipeline()
    display = simple.Show(scene.source, view)
    simple.ColorBy(display, ("POINTS", scene.array))
    colors = simple.GetColorTransferFunction(scene.array)
    colors.ColorSpace = "RGB"
    colors.RGBPoints = flat(scene.colors)
    display.ScalarOpacityUnitDistance = scene.unit_distance()
    simple.GetOpacityTransferFunction(scene.array).Points = flat(
        [value, opacity, 0.5, 0] for value, opacity in scene.opacity())
    display.ImportanceArray = ["POINTS", scene.importance_array]
    if scene.importance:
        display.UseImportanceFunction = 1
        display.ImportanceFunction.Points = flat([value, importance, 0.5, 0]
                                                 for value, importance in scene.importance)
    view.CameraPosition, view.CameraFocalPoint = scene.position, scene.focal_point
    view.CameraViewUp, view.CameraViewAngle = scene.view_up, scene.view_angle
    simple.SetActiveSource(scene.source)
    return display


def settle(frames, view, name):
    simple.Render(view)
    if not frames.settle(PATIENCE):
        raise RuntimeError(f"the view of {name} still renders after {PATIENCE} s")
    simple.SaveScreenshot(os.path.join(OUTPUT, name + ".png"), view, ImageResolution=view.ViewSize)
    save("window-" + name)


def main():
    story.live(2)
    drag((RIGHT, BOTTOM + 50), (NEW_RIGHT, BOTTOM + 50))
    drag((RIGHT // 2, BOTTOM), (RIGHT // 2, NEW_BOTTOM))

    view = simple.GetActiveViewOrCreate("RenderView")
    scene = open_scene()
    display = show(scene, view)
    frames = story.Frames(view)
    display.Method = "Ordinary"
    display.SetRepresentationType("Optimized Volume")
    settle(frames, view, "before")
    display.Method = "Optimized"
    settle(frames, view, "after")
    story.say(f"of the important structures {100 * display.VisibleFraction:.1f} % shows, "
              f"{100 * display.BaseVisibleFraction:.1f} % before")
    save_panel("panel", 2)
    display.Preset = "Keep Context"
    settle(frames, view, "context")
    display.Preset = "Default"
    settle(frames, view, "after")

    x, y = view.ViewSize[0] // 2 + NEW_RIGHT, view.ViewSize[1] // 2 + 200
    frames.clear()
    xdotool("mousemove", x, y)
    xdotool("mousedown", 1)
    for i in range(40):
        xdotool("mousemove", x + 8 * i, y - i)
    save("window-turning")
    xdotool("mouseup", 1)
    story.say(f"{frames.interactive} frames while turning; {frames.describe()}")
    frames.settle(PATIENCE)
    settle(frames, view, "turned")


try:
    main()
except Exception:
    story.say(traceback.format_exc())
finally:
    os._exit(0)
