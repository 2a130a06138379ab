# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Viewpoints as a person meets them in ParaView's window: a phantom is searched, and buttons give
# the view the camera of the best, the next and the worst view and of a selected point; the camera
# is undone and traced for TestViewpoints.replay.py. TestViewpoints.xml has the events between.

import json
import sys

import numpy as np
import story
from paraview import servermanager, simple, smtrace
from story import expect

CAMERA = ["CameraPosition", "CameraFocalPoint", "CameraViewUp", "CameraViewAngle",
          "CameraParallelProjection"]
POINT = 17  # of the sphere: any


def camera_of(view):
    return {name: list(view.GetProperty(name)) for name in CAMERA}


def direction_of(fields, position):
    away = np.subtract(position, fields.GetArray("CameraFocalPoint").GetTuple3(0))
    return away / np.linalg.norm(away)


def expect_fitted(view, fields, direction, what):
    """The view looks from a direction, upright, and the image's box fills its window."""
    expect(np.allclose(direction_of(fields, view.CameraPosition), direction, atol=1e-9),
           f"{what}: the camera is in direction {direction}")
    right, _, _ = story.axes_of(view)
    sideways = right @ fields.GetArray("CameraUpAxis").GetTuple3(0)
    expect(abs(sideways) < 1e-9, f"{what}: upright, {sideways:.1g}")
    corners = np.reshape(fields.GetArray("ImageCorners").GetTuple(0), (8, 3))
    story.expect_filled(view, corners, what)


def differ(first, second):
    """Whether by more than what is left of a unit vector when a camera makes it one again."""
    return max(abs(a - b) for a, b in zip(first, second)) > 4 * sys.float_info.epsilon


def expect_camera(view, camera, what):
    got = camera_of(view)
    different = [f"{name} is {got[name]}, not {camera[name]}" for name in CAMERA
                 if differ(got[name], camera[name])]
    expect(not different, f"{what} {'; '.join(different) or 'is the camera'}")


def expect_colors(display, search, what):
    points = display.LookupTable.RGBPoints
    scores = search.PointData["VisibilityScore"].GetRange()
    expect(max(abs(points[0] - scores[0]), abs(points[-4] - scores[1])) < 1e-6 * scores[1],
           f"colors from {points[0]:.4f} to {points[-4]:.4f} span {what}: {scores}")


def tell():
    story.load_plugins()
    yield

    view = simple.GetActiveView()
    search = simple.GetActiveSource()
    frames = story.Frames(view)
    story.listen(view)
    before = camera_of(view)
    ranked = servermanager.Fetch(search, idx=1)
    count = ranked.GetNumberOfPoints()
    expect(count >= 2, f"the search has {count} viewpoints")
    display = simple.GetDisplayProperties(search, view)
    color = display.LookupTable.RGBPoints[1:4]
    expect(color[0] > 2 * color[2], f"the sphere is colored by score, worst {color}")
    story.live(0.3)
    story.screenshot("window-sphere.png")
    yield

    expect(frames.all() > 0, "going to the best view renders")
    fields = ranked.GetFieldData()
    directions = ranked.GetPointData().GetArray("ViewDirection")
    expect_fitted(view, fields, directions.GetTuple3(0), "the best view")
    story.live(0.3)
    story.screenshot("window-best.png")
    yield

    expect_fitted(view, fields, directions.GetTuple3(1), "the next view")
    second = camera_of(view)
    yield

    worst = direction_of(fields, fields.GetArray("WorstCameraPosition").GetTuple3(0))
    expect_fitted(view, fields, worst, "the worst view")
    story.live(0.3)
    story.screenshot("window-worst.png")
    yield

    expect_camera(view, second, "undone: the next view")
    yield

    expect_camera(view, before, "undone: the view before")
    simple.QuerySelect(QueryString=f"id == {POINT}", FieldType="POINT", Source=search)
    simple.Render(view)
    yield

    sphere = servermanager.Fetch(search)
    expect_fitted(view, fields, sphere.GetPointData().GetArray("ViewDirection").GetTuple3(POINT),
                  "the view of a point")
    story.live(0.3)
    story.screenshot("window-selected.png")
    with open("trace.py", "w", encoding="utf-8") as file:
        file.write(smtrace.stop_trace())
    with open("camera.json", "w", encoding="utf-8") as file:
        json.dump(camera_of(view), file)

    simple.ColorBy(display, ("POINTS", "VisibilityScore"))
    simple.Render(view)
    expect_colors(display, search, "the scores of the importance proxy")
    yield

    frames.settle()
    expect_colors(display, search, "after Apply those of the base extinction, which are smaller")
    path = simple.CameraPath(Input=search)
    on_path = simple.Show(path, view)
    expect(on_path.LookupTable == display.LookupTable, "the path is colored by score, too")
    lowest = path.PointData["VisibilityScore"].GetRange()[0]
    expect(lowest > search.PointData["VisibilityScore"].GetRange()[0], "the path avoids the worst views")
    expect_colors(display, search, "with the path beside them those of the sphere")


smtrace.start_trace()
story.begin(tell())
