# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What ParaView is told about the representation type "Optimized Volume" has to be what its mapper
# does: defaults and enumerations.

import os
import unittest
import xml.etree.ElementTree as ElementTree

# What the extension module depends on.
import vtkmodules.vtkRenderingVolume  # noqa: F401
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

XML = os.path.join(os.environ["LIMPID_XML"], "LimpidRepresentations.xml")
# Of the representation itself.
NOT_OF_THE_MAPPER = {"ImageDimensions", "ShowScore", "ScoreInScreenshots", "StructureLegend"}


def properties():
    """Those that are set, but for functions, buttons, and arrays, whose choice is ParaView's."""
    proxy = ElementTree.parse(XML).getroot().find(".//OptimizedVolumeRepresentationProxy")
    return [element for element in proxy if element.get("command") and
            element.tag.endswith("VectorProperty") and not element.get("information_only") and
            element.find("ArrayListDomain") is None and
            element.get("name") not in NOT_OF_THE_MAPPER]


def group(label):
    """The properties of a group of the panel."""
    root = ElementTree.parse(XML).getroot()
    proxy = root.find(".//OptimizedVolumeRepresentationProxy")
    names = [element.get("name") for element in
             root.find(f".//ExposedProperties/PropertyGroup[@label='{label}']").findall("Property")]
    return [proxy.find(f"*[@name='{name}']") for name in names]


class TestRepresentationDefaults(unittest.TestCase):
    def test_defaults_are_those_of_the_mapper(self):
        mapper = Mapper()
        self.assertGreater(len(properties()), 30)
        for element in properties():
            with self.subTest(property=element.get("name")):
                if element.get("repeat_command"):
                    self.assertEqual(getattr(mapper, "GetNumberOf" + element.get("name"))(), 0)
                    continue
                value = getattr(mapper, "Get" + element.get("name"))()
                expected = value if isinstance(value, tuple) else (value,)
                defaults = tuple(float(text) for text in element.get("default_values").split())
                self.assertEqual(defaults, tuple(float(number) for number in expected))
                self.assertEqual(int(element.get("number_of_elements")), len(expected))

    def test_enumerations_are_those_of_the_mapper(self):
        for element in properties():
            for entry in element.findall("EnumerationDomain/Entry"):
                with self.subTest(property=element.get("name"), entry=entry.get("text")):
                    constant = entry.get("text").upper().replace(" ", "_")
                    self.assertEqual(int(entry.get("value")), getattr(Mapper, constant))

    def test_the_panel_has_few_rows_that_say_what_they_are(self):
        rows = group("Optimized Volume")
        shown = [row.get("name") for row in rows
                 if row.get("panel_visibility", "default") == "default"]
        self.assertLessEqual(len(shown) + len(["Shade", "UseCropping"]), 8, shown)
        for row in rows:
            with self.subTest(property=row.get("name")):
                self.assertGreater(len(row.findtext("Documentation", "").split()), 3)

    def test_numbers_have_sliders(self):
        # This one has a slider of its own, over powers of ten.
        own = "ClearingThreshold"
        for row in group("Optimized Volume") + group("Light of the Volume"):
            if row.tag == "DoubleVectorProperty" and row.get("number_of_elements") == "1":
                with self.subTest(property=row.get("name")):
                    limits = row.find("DoubleRangeDomain")
                    self.assertTrue(row.get("name") == own or
                                    (limits.get("min") and limits.get("max")))


if __name__ == "__main__":
    unittest.main()
