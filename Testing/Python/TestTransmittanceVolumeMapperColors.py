# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The colours of the mapper's pictures are those of the color map, in the light of a view of VTK and
# in the light kit that views of ParaView have.

import unittest

import numpy as np
from vtkmodules.vtkRenderingCore import vtkLightKit

import color_chart
from mapper_tests import MapperTest
from volume_views import View, caught, colors_of, opacity_of, plain_mapper, property_of, save

SCALE = 24


def chart_view(with_kit, opacity=0.9, **properties):
    mapper = plain_mapper()
    mapper.ShadowsOn()
    for name, value in properties.items():
        getattr(mapper, "Set" + name)(value)
    view = View((360, 240))
    view.messages = caught(mapper)
    view.volume = view.add(
        color_chart.image(),
        property_of(colors_of(*color_chart.color_points()),
                    opacity_of(*color_chart.opacity_points(opacity)), 1.0), mapper)
    view.camera.ParallelProjectionOn()
    view.camera.SetPosition(0, 0, 100)
    view.camera.SetFocalPoint(0, 0, 0)
    view.camera.SetParallelScale(SCALE)
    view.renderer.ResetCameraClippingRange()
    if with_kit:
        view.renderer.AutomaticLightCreationOff()
        view.kit = vtkLightKit()
        view.kit.AddLightsToRenderer(view.renderer)
    return view, mapper


class TestColors(MapperTest):
    def assert_own_colors(self, pixels):
        found = color_chart.middles(pixels, SCALE)
        self.assertLessEqual(color_chart.luminance_errors(found).max(), 0.02)
        self.assertLessEqual(color_chart.hue_errors(found).max(), 1)

    def test_a_face_has_the_colours_of_the_color_map(self):
        for with_kit in (False, True):
            for opacity in (0.8, 0.9, 0.999):
                with self.subTest(with_kit=with_kit, opacity=opacity):
                    view, _ = chart_view(with_kit, opacity)
                    pixels = view.picture()
                    save(pixels, "colors-{}-{}".format(int(with_kit), opacity))
                    self.assert_own_colors(pixels)
                    self.assert_fine(view)

    def test_highlights_are_no_brighter_than_the_color_map(self):
        view, _ = chart_view(False, Specular=10, SpecularPower=60)
        self.assert_own_colors(view.picture())

    def test_strong_light_brightens_and_keeps_the_hue(self):
        for intensity in (1.5, 4):
            view, _ = chart_view(True, LightIntensity=intensity)
            pixels = view.picture()
            save(pixels, "colors-strong-{}".format(intensity))
            found = color_chart.middles(pixels, SCALE)
            self.assertLessEqual(color_chart.hue_errors(found).max(), 1)
            own = color_chart.luminance(color_chart.PATCHES)
            self.assertGreaterEqual((color_chart.luminance(found) / own).min(), 0.98)
            self.assertGreater(np.median(color_chart.luminance(found) / own), 1.15)


if __name__ == "__main__":
    unittest.main()
