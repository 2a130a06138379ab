# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What someone sees who opens data, chooses "Optimized Volume" and does nothing else.

import os

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

import displays
import runner
from noise import NOISE, noisy_ball, speck_share

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
SCENES = os.path.join(os.path.dirname(__file__), "..", "..", "..", "shared", "data")
NAMES = ["visible_male", "engine", "carotid_mra", "isabel_wind", "vortex_rings", "thorax_ct",
         "skull_phantom"]
EVERY = 1 if os.environ.get("LIMPID_TEST_LONG") == "1" else 2  # point of a scene along each axis
WHOLE_RANGE = [0, 0, 0.5, 0, 1, 1, 0.5, 0]


def ramp(values):
    """Points of the function over which importance is to rise, by NumPy: all data lie on it."""
    least, begin, end, most = np.quantile(values, [0, 0.95, 0.99, 1])
    return [least, 0, 0.5, 0, begin, 0, 0.5, 0, end, 1, 0.5, 0, most, 1, 0.5, 0]


class TestFirstPicture(displays.DisplayTest):
    def shown(self, source):
        display = simple.Show(source, self.view)
        display.SetRepresentationType("Optimized Volume")
        return display

    def drawn(self, source):
        display = self.shown(source)
        simple.ResetCamera(self.view)
        simple.Render(self.view)
        return display

    def assert_points(self, display, expected):
        # Quantiles of all values and of a part of them.
        tolerance = 2e-3 * (abs(expected[4]) + abs(expected[8]))
        np.testing.assert_allclose(list(display.ImportanceFunction.Points), expected,
                                   atol=tolerance, rtol=0)

    def test_shows_more_than_ordinary_rendering_without_a_message(self):
        missing = []
        for name in [*NAMES, None]:
            file = os.path.join(SCENES, f"{name}.vti")
            if name and not os.path.exists(file):
                missing.append(name)
                continue
            with self.subTest(name=name):
                whole = simple.XMLImageDataReader(FileName=[file]) if name else simple.Wavelet()
                whole.UpdatePipeline()
                source = simple.ExtractSubset(
                    Input=whole, VOI=whole.GetDataInformation().GetExtent(), SampleRateI=EVERY,
                    SampleRateJ=EVERY, SampleRateK=EVERY)
                display = self.drawn(source)

                self.assertEqual(display.Messages, "")
                self.assertGreater(display.VisibleFraction, 1.15 * display.BaseVisibleFraction)
                simple.Delete(display)
                simple.Delete(source)
                simple.Delete(whole)
        if missing:
            self.skipTest("Without these scenes, which are not here: " + ", ".join(missing))

    def test_takes_the_largest_values_for_important_and_says_so(self):
        source = simple.Wavelet()
        display = self.shown(source)
        self.assertEqual(display.UseImportanceFunction, 0)

        simple.ResetCamera(self.view)
        simple.Render(self.view)

        source.UpdatePipeline()
        values = vtk_to_numpy(simple.servermanager.Fetch(source).GetPointData().GetScalars())
        self.assertEqual(display.UseImportanceFunction, 1)
        self.assert_points(display, ramp(values))
        fraction = display.VisibleFraction
        simple.Render(self.view)
        self.assertEqual(display.VisibleFraction, fraction, "another picture")

    def test_begins_above_the_noise(self):
        values = noisy_ball()
        image = vtkImageData()
        image.SetDimensions(values.shape)
        image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
        image.GetPointData().GetScalars().SetName("density")
        source = simple.TrivialProducer()
        source.GetClientSideObject().SetOutput(image)

        display = self.drawn(source)

        of_all = ramp(values)
        begin, end = display.ImportanceFunction.Points[4], display.ImportanceFunction.Points[8]
        self.assertEqual(display.Messages, "")
        self.assertGreater(speck_share(values, of_all[4], of_all[8]), 0.1)
        self.assertLess(speck_share(values, begin, end), 0.1)
        self.assertLess(end, 1 + 3 * NOISE, "the ball is still important")
        self.assertGreater(display.VisibleFraction, 1.15 * display.BaseVisibleFraction)

    def test_starts_in_every_view(self):
        source = simple.Wavelet()
        points = list(self.drawn(source).ImportanceFunction.Points)
        self.view = displays.new_view()

        display = self.drawn(source)

        self.assertEqual(display.Messages, "")
        self.assertEqual(list(display.ImportanceFunction.Points), points)

    def test_leaves_data_with_importance_alone(self):
        display = self.shown(OcclusionPhantom(Resolution=12))
        points = list(display.ImportanceFunction.Points)

        simple.Render(self.view)

        self.assertEqual(display.Messages, "")
        self.assertEqual(display.UseImportanceFunction, 0)
        self.assertEqual(list(display.ImportanceFunction.Points), points)

    def test_follows_the_array_as_long_as_nobody_has_changed_the_points(self):
        share = simple.Calculator(Input=simple.Wavelet(), ResultArrayName="share",
                                  Function="RTData/300")
        source = simple.Calculator(Input=share, ResultArrayName="large", Function="1000*RTData")
        display = self.drawn(source)
        large = list(display.ImportanceFunction.Points)
        display.ImportanceArray = ["POINTS", "RTData"]
        self.assert_points(display, np.divide(large, 4 * [1000, 1, 1, 1]))

        display.ImportanceArray = ["POINTS", "share"]
        self.assertEqual(display.UseImportanceFunction, 0, "shares are importance themselves")
        self.assertEqual(list(display.ImportanceFunction.Points), WHOLE_RANGE)

        display.ImportanceArray = ["POINTS", "large"]
        display.UseImportanceFunction = 1
        self.assertEqual(list(display.ImportanceFunction.Points), large)
        simple.Render(self.view)
        self.assertEqual(display.Messages, "")

        own = [100, 0, 0.5, 0, 200, 1, 0.5, 0]
        display.ImportanceFunction.Points = own
        display.ImportanceArray = ["POINTS", "RTData"]
        self.assertEqual(list(display.ImportanceFunction.Points), own)

    def test_stays_off_once_it_was_switched_off(self):
        display = self.drawn(simple.Wavelet())
        display.UseImportanceFunction = 0

        simple.Render(self.view)
        self.assertEqual(display.UseImportanceFunction, 0)

        view = displays.through_a_state()
        display = simple.GetDisplayProperties(list(simple.GetSources().values())[0], view)
        self.assertEqual(display.UseImportanceFunction, 0)

    def test_has_no_idea_where_all_values_are_alike(self):
        source = simple.Wavelet(Maximum=0, XMag=0, YMag=0, ZMag=0)
        display = self.drawn(source)

        self.assertIn("importance", display.Messages)
        self.assertEqual(display.UseImportanceFunction, 0)


if __name__ == "__main__":
    runner.run()
