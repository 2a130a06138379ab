# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# A movie of the best views, made by a button of the volume: previewed and cancelled, then made,
# undone by one step, redone, and traced for TestMovie.replay.py. TestMovie.xml has the events.

import json

import numpy as np
import story
from paraview import simple, smtrace
from paraview.modules.vtkRemotingServerManager import vtkSMProxyManager
from story import expect

FRAMES = 24
CAMERA = ["CameraPosition", "CameraFocalPoint", "CameraViewUp"]


def camera_of(view):
    return [list(view.GetProperty(name)) for name in CAMERA]


def cameras_of_movie(view):
    """Of all frames, none of which is rendered."""
    scene = simple.GetAnimationScene().GetClientSideObject()
    scene.SetOverrideStillRender(True)
    cameras = []
    for frame in range(FRAMES + 1):
        scene.SetSceneTime(frame / FRAMES)
        view.SMProxy.SynchronizeCameraProperties()
        cameras.append(camera_of(view))
        if frame in (0, 7, 15):
            corners = story.corners_of(simple.GetActiveSource())
            story.expect_in_window(view, corners, f"frame {frame}")
    scene.SetOverrideStillRender(False)
    return cameras


def tracks_of(view):
    return [cue for cue in simple.GetAnimationScene().Cues
            if cue.GetXMLName() == "CameraAnimationCue" and cue.AnimatedProxy == view]


def undo_steps():
    steps = vtkSMProxyManager.GetProxyManager().GetUndoStackBuilder().GetUndoStack()
    return [steps.GetUndoSetLabel(i) for i in range(steps.GetNumberOfUndoSets())]


def state_of_session():
    """All that a movie may change, but the camera."""
    scene = simple.GetAnimationScene()
    manager = vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager()
    groups = ("animation", "animation_keyframes", "sources", "representations")
    return ([scene.GetProperty(name).GetData()
             for name in ("PlayMode", "NumberOfFrames", "StartTime", "EndTime")],
            len(scene.Cues), [manager.GetNumberOfProxies(group) for group in groups])


def tell():
    story.load_plugins()
    smtrace.start_trace()
    yield

    view = simple.GetActiveView()
    source = simple.GetActiveSource()
    frames = story.Frames(view)
    story.listen(view)
    expect(frames.settle(), "the first picture is finished")
    before = camera_of(view)
    session = state_of_session()
    steps = undo_steps()
    story.screenshot("window-before.png")
    yield

    frames.settle()
    first = camera_of(view)
    expect(first != before, "the preview looks from the best view")
    story.expect_in_window(view, story.corners_of(source), "the preview")
    expect(story.dialog_is_open(), "the dialog is open")
    story.screenshot("window-dialog.png")
    yield

    frames.settle()
    expect(camera_of(view) != first, "the preview follows its slider")
    story.expect_in_window(view, story.corners_of(source), "another frame of the preview")
    yield

    frames.settle()
    expect(not story.dialog_is_open(), "to cancel closes the dialog")
    expect(np.allclose(camera_of(view), before), "to cancel leads back to where the view was")
    expect(state_of_session() == session, "and nothing is left of it")
    expect(undo_steps() == steps, f"and there is nothing to undo: {undo_steps()}")
    yield

    frames.settle()
    shown = camera_of(view)
    expect(not story.dialog_is_open(), "to make the movie closes the dialog")
    made = undo_steps()
    expect(made == ["Make Movie"] + steps, f"the movie is one step of undo: {made}")
    with open("trace.py", "w", encoding="utf-8") as file:
        file.write(smtrace.stop_trace())
    expect(len(simple.GetSources()) == 1, "the movie leaves nothing in the pipeline browser")
    scene = simple.GetAnimationScene()
    expect(len(tracks_of(view)) == 1, "the view's camera has one track")
    expect(scene.NumberOfFrames == FRAMES + 1, f"{scene.NumberOfFrames} frames")
    expect(scene.PlayMode == "Sequence", "in sequence")
    with_movie = state_of_session()
    yield

    undone = state_of_session()
    expect(undone == session, f"one step of undo restores all: {undone}, it was {session}")
    expect(not tracks_of(view), "the view's camera has no track")
    expect(undo_steps() == steps, f"no other step was undone: {undo_steps()}")
    yield

    expect(state_of_session() == with_movie, f"redo brings all back: {state_of_session()}")
    cameras = cameras_of_movie(view)
    expect(np.allclose(cameras[0], cameras[-1], atol=1e-4), "the last frame is the first one")
    expect(np.allclose(cameras[0], shown, atol=1e-4), "which the view shows when it is made")
    away = np.array([np.subtract(*camera[:2]) for camera in cameras])
    distances = np.linalg.norm(away, axis=1)
    expect(np.ptp(distances) < 0.02 * distances.mean(), f"all from one distance: {distances}")
    away /= distances[:, np.newaxis]
    turns = np.degrees(np.arccos(np.clip((away[1:] * away[:-1]).sum(axis=1), -1, 1)))
    expect(turns.min() > 0.5 * turns.max() > 0, f"at even speed: {turns.min()} {turns.max()}")
    expect(np.ptp([up for _, _, up in cameras], axis=0).max() < 1e-6, "and upright")
    with open("cameras.json", "w", encoding="utf-8") as file:
        json.dump(cameras, file)
    simple.GetAnimationScene().AnimationTime = 0.4
    frames.settle()
    story.screenshot("window-movie.png")


story.begin(tell())
