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
    """The old view and the new view of the old extinction, and the frames from the move on."""
    with studio.Stage(scene, run.pixels(PIXELS) // studio.FINER) as stage:
        recorder = Recorder(stage)
        own, other = studio.viewpoint_of(scene), studio.viewpoint_of(scene, azimuth=TURN)
        for viewpoint, pause in ((own, 0), (other, 1), (own, 0)):
            stage.display.PauseOptimization = pause
            stage.look(viewpoint)
            recorder.draw("still")
        before = recorder.frames[:2]
        before[1].update(started=0, done=0)
        recorder.frames = []
        stage.look(other)
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
    """`before`: the old view, and the new view of the old extinction."""
    strip = [("before", before[0]), ("0 s, old extinction", before[1])] + [
        ("{:.2f} s{}".format(frame["done"], ", still" if frame is frames[-1] else ""), frame)
        for frame in chosen(frames)]
    figure = pyplot.figure(figsize=(ACROSS, DOWN), dpi=DOTS, facecolor="white")
    axis = figure.add_axes([0.06, 0.12, 0.92, 0.35])
    for frame in [before[1], *frames]:
        color = "tab:blue" if frame["kind"] == "moving" else "tab:orange"
        axis.plot([frame["started"], frame["done"]], [frame["apart"]] * 2, color=color)
        axis.plot(frame["done"], frame["apart"], ".", color=color)
    axis.set_ylim(0)
    axis.set_xlabel("seconds after the camera moved; a line is the time that a frame takes, its dot "
                    "the moment it is seen (blue: moving, orange: still)", fontsize=8)
    axis.set_ylabel("from the last picture [1/255]", fontsize=8)
    axis.tick_params(labelsize=7)
    width = 0.96 / len(strip)
    for place, (name, frame) in enumerate(strip):
        left = 0.02 + place * width
        picture = figure.add_axes([left, 0.53, 0.98 * width, 0.38])
        picture.set_axis_off()
        picture.imshow(frame["picture"])
        picture.set_title(name, fontsize=7, pad=3)
        if place > 0:
            axis.annotate("", (frame["done"], frame["apart"]), xycoords="data",
                          xytext=(left + width / 2, 0.53), textcoords="figure fraction",
                          arrowprops={"arrowstyle": "-", "color": "lightgray", "linewidth": 0.7})
    figure.text(0.02, 0.985, title, fontsize=8, va="top")
    return figure


def make(run):
    scene = next(run.scenes([name for name in SCENES if name in run.files or name == "phantom"]))
    before, frames = record(run, scene)
    last = frames[-1]["picture"].astype(float)
    for frame in [*before, *frames]:
        frame["apart"] = np.abs(frame["picture"] - last).mean()
    figure = plot(scene.title, before, frames)
    simple.Delete(scene.source)
    moving = [frame["done"] - frame["started"] for frame in frames[:-1]]
    return {"scene": scene.title, "first": frames[0]["done"], "frame": float(np.median(moving)),
            "still": frames[-1]["done"] - frames[-1]["started"],
            "apart": [frame["apart"] for frame in (before[1], frames[0], frames[-2])],
            "visible": [frame["visible"] for frame in (before[1], frames[-1])],
            "pictures": [run.save(figure, "figure-5.png")]}


def caption(numbers):
    return ("{}{}, turned by {}°. The mean difference from the last picture, of 255, is {:.1f} with the "
            "extinction of the old view. The first frame arrives after {:.2f} s and differs by {:.1f}. "
            "The last frame in motion differs by {:.1f}, at {:.2f} s per frame. The still picture takes "
            "{:.2f} s. In the new view, the old extinction shows {:.1f} % of the important structures, "
            "and the last picture {:.1f} %.").format(
                studio.load_warning(numbers), numbers["scene"], TURN, numbers["apart"][0],
                numbers["first"], *numbers["apart"][1:], numbers["frame"], numbers["still"],
                *(100 * share for share in numbers["visible"]))


if __name__ == "__main__":
    studio.main(__file__, __doc__)
