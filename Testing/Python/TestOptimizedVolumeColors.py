# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Colours of the representation type "Optimized Volume" in a new view, whose lights are ParaView's:
# values can be read off the scalar bar.

import os

from paraview import simple

import color_chart
import displays
import pictures
import runner

simple.LoadPlugin(os.environ["LIMPID_PLUGIN"], remote=False, ns=globals())

SCALE = 24


def show_chart(view):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(color_chart.image())
    source.UpdatePipeline()
    display = displays.show(source, view, array=("POINTS", "Chart"))
    colors = simple.GetColorTransferFunction("Chart")
    colors.ColorSpace = "RGB"
    colors.RGBPoints = [x for point in color_chart.color_points() for x in point]
    opacities = simple.GetOpacityTransferFunction("Chart")
    opacities.Points = [x for value, opacity in color_chart.opacity_points(0.9)
                        for x in (value, opacity, 0.5, 0)]
    display.ScalarOpacityUnitDistance = 1.0
    view.CameraParallelProjection = 1
    view.CameraParallelScale = SCALE
    view.CameraPosition = [0, 0, 100]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    view.ViewSize = [360, 240]
    return display


class TestOptimizedVolumeColors(displays.DisplayTest):
    def test_a_face_has_the_colours_of_the_color_map(self):
        display = show_chart(self.view)
        display.Optimization = "Off"
        display.ShowScore = 0
        found = color_chart.middles(pictures.take(self.view), SCALE)
        self.assertLessEqual(color_chart.luminance_errors(found).max(), 0.02)
        self.assertLessEqual(color_chart.hue_errors(found).max(), 1)


if __name__ == "__main__":
    runner.run()
