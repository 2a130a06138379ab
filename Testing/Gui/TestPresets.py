# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The presets of an Optimized Volume and the slider from "Keep Context" to "Reveal", as a person meets
# them in the panel: chosen, moved, dragged, undone, redone, traced for TestPresets.replay.py, saved
# and loaded. They follow what Python sets. TestPresets.xml has the events between the stages.

import json

import story
from paraview import simple, smtrace
from story import expect

WEIGHTS = ["ViewWeight", "LightWeight", "ClearingThreshold", "ProtectImportance"]
DEFAULT = [10, 1, 3e-3, 1]
STRONG_REVEAL = [10, 1, 3e-4, 0.1]
KEEP_CONTEXT = [10, 1, 0.3, 1]


def values(display):
    return [getattr(display, name) for name in WEIGHTS]


def expect_values(display, expected, what):
    expect(values(display) == expected, f"{what}: {values(display)}")


def is_between(display):
    """Whether the slider is between its ends, and has changed nothing else."""
    view, light, threshold, protect = values(display)
    return [view, light, protect] == [10, 1, 0.1] and 1e-4 < threshold < 100


def tell():
    view = simple.GetActiveView()
    display = simple.GetDisplayProperties()
    frames = story.Frames(view)
    story.listen(view)
    expect_values(display, DEFAULT, "from the start")
    smtrace.start_trace()
    yield

    # From here to the end of "drag redone" nothing that ParaView could undo may be done by Python.
    expect_values(display, STRONG_REVEAL, "a preset is chosen, which sets two properties")
    yield
    expect_values(display, DEFAULT, "undone in one step")
    yield
    expect_values(display, STRONG_REVEAL, "redone in one step")
    yield

    expect_values(display, [10, 1, 0.0316, 0.1], "the slider is in the middle")
    yield
    expect_values(display, STRONG_REVEAL, "undone in one step")
    yield
    expect_values(display, [10, 1, 0.0316, 0.1], "redone in one step")
    yield

    expect_values(display, [10, 1, 100, 0.1], "the slider is at its left end")
    frames.settle()
    display.UpdatePropertyInformation()
    gained = display.VisibleFraction - display.BaseVisibleFraction
    possible = display.AttainableFraction - display.BaseVisibleFraction
    expect(gained < 0.05 * possible, f"there, context stays: {gained:.4f} of {possible:.4f} gained")
    frames.clear()
    yield
    first = display.ClearingThreshold
    story.live(0.5)
    expect(is_between(display) and frames.all() > 0,
           f"the volume follows the drag: {values(display)}, {frames.all()} renders")
    yield
    last = display.ClearingThreshold
    expect(is_between(display) and last < first, f"and goes on to follow it: {values(display)}")
    yield
    expect(display.ClearingThreshold == last, f"it stays where it is let go: {values(display)}")
    yield
    expect_values(display, [10, 1, 100, 0.1], "a drag is undone in one step")
    yield
    expect(is_between(display) and display.ClearingThreshold == last,
           f"drag redone in one step: {values(display)}")
    with open("trace.py", "w", encoding="utf-8") as file:
        file.write(smtrace.stop_trace())
    with open("traced.json", "w", encoding="utf-8") as file:
        json.dump(dict(zip(WEIGHTS, values(display))), file)
    display.ClearingThreshold = 0.0317  # nearest to the position that 0.0316 has
    yield

    expect(display.ClearingThreshold == 0.0317, "the slider follows Python")
    yield

    expect_values(display, DEFAULT, "a preset is chosen from other values")
    display.Preset = "Paper"
    yield

    expect_values(display, DEFAULT, "the presets follow Python")
    yield

    expect_values(display, KEEP_CONTEXT, "another one is chosen")
    yield

    simple.LoadState("state.pvsm")
    source = simple.FindSource("volume.vti")
    loaded = [simple.GetRepresentation(source, view) for view in simple.GetRenderViews()
              if view.Representations]
    expect(len(loaded) == 1, "the state has one display")
    expect_values(loaded[0], KEEP_CONTEXT, "loaded")


story.begin(tell())
