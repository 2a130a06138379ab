# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The way of Documentation/Segmentations.md from two files to a picture in which two structures can be
# seen: a CT as .nii.gz, and a segmentation of 3D Slicer, which is cropped to its segments.
# TestSegmentation.xml has the events between the stages.

import re

import numpy as np
import story
from image_files import color_of, in_order, segments, write_nifti, write_nrrd
from paraview import simple, smtrace
from paraview.vtk.util.numpy_support import vtk_to_numpy
from story import expect

NAMES = {1: "skin", 2: "soft tissue", 3: "brain", 4: "skull", 5: "vessels", 6: "tumour"}
MOST_ACTIONS = 8


def write_files():
    """A head that lies on an oblique grid, in the coordinates of each format."""
    phantom = simple.OcclusionPhantom(Resolution=48)
    image = simple.servermanager.Fetch(phantom)
    simple.Delete(phantom)
    values, labels = (vtk_to_numpy(image.GetPointData().GetArray(name)).reshape((48,) * 3, order="F")
                      for name in ("Scalars", "Structure"))
    cos, sin = np.cos(0.2), np.sin(0.2)
    steps = 4 * np.array([[cos, 0, -sin], [sin, 0, cos], [0, 1, 0]])
    where = np.argwhere(labels)
    first, last = where.min(axis=0), where.max(axis=0) + 1
    to_right = np.diag([-1, -1, 1])  # NIfTI's x and y are opposite to those of NRRD
    origin = np.array([20.0, -90, 50])
    matrix = np.column_stack([steps, origin])
    write_nifti("ct.nii.gz", (1000 * values).astype("int16"),
                to_right @ matrix)
    write_nrrd("head.seg.nrrd", labels[tuple(map(slice, first, last))].astype("uint8"),
               np.column_stack([steps, origin + steps @ first]),
               more=segments(*((label, NAMES[label], 0) for label in np.unique(labels[labels > 0]))))
    return in_order(labels, matrix)[0]


def count_actions():
    """Events until the first undo, without those of the test itself."""
    with open("events.xml", encoding="utf-8") as file:
        events = re.findall(r'<pqevent object="([^"]*)" command="([^"]*)"',
                            file.read().split("actionUndo")[0])
    return len([command for place, command in events[:-1]
                if "MacrosToolbar" not in place and command not in ("keyEvent", "mouseRelease")])


def text_of(view):
    props = view.GetRenderer().GetViewProps()
    return "".join(str(prop) for prop in props if prop.IsA("vtkScoreAnnotation"))


def shares(display):
    """Of each structure, as the property has them: visible, before, removed, attainable."""
    return np.reshape(list(display.StructureShares), (-1, 4))


def structures(display):
    return list(display.Structures)


def tell():
    story.load_plugins()
    labels = write_files()
    view = simple.GetActiveViewOrCreate("RenderView")
    frames = story.Frames(view)
    story.listen(view)
    story.take_messages()
    expect(count_actions() <= MOST_ACTIONS, f"there are {count_actions()} actions")
    smtrace.start_trace()
    yield

    # From here to the end nothing that ParaView could undo may be done by Python.
    ct = simple.GetActiveSource()
    expect(frames.settle(), "the image is shown")
    camera = list(view.CameraPosition)
    story.screenshot("image.png")
    yield
    filter_ = simple.GetActiveSource()
    display = simple.GetDisplayProperties(filter_, view)
    expect(frames.settle(3 * story.PATIENCE, 2), "the volume is shown")
    expect(structures(display)[1::4] == [NAMES[int(label)] for label in structures(display)[::4]] and
           structures(display)[2::4] == ["0"] * (len(structures(display)) // 4),
           f"structures have their names, none is important: {structures(display)}")
    expect(np.allclose(np.reshape(list(display.LabelColors), (-1, 4)),
                       [(label, *color_of(label)) for label in NAMES]), "and their colors")
    expect(display.Representation == "Optimized Volume", "it is an optimized volume")
    expect(display.ColorArrayName[1] == "Values", "colored by the image")
    expect(simple.GetDisplayProperties(ct, view).Visibility == 0, "instead of the image")
    expect(list(view.CameraPosition) == camera, "the camera stays")
    story.screenshot("opened.png")
    opened = story.shown(view).astype(float)
    yield
    expect(frames.settle(3 * story.PATIENCE, 2), "rendering ends")
    expect(structures(display)[2::4] == ["0", "0", "0", "0", "1", "1"], "two are important")
    for name, row in zip(NAMES.values(), shares(display)):
        story.say(f"{name}: {row[0]:.3f} visible, {row[1]:.3f} before, of at most {row[3]:.3f}")
    expect((shares(display)[4:, 0] > 0.9 * shares(display)[4:, 3]).all(), "both can be seen")
    story.screenshot("ticked.png")
    expect(abs(story.shown(view) - opened).mean() > 1, "the picture is another one")
    traced = " ".join(smtrace.stop_trace().split())
    for words in ("SegmentationReader(", "AddStructures(", "'tumour', '1'"):
        expect(words in traced, f"the trace has {words}")
    yield
    expect(len(simple.GetSources()) == 1 and simple.GetDisplayProperties(ct, view).Visibility == 1,
           "undone in one step, the image alone is there")
    yield
    expect(len(simple.GetSources()) == 3, "and redone in one step, all is there")
    filter_ = simple.FindSource("AddStructures1")
    found = vtk_to_numpy(simple.servermanager.Fetch(filter_).GetPointData().GetArray("Structure"))
    expect((found == labels.ravel(order="F")).all(), "each label is at its place")

    display = simple.GetDisplayProperties(filter_, view)
    rows = structures(display)
    for name, target in (("vessels", "0.4"), ("tumour", "0.045")):
        place = rows.index(name)
        rows[place + 1:place + 3] = "1", target
    display.Structures = rows
    display.StructureColors = 0.5
    simple.Render(view)
    expect(frames.settle(3 * story.PATIENCE, 2), "rendering ends")
    text = text_of(view)
    expect("(>= 40.0 %)" in text and "Structures: vessels" in text,
           f"targets and names are told: {text}")
    story.screenshot("targets.png")


story.begin(tell())
