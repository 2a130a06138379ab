# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What the tests of the representation in ParaView share: views, displays of the phantom."""

import os
import re
import tempfile
import unittest

from paraview import simple

import pictures

BACKGROUND = [0.1, 0.2, 0.3]
# Where the head is looked at from: in front, above, behind and below.
POSITIONS = [[1.9, -4.7, 1.5], [0.5, -2.0, 4.8], [-3.0, 3.5, -2.2]]

# Values of the head's materials and their colours and opacities.
COLORS = [0.0, 0.2, 0.15, 0.2, 0.15, 0.75, 0.5, 0.55, 0.4, 0.87, 0.66, 0.53, 0.65, 0.95, 0.92, 0.8,
          0.75, 0.8, 0.2, 0.15, 0.85, 0.75, 0.05, 0.1, 0.93, 0.3, 0.7, 0.3, 1.0, 0.1, 0.8, 0.35]
OPACITIES = [0.0, 0.0, 0.5, 0.0, 0.05, 0.0, 0.5, 0.0, 0.15, 0.25, 0.5, 0.0, 1.0, 0.6, 0.5, 0.0]
UNIT_DISTANCE = 0.1

# Two renderers that sample a ray at other places differ by this much in 8-bit pictures of volumes
# whose opacity varies slowly over a step (measured between VTK's own: 0.3 to 0.6).
SAME_RENDERING = 1.5


def clear():
    """Deletes all sources, views, color maps and opacity functions.

    A third of a second faster than simple.ResetSession(), and plugins stay loaded.
    """
    for proxies in (simple.GetSources().values(), simple.GetViews(), simple.GetLayouts().values()):
        for proxy in list(proxies):
            simple.Delete(proxy)
    proxies = simple.servermanager.ProxyManager()
    for group in ("lookup_tables", "piecewise_functions"):
        for (name, _), proxy in list(proxies.GetProxiesInGroup(group).items()):
            proxies.UnRegisterProxy(group, name, proxy.SMProxy)
    simple.SetActiveSource(None)
    simple.SetActiveView(None)


def sets(name, value=None):
    """A pattern for what a trace or a state in Python says where a display gets a value, or any:
    display.Mode = 'Joint', or display.Set(..., Mode='Joint') since ParaView 6."""
    shown = "" if value is None else re.escape(repr(value))
    return rf"Display\.(?:{name} = |Set\((?s:.)*?\b{name}=){shown}"


def through_a_state():
    """Saves a state, deletes everything, and loads it; the view, rendered."""
    with tempfile.TemporaryDirectory() as folder:
        state = os.path.join(folder, "state.pvsm")
        simple.SaveState(state)
        clear()
        simple.LoadState(state)
    view = simple.GetActiveView()
    simple.Render(view)
    return view


def set_background(view):
    """The same whatever ParaView's version and settings have by default."""
    view.UseColorPaletteForBackground = 0
    view.Background = BACKGROUND


def new_view(size=(200, 200)):
    simple._DisableFirstRenderCameraReset()
    view = simple.CreateView("RenderView")
    view.ViewSize = list(size)
    view.OrientationAxesVisibility = 0
    view.CenterAxesVisibility = 0
    set_background(view)
    look(view, POSITIONS[0])
    return view


def look(view, position):
    view.CameraPosition = position
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]


def move(display, offset):
    """By the property that ParaView 5.11 calls Position, and 5.13 Translation."""
    name = "Translation" if "Translation" in display.ListProperties() else "Position"
    setattr(display, name, offset)


def set_functions(array="Scalars"):
    """The colour map and the opacity function that displays of an array of this name use."""
    colors = simple.GetColorTransferFunction(array)
    colors.ColorSpace = "RGB"
    colors.RGBPoints = COLORS
    opacity = simple.GetOpacityTransferFunction(array)
    opacity.Points = OPACITIES
    return colors, opacity


def show(source, view, representation="Optimized Volume", array=("POINTS", "Scalars")):
    """Shows a source without the score, which is no part of the volume's picture."""
    source.UpdatePipeline()
    display = simple.Show(source, view)
    simple.ColorBy(display, array)
    set_functions(array[1])
    display.ScalarOpacityUnitDistance = UNIT_DISTANCE
    display.SetScalarBarVisibility(view, False)
    display.ShowScore = 0
    display.SetRepresentationType(representation)
    return display


def show_head(view, resolution=48, **settings):
    display = show(simple.OcclusionPhantom(Resolution=resolution, Scene="Head"), view)
    for name, value in settings.items():
        setattr(display, name, value)
    return display


class DisplayTest(unittest.TestCase):
    """Each test has a new view, and nothing else is there."""

    def setUp(self):
        clear()
        self.view = new_view()


class SampledDisplayTest(DisplayTest):
    """Data that are no image, compared with an image of 32 x 32 x 32 points of the same field."""

    def shown(self, source, array=("POINTS", "Scalars"), **settings):
        """The display of a source, and its picture."""
        display = show(source, self.view, array=array)
        for name, value in settings.items():
            setattr(display, name, value)
        picture = pictures.take(self.view)
        display.UpdatePropertyInformation()
        simple.Hide(source, self.view)
        return display, picture

    def assert_alike(self, sources, image, array=("POINTS", "Scalars"), **settings):
        """Sources, by names, have the image's picture and scores."""
        expected, picture = self.shown(image, array, **settings)
        self.assertEqual(expected.SampledAt, "")
        for name, source in sources.items():
            with self.subTest(name):
                display, same = self.shown(source, array, **settings)
                self.assertEqual(display.SampledAt, "sampled at 32 x 32 x 32 points")
                self.assertEqual(display.Messages, "")
                self.assertAlmostEqual(display.VisibilityScore / expected.VisibilityScore, 1, delta=0.005)
                self.assertAlmostEqual(display.VisibleFraction / expected.VisibleFraction, 1, delta=0.005)
                self.assertLess(abs(same - picture).mean(), 1)
