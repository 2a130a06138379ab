# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What the tests of the volume mapper look at, and what they ask of it.

import unittest

import numpy as np

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from volume_views import BACKGROUND, View, caught, phantom, phantom_property


def show(image=None, volume_property=None, size=(160, 160), **properties):
    """A view of an image with the mapper, and both."""
    mapper = Mapper()
    for name, value in properties.items():
        getattr(mapper, "Set" + name)(value)
    view = View(size)
    view.volume = view.add(image or phantom(), volume_property or phantom_property(), mapper)
    view.look()
    view.messages = caught(mapper)
    return view, mapper


class MapperTest(unittest.TestCase):
    def assert_fine(self, view):
        self.assertEqual(view.messages, [])

    def assert_says(self, view, *words):
        """One message with these words in it, now and not in the next frame again."""
        view.window.Render()
        view.window.Render()
        self.assertEqual(len(view.messages), 1, view.messages)
        for word in words:
            self.assertIn(word, view.messages[0])

    def assert_sane(self, view, mapper):
        for number in (mapper.GetVisibilityScore(), mapper.GetBaseVisibilityScore()):
            self.assertTrue(np.isfinite(number) and number >= 0)
        for share in (mapper.GetVisibleFraction(), mapper.GetBaseVisibleFraction(),
                      mapper.GetSacrificedFraction()):
            self.assertTrue(0 <= share <= 1)

    def assert_empty(self, picture):
        np.testing.assert_allclose(picture - np.round(255 * np.array(BACKGROUND)), 0, atol=1)
