# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What is seen of the result of the filter Extinction Optimizer: in a display that nobody has set
# anything of, on integer data, and in the place of the opacity function of other data.

import os

import numpy as np
from paraview import simple, smtrace
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import displays
import pictures
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
vars(simple).update(OcclusionPhantom=OcclusionPhantom)

# Defaults of the display that are not those of the filter.
AS_THE_DISPLAY = dict(RestrictToView=1)


def data(kind="Unsigned Short", name="Values", resolution=32):
    """The head with its values as numbers of another type, from 0 to 1000."""
    return simple.Calculator(Input=OcclusionPhantom(Resolution=resolution), ResultArrayName=name,
                             Function="floor(1000*Scalars)", ResultArrayType=kind)


def optimized(source, **settings):
    """The filter for the camera of the tests' views, with a light of its own."""
    source.UpdatePipeline()
    result = ExtinctionOptimizer(Input=source, ExtinctionSource="Array",
                                 CameraPosition=displays.POSITIONS[0], CameraViewUp=[0, 0, 1],
                                 LightPosition=[3, -4, 5], **settings)
    result.ScalarArray = ["POINTS", "Values"]
    result.ExtinctionArray = ["POINTS", "BaseExtinction"]
    return result


def set_colors(array):
    colors = simple.GetColorTransferFunction(array)
    colors.ColorSpace = "RGB"
    colors.RGBPoints = [1000 * number if i % 4 == 0 else number
                        for i, number in enumerate(displays.COLORS)]


class TestFoundExtinction(displays.DisplayTest):
    def shown(self, source, **settings):
        """As a script does that sets nothing but these."""
        display = simple.Show(source, self.view)
        self.view.Update()
        for name, value in settings.items():
            setattr(display, name, value)
        return display

    def picture(self, display):
        display.SetScalarBarVisibility(self.view, False)
        display.ShowScore = 0
        return pictures.take(self.view)

    def assert_starts(self, display, filter_):
        self.assertEqual(display.Representation, "Optimized Volume")
        self.assertEqual((display.ExtinctionSource, display.Method), ("Array", "Ordinary"))
        self.assertEqual(list(display.ExtinctionArray), ["POINTS", "Extinction"])
        self.assertEqual(list(display.ColorArrayName), list(filter_.ScalarArray))

    # What is seen without any choice

    def test_the_result_is_shown_as_it_was_found(self):
        result = optimized(data())
        display = self.shown(result)

        self.assert_starts(display, result)
        # The score is taken in single precision from the same field, with the rays of the view.
        set_colors("Values")
        picture = self.picture(display)
        self.assertGreater(picture.std(axis=(0, 1)).max(), 10)
        self.assertEqual(display.Messages, "")
        display.RestrictToView = 0
        simple.Render(self.view)
        score = result.FieldData["VisibilityScore"].GetRange()[0]
        self.assertAlmostEqual(display.VisibilityScore, score, delta=1e-3 * score)

    def test_integers_look_like_their_copy_in_floating_point(self):
        taken = []
        for kind in ("Unsigned Short", "Float"):
            display = self.shown(optimized(data(kind)))
            set_colors("Values")
            taken.append(self.picture(display))
            displays.clear()
            self.view = displays.new_view()
        self.assertGreater(taken[0].std(axis=(0, 1)).max(), 10)
        np.testing.assert_array_equal(*taken)

    def test_looks_like_the_display_that_optimizes(self):
        # With emphasis, the optimisation changes more of the picture.
        result = optimized(data(resolution=48), Emphasis=1, **AS_THE_DISPLAY)
        # Unlit: surfaces are those of the base extinction, and that of the result has those of cuts.
        display = self.shown(result, LightSource="Own", LightPosition=[3, -4, 5], Shadows=0,
                             Emphasis=1)
        set_colors("Values")
        found = self.picture(display)
        display.ExtinctionArray = ["POINTS", "BaseExtinction"]
        before = self.picture(display)
        display.Method = "Optimized"
        converged = self.picture(display)
        score = result.FieldData["VisibilityScore"].GetRange()[0]
        self.assertAlmostEqual(display.VisibilityScore, score, delta=1e-3 * score)

        # Between points, the display that optimizes interpolates the base and the share of it that
        # is kept, the other one their product: different only in cells that a cut passes.
        apart, _ = pictures.difference(found, converged)
        cleared, _ = pictures.difference(before, converged)
        self.assertGreater(cleared, 5)
        self.assertLess(apart, 0.1 * cleared)

    def test_the_table_is_not_shown(self):
        result = optimized(data(resolution=12))
        controller = vtkSMParaViewPipelineControllerWithRendering()
        views = len(simple.GetViews())
        controller.ShowInPreferredView(result.SMProxy, 1, None)
        self.assertEqual(len(simple.GetViews()), views)
        self.assertEqual(len(self.view.Representations), 0)

    # What is left alone

    def test_what_a_script_sets_stays(self):
        display = self.shown(optimized(data(resolution=12)), Method="Optimized",
                             ExtinctionSource="Opacity Function")
        simple.ColorBy(display, ("POINTS", "Scalars"))
        for kind in ("Volume", "Optimized Volume", "Outline", "Optimized Volume"):
            display.SetRepresentationType(kind)
            simple.Render(self.view)
        self.assertEqual((display.ExtinctionSource, display.Method),
                         ("Opacity Function", "Optimized"))
        self.assertEqual(list(display.ColorArrayName), ["POINTS", "Scalars"])

    def test_what_a_script_sets_before_the_type_stays(self):
        controller = vtkSMParaViewPipelineControllerWithRendering()
        result = optimized(data(resolution=12))
        result.UpdatePipeline()
        proxies = simple.servermanager.ProxyManager()
        display = simple.servermanager._getPyProxy(
            proxies.NewProxy("representations", "UniformGridRepresentation"))
        controller.PreInitializeProxy(display.SMProxy)
        display.Input = result
        controller.PostInitializeProxy(display.SMProxy)
        display.Method = "Ament 2017"
        self.view.Representations.append(display)
        display.SetRepresentationType("Optimized Volume")
        self.assertEqual((display.ExtinctionSource, display.Method),
                         ("Opacity Function", "Ament 2017"))

    def test_displays_of_other_data_are_as_ever(self):
        later = simple.Calculator(Input=optimized(data(resolution=12)), ResultArrayName="twice",
                                  Function="2*Extinction")
        for source in (data(resolution=12), later):
            display = self.shown(source)
            self.assertNotEqual(display.Representation, "Optimized Volume")
            display.SetRepresentationType("Optimized Volume")
            self.assertEqual((display.ExtinctionSource, display.Method),
                             ("Opacity Function", "Optimized"))

    def test_a_state_says_what_is_shown(self):
        display = self.shown(optimized(data(resolution=12)), Method="Optimized",
                             ExtinctionSource="Opacity Function")
        view = displays.through_a_state()
        result = next(source for (name, _), source in simple.GetSources().items()
                      if name.startswith("ExtinctionOptimizer"))
        display = simple.GetDisplayProperties(result, view)
        self.assertEqual(display.Representation, "Optimized Volume")
        self.assertEqual((display.ExtinctionSource, display.Method),
                         ("Opacity Function", "Optimized"))

    def test_a_trace_says_what_is_shown(self):
        smtrace.start_trace()
        try:
            self.shown(optimized(data(resolution=12)))
        finally:
            text = smtrace.stop_trace()
        for name, value in (("Representation", "Optimized Volume"),
                            ("ExtinctionSource", "Array"), ("Method", "Ordinary")):
            self.assertRegex(text, displays.sets(name, value))

    # Other data

    def test_an_array_takes_the_place_of_the_opacity_function(self):
        display = displays.show(simple.OcclusionPhantom(Resolution=32), self.view)
        display.Method = "Ordinary"
        expected = pictures.take(self.view)
        display.ExtinctionSource = "Array"
        display.ExtinctionArray = ["POINTS", "BaseExtinction"]
        first = pictures.take(self.view)
        simple.GetOpacityTransferFunction("Scalars").Points = [0, 1, 0.5, 0, 1, 1, 0.5, 0]
        display.ScalarOpacityUnitDistance = 1e-3

        self.assertEqual(display.Messages, "")
        np.testing.assert_array_equal(pictures.take(self.view), first)
        self.assertGreater(pictures.difference(first, expected)[0], 1)

        display.ExtinctionArray = ["POINTS", "Absent"]
        simple.Render(self.view)
        self.assertIn('"Absent"', display.Messages)


if __name__ == "__main__":
    runner.run()
