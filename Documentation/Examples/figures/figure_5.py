# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Fig. 5: the delay after a camera move, frames on an axis of real time.

  pvpython figure_5.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]

A still picture; then the camera turns and frames are drawn as while a person holds the mouse, one
after the other; then the mouse is let go, and one still picture follows. The times are those of this
machine, and of what else it does.
"""

import time

import numpy as np
from matplotlib import pyplot
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from paraview.vtk.vtkRenderingCore import vtkWindowToImageFilter

import studio

SCENES = ("visible_male", "phantom")  # the first that is there
TURN = 70  # of the camera [degrees]
MOVING = 1.2  # seconds of moving frames
FRAMES = 40  # of these at most
SHOWN = (0, 0.1, 0.3, 0.6, 1.1)  # of the moving frames, the first after these times [s]
PIXELS = 400
ACROSS, DOWN, DOTS = 11, 4.2, 100  # of the figure [inches, inches, per inch]


class Recorder:
    """Frames of a stage, with the seconds since the camera moved."""

    def __init__(self, stage):
        self.stage = stage
        self.capture = vtkWindowToImageFilter()
        self.capture.SetInput(stage.view.GetRenderWindow())
        self.capture.SetInputBufferTypeToRGB()
        self.capture.ReadFrontBufferOff()
        self.capture.ShouldRerenderOff()
        self.begin = time.perf_counter()
        self.frames = []

    def start(self):
        self.begin = time.perf_counter()

    def draw(self, kind):
        """A frame as while moving, or a still one."""
        proxy = self.stage.view.SMProxy
        proxy.UpdateVTKObjects()
        started = time.perf_counter()
        (proxy.InteractiveRender if kind == "moving" else proxy.StillRender)()
        self.stage.view.GetRenderWindow().WaitForCompletion()
        done = time.perf_counter()
        self.capture.Modified()
        self.capture.Update()
        image = self.capture.GetOutput()
        columns, rows, _ = image.GetDimensions()
        pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, 3)
        self.frames.append({"kind": kind, "started": started - self.begin,
                            "done": done - self.begin, "picture": pixels[::-1].copy(),
                            "visible": self.stage.numbers()["VisibleFraction"]})


def record(run, scene):
    with studio.Stage(scene, run.pixels(PIXELS) // studio.FINER) as stage:
        recorder = Recorder(stage)
        recorder.draw("still")  # the picture before, and what it takes to have anything at all
        recorder.draw("still")
        stage.look(studio.viewpoint_of(scene, azimuth=TURN))
        stage.display.PauseOptimization = 1
        recorder.draw("moving")  # the new view of the old extinction, for its share
        stage.display.PauseOptimization = 0
        stage.look(studio.viewpoint_of(scene))
        recorder.draw("still")
        before = recorder.frames[-2:]
        recorder.frames = []
        stage.look(studio.viewpoint_of(scene, azimuth=TURN))
        recorder.start()
        while len(recorder.frames) < (3 if run.quick else FRAMES) and \
                time.perf_counter() - recorder.begin < MOVING:
            recorder.draw("moving")
        recorder.draw("still")
    return before, recorder.frames


def chosen(frames):
    """The frames that the strip shows: some that moved, and the still one."""
    moving = [frame for frame in frames if frame["kind"] == "moving"]
    found = []
    for begin in SHOWN:
        later = [frame for frame in moving if frame["started"] >= begin
                 and all(frame is not other for other in found)]
        found += later[:1]
    return found + [frames[-1]]


def plot(title, before, frames):
    shown = chosen(frames)
    figure = pyplot.figure(figsize=(ACROSS, DOWN), dpi=DOTS, facecolor="white")
    axis = figure.add_axes([0.07, 0.13, 0.91, 0.3])
    for frame in frames:
        color = "tab:blue" if frame["kind"] == "moving" else "tab:orange"
        axis.plot([frame["started"], frame["done"]], [100 * frame["visible"]] * 2, color=color)
        axis.plot(frame["done"], 100 * frame["visible"], ".", color=color)
    axis.axhline(100 * before[0]["visible"], color="gray", linestyle=":", linewidth=1)
    axis.text(frames[-1]["done"], 100 * before[0]["visible"], "with the extinction of the old view",
              fontsize=7, va="bottom", ha="right", color="gray")
    axis.set_ylim(0)
    axis.set_xlabel("seconds after the camera moved; each line is a frame, its dot the moment it is "
                    "seen (blue: moving, orange: still)", fontsize=8)
    axis.set_ylabel("visible [%]", fontsize=8)
    axis.tick_params(labelsize=7)
    strip = [("before", before[1], None)] + [
        ("{:.2f} s{}".format(frame["done"], "" if frame["kind"] == "moving" else ", still"), frame,
         frame["done"]) for frame in shown]
    width = 0.96 / len(strip)
    for place, (name, frame, moment) in enumerate(strip):
        picture = figure.add_axes([0.02 + place * width, 0.53, 0.98 * width, 0.4])
        picture.set_axis_off()
        picture.imshow(frame["picture"])
        picture.set_title("{}: {:.1f} % visible".format(name, 100 * frame["visible"]), fontsize=7,
                          pad=3)
        if moment is not None:
            axis.annotate("", (moment, 100 * frame["visible"]), xycoords="data",
                          xytext=(0.02 + (place + 0.5) * width, 0.53), textcoords="figure fraction",
                          arrowprops={"arrowstyle": "-", "color": "lightgray", "linewidth": 0.7})
    figure.text(0.02, 0.985, title, fontsize=8, va="top")
    return figure


def make(run):
    scene = next(run.scenes([name for name in SCENES if name in run.files or name == "phantom"]))
    before, frames = record(run, scene)
    moving = [frame["done"] - frame["started"] for frame in frames[:-1]]
    figure = plot(scene.title, before, frames)
    simple.Delete(scene.source)
    return {"scene": scene.title, "old_view": before[1]["visible"],
            "old_extinction": before[0]["visible"], "first": frames[0]["done"],
            "of_first": frames[0]["visible"], "of_moving": frames[-2]["visible"],
            "of_still": frames[-1]["visible"], "frame": float(np.median(moving)),
            "still": frames[-1]["done"] - frames[-1]["started"],
            "pictures": [run.save(figure, "figure-5.png")]}


def caption(numbers):
    return ("{}{}, turned by {}°: the new view of the old extinction shows {:.1f} % of what is "
            "important; the first frame, {:.2f} s after the move, {:.1f} %; the last of the moving ones, "
            "a frame every {:.2f} s, {:.1f} %; the still picture, which takes {:.2f} s, {:.1f} %.").format(
                studio.load_warning(numbers), numbers["scene"], TURN,
                100 * numbers["old_extinction"], numbers["first"], 100 * numbers["of_first"],
                numbers["frame"], 100 * numbers["of_moving"], numbers["still"],
                100 * numbers["of_still"])


if __name__ == "__main__":
    studio.main(__file__, __doc__)
