# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# A large screenshot in ParaView's window shows its progress, which does not change the picture. An
# aborted one leaves the window as it was, and a warning says that it is incomplete.

import numpy as np

import pictures
import story
from paraview import simple
from story import expect

SIZE = [3840, 2880]  # takes seconds, and 16 tiles of a small window
SMALL = [100, 75]


class Watcher:
    """Looks for the dialog whenever a picture reports its progress, and closes it if it is told to."""

    def __init__(self, view):
        volumes = view.GetRenderer().GetVolumes()
        self.mapper = volumes.GetItemAsObject(0).GetMapper()
        self.watch(False)

    def watch(self, aborts):
        self.aborts = aborts
        self.seen = 0
        self.after = 0  # reports of the picture after it was aborted
        self.closed = False
        self.tag = self.mapper.AddObserver("ProgressEvent", self._look)

    def ignore(self):
        self.mapper.RemoveObserver(self.tag)

    def _look(self, *_):
        self.after += self.closed
        if story.dialog_is_open():
            self.seen += 1
            if self.aborts and not self.closed:
                story.close_dialog()
                self.closed = True


def save(view, name):
    """The screenshot with its transparency, after which the window has come to rest."""
    simple.SaveScreenshot(name, view, ImageResolution=SIZE, TransparentBackground=1)
    story.live(1.0)
    return pictures.read(name, channels=4)


def forget(view, display):
    """Saves another picture, so that the mapper does not keep the last one."""
    threshold = display.ClearingThreshold
    display.ClearingThreshold = 10 * threshold
    simple.SaveScreenshot("other.png", view, ImageResolution=SMALL)
    display.ClearingThreshold = threshold
    simple.Render(view)


def tell():
    story.load_plugins()
    view = simple.GetActiveViewOrCreate("RenderView")
    view.OrientationAxesVisibility = 0  # its labels are not alike in every large picture
    source = simple.OcclusionPhantom(Resolution=96)
    display = simple.Show(source, view)
    simple.ColorBy(display, ("POINTS", "Scalars"))
    display.SetRepresentationType("Optimized Volume")
    simple.ResetCamera(view)
    frames = story.Frames(view)
    simple.Render(view)
    frames.expect_end(display, "shown")
    watcher = Watcher(view)
    watcher.ignore()

    silence = view.SMProxy.AddObserver(
        "StartEvent", lambda *_: watcher.mapper.RemoveObservers("ProgressEvent"))
    reference = save(view, "reference.png")
    view.SMProxy.RemoveObserver(silence)
    forget(view, display)
    frames.expect_end(display, "the first picture is saved")

    watcher.watch(aborts=False)
    picture = save(view, "picture.png")
    watcher.ignore()
    expect(watcher.seen > 0, f"progress is shown ({watcher.seen} reports while it is)")
    expect(not story.dialog_is_open(), "afterwards, it is gone")
    expect(np.array_equal(picture, reference), "the picture is the one without progress")
    expect(not story.take_messages(), "nothing is said of a complete picture")
    forget(view, display)
    frames.expect_end(display, "the second picture is saved")

    before = story.shown(view)
    watcher.watch(aborts=True)
    aborted = save(view, "aborted.png")
    watcher.ignore()
    expect(watcher.closed, "the dialog is closed while the picture is rendered")
    expect(not np.array_equal(aborted, reference), "the aborted picture is incomplete")
    warnings = story.take_messages()
    expect(len(warnings) == 1, f"it is said once that it is {warnings}")
    frames.expect_end(display, "a picture is aborted")
    mean, p99 = pictures.difference(before, story.shown(view))
    expect(mean == 0, f"the window is as it was (mean difference {mean:.4f}, p99 {p99:.4f} of 255)")

    again = save(view, "again.png")
    expect(np.array_equal(again, reference), "the next picture is complete")
    expect(not story.take_messages(), "nothing is said of it")
    yield


story.begin(tell())
