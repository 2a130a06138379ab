# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Tests in ParaView's window that take turns: events press what a person presses, Python looks.

NAME.xml has the events for ParaView's test player, some in words of events.sed, and <proceed/> between
them. NAME.py has a generator: it runs from one `yield` to the next at each <proceed/>, and may wait
while the window goes on living. What it finds is in report.txt of the working directory,
whose last line is ENDED if nothing was wrong.
"""

import ctypes
import itertools
import os
import shutil
import statistics
import subprocess
import time
import traceback

import numpy as np
import pictures
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from paraview.vtk.vtkCommonCore import vtkOutputWindow
from paraview.vtk.vtkRenderingCore import vtkWindowToImageFilter

ENDED = "The story ended well."
PATIENCE = 60.0  # seconds in which everything must have settled, on a slow and busy machine

_report = open("report.txt", "w", encoding="utf-8")
_begin = time.monotonic()
_story = None
_failures = 0
_window = vtkOutputWindow.GetInstance()  # Output Messages
_messages = []  # in it


def _hear(_, __, text):
    if "In unknown, line 0" not in text:  # those of Qt, of which ParaView's own widgets cause some
        _messages.append(text)


_hear.CallDataType = "string0"
for _event in ("ErrorEvent", "WarningEvent"):
    _window.AddObserver(_event, _hear)


def say(text):
    print(f"{time.monotonic() - _begin:5.1f} s  {text}", file=_report, flush=True)


def expect(condition, text):
    """Notes what should be so, and whether it is."""
    global _failures
    _failures += not condition
    say(("ok: " if condition else "WRONG: ") + text)


def take_messages():
    """Errors and warnings since the last call. A story fails if any are left at its end."""
    taken = _messages[:]
    _messages.clear()
    return taken


def load_plugins():
    """Those of the working directory; `simple` gets their sources and filters."""
    for plugin in ("Limpid.so", "LimpidGui.so"):
        simple.LoadPlugin(os.path.abspath(plugin), remote=False, ns=vars(simple))


def _qt(function):
    """A function of Qt, by its name in the libraries: ParaView offers it to C++ alone. Observers in
    Python may be called meanwhile, so that Python must not be let go (CDLL would)."""
    return ctypes.PyDLL(None)[function]


def dialog_is_open():
    """Whether a dialog keeps everything else from being pressed."""
    dialog = _qt("_ZN12QApplication17activeModalWidgetEv")
    dialog.restype = ctypes.c_void_p
    return dialog() is not None


def close_dialog():
    """Closes the dialog that is open, as the button of its frame does."""
    dialog = _qt("_ZN12QApplication17activeModalWidgetEv")
    dialog.restype = ctypes.c_void_p
    close = _qt("_ZN7QWidget5closeEv")
    close.argtypes = [ctypes.c_void_p]
    close(dialog())


def live(seconds):
    """Lets the window handle its events."""
    process_events = _qt(
        "_ZN16QCoreApplication13processEventsE6QFlagsIN10QEventLoop17ProcessEventsFlagEE")
    end = time.monotonic() + seconds
    process_events(0)
    while time.monotonic() < end:
        time.sleep(0.005)
        process_events(0)


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


def take(view, path, resolution=None):
    """A screenshot of a view as pictures.take has it, which stays in the story's folder."""
    simple.SaveScreenshot(path, view, ImageResolution=resolution or view.ViewSize)
    return pictures.read(path)


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


def axes_of(view):
    """The directions to the right, upwards and ahead of a view's camera."""
    ahead = np.subtract(view.CameraFocalPoint, view.CameraPosition)
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, view.CameraViewUp)
    right /= np.linalg.norm(right)
    return right, np.cross(right, ahead), ahead


def corners_of(source):
    bounds = np.reshape(source.GetDataInformation().GetBounds(), (3, 2))
    return list(itertools.product(*bounds))


def place_in_window(view, points):
    """Where points are across and upwards in a view's window, whose sides are at -1 and 1."""
    right, up, ahead = axes_of(view)
    offsets = np.subtract(points, view.CameraPosition)
    half = np.tan(np.radians(view.CameraViewAngle / 2)) * (offsets @ ahead)
    aspect = view.ViewSize[0] / view.ViewSize[1]
    return np.stack([offsets @ right / (half * aspect), offsets @ up / half])


def expect_in_window(view, points, what):
    most = abs(place_in_window(view, points)).max()
    expect(most < 1, f"{what}: all of the box is in the window, {most:.3f}")


def expect_filled(view, corners, what):
    """The box with these corners is inside the window and fills at least 85 % of one side."""
    expect_in_window(view, corners, what)
    share = np.ptp(place_in_window(view, corners), axis=1).max() / 2
    expect(share > 0.85, f"{what}: it fills the window to {share:.3f}")


def turn(view, moves):
    """Presses the left button in the middle of a view and moves the mouse to the right, so many
    times; returns the seconds that it took. `let_go` ends it."""
    interactor = view.GetInteractor()
    width, height = view.ViewSize
    interactor.SetEventInformation(width // 2, height // 2, 0, 0)
    interactor.InvokeEvent("LeftButtonPressEvent")
    start = time.monotonic()
    for i in range(moves):
        interactor.SetEventInformation(width // 2 + 5 * (i + 1), height // 2 + i, 0, 0)
        interactor.InvokeEvent("MouseMoveEvent")
        live(0)
    return time.monotonic() - start


def let_go(view):
    view.GetInteractor().InvokeEvent("LeftButtonReleaseEvent")


def zoom(view, notches):
    """Turns the mouse wheel in the middle of a view."""
    interactor = view.GetInteractor()
    width, height = view.ViewSize
    interactor.SetEventInformation(width // 2, height // 2, 0, 0)
    for _ in range(notches):
        interactor.InvokeEvent("MouseWheelForwardEvent")
        live(0)


class Frames:
    """The renders of a view since the last call of `clear`."""

    def __init__(self, view):
        self._window = view.GetRenderWindow()
        self.clear()
        view.SMProxy.AddObserver("StartEvent", self._begin)
        view.SMProxy.AddObserver("EndEvent", self._end)

    def _begin(self, *_):
        self._started = time.monotonic()

    def _end(self, *_):
        # How ParaView tells its views which of the two it is.
        if self._window.GetDesiredUpdateRate() >= 1:
            self.interactive += 1
            self._seconds.append(time.monotonic() - self._started)
        else:
            self.still += 1

    def clear(self):
        self.interactive = 0
        self.still = 0
        self._seconds = []

    def all(self):
        return self.interactive + self.still

    def describe(self):
        if not self._seconds:
            return "no frames while moving"
        milliseconds = [1000 * second for second in self._seconds]
        return (f"frames while moving: median {statistics.median(milliseconds):.0f} ms, "
                f"first {milliseconds[0]:.0f} ms, longest {max(milliseconds):.0f} ms")

    def settle(self, patience=PATIENCE, quiet=0.8):
        """Lives on until nothing was rendered for `quiet` seconds, which is longer than ParaView
        waits with a still render after an interaction. Whether that came to pass."""
        end = time.monotonic() + patience
        count = -1
        while count != self.all() and time.monotonic() < end:
            count = self.all()
            live(quiet)
        return count == self.all()

    def expect_end(self, display, what):
        """Rendering settles, and the display is optimised to the end."""
        expect(self.settle(), f"{what}: rendering ends")
        display.UpdatePropertyInformation()
        expect(display.Converged == 1, f"{what}: nothing is left to do")


class Recorder:
    """The pictures of all renders of a view since the last call of `clear`."""

    def __init__(self, view):
        self.clear()
        view.SMProxy.AddObserver("EndEvent", lambda *_: self.pictures.append(shown(view)))

    def clear(self):
        self.pictures = []


def begin(generator):
    global _story
    _story = generator


def listen(view):
    """Lets <proceed quietly="1"/> work: a key in this view. In ParaView 5.13 and later a macro,
    which <proceed/> is, counts as a step that could be undone."""
    def key_pressed(interactor, _):
        if interactor.GetKeySym() == "F9":
            proceed()
    view.GetInteractor().AddObserver("KeyPressEvent", key_pressed)


def proceed():
    global _failures
    of_macro = vtkOutputWindow.GetInstance()  # tells its messages when it ends
    vtkOutputWindow.SetInstance(_window)
    try:
        next(_story)
    except StopIteration:
        left = take_messages()
        expect(not left, f"nothing else is in Output Messages {left or ''}")
        if _failures == 0:
            print(ENDED, file=_report, flush=True)
    except Exception:
        _failures += 1
        say(traceback.format_exc())
    vtkOutputWindow.SetInstance(of_macro)
