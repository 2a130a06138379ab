# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The first minute with a CT: from the menu File to a picture of the skull inside the head, in five
# actions and without a message. TestFirstMinute.xml has them. Then what was set up is taken over:
# by filters, by a second view, and by a trace for TestFirstMinute.replay.py.

import json

import story
from paraview import simple, smtrace
from story import expect

# What filters take from the display, and from the view.
SETTINGS = ["UseImportanceFunction", "ClearingThreshold", "ProtectImportance", "ViewWeight",
            "LightWeight", "ImportanceSmoothing", "Smoothness", "Method", "Mode",
            "RestrictToView", "ScalarOpacityUnitDistance"]
CAMERA = ["CameraPosition", "CameraFocalPoint", "CameraViewUp", "CameraViewAngle",
          "CameraParallelProjection"]


def value_of(proxy, name):
    value = proxy.GetProperty(name).GetData()
    return list(value) if isinstance(value, (list, tuple)) else value


def setup_of(proxy, names):
    """Values of those properties that the proxy has, and the points of its functions."""
    values = {name: value_of(proxy, name) for name in names if proxy.GetProperty(name)}
    for function in ("ImportanceFunction", "ScalarOpacityFunction"):
        values[function] = list(proxy.GetProperty(function)[0].Points)
    return values


def expect_setup(display, view, what, up=None):
    """`up`: what is upwards for a filter that looks from everywhere; None: it has the camera."""
    source = simple.GetActiveSource()
    wanted = setup_of(display, SETTINGS)
    wanted.update({name: value_of(view, name) for name in CAMERA})
    wanted["CameraViewUp"] = up or wanted["CameraViewUp"]
    got = setup_of(source, SETTINGS + CAMERA)
    different = [f"{name} is {got[name]}, not {wanted[name]}" for name in got
                 if got[name] != wanted[name]]
    expect(len(got) > 8 and not different, f"{what} has {len(got)} properties of display and view"
           + "".join("; " + text for text in different))
    for name in ("ImportanceArray", "ScalarArray"):
        expect(source.GetProperty(name)[1] == "ct", f"{what}: {name} is "
               f"{source.GetProperty(name)[1]}")
    return got


def expect_best_view(view, reader, what):
    """The camera is upright, and the volume's box fills the window."""
    right, _, _ = story.axes_of(view)
    expect(abs(right[1]) < 1e-6, f"{what}: upwards is what was upwards before")
    story.expect_filled(view, story.corners_of(reader), what)


def tell():
    story.load_plugins()
    smtrace.start_trace()
    yield

    view = simple.GetActiveView()
    reader = simple.GetActiveSource()
    display = simple.GetDisplayProperties()
    frames = story.Frames(view)
    story.listen(view)
    expect(frames.settle(), "the first picture is finished")
    display.UpdatePropertyInformation()
    first = display.VisibleFraction
    expect(display.Messages == "", f"no message: {display.Messages!r}")
    expect(first > 2 * display.BaseVisibleFraction,
           f"of the important structures {100 * first:.1f} % shows, "
           f"{100 * display.BaseVisibleFraction:.1f} % in Ordinary")
    story.screenshot("window-first.png")
    frames.clear()
    yield

    expect(frames.settle(), "the best view is finished")
    display.UpdatePropertyInformation()
    expect(display.VisibleFraction > 1.2 * first,
           f"from the best view {100 * display.VisibleFraction:.1f} %")
    expect(len(simple.GetSources()) == 1, "the search left nothing in the pipeline browser")
    expect(list(view.CameraPosition)[:2] != [0, 0], "the camera moved")
    expect_best_view(view, reader, "the best view")
    story.screenshot("window-best.png")
    shape = list(view.ViewSize)
    simple.GetLayout().SplitHorizontal(0, 0.4)
    story.live(1)
    expect(shape[0] > 2 * view.ViewSize[0], f"the view is narrower: {view.ViewSize}, was {shape}")
    yield

    expect(frames.settle(), "the best view is finished again")
    expect_best_view(view, reader, "the best view of a narrow window")
    story.screenshot("window-narrow.png")
    yield

    taken = expect_setup(display, view, "the Extinction Optimizer")
    story.screenshot("window-filter.png")
    yield

    expect(len(simple.GetSources()) == 1, "one step of undo takes the filter away")
    yield

    expect(len(simple.GetSources()) == 2, "redo brings it back")
    optimizer = [each for (name, _), each in simple.GetSources().items() if "Optimizer" in name][0]
    simple.SetActiveSource(optimizer)
    expect(expect_setup(display, view, "the filter again") == taken, "with the same values")
    optimizer.UpdatePipeline()
    share = optimizer.FieldData["BaseVisibleFraction"].GetRange()[0]
    expect(abs(share - display.BaseVisibleFraction) < 1e-6,
           f"of the important structures the filter sees {100 * share:.4f} % in Ordinary, the display "
           f"{100 * display.BaseVisibleFraction:.4f} %")
    simple.SetActiveSource(reader)
    yield

    expect_setup(display, view, "the Viewpoint Search", up=[0, 1, 0])
    with open("taken.json", "w", encoding="utf-8") as file:
        json.dump(taken, file)
    with open("trace.py", "w", encoding="utf-8") as file:
        file.write(smtrace.stop_trace())

    display.UseImportanceFunction = 0
    display.Shadows = 0
    second = simple.CreateRenderView()
    simple.AssignViewToLayout(second)
    other = simple.Show(reader, second)
    for name in ("Representation", "ColorArrayName", "ImportanceArray", "Shadows", *SETTINGS):
        if display.GetProperty(name):
            expect(value_of(other, name) == value_of(display, name),
                   f"in a second view {name} is {value_of(other, name)}")
    simple.Render(second)
    expect(other.UseImportanceFunction == 0, "what was switched off stays off there")
    function = display.ImportanceFunction
    expect(other.ImportanceFunction != function, "each has an importance function of its own,")
    expect(list(other.ImportanceFunction.Points) == list(function.Points), "with the same points")


story.begin(tell())
