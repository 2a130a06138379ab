# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The presets of the representation type "Optimized Volume" as scripts see them.

import os

from paraview import simple, smstate
from paraview.vtk.vtkCommonCore import vtkOutputWindow

import displays
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
# Of the display. Those that do not differ between presets are left out but for Default.
DEFAULT = {"ViewWeight": 10, "LightWeight": 1, "RegularizationWeight": 1e-3,
           "ClearingThreshold": 3e-3, "ProtectImportance": 1, "Emphasis": 0,
           "ImportanceSmoothing": 1, "Smoothness": 0.2, "TemporalCoherence": 0.2}
PRESETS = {"Default": DEFAULT,
           "Keep Context": {**DEFAULT, "ClearingThreshold": 0.3},
           "Strong Reveal": {**DEFAULT, "ClearingThreshold": 3e-4, "ProtectImportance": 0.1},
           "Paper": {**DEFAULT, "ClearingThreshold": 0, "ProtectImportance": 0, "Emphasis": 1,
                     "ImportanceSmoothing": 0, "Smoothness": 0, "TemporalCoherence": 0}}
NAMES = sorted(DEFAULT)


def values(proxy):
    return {name: float(proxy.GetProperty(name).SMProperty.GetElement(0)) for name in NAMES
            if proxy.GetProperty(name)}


def change_all(proxy):
    for name in values(proxy):
        value = 0 if name == "ImportanceSmoothing" else 0.5
        proxy.GetProperty(name).SMProperty.SetElement(0, value)


class TestPresets(displays.DisplayTest):
    def setUp(self):
        super().setUp()
        phantom = OcclusionPhantom(registrationName="phantom", Resolution=12)
        self.display = simple.Show(phantom, self.view)
        self.display.SetRepresentationType("Optimized Volume")
        self.errors = []

        def observe(_, __, text):
            self.errors.append(text)
        observe.CallDataType = "string0"
        window = vtkOutputWindow.GetInstance()
        tag = window.AddObserver("ErrorEvent", observe)
        self.addCleanup(window.RemoveObserver, tag)

    def test_set_their_values(self):
        for name, expected in PRESETS.items():
            with self.subTest(preset=name):
                change_all(self.display)

                self.display.Preset = name

                self.assertEqual(values(self.display), expected)
                self.assertEqual(self.errors, [])

    def test_displays_start_with_the_first(self):
        self.assertEqual(values(self.display), DEFAULT)

    def test_are_found_without_capital_letters(self):
        for name, expected in PRESETS.items():
            for written in (name.lower(), name.capitalize()):
                change_all(self.display)

                self.display.Preset = written

                self.assertEqual(values(self.display), expected)

    def test_set_what_filters_have_of_it(self):
        for make, without in ((ExtinctionOptimizer, ("TemporalCoherence",)),
                              (ViewpointSearch, ("TemporalCoherence", "Smoothness"))):
            proxy = make(Input=simple.FindSource("phantom"))
            start = values(proxy)
            for name, values_of_display in PRESETS.items():
                expected = {setting: 0 if setting in without else value
                            for setting, value in values_of_display.items() if setting in start}
                with self.subTest(filter=make.__name__, preset=name):
                    self.assertTrue(name != "Default" or start == expected)
                    change_all(proxy)

                    proxy.Preset = name

                    self.assertEqual(values(proxy), expected)

    def test_come_to_the_filter(self):
        optimizer = ExtinctionOptimizer(Input=simple.FindSource("phantom"), Preset="Paper")
        optimizer.UpdatePipeline()
        printed = str(optimizer.GetClientSideObject())

        for name, value in (("Emphasis", 1), ("ProtectImportance", 0), ("ClearingThreshold", 0)):
            self.assertRegex(printed, rf"{name}: {value}\n")

    def test_the_regularization_weight_counts_when_it_is_set(self):
        for proxy in (self.display, ExtinctionOptimizer(Input=simple.FindSource("phantom"))):
            proxy.RegularizationWeight = 0.02
            self.assertEqual(proxy.ClearingThreshold, 0)
            proxy.ClearingThreshold = 0.1
            self.assertEqual(proxy.RegularizationWeight, 0.02)
            proxy.Preset = "Default"
            self.assertEqual(proxy.ClearingThreshold, 3e-3)
            self.assertEqual(proxy.RegularizationWeight, 1e-3)
            proxy.UpdateVTKObjects()

    def test_an_unknown_name_raises_and_changes_nothing(self):
        for proxy in (self.display, ExtinctionOptimizer(Input=simple.FindSource("phantom"))):
            proxy.ViewWeight = 3
            before = values(proxy)

            with self.assertRaisesRegex(ValueError, "Nonsense"):
                proxy.Preset = "Nonsense"

            self.assertEqual(values(proxy), before)
            self.assertEqual(self.errors, [])
        with self.assertRaises(ValueError):
            ExtinctionOptimizer(Preset="Nonsense")

    def test_an_unknown_number_changes_nothing_and_says_which_names_there_are(self):
        before = values(self.display)

        self.display.Preset = 5

        self.assertEqual(values(self.display), before)
        self.assertEqual(len(self.errors), 1)
        self.assertIn("Default, Keep Context, Strong Reveal, Paper.", self.errors[0])

    def test_have_no_state_of_their_own(self):
        self.display.Preset = "Strong Reveal"

        self.assertEqual(self.display.Preset, "")
        state = smstate.get_state()
        self.assertNotIn("Preset", state)
        self.assertRegex(state, displays.sets("ClearingThreshold", 0.0003))
        self.assertRegex(state, displays.sets("ProtectImportance", 0.1))


if __name__ == "__main__":
    runner.run()
