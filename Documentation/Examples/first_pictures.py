# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs in ParaView's window, started by first_pictures.sh: opens files, chooses the representation
# type, and takes pictures, in Ordinary too.

import os
import traceback

import story
from paraview import simple

OUTPUT = os.environ["LIMPID_OUTPUT"]
FILES = os.environ["LIMPID_FILES"].splitlines()
PATIENCE = 120  # seconds


def finish(display, frames, path):
    simple.Render()
    if not frames.settle(PATIENCE):
        raise RuntimeError(f"{path} still renders after {PATIENCE} s")
    display.UpdatePropertyInformation()


def take(view, path):
    """What the view shows, with the text in its corner."""
    simple.SaveScreenshot(path, view, ImageResolution=view.ViewSize)


def show(file):
    path = os.path.join(OUTPUT, os.path.splitext(os.path.basename(file))[0])
    view = simple.CreateRenderView()
    simple.AssignViewToLayout(view)
    source = simple.OpenDataFile(file)
    display = simple.Show(source, view)
    simple.ResetCamera(view)
    simple.Render(view)
    frames = story.Frames(view)
    display.SetRepresentationType("Optimized Volume")

    finish(display, frames, path)
    story.screenshot(path + ".png")
    take(view, path + "-optimized.png")
    story.say(f"{os.path.basename(file)}: {100 * display.VisibleFraction:.1f} % of what is "
              f"important shows, {100 * display.BaseVisibleFraction:.1f} % in Ordinary; "
              f"messages: {display.Messages or 'none'}")
    display.Method = "Ordinary"
    finish(display, frames, path)
    take(view, path + "-ordinary.png")
    simple.Delete(source)
    simple.Delete(view)


try:
    story.live(2)
    simple.Delete(simple.GetActiveView())
    for each in FILES:
        show(each)
except Exception:
    story.say(traceback.format_exc())
os._exit(0)
