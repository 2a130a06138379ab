# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# A movie of the best views, made by a button of the volume: previewed and cancelled, then made,
# undone, redone, and traced for TestMovie.replay.py. TestMovie.xml has the events.

import json

import numpy as np
import story
from paraview import simple, smtrace
from story import expect

PATIENCE = 60.0  # seconds in which everything must have settled, on a slow and busy machine
FRAMES = 24
CAMERA = ["CameraPosition", "CameraFocalPoint", "CameraViewUp"]


def camera_of(view):
    return [list(view.GetProperty(name)) for name in CAMERA]


def camera_at(view, share):
    simple.GetAnimationScene().AnimationTime = share
    return camera_of(view)


def tracks_of(view):
    return [cue for cue in simple.GetAnimationScene().Cues
            if cue.GetXMLName() == "CameraAnimationCue" and cue.AnimatedProxy == view]


def expect_in_window(view, source, what):
    """All of the source's box."""
    bounds = np.reshape(source.GetDataInformation().GetBounds(), (3, 2))
    corners = np.array([[bounds[axis, side] for axis, side in enumerate(sides)]
                        for sides in np.ndindex(2, 2, 2)])
    position, focal_point, up = map(np.array, camera_of(view))
    ahead = (focal_point - position) / np.linalg.norm(focal_point - position)
    up = up - (up @ ahead) * ahead
    up /= np.linalg.norm(up)
    offsets = corners - position
    half = np.tan(np.radians(view.CameraViewAngle / 2)) * (offsets @ ahead)
    aspect = view.ViewSize[0] / view.ViewSize[1]
    most = max(abs(offsets @ np.cross(ahead, up) / (half * aspect)).max(),
               abs(offsets @ up / half).max())
    expect(most < 1, f"{what}: all of the volume is in the window, {most:.3f}")


def tell():
    story.load_plugins()
    smtrace.start_trace()
    yield

    view = simple.GetActiveView()
    source = simple.GetActiveSource()
    frames = story.Frames(view)
    story.listen(view)
    expect(frames.settle(PATIENCE), "the first picture is finished")
    before = camera_of(view)
    story.screenshot("window-before.png")
    yield

    frames.settle(PATIENCE)
    first = camera_of(view)
    expect(first != before, "the preview looks from the best view")
    expect_in_window(view, source, "the preview")
    story.screenshot("window-dialog.png")
    yield

    frames.settle(PATIENCE)
    expect(camera_of(view) != first, "the preview follows its slider")
    expect_in_window(view, source, "another frame of the preview")
    yield

    frames.settle(PATIENCE)
    expect(np.allclose(camera_of(view), before), "to cancel leads back to where the view was")
    expect(not tracks_of(view), "and there is no animation")
    expect(len(simple.GetSources()) == 1, "and nothing in the pipeline browser")
    yield

    frames.settle(PATIENCE)
    expect(len(simple.GetSources()) == 1, "the movie leaves nothing in the pipeline browser")
    scene = simple.GetAnimationScene()
    expect(len(tracks_of(view)) == 1, "the view's camera has one track")
    expect(scene.NumberOfFrames == FRAMES + 1, f"{scene.NumberOfFrames} frames")
    expect(scene.PlayMode == "Sequence", "in sequence")
    cameras = [camera_at(view, frame / FRAMES) for frame in range(FRAMES + 1)]
    expect(np.allclose(cameras[0], cameras[-1], atol=1e-4), "the last frame is the first one")
    away = np.array([np.subtract(*camera[:2]) for camera in cameras])
    distances = np.linalg.norm(away, axis=1)
    expect(np.ptp(distances) < 0.02 * distances.mean(), f"all from one distance: {distances}")
    away /= distances[:, np.newaxis]
    turns = np.degrees(np.arccos(np.clip((away[1:] * away[:-1]).sum(axis=1), -1, 1)))
    expect(turns.min() > 0.5 * turns.max() > 0, f"at even speed: {turns.min()} {turns.max()}")
    for frame in (0, 7, 15):
        camera_at(view, frame / FRAMES)
        expect_in_window(view, source, f"frame {frame}")
    with open("cameras.json", "w", encoding="utf-8") as file:
        json.dump(cameras, file)
    with open("trace.py", "w", encoding="utf-8") as file:
        file.write(smtrace.stop_trace())
    camera_at(view, 0.4)
    frames.settle(PATIENCE)
    story.screenshot("window-movie.png")
    yield

    expect(not tracks_of(view), "one step of undo takes the animation away")
    yield

    expect(len(tracks_of(view)) == 1, "redo brings it back")
    expect(np.allclose(camera_at(view, 7 / FRAMES), cameras[7]), "as it was")


story.begin(tell())
