# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Tests in ParaView's window that take turns: events press what a person presses, Python looks.

NAME.xml has the events for ParaView's test player. NAME.py has a generator: it runs from one
`yield` to the next whenever the events start the macro "Proceed", and may wait while the window
goes on living. What it finds is in report.txt of the working directory, whose last line is ENDED
if nothing was wrong.
"""

import ctypes
import shutil
import subprocess
import time
import traceback

from paraview.vtk.util.numpy_support import vtk_to_numpy
from paraview.vtk.vtkRenderingCore import vtkWindowToImageFilter

ENDED = "The story ended well."

_report = open("report.txt", "w", encoding="utf-8")
_story = None
_failures = 0


def say(text):
    print(text, file=_report, flush=True)


def expect(condition, text):
    """Notes what should be so, and whether it is."""
    global _failures
    _failures += not condition
    say(("ok: " if condition else "WRONG: ") + text)


def live(seconds):
    """Lets the window handle its events. ParaView offers this to C++ alone."""
    process_events = ctypes.CDLL(None)[
        "_ZN16QCoreApplication13processEventsE6QFlagsIN10QEventLoop17ProcessEventsFlagEE"]
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        process_events(0)
        time.sleep(0.005)


def live_until(condition, seconds):
    """Whether a condition came true within so many seconds."""
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        live(0.05)
    return condition()


def screenshot(path):
    """The whole screen, if the program "import" of ImageMagick is there."""
    if shutil.which("import"):
        subprocess.run(["import", "-window", "root", path], check=False)


def shown(view):
    """What a view shows now, as pictures.take has it: nothing is rendered or changed for it."""
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(view.GetRenderWindow())
    grabber.ShouldRerenderOff()
    grabber.ReadFrontBufferOff()
    grabber.Update()
    width, height, _ = grabber.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(grabber.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[:, :, :3].astype(float)


class Frames:
    """The renders of a view since the last call of `clear`."""

    def __init__(self, view):
        self._window = view.GetRenderWindow()
        self.clear()
        view.SMProxy.AddObserver("EndEvent", self._count)

    def _count(self, *_):
        # How ParaView tells its views which of the two it is.
        if self._window.GetDesiredUpdateRate() >= 1:
            self.interactive += 1
        else:
            self.still += 1

    def clear(self):
        self.interactive = 0
        self.still = 0

    def all(self):
        return self.interactive + self.still

    def settle(self, seconds, quiet=1.0):
        """Lives on until nothing was rendered for `quiet` seconds. Whether that came to pass."""
        end = time.monotonic() + seconds
        count = -1
        while count != self.all() and time.monotonic() < end:
            count = self.all()
            live(quiet)
        return count == self.all()


def begin(generator):
    global _story
    _story = generator


def proceed():
    global _failures
    try:
        next(_story)
    except StopIteration:
        if _failures == 0:
            say(ENDED)
    except Exception:
        _failures += 1
        say(traceback.format_exc())
