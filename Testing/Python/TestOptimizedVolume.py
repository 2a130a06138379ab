# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The representation type "Optimized Volume" as scripts see it: properties, what is chosen by
# itself, scores, messages.

import os
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
from paraview import simple

import displays
import pictures
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
vars(simple).update(OcclusionPhantom=OcclusionPhantom)
XML = os.path.join(os.environ["LIMPID_XML"], "LimpidRepresentations.xml")


def image_source(dimensions, spacing=(1, 1, 1), **arrays):
    """An image; every keyword is a point array, given as a Python expression of x, y and z."""
    lines = ["import numpy as np", "output.SetDimensions({})".format(list(dimensions)),
             "output.SetSpacing({})".format(list(spacing)),
             "n = np.indices({})".format(list(reversed(dimensions))),
             "z, y, x = (c.ravel().astype(float) for c in n)"]
    for name, expression in arrays.items():
        lines.append("output.PointData.append(np.asarray({}), '{}')".format(expression, name))
    upper = [n - 1 for n in dimensions]
    return simple.ProgrammableSource(
        OutputDataSetType="vtkImageData", Script="\n".join(lines), ScriptRequestInformation="""
from paraview import vtk
self.GetOutputInformation(0).Set(vtk.vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(),
                                 0, {}, 0, {}, 0, {})
""".format(*upper))


class TestOptimizedVolume(displays.DisplayTest):
    def shown(self, source, **settings):
        """Shows a source as a script does that sets nothing but the type, and these."""
        source.UpdatePipeline()
        display = simple.Show(source, self.view)
        display.SetRepresentationType("Optimized Volume")
        for name, value in settings.items():
            setattr(display, name, value)
        return display

    def assert_draws(self, display, message=""):
        """There is a picture with finite pixels, and a message that contains these words."""
        simple.ResetCamera(self.view)
        display.ShowScore = 0
        picture = pictures.take(self.view)
        self.assertGreater(picture.std(axis=(0, 1)).max(), 1)
        self.assert_says(display, message)

    def assert_says(self, display, message):
        if message:
            self.assertIn(message, display.Messages)
        else:
            self.assertEqual(display.Messages, "")

    # Properties

    def test_shade_is_a_row_as_for_volume(self):
        display = self.shown(OcclusionPhantom())
        self.assertEqual(display.GetProperty("Shade").SMProperty.GetPanelVisibility(), "default")

    def test_has_the_properties_of_the_contract(self):
        display = simple.Show(OcclusionPhantom(), self.view)

        self.assertIn("Optimized Volume", display.GetProperty("Representation").GetAvailable())
        self.assertLessEqual(
            {"ImportanceArray", "UseImportanceFunction", "ImportanceFunction",
             "ExtinctionSource", "ExtinctionArray",
             "RegularizationWeight", "ClearingThreshold", "ViewWeight", "LightWeight", "LightType",
             "LightPosition",
             "Mode", "Solver", "MaximumIterations", "Tolerance", "MaximumSeconds", "Derivative",
             "RayDensity", "SkipUnneeded", "RestrictToView", "ProtectImportance", "Emphasis",
             "Backend",
             "ImportanceSmoothing", "Smoothness",
             "Optimization", "Preset", "Shadows", "ShadowStrength", "Ambient", "Anisotropy",
             "SpecularPower", "LightIntensity", "Method", "ShowScore", "ScoreInScreenshots", "ShowMissed",
             "VisibilityScore", "VisibleFraction", "AttainableFraction", "AttainableScore",
             "AttainableLightScore", "Converged"},
            set(display.ListProperties()))

    def test_is_not_for_surfaces(self):
        display = simple.Show(simple.Sphere(), self.view)
        self.assertNotIn("Optimized Volume", display.GetProperty("Representation").GetAvailable())

    def test_shares_the_properties_that_surfaces_have_too(self):
        display = self.shown(OcclusionPhantom(Resolution=24))
        display.Ambient = 0.25
        display.SpecularPower = 7
        display.Anisotropy = 0.5

        self.assertEqual(display.VolumeAmbient, 0.25)
        self.assertEqual(display.VolumeSpecularPower, 7)
        self.assertEqual(display.ScatteringAnisotropy, 0.5)

    def test_every_property_is_documented_and_in_one_group(self):
        root = ElementTree.parse(XML).getroot()
        proxy = root.find(".//OptimizedVolumeRepresentationProxy")
        defined = [element.get("name") for element in proxy
                   if element.tag.endswith("Property")]
        exposed = root.find(".//ExposedProperties")
        grouped = [entry.get("name") for entry in exposed.iter("Property")]
        self.assertEqual(sorted(grouped), sorted(defined))
        for element in proxy:
            if element.tag.endswith("Property"):
                with self.subTest(property=element.get("name")):
                    text = " ".join((element.findtext("Documentation") or "").split())
                    self.assertTrue(text.endswith("."), "no documentation, or no sentence")

    def test_every_property_that_is_set_has_a_domain(self):
        proxy = ElementTree.parse(XML).getroot().find(".//OptimizedVolumeRepresentationProxy")
        for element in proxy:
            if element.tag.endswith("VectorProperty") and element.get("command") and \
                    not element.get("information_only"):
                with self.subTest(property=element.get("name")):
                    self.assertTrue(any(child.tag.endswith("Domain") for child in element))

    def test_labels_are_the_names_in_words_and_unique_in_the_display(self):
        # Scripts and traces know properties by their labels.
        display = simple.Show(OcclusionPhantom(), self.view)
        labels = [display.GetProperty(name).SMProperty.GetXMLLabel().replace(" ", "")
                  for name in display.ListProperties()]
        proxy = ElementTree.parse(XML).getroot().find(".//OptimizedVolumeRepresentationProxy")
        for element in proxy:
            if element.tag.endswith("Property"):
                with self.subTest(property=element.get("name")):
                    self.assertRegex(element.get("name"), "^([A-Z][a-z]+)+$")
                    self.assertEqual(element.get("label"), None)  # made of the name
                    self.assertEqual(labels.count(element.get("name")), 1)

    def test_few_properties_are_in_the_default_panel(self):
        proxy = ElementTree.parse(XML).getroot().find(".//OptimizedVolumeRepresentationProxy")
        rows = [element.get("name") for element in proxy
                if element.tag.endswith("Property") and
                element.get("panel_visibility", "default") == "default"]

        self.assertLessEqual(len(rows), 8, rows)

    # What is chosen by itself

    def test_is_never_invisible_for_want_of_a_color_array(self):
        display = self.shown(OcclusionPhantom(Resolution=32))

        self.assertEqual(list(display.ColorArrayName), ["POINTS", "Scalars"])
        self.assertIsNotNone(display.LookupTable)
        self.assert_draws(display)

    def test_shows_an_array_of_its_own_choice_when_the_color_is_solid(self):
        display = self.shown(OcclusionPhantom(Resolution=32))
        display.ColorArrayName = [None, ""]
        display.LookupTable = None
        display.ScalarOpacityFunction = None

        self.assert_draws(display, "No array is chosen for coloring")

    def test_keeps_the_color_map_that_an_array_has(self):
        colors = simple.GetColorTransferFunction("RTData")
        colors.RGBPoints = [100, 0, 0, 0, 200, 1, 1, 1]
        display = self.shown(simple.Wavelet())

        self.assertEqual(list(display.ColorArrayName), ["POINTS", "RTData"])
        self.assertEqual(list(colors.RGBPoints), [100, 0, 0, 0, 200, 1, 1, 1])

    def test_keeps_the_color_array_that_was_chosen(self):
        source = OcclusionPhantom(Resolution=24)
        display = simple.Show(source, self.view)
        simple.ColorBy(display, ("POINTS", "BaseExtinction"))
        display.SetRepresentationType("Optimized Volume")

        self.assertEqual(list(display.ColorArrayName), ["POINTS", "BaseExtinction"])

    def test_takes_the_array_importance(self):
        display = self.shown(OcclusionPhantom(Resolution=32))
        simple.Render(self.view)

        self.assertEqual(list(display.ImportanceArray), ["POINTS", "Importance"])
        self.assertGreater(display.VisibleFraction, display.BaseVisibleFraction)

    def test_stays_near_a_reference(self):
        display = self.shown(OcclusionPhantom(Resolution=32), ReferencePull=0)
        simple.Render(self.view)
        cleared = display.VisibleFraction
        self.assertEqual(list(display.ReferenceArray), ["POINTS", "(None)"])
        display.ReferenceArray = ["POINTS", "BaseExtinction"]
        display.ReferencePull = 100
        simple.Render(self.view)

        self.assert_says(display, "")
        self.assertLess(display.VisibleFraction,
                        display.BaseVisibleFraction + 0.5 * (cleared - display.BaseVisibleFraction))

    def test_makes_importance_of_the_color_array_by_a_function(self):
        display = self.shown(simple.Wavelet(), UseImportanceFunction=1)
        display.ImportanceFunction.Points = [180, 0, 0.5, 0, 277, 1, 0.5, 0]
        simple.Render(self.view)

        self.assertEqual(list(display.ImportanceArray), ["POINTS", "(Color Array)"])
        self.assert_says(display, "")
        self.assertGreater(display.VisibleFraction, 0)

    def test_draws_ordinarily_and_says_so_without_importance(self):
        display = self.shown(simple.Wavelet(), ImportanceArray=["POINTS", "not there"])

        self.assert_draws(display, "The importance array \"not there\" is not among")
        self.assertEqual(display.VisibleFraction, 0)
        self.assertEqual(display.Converged, 1)

    def test_says_that_a_chosen_array_is_missing_whatever_its_name(self):
        for name in ("Importance", "importance"):
            with self.subTest(name):
                display = self.shown(simple.Wavelet(), ImportanceArray=["POINTS", name])
                self.assert_draws(display, f"The importance array \"{name}\" is not among")
                self.assertEqual(display.VisibleFraction, 0)
                simple.Delete(display)
        display = self.shown(simple.Wavelet())  # nothing is chosen
        self.assert_draws(display)
        self.assertGreater(display.VisibleFraction, 0)

    def test_takes_one_component_of_a_vector(self):
        source = image_source((12, 12, 12), v="np.stack([x, 0 * x, 0 * x], axis=1)")
        display = self.shown(source, ShowScore=0)
        simple.ResetCamera(self.view)
        taken = {}
        for component in ("X", "Y", "Magnitude"):
            simple.ColorBy(display, ("POINTS", "v", component))
            taken[component] = pictures.take(self.view)
        display.Visibility = 0

        # The opacity function is zero at zero, which all of the second component is.
        np.testing.assert_array_equal(taken["Y"], pictures.take(self.view))
        np.testing.assert_array_equal(taken["X"], taken["Magnitude"])
        self.assertGreater(np.abs(taken["X"] - taken["Y"]).max(), 50)

    # Scores

    def test_score_is_that_of_the_filter(self):
        source = OcclusionPhantom(Resolution=48)
        display = displays.show(source, self.view)
        display.LightSource = "Own"
        display.LightPosition = [-2.5, -4.5, 4.5]
        optimizer = ExtinctionOptimizer(Input=source)
        optimizer.ScalarArray = ["POINTS", "Scalars"]
        optimizer.ScalarOpacityFunction = simple.GetOpacityTransferFunction("Scalars")
        optimizer.ScalarOpacityUnitDistance = displays.UNIT_DISTANCE
        optimizer.LightPosition = display.LightPosition
        optimizer.CameraFocalPoint = [0, 0, 0]
        optimizer.CameraViewUp = [0, 0, 1]
        optimizer.CameraParallelScale = self.view.CameraParallelScale = 0.9
        variants = [{}, {"Preset": "Default"}, {"RestrictToView": 0}, {"LightType": "Directional"}, {"Mode": "Separate"},
                    {"ViewWeight": 2, "LightWeight": 3, "RegularizationWeight": 0.1},
                    {"Solver": "Adam", "IterationsPerLevel": [4, 4, 4], "Derivative": "Ray"},
                    {"MaximumIterations": 1, "RayDensity": 1.5}, {"ProtectImportance": 0.7},
                    {"Emphasis": 0.4}, {"ClearingThreshold": 0.1},
                    {"ImportanceSmoothing": "Median"}, {"Smoothness": 0.2}]
        for number, variant in enumerate(variants):
            position = displays.POSITIONS[number % len(displays.POSITIONS)]
            parallel = number % 2
            with self.subTest(variant=variant, position=position, parallel=parallel):
                defaults = {"Preset": "Paper", "RestrictToView": 1, "MaximumIterations": 8,
                            "RayDensity": 1}
                for name, value in {**defaults, **variant}.items():
                    setattr(display, name, value)
                    setattr(optimizer, name, value)
                displays.look(self.view, position)
                self.view.CameraParallelProjection = parallel
                simple.Render(self.view)
                optimizer.CameraPosition = position
                optimizer.CameraParallelProjection = parallel
                optimizer.UpdatePipeline()

                # Both run the same solver. The display looks extinctions up in a table of 4096
                # entries, so at a kink of the opacity function they are off by up to a step of it.
                for name in ("VisibilityScore", "BaseVisibilityScore", "VisibleFraction",
                             "BaseVisibleFraction", "AttainableFraction", "AttainableScore",
                             "Iterations"):
                    expected = optimizer.FieldData[name].GetRange()[0]
                    self.assertAlmostEqual(getattr(display, name) / expected, 1, delta=1 / 4096)
                self.assertAlmostEqual(display.SacrificedFraction,
                                       optimizer.FieldData["SacrificedFraction"].GetRange()[0],
                                       delta=1 / 4096)

    def test_information_is_of_the_last_picture(self):
        display = self.shown(OcclusionPhantom(Resolution=32))
        simple.Render(self.view)
        first = display.VisibilityScore
        displays.look(self.view, displays.POSITIONS[2])
        simple.Render(self.view)

        self.assertNotEqual(display.VisibilityScore, first)
        self.assertEqual(display.Converged, 1)
        self.assertGreater(display.Iterations, 0)
        self.assertIn("light", display.LightDescription)
        self.assertIn("CPU", display.BackendName)

    def test_knows_what_could_be_seen_at_most_only_when_it_rests(self):
        display = self.shown(OcclusionPhantom(Resolution=32))
        simple.Render(self.view)
        first = display.AttainableFraction
        self.assertGreater(first, display.VisibleFraction)
        self.assertGreater(display.AttainableScore, display.VisibilityScore)
        displays.look(self.view, displays.POSITIONS[2])
        self.view.SMProxy.InteractiveRender()
        display.UpdatePropertyInformation()
        self.assertEqual(display.AttainableFraction, 0)
        simple.Render(self.view)
        self.assertNotEqual(display.AttainableFraction, first)
        self.assertGreater(display.AttainableFraction, display.VisibleFraction)

        display.Optimization = "Off"
        simple.Render(self.view)
        self.assertEqual(display.AttainableFraction, 0)

    def test_pause_keeps_the_extinction(self):
        display = self.shown(OcclusionPhantom(Resolution=32))
        simple.Render(self.view)
        optimized = display.VisibleFraction
        display.PauseOptimization = 1
        displays.look(self.view, displays.POSITIONS[2])
        simple.Render(self.view)
        paused = display.VisibleFraction
        display.PauseOptimization = 0
        simple.Render(self.view)

        self.assertNotEqual(paused, optimized)
        self.assertGreater(display.VisibleFraction, paused)

    def test_once_keeps_the_first_camera_until_reset(self):
        display = self.shown(OcclusionPhantom(Resolution=32), Optimization="Once")
        simple.Render(self.view)
        displays.look(self.view, displays.POSITIONS[2])
        simple.Render(self.view)
        kept = display.VisibleFraction
        display.ResetOptimization()
        simple.Render(self.view)

        self.assertGreater(display.VisibleFraction, kept)

    def test_works_again_after_it_was_hidden(self):
        source = OcclusionPhantom(Resolution=32)
        display = self.shown(source)
        first = pictures.take(self.view)
        simple.Hide(source, self.view)
        simple.Render(self.view)
        simple.Show(source, self.view)

        np.testing.assert_array_equal(pictures.take(self.view), first)
        self.assertEqual(display.Converged, 1)

    def test_has_nothing_left_to_do_when_it_is_not_drawn(self):
        display = self.shown(OcclusionPhantom(Resolution=24))
        self.view.CameraPosition, self.view.CameraFocalPoint = [0, -50, 0], [0, -100, 0]
        simple.Render(self.view)

        self.assertEqual(display.Converged, 1)

    def test_follows_the_data(self):
        source = OcclusionPhantom(Resolution=24, Scene="Head")
        display = self.shown(source)
        first = pictures.take(self.view)
        source.Scene = "Flame"
        other = pictures.take(self.view)
        source.Scene = "Head"

        self.assertGreater(np.abs(first - other).mean(), 1)
        np.testing.assert_array_equal(pictures.take(self.view), first)
        self.assert_says(display, "")

    def test_every_method_is_drawn_and_scored(self):
        display = self.shown(OcclusionPhantom(Resolution=24))
        ordinary = display.BaseVisibilityScore
        for method in ("Viola 2004", "Marchesin 2010", "Ament 2017"):
            with self.subTest(method=method):
                display.Method = method
                self.assert_draws(display, "")
                self.assertNotEqual(display.VisibilityScore, ordinary)

    # Bad input: a message, no crash, something to look at

    def test_refuses_cuda_in_words(self):
        display = self.shown(OcclusionPhantom(Resolution=24), Backend="CUDA")

        self.assert_draws(display, "CUDA")

    def test_samples_a_rectilinear_grid(self):
        grid = simple.ProgrammableSource(OutputDataSetType="vtkRectilinearGrid", Script="""
import numpy as np
from paraview.vtk.util.numpy_support import numpy_to_vtk
coordinates = numpy_to_vtk(np.array([0.0, 1.0, 3.0, 4.0]), deep=1)
output.SetDimensions(4, 4, 4)
for set in (output.SetXCoordinates, output.SetYCoordinates, output.SetZCoordinates):
    set(coordinates)
output.PointData.append(np.arange(64.0), 'a')
""", ScriptRequestInformation="""
from paraview import vtk
self.GetOutputInformation(0).Set(vtk.vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(),
                                 0, 3, 0, 3, 0, 3)
""")
        display = self.shown(grid)

        self.assert_draws(display)
        display.UpdatePropertyInformation()
        self.assertEqual(display.SampledAt, "sampled at 5 x 5 x 5 points")

    def test_samples_several_blocks(self):
        sides = [simple.Wavelet(WholeExtent=[*along, -10, 10, -10, 10]) for along in ((-10, 0), (0, 10))]
        display = self.shown(simple.GroupDatasets(Input=sides))

        self.assert_draws(display)
        display.UpdatePropertyInformation()
        self.assertEqual(display.SampledAt, "sampled at 21 x 21 x 21 points")

    def test_takes_an_image_that_replaces_other_data(self):
        blocks = simple.GroupDatasets(Input=[simple.Wavelet()])
        blocks.UpdatePipeline()
        display = self.shown(OcclusionPhantom(Resolution=16))
        first = pictures.take(self.view)
        source = display.Input
        display.Input = blocks
        simple.Render(self.view)
        display.Input = source

        np.testing.assert_array_equal(pictures.take(self.view), first)

    def test_says_that_an_importance_array_is_missing(self):
        display = self.shown(OcclusionPhantom(Resolution=24), ImportanceArray=["POINTS", "nothing"])

        self.assert_draws(display, "nothing")

    def test_says_that_a_color_array_is_missing(self):
        display = self.shown(OcclusionPhantom(Resolution=24), ColorArrayName=["POINTS", "nothing"])
        simple.Render(self.view)

        self.assert_says(display, "nothing")

    def test_says_what_it_takes_of_four_components(self):
        source = image_source((12, 12, 12), rgba="np.stack([x, y, z, x], axis=1) / 12")
        display = self.shown(source)

        self.assert_draws(display, "4 components")

    def test_says_that_values_are_not_taken_as_colors(self):
        source = image_source((12, 12, 12), rgba="np.stack([x, y, z, x], axis=1) / 12")
        for name, value in (("MapScalars", 0), ("MultiComponentsMapping", 1)):
            with self.subTest(name=name):
                display = self.shown(source, **{name: value})
                self.assert_draws(display, " ".join(re.findall("[A-Z][a-z]+", name)))
                simple.Delete(display)

    def test_says_that_it_interpolates_linearly_only(self):
        display = self.shown(OcclusionPhantom(Resolution=24), InterpolationType="Nearest")

        self.assert_draws(display, "interpolates")

    def test_says_that_it_has_no_separate_opacity_array(self):
        display = self.shown(OcclusionPhantom(Resolution=24), UseSeparateOpacityArray=1,
                             OpacityArrayName=["POINTS", "Importance"])

        self.assert_draws(display, "Separate Opacity Array")

    def test_draws_what_is_opaque_everywhere(self):
        source = OcclusionPhantom(Resolution=24)
        display = self.shown(source)
        display.ScalarOpacityFunction.Points = [0, 1, 0.5, 0, 1, 1, 0.5, 0]

        self.assert_draws(display)

    def test_says_that_the_unit_distance_is_zero(self):
        display = self.shown(OcclusionPhantom(Resolution=24), ScalarOpacityUnitDistance=0)
        simple.Render(self.view)

        self.assert_says(display, "unit distance")

    def test_draws_with_the_camera_on_and_in_the_box(self):
        display = self.shown(OcclusionPhantom(Resolution=24), ShowScore=0)
        for position in ([0, -1, 0], [0, 0, 0.5], [1, 1, 1], [0, 0, 0]):
            with self.subTest(position=position):
                self.view.CameraPosition = position
                self.view.CameraFocalPoint = [0.01, 0.02, 0]
                self.view.CameraViewUp = [0, 0, 1]
                self.assertTrue(np.isfinite(pictures.take(self.view)).all())

    def test_draws_in_tiny_views(self):
        for size in ([1, 1], [1, 50], [3, 2]):
            with self.subTest(size=size):
                view = displays.new_view(size)
                displays.show(OcclusionPhantom(Resolution=16), view)
                self.assertTrue(np.isfinite(pictures.take(view)).all())

    def test_draws_nothing_of_an_image_without_volume(self):
        for dimensions in ((8, 8, 1), (8, 1, 1), (1, 1, 1)):
            with self.subTest(dimensions=dimensions):
                display = self.shown(image_source(dimensions, a="x"))
                simple.Render(self.view)
                self.assertNotEqual(display.Messages, "")

    def test_draws_values_that_are_not_numbers_as_empty(self):
        source = image_source((12, 12, 12), a="np.where(x > 6, np.nan, x)")
        display = self.shown(source)
        simple.GetColorTransferFunction("a").RescaleTransferFunction(0, 12)
        simple.GetOpacityTransferFunction("a").RescaleTransferFunction(0, 12)

        self.assert_draws(display, "NaN")


if __name__ == "__main__":
    runner.run()
