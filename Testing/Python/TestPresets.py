# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The presets of the representation type "Optimized Volume" as scripts see them.

import os
import xml.etree.ElementTree as ElementTree

from paraview import simple, smstate
from paraview.vtk.vtkCommonCore import vtkOutputWindow

import displays
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
XML = ElementTree.parse(os.path.join(os.environ["LIMPID_XML"], "LimpidRepresentations.xml"))
VOLUME = XML.getroot().find(".//OptimizedVolumeRepresentationProxy")
PRESETS = {preset.get("name"): {value.get("property"): float(value.get("value"))
                                for value in preset.iter("Value")}
           for preset in VOLUME.iter("Preset")}
NAMES = sorted({name for values in PRESETS.values() for name in values})
PAPER = {"ViewWeight": 10, "LightWeight": 1, "RegularizationWeight": 1e-3, "ProtectImportance": 0, "Emphasis": 1,
         "ImportanceSmoothing": 0, "Smoothness": 0}


class TestPresets(displays.DisplayTest):
    def setUp(self):
        super().setUp()
        self.display = simple.Show(OcclusionPhantom(Resolution=12), self.view)
        self.display.SetRepresentationType("Optimized Volume")
        self.defaults = self.values()
        self.errors = []

        def observe(_, __, text):
            self.errors.append(text)
        observe.CallDataType = "string0"
        window = vtkOutputWindow.GetInstance()
        tag = window.AddObserver("ErrorEvent", observe)
        self.addCleanup(window.RemoveObserver, tag)

    def values(self):
        return {name: float(self.display.GetProperty(name).SMProperty.GetElement(0))
                for name in NAMES}

    def test_are_values_of_properties_with_one_number(self):
        self.assertEqual(list(PRESETS), ["Default", "Keep Context", "Strong Reveal", "Paper"])
        for name in NAMES:
            element = VOLUME.find("./*[@name='{}']".format(name))
            self.assertIsNotNone(element, name)
            self.assertEqual(element.get("number_of_elements"), "1", name)

    def test_differ_from_each_other(self):
        seen = []
        for name in PRESETS:
            self.display.Preset = name
            self.assertNotIn(self.values(), seen, name)
            seen.append(self.values())

    def test_set_what_they_name_and_defaults_of_the_rest(self):
        for name, values in PRESETS.items():
            with self.subTest(preset=name):
                for other in NAMES:
                    self.display.GetProperty(other).SMProperty.SetElement(
                        0, 0 if self.defaults[other] else 1)

                self.display.Preset = name

                self.assertEqual(self.values(), {**self.defaults, **values})
                self.assertEqual(self.errors, [])

    def test_the_first_is_the_default(self):
        self.display.Preset = "Paper"
        self.display.Preset = next(iter(PRESETS))

        self.assertEqual(self.values(), self.defaults)

    def test_paper_is_the_paper(self):
        self.display.Preset = "Paper"

        found = self.values()
        self.assertEqual({name: found[name] for name in PAPER}, PAPER)

    def test_an_unknown_name_changes_nothing_and_says_which_there_are(self):
        self.display.ViewWeight = 3
        before = self.values()

        self.display.Preset = "Nonsense"

        self.assertEqual(self.values(), before)
        self.assertEqual(len(self.errors), 1)
        self.assertIn('"Nonsense"', self.errors[0])
        self.assertIn("Default, Keep Context, Strong Reveal, Paper.", self.errors[0])

    def test_have_no_state_of_their_own(self):
        self.display.Preset = "Strong Reveal"

        self.assertEqual(self.display.Preset, "")
        state = smstate.get_state()
        self.assertNotIn("Preset", state)
        self.assertRegex(state, displays.sets("RegularizationWeight", 0.0001))
        self.assertRegex(state, displays.sets("ProtectImportance", 0.1))


if __name__ == "__main__":
    runner.run()
