# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What happens to windows, inputs and mappers between frames and within them, and what is left in
# memory after many.

import gc
import time
import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderWindow

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import View, image_of, opacity_of, phantom, phantom_property


def resident_bytes():
    with open("/proc/self/status") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith("VmRSS"))


class TestWindows(MapperTest):
    def test_a_window_of_few_pixels(self):
        view, mapper = show()
        expected = view.picture()
        for size in ((1, 1), (1, 160), (160, 1)):  # X has no windows of 0
            view.window.SetSize(*size)
            view.window.Render()
        view.window.SetSize(160, 160)
        np.testing.assert_array_equal(view.picture(), expected)

    def test_a_viewport_without_pixels_is_told(self):
        view, mapper = show()
        expected = view.picture()
        view.renderer.SetViewport(0.5, 0.5, 0.5, 0.5)
        self.assert_says(view, "there is no room for a picture")
        view.renderer.SetViewport(0, 0, 1, 1)
        np.testing.assert_array_equal(view.picture(), expected)

    def test_a_window_that_is_finalized_and_made_again(self):
        view, mapper = show()
        expected = view.picture()
        for _ in range(3):
            view.window.Finalize()
            np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)

    def test_another_window_for_the_same_renderer(self):
        view, mapper = show()
        expected = view.picture()
        for _ in range(3):
            view.window.RemoveRenderer(view.renderer)
            view.window = vtkRenderWindow()
            view.window.SetOffScreenRendering(1)
            view.window.SetMultiSamples(0)
            view.window.SetSize(160, 160)
            view.window.AddRenderer(view.renderer)
            np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)


class TestWithinAFrame(MapperTest):
    """An observer does in the midst of a frame what it should not."""

    def during(self, act):
        view, mapper = show(size=(300, 300))
        expected = view.picture()
        mapper.Reset()
        view.camera.Azimuth(10)
        done = []

        def observe(*_):
            if not done:
                done.append(True)
                act(view, mapper)
        tag = view.window.AddObserver("AbortCheckEvent", observe)
        time.sleep(0.3)  # VTK asks five times a second
        view.window.Render()
        view.window.RemoveObserver(tag)
        self.assertTrue(done, "there was nothing to be asked")
        view.camera.Azimuth(-10)
        return view, mapper, expected

    def assert_goes_on(self, view, mapper, expected):
        mapper.Reset()
        view.camera.SetPosition(*view.camera.GetPosition())
        # The camera has gone there and back: it differs by rounding.
        self.assertLess(np.abs(view.picture() - expected).mean(), 0.5)

    def test_the_volume_is_removed(self):
        view, mapper, expected = self.during(
            lambda view, _: view.renderer.RemoveVolume(view.volume))
        view.renderer.AddVolume(view.volume)
        self.assert_goes_on(view, mapper, expected)

    def test_the_volume_gets_another_mapper(self):
        view, mapper, expected = self.during(lambda view, _: view.volume.SetMapper(Mapper()))
        view.volume.SetMapper(mapper)
        self.assert_goes_on(view, mapper, expected)

    def test_the_mapper_dies(self):
        view, mapper = show(size=(300, 300))
        view.window.Render()
        view.camera.Azimuth(10)
        del mapper
        view.window.AddObserver("AbortCheckEvent", lambda *_: view.volume.SetMapper(Mapper()))
        time.sleep(0.3)
        view.window.Render()
        self.assertIsNone(view.volume.GetMapper().GetInput())

    def test_the_memory_is_given_back(self):
        for act in (lambda _, mapper: mapper.ReleaseMemory(), lambda _, mapper: mapper.Reset(),
                    lambda view, _: view.volume.VisibilityOff()):
            view, mapper, expected = self.during(act)
            view.volume.VisibilityOn()
            self.assert_goes_on(view, mapper, expected)

    def test_the_input_is_emptied(self):
        image = phantom()
        kept = vtkImageData()
        kept.ShallowCopy(image)

        def empty(_, mapper):
            mapper.GetInput().Initialize()
        view, mapper, expected = self.during(empty)
        mapper.SetInputData(kept)
        self.assert_goes_on(view, mapper, expected)

    def test_the_input_is_taken_away(self):
        view, mapper, expected = self.during(lambda _, mapper: mapper.RemoveAllInputConnections(0))
        view.window.Render()
        mapper.SetInputData(phantom())
        self.assert_goes_on(view, mapper, expected)


class TestBetweenFrames(MapperTest):
    def test_an_input_that_is_emptied_or_taken_away(self):
        view, mapper = show()
        expected = view.picture()
        for act in (lambda: mapper.GetInput().Initialize(),
                    lambda: mapper.GetInput().GetPointData().Initialize(),
                    lambda: mapper.SetInputData(vtkImageData()),
                    lambda: mapper.SetInputData(image_of((4, 4, 4))),
                    lambda: mapper.RemoveAllInputConnections(0)):
            act()
            view.messages.clear()
            self.assert_empty(view.picture())
            if mapper.GetInput():
                self.assertEqual(len(view.messages), 1, view.messages)
            mapper.SetInputData(phantom())
            np.testing.assert_array_equal(view.picture(), expected)

    def test_a_mapper_that_dies_in_a_view(self):
        view, mapper = show()
        expected = view.picture()
        for _ in range(3):
            other = Mapper()
            other.SetInputData(phantom())
            view.volume.SetMapper(other)
            del mapper
            gc.collect()
            mapper = other
            np.testing.assert_array_equal(view.picture(), expected)


class TestMemory(MapperTest):
    def test_many_renders_of_changing_input_take_no_more_memory(self):
        images = [phantom(10), phantom(12)]
        view, mapper = show(images[0], size=(60, 60), MaximumIterations=2)
        lamp = vtkLight()
        view.renderer.AddLight(lamp)
        after = {}
        for i in range(301):
            mapper.SetInputData(images[i % 2])                          # extent
            images[i % 2].GetPointData().GetArray("Scalars").Modified()  # array
            view.volume.GetProperty().SetScalarOpacity(opacity_of((0, 0), (1, 0.1 + 0.001 * i)))
            view.camera.Azimuth(7)
            lamp.SetPosition(i, 1, 1)
            if i % 5 == 0:
                view.volume.SetProperty(phantom_property())
            if i % 7 == 0:
                mapper.SetMode(i % 2)
                mapper.SetImportanceArray("Importance" if i % 2 else "Scalars")
            view.window.Render()
            after[i] = resident_bytes()
        self.assert_fine(view)
        # What allocators and the driver keep comes and goes by a few MB.
        self.assertLess(after[300] - after[100], 4e6)


if __name__ == "__main__":
    unittest.main()
