# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The picture: what is hidden by the stock rendering of the base extinction shows in that of the
# result, drawn by the stock volume representation with a separate opacity array.

import os
import unittest

from paraview import simple

import pictures
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())


class TestPluginRendering(unittest.TestCase):
    def test_important_material_shows_after_the_optimisation(self):
        optimizer = ExtinctionOptimizer(Input=OcclusionPhantom(Resolution=48, Scene="Shells"))
        # The core is important as the shells about it are, in part; protected, they would hide it.
        optimizer.Preset = "Paper"
        optimizer.ExtinctionSource = "Array"
        optimizer.CameraPosition = [0, -6, 0]
        optimizer.CameraViewUp = [0, 0, 1]
        optimizer.ScalarOpacityUnitDistance = 0.0425  # a cell
        optimizer.UpdatePipeline()
        before = simple.Calculator(Input=optimizer, ResultArrayName="Opacity",
                                   Function="1-exp(-BaseExtinction*{})".format(
                                       optimizer.ScalarOpacityUnitDistance))
        colors = simple.GetColorTransferFunction("Scalars")
        # Only the core, where Scalars is 1, is green.
        colors.RGBPoints = [0, 1, 0, 0, 0.9, 1, 0, 0, 0.95, 0, 1, 0, 1, 0, 1, 0]
        colors.ColorSpace = "RGB"
        simple.GetOpacityTransferFunction("Scalars").Points = [0, 0, 0.5, 0, 1, 1, 0.5, 0]

        view = simple.CreateView("RenderView")
        view.ViewSize = [200, 200]
        view.OrientationAxesVisibility = 0
        view.UseColorPaletteForBackground = 0
        view.Background = [0, 0, 0]
        green = []
        for source in (before, optimizer):
            source.UpdatePipeline()
            display = simple.Show(source, view)
            simple.ColorBy(display, ("POINTS", "Scalars"))
            display.SetRepresentationType("Volume")
            display.UseSeparateOpacityArray = 1
            display.OpacityArrayName = ["POINTS", "Opacity"]
            view.Update()
            volumes = view.GetRenderer().GetVolumes()
            for i in range(volumes.GetNumberOfItems()):
                # The component of a separate opacity array, which ParaView 5.11 does not set.
                volumes.GetItemAsObject(i).GetProperty().SetScalarOpacityUnitDistance(
                    1, optimizer.ScalarOpacityUnitDistance)
            view.CameraPosition = optimizer.CameraPosition
            view.CameraFocalPoint = [0, 0, 0]
            view.CameraViewUp = optimizer.CameraViewUp
            pixels = pictures.take(view).reshape(-1, 3)
            simple.Hide(source, view)
            # Green light beyond red is the core's own; a shell in front only takes away from it.
            green.append((pixels[:, 1] - pixels[:, 0]).clip(0).sum())

        self.assertGreater(green[1], 10 * green[0])
        self.assertGreater(green[1], 0)


if __name__ == "__main__":
    runner.run()
