# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What the mapper's pictures miss of what is important, painted over them.

import math
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkPlane
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkRenderer

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import (BACKGROUND, View, actor_of, caught, colors_of, difference, gray_property,
                          image_of, opacity_of, phantom, plain_mapper, property_of, save)

COLOR = np.array((0.9, 0.5, 0.1))
DEPTH = 0.4  # optical depth of a cell
PAINT = np.array((1.0, 0.0, 1.0))
# The picture, the paint and what it is drawn over are rounded to 8 bits.
ROUNDING = 2


def slab(view, size=2.0, mapper=None, place=0.0):
    """Eight cells along z, of which those below 0 are important: none, half, and wholly."""
    mapper = mapper or plain_mapper()
    importance = np.repeat([1, 1, 1, 1, 0, 0, 0, 0, 0], 81).astype(np.float32)
    image = image_of((9, 9, 9), (2, 2, size), (place - 8, -8, -4 * size),
                     scalars=np.zeros(729, np.float32), Importance=importance)
    volume = view.add(image, gray_property(1 - math.exp(-DEPTH), size, COLOR), mapper)
    mapper.ShowMissedOn()
    return volume, mapper, caught(mapper)


def look_along_z(view, scale=6):
    view.camera.ParallelProjectionOn()
    view.camera.SetPosition(0, 0, 100)
    view.camera.SetFocalPoint(0, 0, 0)
    view.camera.SetParallelScale(scale)
    view.renderer.ResetCameraClippingRange()


def missed(in_front=4, behind=3, between=True):
    """Of a ray through so many cells: what could be seen less what is, see the test of the core."""
    possible = 1 - math.exp(-behind * DEPTH)
    passed = math.exp(-DEPTH)
    seen = 0.5 * (1 - passed) + passed * possible if between else possible
    # The half important cell covers what it hides itself, but for the square of what it lacks.
    left = max(0, 1 - 0.5 / possible)**2 * (possible - seen)
    return (1 - math.exp(-in_front * DEPTH)) * seen + left


def opacity(share):
    return 0.7 * share * share * (3 - 2 * share)


def painted(under, share, paint=PAINT):
    return 255 * ((1 - opacity(share)) * under + opacity(share) * paint)


def slab_on(background, cells=8):
    through = math.exp(-cells * DEPTH)
    return through * np.array(background) + (1 - through) * COLOR


def dense_property():
    """Of the phantom, with a shell that hides what is inside."""
    return property_of(
        colors_of((0, 0.2, 0.3, 0.9), (0.5, 0.9, 0.8, 0.6), (1, 0.9, 0.2, 0.1)),
        opacity_of((0, 0), (0.1, 0.2), (1, 0.6)), 0.05)


class TestMissed(MapperTest):
    def assert_middle(self, view, expected):
        picture = view.picture()
        rows, columns, _ = picture.shape
        np.testing.assert_allclose(picture[rows // 2, columns // 2], expected, atol=ROUNDING)

    def test_what_ordinary_volume_rendering_hides_is_painted(self):
        for color in (PAINT, np.array((0.0, 1.0, 0.25))):
            view = View()
            _, mapper, messages = slab(view)
            mapper.SetMethod(Mapper.ORDINARY)
            mapper.SetMissedColor(*color)
            look_along_z(view)
            self.assert_middle(view, painted(slab_on(BACKGROUND), missed(), color))
            self.assertEqual(messages, [])

    def test_from_the_other_side_nothing_is_missed(self):
        view = View()
        slab(view)
        look_along_z(view)
        view.camera.SetPosition(0, 0, -100)
        view.renderer.ResetCameraClippingRange()
        self.assert_middle(view, 255 * slab_on(BACKGROUND))

    def test_off_is_the_picture_as_it_was_bit_for_bit(self):
        for method in (Mapper.ORDINARY, Mapper.OPTIMIZED):
            with self.subTest(method=method):
                view, mapper = show(None, dense_property(), Method=method)
                before = view.picture()
                mapper.ShowMissedOn()
                on = view.picture()
                mapper.ShowMissedOff()
                np.testing.assert_array_equal(view.picture(), before)
                self.assertGreater(difference(on, before), 0.1)
                self.assert_fine(view)

    def test_less_is_missed_of_an_optimized_volume(self):
        paint = []
        for method in (Mapper.ORDINARY, Mapper.OPTIMIZED):
            view = View()
            _, mapper, messages = slab(view)
            mapper.SetOptimization(Mapper.CONTINUOUS)
            mapper.SetMethod(method)
            look_along_z(view)
            picture = view.picture()
            save(picture, "missed-{}".format(method))
            mapper.ShowMissedOff()
            paint.append(difference(picture, view.picture()))
            self.assertEqual(messages, [])
        self.assertGreater(paint[0], 20)
        self.assertLess(paint[1], 0.1 * paint[0])

    def test_at_rest_it_is_that_of_a_fresh_picture_whatever_moved(self):
        fresh, _ = show(ShowMissed=1)
        expected = fresh.picture()
        view, mapper = show(ShowMissed=1)
        view.camera.Azimuth(-40)
        view.picture()
        view.interact(True)
        for _ in range(4):
            view.camera.Azimuth(10)
            view.renderer.ResetCameraClippingRange()
            view.window.Render()
        view.interact(False)
        fresh.camera.DeepCopy(view.camera)
        np.testing.assert_array_equal(view.picture(), fresh.picture())
        fresh.look()
        view.look()
        np.testing.assert_array_equal(view.picture(), expected)
        mapper.ReleaseMemory()
        np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)

    def test_a_moving_picture_has_what_it_misses_itself(self):
        # A frame without an optimisation depends on its camera only, whether it moves or not.
        view = View()
        _, mapper, _ = slab(view)
        mapper.SetInteractiveFrameTime(2)
        look_along_z(view)
        view.camera.SetPosition(0, 0, -100)
        view.renderer.ResetCameraClippingRange()
        view.picture()
        view.interact(True)
        look_along_z(view)
        self.assert_middle(view, painted(slab_on(BACKGROUND), missed()))

    def test_new_data_importance_functions_and_colours_are_followed(self):
        view, mapper = show(ShowMissed=1)
        view.picture()
        for change in (dict(Input=phantom(24)), dict(MissedColor=(0, 1, 0)),
                       dict(ImportanceFunction=opacity_of((0.6, 0), (0.7, 1)),
                            UseImportanceFunction=1), dict(Method=Mapper.ORDINARY)):
            with self.subTest(change=list(change)):
                for name, value in change.items():
                    getattr(mapper, "SetInputData" if name == "Input" else "Set" + name)(
                        *(value if isinstance(value, tuple) else (value,)))
                found = view.picture()
                mapper.ReleaseMemory()
                np.testing.assert_array_equal(found, view.picture())
        self.assert_fine(view)

    def test_rays_end_at_opaque_geometry_and_at_planes(self):
        # At z = 0, in front of what is important.
        wall = vtkPlaneSource()
        wall.SetOrigin(-40, -40, 0)
        wall.SetPoint1(40, -40, 0)
        wall.SetPoint2(-40, 40, 0)
        view = View()
        slab(view)
        look_along_z(view)
        view.renderer.AddActor(actor_of(wall, (0.3, 0.6, 0.2)))
        self.assert_middle(view, 255 * slab_on((0.3, 0.6, 0.2), 4))

        view = View()
        _, mapper, _ = slab(view)
        look_along_z(view)
        plane = vtkPlane()
        plane.SetNormal(0, 0, 1)
        mapper.AddClippingPlane(plane)
        self.assert_middle(view, 255 * slab_on(BACKGROUND, 4))

    def test_what_is_cropped_or_blanked_is_not_missed(self):
        view = View()
        _, mapper, _ = slab(view)
        look_along_z(view)
        mapper.SetCroppingRegionPlanes(-8, 8, -8, 8, 0, 8)
        mapper.CroppingOn()
        self.assert_middle(view, 255 * slab_on(BACKGROUND, 4))

        view = View()
        _, mapper, _ = slab(view)
        look_along_z(view)
        image = mapper.GetInput()
        image.AllocatePointGhostArray()
        vtk_to_numpy(image.GetPointGhostArray())[:4 * 81] = vtkDataSetAttributes.HIDDENPOINT
        image.Modified()
        without = view.picture()
        mapper.ShowMissedOff()
        np.testing.assert_array_equal(view.picture(), without)

    def test_it_is_in_front_of_translucent_surfaces_that_are_peeled(self):
        # The surface stands between what hides and what is hidden, and behind all.
        for z, cells_in_front in ((0.0, 4), (-9.0, 8)):
            with self.subTest(z=z):
                plane = vtkPlaneSource()
                plane.SetOrigin(-40, -40, z)
                plane.SetPoint1(40, -40, z)
                plane.SetPoint2(-40, 40, z)
                view = View()
                slab(view)
                look_along_z(view)
                view.renderer.AddActor(actor_of(plane, (0.1, 0.9, 0.2), 0.4))
                view.renderer.ResetCameraClippingRange()
                view.renderer.UseDepthPeelingOn()
                view.renderer.UseDepthPeelingForVolumesOn()
                view.renderer.SetMaximumNumberOfPeels(20)
                view.renderer.SetOcclusionRatio(0)
                behind = slab_on(BACKGROUND, 8 - cells_in_front)
                under = slab_on(0.6 * behind + 0.4 * np.array((0.1, 0.9, 0.2)), cells_in_front)
                self.assert_middle(view, painted(under, missed()))

    def test_peeling_without_surfaces_paints_the_same(self):
        pictures = []
        for peels in (0, 1):
            view, _ = show(ShowMissed=1)
            view.renderer.SetUseDepthPeeling(peels)
            view.renderer.SetUseDepthPeelingForVolumes(peels)
            pictures.append(view.picture())
        self.assertLess(np.abs(pictures[0] - pictures[1]).max(), ROUNDING)

    def test_each_of_several_volumes_and_views_has_its_own(self):
        view = View((300, 200))
        _, first, _ = slab(view, place=-8.5)
        _, second, _ = slab(view, place=8.5)
        second.ShowMissedOff()
        look_along_z(view)
        picture = view.picture()
        np.testing.assert_allclose(picture[100, 60], painted(slab_on(BACKGROUND), missed()),
                                   atol=ROUNDING)
        np.testing.assert_allclose(picture[100, 240], 255 * slab_on(BACKGROUND), atol=ROUNDING)

        other = vtkRenderer()
        other.SetBackground(*BACKGROUND)
        other.SetViewport(0.5, 0, 1, 1)
        view.renderer.SetViewport(0, 0, 0.5, 1)
        view.window.AddRenderer(other)
        other.AddVolume(view.renderer.GetVolumes().GetItemAsObject(0))
        other.GetActiveCamera().DeepCopy(view.camera)
        other.GetActiveCamera().SetPosition(-8.5, 0, -100)
        other.GetActiveCamera().SetFocalPoint(-8.5, 0, 0)
        other.ResetCameraClippingRange()
        view.camera.SetPosition(-8.5, 0, 100)
        view.camera.SetFocalPoint(-8.5, 0, 0)
        view.renderer.ResetCameraClippingRange()
        picture = view.picture()
        np.testing.assert_allclose(picture[100, 75], painted(slab_on(BACKGROUND), missed()),
                                   atol=ROUNDING)
        np.testing.assert_allclose(picture[100, 225], 255 * slab_on(BACKGROUND), atol=ROUNDING)

    def test_says_when_the_importance_is_not_there(self):
        image = image_of((9, 9, 9), scalars=np.linspace(0, 1, 729).astype(np.float32))
        view, mapper = show(image, Method=Mapper.ORDINARY, ImportanceArray="Nowhere")
        without = view.picture()
        self.assert_fine(view)
        mapper.ShowMissedOn()
        self.assert_says(view, "\"Nowhere\"", "not painted")
        np.testing.assert_array_equal(view.picture(), without)

    def test_moves_a_colour_that_is_none_into_its_range(self):
        view, mapper = show(ShowMissed=1)
        mapper.SetMissedColor(0.5, 1.5, 0)
        self.assertEqual(mapper.GetMissedColor(), (0.5, 1, 0))
        self.assertEqual(len(view.messages), 1)
        self.assertIn("MissedColor is 1.5", view.messages[0])

    def test_an_abort_at_any_check_leaves_a_mapper_that_draws(self):
        self.assert_survives_aborts(*show(size=(500, 500), ShowMissed=1))

    def test_goes_on_after_a_lack_of_memory(self):
        self.assert_survives_lack_of_memory(*show(ShowMissed=1))


if __name__ == "__main__":
    unittest.main()
