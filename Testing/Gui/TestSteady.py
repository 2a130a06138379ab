# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Every frame of ParaView's window while thin vessels are turned and let go, edited and resized: what
# was uncovered stays uncovered. How large its steps are is told, not tested: that depends on the
# machine.

import statistics

import numpy as np

import story
from paraview import simple
from story import expect

VISIBLE = 0.3  # mean change of a frame, of 255, that is one


def apart(one, other):
    return float(np.abs(one - other).mean())


def original_of(view, frames, display):
    """The finished picture of the volume without optimization."""
    display.Method = "Ordinary"
    simple.Render(view)
    frames.expect_end(display, "original")
    picture = story.shown(view)
    display.Method = "Optimized"
    simple.Render(view)
    frames.expect_end(display, "optimized again")
    return picture


def tell():
    story.load_plugins()
    view = simple.GetActiveViewOrCreate("RenderView")
    source = simple.OcclusionPhantom(Scene="Vessels", Resolution=64)
    display = simple.Show(source, view)
    display.SetRepresentationType("Optimized Volume")
    simple.ColorBy(display, ("POINTS", "Scalars"))
    display.ImportanceArray = ["POINTS", "Importance"]
    display.ExtinctionSource = "Array"
    display.ExtinctionArray = ["POINTS", "BaseExtinction"]
    simple.ResetCamera(view)
    frames, recorder = story.Frames(view), story.Recorder(view)
    simple.Render(view)
    frames.expect_end(display, "shown")

    def release():
        story.turn(view, 15)
        recorder.clear()
        recorder.pictures.append(story.shown(view))
        story.let_go(view)

    def edit():
        display.ClearingThreshold = 0.1
        simple.Render(view)

    def enlarge():
        simple.GetLayout().SplitHorizontal(0, 0.7)

    for act in (release, edit, enlarge):
        name = act.__name__
        before = story.shown(view)
        recorder.clear()
        act()
        frames.expect_end(display, name)
        pictures = list(recorder.pictures)
        final = story.shown(view)
        original = original_of(view, frames, display)
        same = [picture for picture in pictures if picture.shape == final.shape]
        known = [picture for picture in (before, final) if picture.shape == final.shape]
        known += same[:1] if name == "release" else []  # the last one in motion
        expect(len(same) > 1, f"{name}: {len(same)} frames")
        expect(min(apart(picture, original) for picture in known) > 1,
               f"{name}: the original is another picture")
        nearer = [number for number, picture in enumerate(same)
                  if apart(picture, original) < min(apart(picture, other) for other in known)]
        expect(not nearer, f"{name}: no frame is nearer to the original {nearer}")
        jumps = [apart(one, other) for one, other in zip(same, same[1:])]
        large = [jump for jump in jumps if jump > VISIBLE] or [0]
        story.say(f"{name}: {len(large)} of {len(jumps)} frames change visibly, the largest by "
                  f"{max(large):.2f}, the median {statistics.median(large):.2f} of 255")
    yield


story.begin(tell())
