# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The steps of Documentation/Tutorial.md, one after the other, in ParaView's window: that page's
# pictures are the screenshots of this story. TestTutorial.xml has what a person presses.

import os

import story
from paraview import simple
from story import expect

FRAMES = 6


def share(display):
    display.UpdatePropertyInformation()
    return 100 * display.VisibleFraction


def tell():
    story.load_plugins()
    yield

    view = simple.GetActiveView()
    display = simple.GetDisplayProperties()
    frames = story.Frames(view)

    def finished(name):
        expect(frames.settle() and not display.Messages,
               f"{name}: {share(display):.1f} % of the important structures shows {display.Messages}")
        story.screenshot(f"tutorial-{name}.png")

    finished("first")
    yield

    finished("best-view")
    yield

    finished("colors")
    before = list(display.ImportanceFunction.Points)
    yield

    points = list(display.ImportanceFunction.Points)
    expect(points[4] == 80 and points[:4] + points[5:] == before[:4] + before[5:],
           f"the point that was clicked moved, and no other one: {points[::4]}")
    finished("importance")
    revealed = share(display)
    yield

    expect(display.ClearingThreshold > 0.01, "the slider moves towards Keep Context")
    finished("context")
    expect(share(display) < revealed, "less of the important structures shows with more context")
    yield

    frames.settle()
    expect(share(display) == revealed, "as much as before")
    yield

    frames.settle()
    story.screenshot("tutorial-original.png")
    expect(share(display) < 0.5 * revealed, "less shows while Show Original is held down")
    yield

    frames.settle()
    search = simple.GetActiveSource()
    expect(search.FieldData["BestVisibilityScore"].GetRange()[0]
           > search.FieldData["WorstVisibilityScore"].GetRange()[0], "the sphere has scores")
    story.screenshot("tutorial-sphere.png")

    # What View > Animation View > Camera, Orbit makes.
    simple.Hide(search, view)
    scene = simple.GetAnimationScene()
    scene.NumberOfFrames = FRAMES
    orbit = simple.GetCameraTrack(view=view)
    orbit.Mode = "Path-based"
    orbit.KeyFrames = [
        simple.CameraKeyFrame(KeyTime=0, PositionPathPoints=orbit_of(view), ClosedPositionPath=1,
                              FocalPathPoints=list(view.CameraFocalPoint),
                              ViewUp=list(view.CameraViewUp)),
        simple.CameraKeyFrame(KeyTime=1)]
    simple.SaveAnimation("movie.png", view, ImageResolution=[500, 350],
                         FrameWindow=[0, FRAMES - 1])
    made = [name for name in os.listdir(".") if name.startswith("movie.")]
    expect(len(made) == FRAMES, f"the movie has {len(made)} frames")


def orbit_of(view):
    """Positions round the focal point, about the direction that is up."""
    import numpy as np

    focal, up = np.array(view.CameraFocalPoint), np.array(view.CameraViewUp)
    out = np.array(view.CameraPosition) - focal
    up = up - out * up.dot(out) / out.dot(out)
    up /= np.linalg.norm(up)
    angles = np.arange(8) * np.pi / 4
    return [value for angle in angles for value in
            focal + np.cos(angle) * out + np.sin(angle) * np.cross(up, out)]


story.begin(tell())
