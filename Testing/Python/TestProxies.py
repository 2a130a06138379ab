# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What ParaView's tests TestValidateProxies and TestXMLSaveLoadState ask of its proxies, of ours.

import os
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from paraview import simple
from paraview.vtk.vtkCommonCore import vtkOutputWindow

import displays
import runner


def definitions():
    """Group and name of all proxies that can be asked for."""
    iterator = simple.servermanager.ProxyManager().GetProxyDefinitionManager().NewIterator()
    found = set()
    while not iterator.IsDoneWithTraversal():
        found.add((iterator.GetGroupName(), iterator.GetProxyName()))
        iterator.GoToNextItem()
    return found


BEFORE = definitions()
simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
OURS = sorted(definitions() - BEFORE)


class ProxyTest(unittest.TestCase):
    def setUp(self):
        displays.clear()
        self.manager = simple.servermanager.ProxyManager().SMProxyManager
        self.errors = []

        def observe(_, __, text):
            self.errors.append(text)
        observe.CallDataType = "string0"
        window = vtkOutputWindow.GetInstance()
        tags = [window.AddObserver(event, observe) for event in ("ErrorEvent", "WarningEvent")]
        self.addCleanup(lambda: [window.RemoveObserver(tag) for tag in tags])


class TestValidateProxies(ProxyTest):
    def test_all_can_be_made(self):
        self.assertGreaterEqual(len(OURS), 5)
        for group, name in OURS:
            with self.subTest(group=group, name=name):
                proxy = self.manager.NewProxy(group, name)
                self.assertIsNotNone(proxy)
                proxy.UpdateVTKObjects()
                self.assertEqual(self.errors, [])


class TestXMLSaveLoadState(ProxyTest):
    def saved(self):
        """The state: texts of the elements of each registered proxy that is ours."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "state.pvsm")
            self.manager.SaveXMLState(path)
            return ElementTree.parse(path).getroot()

    def properties(self, root):
        """Values of the properties of our proxies, without ids, which change."""
        found = {}
        for proxy in root.iter("Proxy"):
            if (proxy.get("group"), proxy.get("type")) in OURS:
                found[proxy.get("type")] = {
                    element.get("name"): [value.get("value") for value in element.iter("Element")]
                    for element in proxy.findall("Property") if element.find("Proxy") is None}
        return found

    def test_a_loaded_state_is_the_saved_one(self):
        phantom = OcclusionPhantom(Resolution=12, Scene="Shells")
        ExtinctionOptimizer(Input=phantom, ViewWeight=7.5, Mode="Separate", LightType="Directional",
                            IterationsPerLevel=[3, 2, 1])
        ViewpointSearch(Input=phantom, NumberOfViewpoints=2, Sampling="Fibonacci",
                        NumberOfDirections=77)
        root = self.saved()
        before = self.properties(root)
        displays.clear()
        self.assertEqual(self.properties(self.saved()), {})

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "state.pvsm")
            ElementTree.ElementTree(root).write(path)
            self.manager.LoadXMLState(path)

        after = self.properties(self.saved())
        self.assertEqual(sorted(before), ["ExtinctionOptimizer", "OcclusionPhantom",
                                          "ViewpointSearch"])
        self.assertEqual(after, before)
        self.assertEqual(after["ExtinctionOptimizer"]["ViewWeight"], ["7.5"])
        self.assertEqual(self.errors, [])


if __name__ == "__main__":
    runner.run()
