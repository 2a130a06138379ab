# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The table of structures as a person meets it in the panel: filled from the data, with names of the
# color map; two rows changed and painted as one, undone and redone; switched off and on; the
# best view of one row. Once the picture is finished, the table and the view say what is seen. A
# search of the volume starts with its structures, and a filter has such a table, too.
# TestStructures.xml has the events between the stages.

import numpy as np
import story
from paraview import simple, smtrace
from paraview.vtk.util.numpy_support import vtk_to_numpy
from story import expect


def text_of(view):
    props = view.GetRenderer().GetViewProps()
    return "".join(str(prop) for prop in props if prop.IsA("vtkScoreAnnotation")).splitlines()


def column(display, number):
    return list(display.Structures)[number::4]


def expect_column(display, number, expected, what):
    found = column(display, number)
    expect(found == expected, f"{what}: {found}")


def place_of_core(view, source):
    """Pixels from the lower left corner."""
    image = simple.servermanager.Fetch(source)
    labels = vtk_to_numpy(image.GetPointData().GetArray("Labels"))
    core = np.mean([image.GetPoint(i) for i in np.flatnonzero(labels == 3)], axis=0)
    place = story.place_in_window(view, [core])[:, 0]
    return [int(pixel) for pixel in (place + 1) / 2 * view.ViewSize]


def click(view, x, y):
    interactor = view.GetInteractor()
    interactor.SetEventInformation(x, y, 0, 0)
    interactor.InvokeEvent("LeftButtonPressEvent")
    interactor.InvokeEvent("LeftButtonReleaseEvent")


def tell():
    story.load_plugins()
    view = simple.GetActiveViewOrCreate("RenderView")
    source = simple.Calculator(Input=simple.OcclusionPhantom(Resolution=32), ResultArrayName="Labels",
                               Function="ceil(3*Importance)")
    display = simple.Show(source, view)
    display.SetRepresentationType("Optimized Volume")
    simple.ColorBy(display, ("POINTS", "Scalars"))
    colors = simple.GetColorTransferFunction("Labels")
    colors.InterpretValuesAsCategories = 1
    colors.Annotations = ["1", "rim", "3", "core"]
    colors.IndexedColors = [0.5, 0.25, 0, 0, 0.25, 1]
    simple.SetActiveSource(source)
    simple.ResetCamera(view)
    display.StructureArray = ["POINTS", "Labels"]
    frames = story.Frames(view)
    simple.Render(view)
    frames.settle()
    story.listen(view)
    story.take_messages()  # that no structures are listed
    smtrace.start_trace()
    yield

    # From here to "switched on" nothing that ParaView could undo may be done by Python.
    expect_column(display, 0, ["1", "2", "3"], "the labels in the data")
    expect_column(display, 1, ["rim", "label 2", "core"], "their names")
    given = [1, 0.5, 0.25, 0, 3, 0, 0.25, 1]
    expect(list(display.LabelColors) == given, f"their colors: {list(display.LabelColors)}")
    expect_column(display, 2, ["1", "1", "1"], "are important")
    expect(frames.settle(3 * story.PATIENCE, 2), "rendering ends")
    before = list(display.StructureShares)
    expect(len(before) == 12, "what is seen of each is measured")
    story.screenshot("filled.png")
    yield
    expect_column(display, 2, ["0.4", "0.4", "1"], "two selected rows are changed as one")
    story.screenshot("changed.png")
    yield
    expect_column(display, 2, ["1", "1", "1"], "undone in one step")
    yield
    expect_column(display, 2, ["0.4", "0.4", "1"], "redone in one step")
    yield
    expect(list(display.LabelColors) == [1, 1, 0.4, 0, 3, 0, 0.25, 1, 2, 1, 0.4, 0],
           f"both get the color that is chosen for one: {list(display.LabelColors)}")
    story.screenshot("painted.png")
    yield
    expect(list(display.LabelColors) == given, "undone in one step")
    yield
    expect_column(display, 2, ["0", "0", "0"], "none is important")
    yield
    expect_column(display, 2, ["0.4", "0.4", "1"], "switched on, all are as important as before")
    camera = list(view.CameraPosition)
    yield
    expect(frames.settle(3 * story.PATIENCE, 2), "rendering ends")
    best, first = (shares[11:] for shares in (list(display.StructureShares), before))
    expect(best >= first and list(view.CameraPosition) != camera,
           f"of the core the best view could show {best}, the first one {first}")
    expect_column(display, 2, ["0.4", "0.4", "1"], "for which no importance was changed")
    story.screenshot("core.png")
    yield
    expect(np.allclose(view.CameraPosition, camera), "one Camera Undo goes back")
    yield
    expect_column(display, 3, ["", "", "0.955"], "a percentage is typed as the target of one row")
    expect(frames.settle(3 * story.PATIENCE, 2), "rendering ends")
    expect(any(line.startswith("core ") and line.endswith(" (target 95.5 %)")
               for line in text_of(view)), "the view says so, too")
    told = story.take_messages()
    expect(len(told) == 1 and '"core"' in told[0], f"and that it cannot be reached: {told}")
    yield
    click(view, *place_of_core(view, source))
    yield
    expect_column(display, 2, ["0.4", "0.6", "1"], "a click in the view had selected another row")
    traced = smtrace.stop_trace().replace("\n", " ")
    expect("['1', 'rim', '0.4', '', '2', 'label 2', '0.6', ''" in " ".join(traced.split()),
           "the trace has the table")
    expect(".LabelColors = [1.0, 1.0, 0.4, 0.0, 3.0, 0.0, 0.25, 1.0, 2.0, 1.0, 0.4, 0.0]"
           in " ".join(traced.split()),
           "and the colors")
    yield
    search = simple.GetActiveSource()
    expect(search.StructureArray[1] == "Labels" and list(search.Structures) == list(display.Structures),
           f"a search starts with them: {list(search.Structures)}")
    simple.Delete(search)
    simple.Hide(source, view)
    story.take_messages()  # the same about the core, if the optimization had time for it
    filter_ = simple.ExtinctionOptimizer(Input=source)
    filter_.StructureArray = ["POINTS", "Labels"]
    simple.SetActiveSource(filter_)
    yield
    expect(len(list(filter_.Structures)) == 0, "a filter waits for Apply")
    yield
    expect_column(filter_, 1, ["rim", "label 2", "core"], "the table of a filter is applied")


story.begin(tell())
