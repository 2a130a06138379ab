# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# A volume that is on display before the plugin is loaded: it looks as it did, filters take it over,
# and it can be shown as an optimized volume like any other. TestLatePlugin.xml opens it, makes a
# filter and chooses the type.

import pictures
import story
from paraview import simple
from story import expect


def tell():
    view = simple.GetActiveView()
    reader = simple.GetActiveSource()
    display = simple.GetDisplayProperties()
    frames = story.Frames(view)
    story.listen(view)
    display.ScalarOpacityUnitDistance = 7
    expect(frames.settle(), "the volume is shown")
    expect(not display.GetProperty("ImportanceArray"), "ParaView knows no importance")
    before = story.take(view, "before.png")

    story.load_plugins()
    story.live_until(lambda: simple.GetDisplayProperties().GetProperty("ImportanceArray"), 5)
    display = simple.GetDisplayProperties()
    expect(display.GetProperty("ImportanceArray"), "with the plugin it does")
    expect(display.Representation == "Volume", f"the type is still {display.Representation}")
    expect(display.ScalarOpacityUnitDistance == 7, "so is the unit distance")
    frames.settle()
    mean, _ = pictures.difference(before, story.take(view, "after.png"))
    expect(mean == 0, f"it looks as before (mean difference {mean:.3f})")
    yield

    optimizer = simple.GetActiveSource()
    least, begin, end, most = optimizer.ImportanceFunction.Points[::4]
    expect(optimizer.UseImportanceFunction == 1 and least < begin < end < most,
           f"a filter starts with the largest values for important: {begin:.1f} to {end:.1f}")
    expect(optimizer.ScalarOpacityUnitDistance == 7, "and with the volume's unit distance,")
    expect(list(optimizer.ScalarOpacityFunction.Points)
           == list(simple.GetOpacityTransferFunction("ct").Points), "opacity function")
    expect(list(optimizer.CameraPosition) == list(view.CameraPosition), "and camera of the view")
    yield

    expect(list(simple.GetSources().values()) == [reader], "undo takes it away")
    simple.SetActiveSource(reader)
    yield

    expect(simple.GetDisplayProperties().Representation == "Optimized Volume",
           "the type can be chosen")
    expect(frames.settle(), "the picture is finished")
    # Python's class of displays is older than the plugin, and lacks its properties' names.
    display.UpdatePropertyInformation()
    now, before, messages = (display.GetProperty(name).GetData() for name in
                             ("VisibleFraction", "BaseVisibleFraction", "Messages"))
    expect(now > before and not messages, f"{100 * now:.1f} % shows, {100 * before:.1f} % before"
           f" {messages}")


story.begin(tell())
