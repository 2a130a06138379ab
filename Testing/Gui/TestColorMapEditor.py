# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Colors and opacities as a person changes them in ParaView's window, by the mouse in the editor and
# by the buttons of the toolbar, while an optimised volume is shown: as in ParaView's own stories
# ColorEditorVolumeControls and RescaleRange of its type "Volume". TestColorMapEditor.xml has the
# events.

import pictures
import story
from paraview import simple
from story import expect


class Shown:
    """What is seen of a display when everything has come to rest."""

    def __init__(self, display, view):
        self.display = display
        self.display.ScoreInScreenshots = 1  # as in the window
        self.view = view
        self.frames = story.Frames(view)
        self.last = None

    def changed(self, what, least=0.1):
        """A picture that differs from the last one, optimised to the end, without messages."""
        self.frames.expect_end(self.display, what)
        expect(self.display.Messages == "", f"{what}: no messages ({self.display.Messages!r})")
        picture = story.shown(self.view)
        if self.last is not None:
            mean, _ = pictures.difference(self.last, picture)
            expect(mean >= least, f"{what}: another picture (mean absolute difference {mean:.3f})")
        mean, _ = pictures.difference(picture, story.take(self.view, "shown.png"))
        expect(mean == 0, f"{what}: a screenshot shows the same")
        self.last = picture
        return picture


def tell():
    story.load_plugins()
    view = simple.GetActiveView()
    phantom = simple.OcclusionPhantom(Resolution=64)
    display = simple.Show(phantom, view)
    simple.ColorBy(display, ("POINTS", "Scalars"))
    display.SetRepresentationType("Optimized Volume")
    simple.ResetCamera(view)
    simple.SetActiveSource(phantom)
    simple.Render(view)
    yield

    shown = Shown(display, view)
    first = shown.changed("shown")
    opacity = simple.GetOpacityTransferFunction("Scalars")
    points = list(opacity.Points)
    yield

    added = list(opacity.Points)
    expect(len(added) == len(points) + 4, f"a click adds a point: {added}")
    shown.changed("a point added", least=0)  # it is on the line
    yield

    expect(len(opacity.Points) == len(added) and opacity.Points[5] < added[5] - 0.1,
           f"it is dragged down: {list(opacity.Points)}")
    shown.changed("a point dragged")
    yield

    expect(list(opacity.Points) == points, f"it is deleted: {list(opacity.Points)}")
    again = shown.changed("the point deleted")
    mean, _ = pictures.difference(first, again)
    expect(mean == 0, f"the first picture again (mean absolute difference {mean:.3f})")
    yield

    shown.changed("other colors")
    yield

    expect(abs(opacity.Points[0] - 0.2) < 1e-6, f"for some values: {list(opacity.Points)}")
    shown.changed("rescaled")
    yield

    expect(opacity.Points[0] == points[0], f"for all values: {list(opacity.Points)}")
    shown.changed("for all values again")


story.begin(tell())
