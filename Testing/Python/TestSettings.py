# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The page "Limpid" of ParaView's settings: what displays and filters start with.

import os

from paraview import simple
from paraview.modules.vtkRemotingServerManager import vtkSMParaViewPipelineController

import displays
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())
NAMES = ["Backend", "InteractiveFrameTime", "DrawOn", "ShowScore", "ScoreInScreenshots"]


class TestSettings(displays.DisplayTest):
    def setUp(self):
        super().setUp()
        # As the window does when a plugin is loaded.
        session = simple.servermanager.ActiveConnection.Session
        vtkSMParaViewPipelineController().UpdateSettingsProxies(session)
        proxies = simple.servermanager.ProxyManager()
        self.settings = proxies.GetProxy("settings", "LimpidSettings")
        for name in NAMES:
            self.settings.GetProperty(name).SMProperty.ResetToXMLDefaults()
        self.source = OcclusionPhantom(Resolution=12)

    def display(self):
        display = simple.Show(self.source, self.view)
        display.SetRepresentationType("Optimized Volume")
        return display

    def test_have_the_defaults_of_displays(self):
        display = self.display()
        for name in NAMES:
            self.assertEqual(self.settings.GetProperty(name).GetData(),
                             display.GetProperty(name).GetData(), name)

    def test_are_what_displays_and_filters_start_with(self):
        self.settings.ShowScore = 0
        self.settings.InteractiveFrameTime = 0.5
        self.settings.Backend = "CPU"
        self.settings.DrawOn = "Processor"

        display = self.display()
        filters = [ExtinctionOptimizer(Input=self.source), ViewpointSearch(Input=self.source)]

        self.assertEqual((display.ShowScore, display.InteractiveFrameTime, display.Backend,
                          display.DrawOn), (0, 0.5, "CPU", "Processor"))
        self.assertEqual([each.Backend for each in filters], ["CPU", "CPU"])
        simple.Render(self.view)
        self.assertEqual(display.Messages, "")

    def test_are_followed_by_what_nobody_has_changed(self):
        display = self.display()
        display.InteractiveFrameTime = 0.3

        self.settings.ShowScore = 0
        self.settings.InteractiveFrameTime = 0.5

        self.assertEqual((display.ShowScore, display.InteractiveFrameTime), (0, 0.3))


if __name__ == "__main__":
    runner.run()
