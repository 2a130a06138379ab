# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The mapper among translucent surfaces, with and without depth peeling.

import time
import unittest

import numpy as np
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkHardwareSelector, vtkRenderer

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import (BACKGROUND, View, actor_of, caught, difference, gpu_mapper, gray_property,
                          image_of, phantom, phantom_property, plain_mapper, save, sphere)

COLOR = (0.9, 0.5, 0.1)
EXTINCTION = 0.06
UNIT = 1.0


def add_surface(view, source, color, opacity):
    actor = actor_of(source, color, opacity)
    view.renderer.AddActor(actor)
    view.renderer.ResetCameraClippingRange()
    return actor


def plane(z, size=40.0):
    source = vtkPlaneSource()
    source.SetOrigin(-size, -size, z)
    source.SetPoint1(size, -size, z)
    source.SetPoint2(-size, size, z)
    return source


def peel(view, peels=20):
    view.renderer.UseDepthPeelingOn()
    view.renderer.UseDepthPeelingForVolumesOn()
    view.renderer.SetMaximumNumberOfPeels(peels)
    view.renderer.SetOcclusionRatio(0)


def slab(view, low, high, color=COLOR):
    """A volume with EXTINCTION between two z, and its messages."""
    mapper = plain_mapper()
    image = image_of((9, 9, 9), (2, 2, (high - low) / 8), (-8, -8, low),
                     scalars=np.zeros(9 * 9 * 9, np.float32))
    volume = view.add(image, gray_property(1 - np.exp(-EXTINCTION * UNIT), UNIT, color), mapper)
    return volume, caught(mapper)


def look_along_z(view):
    """From above, in parallel, at 16 x 16 units."""
    view.camera.ParallelProjectionOn()
    view.camera.SetPosition(0, 0, 100)
    view.camera.SetFocalPoint(0, 0, 0)
    view.camera.SetParallelScale(6)
    view.renderer.ResetCameraClippingRange()


def seen(slabs, planes):
    """What is seen along z: slabs are (low, high, color), planes (z, color, opacity)."""
    cuts = sorted({z for low, high, _ in slabs for z in (low, high)} | {p[0] for p in planes})
    result = np.array(BACKGROUND)
    for below, z in zip([None] + cuts, cuts):
        for low, high, color in slabs:
            if below is not None and low <= below and z <= high:
                through = np.exp(-EXTINCTION * (z - below))
                result = through * result + (1 - through) * np.array(color)
        for at, color, opacity in planes:
            if at == z:
                result = (1 - opacity) * result + opacity * np.array(color)
    return 255 * result


PLANES = [(12.0, (0.1, 0.9, 0.2), 0.3), (5.5, (0.2, 0.2, 1.0), 0.25), (1.0, (1.0, 0.1, 0.1), 0.4),
          (-3.25, (0.9, 0.9, 0.2), 0.2), (-7.9, (0.1, 0.8, 0.8), 0.35), (-11.0, (0.6, 0.1, 0.9), 0.5)]


class TestDepthPeeling(MapperTest):
    def assert_seen(self, view, expected, surfaces):
        # Every picture and every surface is rounded to 8 bits when it is mixed in.
        picture = view.picture()
        tolerance = 0.5 * (2 * surfaces + 3)
        rows, columns, _ = picture.shape
        for row, column in ((rows // 2, columns // 2), (rows // 8, columns // 3),
                            (7 * rows // 8, 7 * columns // 8)):
            np.testing.assert_allclose(picture[row, column], expected, atol=tolerance)

    def test_surfaces_before_in_and_behind_a_volume_follow_beers_law(self):
        choices = [[i] for i in range(len(PLANES))] + [[0, 5], [1, 2], [2, 3, 4], range(6)]
        for chosen in choices:
            with self.subTest(chosen=list(chosen)):
                view = View()
                _, messages = slab(view, -8, 8)
                look_along_z(view)
                planes = [PLANES[i] for i in chosen]
                for z, color, opacity in planes:
                    add_surface(view, plane(z), color, opacity)
                peel(view)
                self.assert_seen(view, seen([(-8, 8, COLOR)], planes), len(planes))
                self.assertEqual(messages, [])

    def test_opaque_surfaces_end_what_is_peeled(self):
        for z in (2.5, -5.0, -9.5):
            with self.subTest(z=z):
                view = View()
                slab(view, -8, 8)
                look_along_z(view)
                wall = (z, (0.3, 0.6, 0.2), 1.0)
                for at, color, opacity in PLANES + [wall]:
                    add_surface(view, plane(at), color, opacity)
                peel(view)
                self.assert_seen(view, seen([(-8, 8, COLOR)], PLANES + [wall]), 6)

    def test_two_volumes_are_peeled_in_order(self):
        other = (0.1, 0.4, 0.9)
        planes = [PLANES[i] for i in (0, 1, 2, 4)]
        expected = seen([(-8, 0, other), (3, 8, COLOR)], planes)
        for farther_first in (True, False):
            with self.subTest(farther_first=farther_first):
                view = View()
                slabs = [(-8, 0, other), (3, 8, COLOR)]
                messages = [slab(view, *s)[1] for s in (slabs if farther_first else slabs[::-1])]
                look_along_z(view)
                for z, color, opacity in planes:
                    add_surface(view, plane(z), color, opacity)
                peel(view)
                self.assert_seen(view, expected, len(planes))
                self.assertEqual(messages, [[], []])

    def test_the_picture_is_that_of_vtk_with_curved_surfaces(self):
        def picture_of(mapper):
            view = View()
            view.add(phantom(48), phantom_property(), mapper)
            view.look()
            add_surface(view, sphere((0.1, 0.1, 0.2), 0.4), (0.2, 0.9, 0.3), 0.4)
            add_surface(view, sphere((0.3, -0.2, 0.4), 0.3), (0.9, 0.9, 0.3), 0.3)
            peel(view)
            return view.picture()

        ours = picture_of(plain_mapper(0.5))
        theirs = picture_of(gpu_mapper(0.01))
        save(ours, "peeled-ours")
        save(theirs, "peeled-theirs")
        self.assertLess(difference(ours, theirs), 1.0)
        self.assertLess(np.abs(ours - theirs).max(), 20)

    def test_where_no_surface_is_the_picture_is_the_same(self):
        for properties in ({}, {"Jitter": 1}, {"SampleDistance": 2.3}):
            with self.subTest(**properties):
                view, mapper = show(**properties)
                whole = view.picture()
                score = mapper.GetVisibilityScore()
                view.renderer.SetViewPoint(0.9, 0.9, 0)  # in the upper right corner
                view.renderer.ViewToWorld()
                corner = view.renderer.GetWorldPoint()
                add_surface(view, sphere(corner[:3], 0.05), (1, 1, 1), 0.5)
                peel(view)
                peeled = view.picture()
                np.testing.assert_array_equal(peeled[:140, :140], whole[:140, :140])
                self.assertGreater(np.abs(peeled - whole)[140:, 140:].max(), 30)
                self.assertEqual(mapper.GetVisibilityScore(), score)
                self.assert_fine(view)

    def test_surfaces_that_cannot_be_seen_change_nothing(self):
        for properties in ({}, {"Jitter": 1}):
            with self.subTest(**properties):
                view, mapper = show(**properties)
                whole = view.picture()
                for radius in (0.3, 0.6, 0.9):
                    add_surface(view, sphere((0, 0, 0), radius), (1, 1, 1), 1e-4)
                peel(view)
                peeled = view.picture()
                # Six surfaces part the rays: two more samples each, and 8 bits each time.
                self.assertLess(difference(peeled, whole), 0.7)
                self.assertLess(np.abs(peeled - whole).max(), 12)
                self.assertTrue(mapper.GetConverged())
                self.assert_fine(view)

    def test_moving_frames_are_peeled(self):
        view, _ = show()
        add_surface(view, sphere((0, 0, 0), 0.5), (0.2, 0.9, 0.3), 0.5)
        peel(view)
        still = view.picture()
        view.interact(True)
        for _ in range(6):
            moving = view.picture()
        self.assertLess(difference(moving, still), 6)
        view.interact(False)
        np.testing.assert_array_equal(view.picture(), still)
        self.assert_fine(view)

    def test_each_viewport_has_its_own(self):
        def fill(view, renderer):
            mapper = plain_mapper()
            view.renderer = renderer
            view.add(phantom(), phantom_property(), mapper)
            view.look()
            add_surface(view, sphere((0.1, 0.1, 0.2), 0.4), (0.2, 0.9, 0.3), 0.4)
            peel(view)

        alone = View((120, 160))
        fill(alone, alone.renderer)
        both = View((240, 160))
        right = vtkRenderer()
        right.SetBackground(*BACKGROUND)
        right.SetViewport(0.5, 0, 1, 1)
        both.window.AddRenderer(right)
        both.renderer.SetViewport(0, 0, 0.5, 1)
        fill(both, both.renderer)
        fill(both, right)

        expected = alone.picture()
        picture = both.picture()
        np.testing.assert_array_equal(picture[:, :120], expected)
        np.testing.assert_array_equal(picture[:, 120:], expected)

    def test_a_window_can_change_its_size(self):
        view, _ = show()
        add_surface(view, sphere((0, 0, 0), 0.5), (0.2, 0.9, 0.3), 0.5)
        peel(view)
        first = view.picture()
        view.window.SetSize(90, 210)
        self.assertEqual(view.picture().shape, (210, 90, 3))
        view.window.SetSize(160, 160)
        np.testing.assert_array_equal(view.picture(), first)
        self.assert_fine(view)

    def test_the_volume_is_picked_after_it_was_peeled(self):
        view, _ = show()
        add_surface(view, sphere((0, 0, 0), 3.0), (0.2, 0.9, 0.3), 0.1).PickableOff()
        peel(view)
        view.window.Render()
        for pixel, expected in (((80, 80), [view.volume]), ((2, 2), [])):
            selector = vtkHardwareSelector()
            selector.SetRenderer(view.renderer)
            selector.SetArea(*pixel, *pixel)
            selection = selector.Select()
            self.assertEqual([selection.GetNode(i).GetProperties().Get(
                selection.GetNode(i).PROP()) for i in range(selection.GetNumberOfNodes())], expected)

    def test_a_frame_can_be_aborted(self):
        view, mapper = show()
        add_surface(view, sphere((0, 0, 0), 0.5), (0.2, 0.9, 0.3), 0.5)
        peel(view)
        expected = view.picture()
        tag = view.window.AddObserver(vtkCommand.AbortCheckEvent,
                                      lambda *_: view.window.SetAbortRender(1))
        mapper.Reset()
        time.sleep(0.3)  # VTK asks five times a second
        view.window.Render()
        self.assertFalse(mapper.GetConverged())
        view.window.RemoveObserver(tag)
        view.window.SetAbortRender(0)
        np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)

    def test_memory_can_be_released_between_frames(self):
        view, mapper = show()
        add_surface(view, sphere((0, 0, 0), 0.5), (0.2, 0.9, 0.3), 0.5)
        peel(view)
        expected = view.picture()
        mapper.ReleaseMemory()
        mapper.ReleaseGraphicsResources(view.window)
        np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)

    def test_a_volume_of_another_mapper_gets_a_warning(self):
        view, _ = show()
        view.add(image_of((4, 4, 4), origin=(5, 5, 5), scalars=np.zeros(64, np.float32)),
                 gray_property(), gpu_mapper(0.5))
        add_surface(view, sphere((0, 0, 0), 0.5), (0.2, 0.9, 0.3), 0.5)
        peel(view)
        self.assert_says(view, "another mapper", "UseDepthPeelingForVolumesOff")


class TestTranslucentGeometry(MapperTest):
    """Without peeling of volumes."""

    def add_sphere(self, view, share):
        center = share * np.array(view.camera.GetPosition())
        add_surface(view, sphere(center, 0.5), (1, 1, 1), 0.5)

    def test_behind_the_volume_is_right(self):
        view, _ = show()
        self.add_sphere(view, -0.6)
        view.window.Render()
        self.assertFalse(Mapper.NeedsDepthPeeling(view.renderer, view.volume))
        self.assert_fine(view)

    def test_in_front_and_inside_get_a_warning_that_helps(self):
        for share in (0.5, 0):
            with self.subTest(share=share):
                view, mapper = show()
                self.add_sphere(view, share)
                self.assertTrue(Mapper.NeedsDepthPeeling(view.renderer, view.volume))
                self.assert_says(view, "ranslucent", "UseDepthPeelingForVolumesOn")
                peel(view)
                view.window.Render()
                self.assertEqual(mapper.GetMessages(), "")


if __name__ == "__main__":
    unittest.main()
