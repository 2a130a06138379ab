# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What ParaView is told about a class has to be what the class does.

import os
import unittest
import xml.etree.ElementTree as ElementTree

import limpid.vtkLimpidFilters as filters

XML = os.path.join(os.environ["LIMPID_XML"], "LimpidFilters.xml")
PROPERTIES = ("IntVectorProperty", "DoubleVectorProperty", "StringVectorProperty", "ProxyProperty",
              "RegularizationProperty")


def proxies():
    """All that can be made; what they have in common comes with each of them."""
    groups = ElementTree.parse(XML).getroot().iter("ProxyGroup")
    return [proxy for group in groups if group.get("name") in ("sources", "filters")
            for proxy in group.iter("SourceProxy")]


def elements(proxy):
    """Those of the proxy that it is based on, if any, and its own."""
    based = [] if proxy.get("base_proxyname") is None else elements(
        ElementTree.parse(XML).getroot().find(
            f"ProxyGroup[@name='{proxy.get('base_proxygroup')}']"
            f"/SourceProxy[@name='{proxy.get('base_proxyname')}']"))
    return based + list(proxy)


def properties(proxy):
    return [element for element in elements(proxy) if element.tag in PROPERTIES]


class TestPropertyDefaults(unittest.TestCase):
    def test_defaults_are_those_of_the_class(self):
        compared = 0
        for proxy in proxies():
            instance = getattr(filters, proxy.get("class"))()
            for element in properties(proxy):
                command = element.get("command")
                if command == "SetInputArrayToProcess" or element.tag == "ProxyProperty":
                    continue
                with self.subTest(property=element.get("name")):
                    if element.get("repeat_command"):
                        self.assertEqual(command + "s", "Add" + element.get("name"))
                        default = element.get("default_values")
                        entries = (
                            default.split(element.get("default_values_delimiter")) if default
                            else [])
                        self.assertEqual(
                            getattr(instance, "GetNumberOf" + element.get("name"))(), len(entries))
                        # ParaView begins with as many as are said, whatever is listed.
                        self.assertEqual(int(element.get("number_of_elements", 0)), len(entries))
                        if entries:
                            get = getattr(instance, "Get" + element.get("name")[:-1])
                            self.assertEqual({get(i) for i in range(len(entries))}, set(entries))
                        compared += 1
                        continue
                    self.assertEqual(command, "Set" + element.get("name"))
                    value = getattr(instance, "Get" + element.get("name"))()
                    if element.tag == "StringVectorProperty":
                        self.assertEqual(element.get("default_values"), value)
                        compared += 1
                        continue
                    expected = value if isinstance(value, tuple) else (value,)
                    defaults = tuple(float(text) for text in element.get("default_values").split())
                    self.assertEqual(defaults, tuple(float(number) for number in expected))
                    self.assertEqual(int(element.get("number_of_elements")), len(expected))
                    compared += 1
        self.assertGreater(compared, 45)

    def test_enumerations_are_those_of_the_class(self):
        optimizer = filters.vtkExtinctionOptimizer
        search = filters.vtkViewpointSearch
        expected = {
            "ExtinctionSource": {"Opacity Function": optimizer.OPACITY_FUNCTION,
                                 "Array": optimizer.ARRAY},
            "LightType": {"Point": optimizer.POINT, "Directional": optimizer.DIRECTIONAL},
            "Method": {"Optimized": optimizer.OPTIMIZED, "Ordinary": optimizer.ORDINARY,
                       "Viola 2004": optimizer.VIOLA_2004,
                       "Marchesin 2010": optimizer.MARCHESIN_2010,
                       "Ament 2017": optimizer.AMENT_2017},
            "Mode": {"Joint": optimizer.JOINT, "Separate": optimizer.SEPARATE},
            "Solver": {"Policy": optimizer.POLICY, "Adam": optimizer.ADAM},
            "Views": {"Single View": optimizer.SINGLE_VIEW, "Stereo Pair": optimizer.STEREO_PAIR,
                      "Orbit": optimizer.ORBIT},
            "ViewpointGuide": {"Attainable": optimizer.ATTAINABLE, "Proxy": optimizer.PROXY,
                               "Coupled": optimizer.COUPLED},
            "ImportanceSmoothing": {"Off": optimizer.AS_GIVEN, "Median": optimizer.MEDIAN},
            "Derivative": {"Volume": optimizer.VOLUME, "Ray": optimizer.RAY},
            "Backend": {"Auto": optimizer.AUTO, "CPU": optimizer.CPU, "CUDA": optimizer.CUDA},
            "ControlResolution": {"Auto": optimizer.FINEST_THAT_FITS, "Full": optimizer.FULL,
                                  "Half": optimizer.HALF, "Quarter": optimizer.QUARTER},
            "Way": {"Round Trip": filters.vtkCameraPath.ROUND_TRIP,
                    "Through Time": filters.vtkCameraPath.THROUGH_TIME},
            "Resampling": {"Majority": filters.vtkAddStructures.MAJORITY,
                           "Nearest": filters.vtkAddStructures.NEAREST},
            "Scene": {"Head": 0, "Flame": 1, "Shells": 2, "Homogeneous": 3, "Vessels": 4},
            "Field": {"Attainable": search.ATTAINABLE,
                      "Importance Proxy": search.IMPORTANCE_PROXY,
                      "Base Extinction": search.BASE_EXTINCTION,
                      "Extinction Array": search.EXTINCTION_ARRAY,
                      "Optimize Per View": search.OPTIMIZE_PER_VIEW},
            "Sampling": {"Icosphere": search.ICOSPHERE, "Fibonacci": search.FIBONACCI,
                         "Latitude-Longitude": search.LATITUDE_LONGITUDE},
        }
        found = {}
        for proxy in proxies():
            for element in properties(proxy):
                entries = element.findall("EnumerationDomain/Entry")
                if entries:
                    found[element.get("name")] = {
                        entry.get("text"): int(entry.get("value")) for entry in entries}
        self.assertEqual(found, expected)

    def test_everything_is_documented(self):
        for proxy in proxies():
            self.assertTrue(proxy.find("Documentation").get("short_help"))
            for element in elements(proxy):
                if element.tag in PROPERTIES + ("InputProperty",):
                    with self.subTest(property=element.get("name")):
                        text = " ".join((element.findtext("Documentation") or "").split())
                        self.assertTrue(text.endswith("."), "no documentation, or no sentence")

    def test_no_property_is_there_twice(self):
        for proxy in proxies():
            names = [element.get("name") for element in properties(proxy)]
            self.assertEqual(len(set(names)), len(names))

    def test_every_property_is_in_one_group(self):
        for proxy in proxies():
            groups = [entry.get("name")
                      for group in proxy.findall("PropertyGroup") for entry in group]
            if groups:
                shown = [element.get("name") for element in properties(proxy)
                         if element.get("panel_visibility") != "never"]
                self.assertEqual(sorted(groups), sorted(shown))


if __name__ == "__main__":
    unittest.main()
