# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The representation type "Optimized Volume" as a person meets it in ParaView's window: chosen,
# turned by the mouse, refined while nothing else happens, undone, redone, saved, loaded, and traced
# for TestOptimizedVolume.replay.py. TestOptimizedVolume.xml has the events between the stages.

import pictures
import story
from paraview import simple, smtrace
from story import expect

SIZE = [600, 400]
PATIENCE = 60.0  # seconds in which everything must have settled, on a slow and busy machine


def the_end_is_reached(frames, display, what):
    expect(frames.settle(PATIENCE), f"{what}: rendering ends")
    display.UpdatePropertyInformation()
    expect(display.Converged == 1, f"{what}: nothing is left to do")
    frames.clear()
    story.live(3.0)
    expect(frames.all() == 0, f"{what}: {frames.all()} renders in 3 s after that")


def compare(first, second, same, what):
    mean, p99 = pictures.difference(first, second)
    text = f"mean absolute difference {mean:.3f}, 99th percentile {p99:.1f}"
    if same:
        expect(mean == 0, f"{what}: the same picture ({text})")
    else:
        expect(mean > 0.1, f"{what}: another picture ({text})")


def tell():
    view = simple.GetActiveView()
    display = simple.GetDisplayProperties()
    frames = story.Frames(view)

    expect(display.Representation == "Optimized Volume", "the type can be chosen")
    expect(display.ImportanceArray[1] == "Importance", "the importance can be chosen")
    the_end_is_reached(frames, display, "shown")
    expect(display.VisibleFraction > display.BaseVisibleFraction,
           f"of what is important {100 * display.VisibleFraction:.1f} % shows, "
           f"{100 * display.BaseVisibleFraction:.1f} % before")
    shown = pictures.take(view)
    story.screenshot("shown-window.png")
    yield

    expect(frames.interactive > 0, f"turning it renders quickly, {frames.interactive} times")
    the_end_is_reached(frames, display, "turned")
    turned = pictures.take(view)
    compare(shown, turned, False, "turned")
    story.screenshot("turned-window.png")
    compare(story.shown(view), turned, True, "what the steps arrive at and what a screenshot makes")

    interactor = view.GetInteractor()
    interactor.InvokeEvent("StartInteractionEvent")
    view.CameraPosition = [1.1 * x for x in view.CameraPosition]
    simple.Render(view)
    frames.clear()
    story.live(1.0)
    expect(frames.all() == 0, "no step is made while the mouse button is down")
    interactor.InvokeEvent("EndInteractionEvent")
    the_end_is_reached(frames, display, "after the button is up")
    turned = story.shown(view)
    yield

    # From here to the end of "redone" nothing that ParaView could undo may be done by Python.
    expect(display.Shadows == 0, "a property can be changed in the panel")
    the_end_is_reached(frames, display, "changed")
    changed = story.shown(view)
    compare(turned, changed, False, "changed")
    yield

    expect(display.Shadows == 1, "the change can be undone")
    the_end_is_reached(frames, display, "undone")
    compare(turned, story.shown(view), True, "undone")
    yield

    expect(display.Shadows == 0, "the change can be redone")
    the_end_is_reached(frames, display, "redone")
    compare(changed, story.shown(view), True, "redone")
    taken = pictures.take(view, SIZE)
    pictures.write("traced.png", taken)
    with open("trace.py", "w", encoding="utf-8") as file:
        file.write(smtrace.stop_trace())
    yield

    views = [each for each in simple.GetRenderViews() if each.Representations]
    expect(len(views) == 1, "the state has one view that is not empty")
    loaded = views[-1]
    frames = story.Frames(loaded)
    expect(frames.settle(PATIENCE), "loaded: rendering ends")
    compare(taken, pictures.take(loaded, SIZE), True, "loaded")
    with open("state.pvsm", encoding="utf-8") as file:
        expect("Progressive" not in file.read(), "the state has nothing of the refinement")
    yield


smtrace.start_trace()
story.begin(tell())
