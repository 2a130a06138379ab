# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The result of Extinction Optimizer as a person meets it in ParaView's window: after Apply the view
# shows the extinction that was found, colored by the integers that the filter was given, and nothing
# else opens. TestFoundExtinction.xml has the events between.

import story
from paraview import simple
from story import expect


def tell():
    story.load_plugins()
    yield

    integers = simple.Calculator(Input=simple.GetActiveSource(), ResultArrayName="Values",
                                 Function="1000*Scalars", ResultArrayType="Unsigned Short")
    integers.UpdatePipeline()
    simple.SetActiveSource(integers)
    yield

    view = simple.GetActiveView()
    result = simple.GetActiveSource()
    frames = story.Frames(view)
    expect(frames.settle(), "the view comes to rest")
    expect(len(simple.GetViews()) == 1, f"there are {len(simple.GetViews())} views")
    display = simple.GetDisplayProperties(result, view)
    shown = (display.Representation, display.ExtinctionSource, display.ExtinctionArray[1],
             display.Method)
    expect(shown == ("Optimized Volume", "Array", "Extinction", "Ordinary"), f"it shows {shown}")
    expect(list(display.ColorArrayName) == list(result.ScalarArray),
           f"the colors are those of {list(display.ColorArrayName)}")
    expect(display.Messages == "", f"the display says: {display.Messages!r}")
    expect(story.shown(view).std(axis=(0, 1)).max() > 5, "there is a picture")
    story.screenshot("window-found.png")
    display.Method = "Optimized"
    display.ExtinctionArray = ["POINTS", "BaseExtinction"]
    result.ViewWeight = 5
    yield

    expect(frames.settle(), "the view comes to rest again")
    expect((display.Method, display.ExtinctionArray[1]) == ("Optimized", "BaseExtinction"),
           "what was chosen stays after Apply")
    expect(len(simple.GetViews()) == 1, "there is still one view")


story.begin(tell())
