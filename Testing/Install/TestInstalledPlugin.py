# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The plugin as ParaView finds it by PV_PLUGIN_PATH, without LoadPlugin.

import os
import pathlib
import sys
import tempfile
import unittest

from paraview import servermanager, simple
from vtkmodules.vtkIOImage import vtkPNGReader

sys.path.append(os.path.join(os.path.dirname(__file__), "..", "Python"))
import runner


def loaded_plugins():
    """The files of the plugins that are loaded, by name."""
    plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
    return {plugins.GetPluginName(i): pathlib.Path(plugins.GetPluginFileName(i))
            for i in range(plugins.GetNumberOfPlugins()) if plugins.GetPluginLoaded(i)}


class TestInstalledPlugin(unittest.TestCase):
    def test_is_the_one_that_was_installed(self):
        self.assertEqual(loaded_plugins()["Limpid"].resolve().parent,
                         pathlib.Path(os.environ["PV_PLUGIN_PATH"]).resolve())

    def test_shows_an_optimized_volume(self):
        display = simple.Show(simple.OcclusionPhantom(Resolution=32))
        simple.ColorBy(display, ("POINTS", "Scalars"))
        display.SetRepresentationType("Optimized Volume")
        reader = vtkPNGReader()
        with tempfile.TemporaryDirectory() as folder:
            picture = os.path.join(folder, "picture.png")
            simple.SaveScreenshot(picture, ImageResolution=[200, 200])
            reader.SetFileName(picture)
            reader.Update()

        low, high = reader.GetOutput().GetScalarRange()
        self.assertGreater(high - low, 50)
        self.assertGreater(display.VisibleFraction, display.BaseVisibleFraction)


if __name__ == "__main__":
    runner.run()
