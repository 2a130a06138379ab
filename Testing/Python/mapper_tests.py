# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What the tests of the volume mapper look at, and what they ask of it.

import time
import unittest

import numpy as np

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from images import memory_limited_to
from volume_views import BACKGROUND, View, caught, difference, phantom, phantom_property


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


def placement_of(view):
    """The properties with which a filter looks from the camera of a view."""
    camera = view.camera
    return {"AutomaticPlacement": 0, "CameraPosition": camera.GetPosition(),
            "CameraFocalPoint": camera.GetFocalPoint(), "CameraViewUp": camera.GetViewUp(),
            "CameraViewAngle": camera.GetViewAngle(), "CameraAspectRatio": 1}


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

    def frames_to_the_end(self, view, mapper):
        for frames in range(1, 4000):  # they may be fast, and changes take time
            view.window.Render()
            if mapper.GetConverged():
                return frames
        self.fail("it does not converge")

    def assert_becomes_sharp(self, view, mapper, take):
        """A coarse picture does, little by little. `take()`: renders and returns a picture."""
        view.interact(True)
        for _ in range(5):  # until it knows how coarse to be
            view.window.Render()
        view.interact(False)
        frames = []
        while not frames or not mapper.GetConverged():
            frames.append(take())
        # The first one may be coarser than the others: it has their time, too.
        left = [difference(frame, frames[-1]) for frame in frames[1:]]
        self.assertGreater(left[0], 0.5)
        self.assertGreaterEqual(sum(0 < share < left[0] for share in left), 4)
        for before, after in zip(left, left[1:]):
            self.assertLess(before - after, 0.3 * left[0])

    def assert_made_again(self, view, mapper):
        """The same picture after all memory was given back, in each way in which it is."""
        expected = view.picture()
        for act in (mapper.ReleaseMemory, view.window.Finalize, view.volume.VisibilityOff):
            act()
            view.window.Render()
            view.volume.VisibilityOn()
            np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)

    def assert_survives_aborts(self, view, mapper):
        """An abort at any check leaves a mapper that draws. VTK asks five times a second: give the
        view a size at which a frame takes longer."""
        expected = view.picture()
        wanted, seen = 0, 0

        def observe(*_):
            nonlocal seen
            seen += 1
            if seen == wanted:
                view.window.SetAbortRender(1)
        while seen >= wanted:
            wanted, seen = wanted + 1, 0
            mapper.Reset()
            tag = view.window.AddObserver("AbortCheckEvent", observe)
            time.sleep(0.25)  # so that it asks in this frame, too
            view.window.Render()
            view.window.RemoveObserver(tag)
            if wanted % 2:  # goes on with what there is, or begins anew
                mapper.Reset()
            np.testing.assert_array_equal(view.picture(), expected)
        self.assertGreater(wanted, 1)
        self.assert_fine(view)

    def assert_survives_lack_of_memory(self, view, mapper, *words):
        """A message with these words in it about an image that is too large; then draws what it
        drew before. A second one where memory lacks for the picture without optimization, too: how
        much the allocator has kept is not known, but no more than 32 MiB at a time, and the
        gradient of the image takes 74 MB."""
        expected = view.picture()
        small = mapper.GetInput()
        mapper.SetInputData(phantom(210))
        with memory_limited_to(2 ** 22):
            view.window.Render()
        self.assertIn(len(view.messages), (1, 2), view.messages)
        self.assertEqual(len(set(view.messages)), len(view.messages))
        for word in words:
            for message in view.messages:
                self.assertIn(word, message)
        view.messages.clear()
        mapper.SetInputData(small)
        np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)

    def assert_empty(self, picture):
        np.testing.assert_allclose(picture - np.round(255 * np.array(BACKGROUND)), 0, atol=1)
