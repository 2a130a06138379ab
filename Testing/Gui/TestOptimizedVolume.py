# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The representation type "Optimized Volume" as a person meets it in ParaView's window: the plugins
# are loaded, a volume is opened, what is important is chosen, the volume is turned by the mouse,
# refined while nothing else happens, changed, undone, redone, saved, loaded, and traced for
# TestOptimizedVolume.replay.py. TestOptimizedVolume.xml has the events between the stages.

import pictures
import story
from paraview import simple, smtrace
from story import expect


def the_end_is_reached(frames, display, what):
    frames.clear()
    frames.expect_end(display, what)


def the_first_frame_is_finished(recorder, before, what):
    """Of those since the last call that no longer show the picture before: all show the last one's.
    ParaView renders after a macro, which is before the events that follow it."""
    left = [pictures.difference(each, recorder.pictures[-1])[0] for each in recorder.pictures
            if pictures.difference(each, before)[0] > 0]
    expect(left and max(left) == 0, f"{what}: the first frame is finished {left}")
    recorder.clear()


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
    display.ShowScore = 0  # saved pictures, which are compared with the window, have no score
    frames, recorder = story.Frames(view), story.Recorder(view)
    story.listen(view)

    expect(display.Representation == "Optimized Volume", "the type can be chosen")
    expect(display.ImportanceArray[1] == "ct", "the importance can be chosen")
    the_end_is_reached(frames, display, "shown")
    frames.clear()
    story.live(3.0)
    expect(frames.all() == 0, f"shown: {frames.all()} renders in 3 s after that")
    expect(display.VisibleFraction > display.BaseVisibleFraction,
           f"of the important structures {100 * display.VisibleFraction:.1f} % shows, "
           f"{100 * display.BaseVisibleFraction:.1f} % before")
    expect(display.Messages == "", f"no messages are left: {display.Messages!r}")
    optimized = story.shown(view)
    compare(optimized, story.take(view, "optimized.png"), True,
            "what the steps arrive at and what a screenshot makes")
    story.screenshot("window-optimized.png")
    story.live(3.0)  # until it has made what Show Original shows
    recorder.clear()
    yield

    the_end_is_reached(frames, display, "original")
    the_first_frame_is_finished(recorder, optimized, "original")
    original = story.shown(view)
    compare(optimized, story.shown(view), False, "original")
    story.screenshot("window-original.png")
    yield

    the_end_is_reached(frames, display, "optimized again")
    the_first_frame_is_finished(recorder, original, "optimized again")
    compare(optimized, story.shown(view), True, "optimized again")
    frames.clear()
    yield

    expect(frames.interactive > 0, f"turning it renders quickly, {frames.interactive} times")
    frames.clear()
    seconds = story.turn(view, 30)
    count = frames.interactive
    expect(count >= 20, f"the mouse turned it on: {count} frames, {count / seconds:.1f} per second")
    story.say(f"view {view.ViewSize[0]} x {view.ViewSize[1]}, {frames.describe()}")
    display.UpdatePropertyInformation()
    story.say(f"of the important structures {100 * display.VisibleFraction:.1f} % shows while turning, "
              f"{100 * display.BaseVisibleFraction:.1f} % before")
    story.screenshot("window-turning.png")
    frames.clear()
    story.live(1.0)
    expect(frames.all() == 0, "no step is made while the mouse button is down")
    story.let_go(view)
    the_end_is_reached(frames, display, "turned")
    frames.clear()
    story.zoom(view, 5)
    story.live(0.1)
    expect(frames.interactive == 5 and frames.still <= 5,
           f"{frames.interactive} quick frames for 5 notches of the wheel, and no steps between: "
           f"{frames.still} still renders")
    the_end_is_reached(frames, display, "zoomed")
    turned = story.shown(view)
    compare(optimized, turned, False, "turned")
    compare(turned, story.take(view, "turned.png"), True, "turned: steps and screenshot")
    story.screenshot("window-turned.png")
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
    changed = story.take(view, "changed.png")
    with open("trace.py", "w", encoding="utf-8") as file:
        file.write(smtrace.stop_trace())
    yield

    simple.LoadState("state.pvsm")
    views = [each for each in simple.GetRenderViews() if each.Representations]
    expect(len(views) == 1, "the state has one view that is not empty")
    compare(changed, story.take(views[-1], "loaded.png"), True, "loaded")
    with open("state.pvsm", encoding="utf-8") as file:
        expect("Progressive" not in file.read(), "the state has nothing of the refinement")


smtrace.start_trace()
story.begin(tell())
