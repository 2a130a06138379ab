# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The mapper among lights, cropping planes, other volumes, geometry and selections.

import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPlane, vtkPlaneCollection
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import (vtkActor, vtkHardwareSelector, vtkLight, vtkPolyDataMapper,
                                         vtkRenderer, vtkVolume)
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import (BACKGROUND, View, actor_of, caught, colors_of, difference, gray_property,
                          image_of, opacity_of, phantom, plain_mapper, property_of, save, sphere)


class TestLights(MapperTest):
    def light(self, **properties):
        light = vtkLight()
        for name, value in properties.items():
            getattr(light, "Set" + name)(value)
        return light

    def test_the_strongest_light_that_is_on_is_chosen_and_named(self):
        view, mapper = show()
        view.renderer.AutomaticLightCreationOff()
        view.renderer.AddLight(self.light(Intensity=0.5, Position=(5, 0, 0)))
        view.renderer.AddLight(self.light(Intensity=0.9, Position=(0, 5, 0), Positional=1,
                                          ConeAngle=30))
        view.renderer.AddLight(self.light(Intensity=2.0, Position=(0, 0, 5), Switch=0))
        view.renderer.AddLight(self.light(Intensity=2.0, Position=(0, 0, 5), Color=(0.1, 0, 0)))
        second = view.picture()
        for word in ("light 2 of 4", "scene light", "positional", "0.9", "cone"):
            self.assertIn(word, mapper.GetLightDescription())
        view.renderer.GetLights().GetItemAsObject(1).SwitchOff()
        first = view.picture()
        self.assertIn("light 1 of 4", mapper.GetLightDescription())
        self.assertIn("directional", mapper.GetLightDescription())
        self.assertGreater(difference(first, second), 0.3)
        self.assert_fine(view)

    def test_the_automatic_light_is_a_headlight(self):
        view, mapper = show()
        view.window.Render()
        self.assertIn("headlight", mapper.GetLightDescription())

    def test_a_camera_light_goes_with_the_camera(self):
        view, mapper = show(Optimization=Mapper.OFF)
        view.renderer.AutomaticLightCreationOff()
        follows = self.light(Position=(1, 1, 1))
        follows.SetLightTypeToCameraLight()
        view.renderer.AddLight(follows)
        by_light = view.picture()
        self.assertIn("camera light", mapper.GetLightDescription())
        # The same as a light of our own at that place.
        place = np.array(follows.GetTransformedPosition())
        target = np.array(follows.GetTransformedFocalPoint())
        mapper.SetLightSource(Mapper.OWN)
        mapper.SetLightType(Mapper.DIRECTIONAL)
        mapper.SetLightPosition(*(np.array(view.camera.GetFocalPoint()) + place - target))
        self.assertLess(difference(view.picture(), by_light), 0.1)
        self.assertIn("own light: directional", mapper.GetLightDescription())

    def test_an_own_light_that_nobody_has_placed_goes_with_the_camera(self):
        view, mapper = show(LightSource=Mapper.OWN)
        view.window.Render()
        first = mapper.GetLightDescription()
        view.camera.Azimuth(40)
        view.window.Render()
        self.assertIn("point", first)
        self.assertNotEqual(mapper.GetLightDescription(), first)

    def test_the_light_neither_tints_the_colours_nor_says_how_bright_they_are(self):
        view, mapper = show(Optimization=Mapper.OFF)
        view.renderer.AutomaticLightCreationOff()
        light = self.light(Position=(1, 1, 1), Intensity=0.5)
        view.renderer.AddLight(light)
        white = view.picture()
        light.SetIntensity(0.9)
        np.testing.assert_array_equal(view.picture(), white)
        light.SetColor(1, 0, 0)
        np.testing.assert_array_equal(view.picture(), white)
        mapper.SetLightIntensity(0.3)
        self.assertLess(view.picture().sum(), white.sum())

    def test_light_goes_with_the_volume_that_is_moved(self):
        # Everything moved together looks the same.
        reference, _ = show(LightSource=Mapper.OWN, LightPosition=(3, 4, 5))
        view, mapper = show(LightSource=Mapper.OWN)
        view.volume.SetPosition(10, 20, 30)
        mapper.SetLightPosition(13, 24, 35)
        view.look()
        self.assertLess(difference(view.picture(), reference.picture()), 0.2)

    def test_shadows_and_shade_are_what_lights_the_volume(self):
        view, mapper = show(Optimization=Mapper.OFF)
        pictures = {}
        for shadows in (0, 1):
            for shade in (0, 1):
                mapper.SetShadows(shadows)
                view.volume.GetProperty().SetShade(shade)
                pictures[shadows, shade] = view.picture()
        save(pictures[0, 0], "unlit")
        save(pictures[0, 1], "shade")
        save(pictures[1, 0], "shadows")
        np.testing.assert_array_equal(pictures[1, 0], pictures[1, 1])
        self.assertGreater(difference(pictures[0, 0], pictures[0, 1]), 0.5)
        self.assertGreater(difference(pictures[0, 1], pictures[1, 1]), 0.5)
        mapper.SetShadowStrength(0)
        np.testing.assert_array_equal(view.picture(), pictures[0, 1])

    def test_no_light(self):
        view, mapper = show()
        view.renderer.AutomaticLightCreationOff()
        self.assert_says(view, "No light", "LightSource")
        self.assertGreater(view.picture().std(), 3)
        self.assertGreater(mapper.GetVisibilityScore(), mapper.GetBaseVisibilityScore())


class TestCropping(MapperTest):
    def test_a_cropping_box_is_a_smaller_image(self):
        view, mapper = show(phantom(33), Shadows=0)
        mapper.CroppingOn()
        mapper.SetCroppingRegionPlanes(-0.5, 1, -1, 0.5, -0.25, 0.75)
        view.camera.Azimuth(10)
        cropped = view.picture()
        score = mapper.GetVisibilityScore()
        save(cropped, "cropped")
        mapper.SetOptimization(Mapper.OFF)
        cropped_base = view.picture()
        mapper.CroppingOff()

        def part(layers):
            """Picture and score of the points in the box and so many layers of points more."""
            image = phantom(33)
            image.Crop((8 - layers, 32, 0, 24 + layers, 12 - layers, 28 + layers))
            mapper.SetInputData(image)
            return view.picture(), mapper.GetVisibilityScore()
        self.assertLess(difference(part(0)[0], cropped_base), 0.01)

        # For the optimization, extinction fades out between the last point inside and the first
        # outside: that is half a layer of cells, whose effect is less than a whole layer's.
        mapper.SetOptimization(Mapper.CONTINUOUS)
        smaller, smaller_score = part(0)
        larger, larger_score = part(1)
        save(smaller, "smaller")
        self.assertLess(difference(cropped, smaller), difference(larger, smaller))
        self.assertLess(abs(score - smaller_score), larger_score - smaller_score)

    def test_clipping_planes_are_in_world_coordinates(self):
        view, mapper = show(Optimization=Mapper.OFF, Shadows=0)
        view.volume.SetPosition(3, 0, 0)
        view.look(0, 0)
        whole = view.picture()
        plane = vtkPlane()
        plane.SetOrigin(3, 0, 0)
        plane.SetNormal(1, 0, 0)
        planes = vtkPlaneCollection()
        planes.AddItem(plane)
        mapper.SetClippingPlanes(planes)
        half = view.picture()
        self.assert_empty(half[:, :70])
        self.assertLess(difference(half[:, 90:], whole[:, 90:]), 0.5)
        plane.SetNormal(-1, 0, 0)
        self.assert_empty(view.picture()[:, 90:])

    def test_what_is_clipped_casts_no_shadow(self):
        # Lit from the side that is clipped off: as an image that ends there, and nearer to it than
        # an image with one layer of points more.
        view, mapper = show(phantom(33), Optimization=Mapper.OFF, LightSource=Mapper.OWN,
                            LightType=Mapper.DIRECTIONAL, LightPosition=(5, 0, 0))
        plane = vtkPlane()
        plane.SetNormal(-1, 0, 0)
        mapper.AddClippingPlane(plane)
        clipped = view.picture()
        mapper.RemoveAllClippingPlanes()

        def up_to(last):
            image = phantom(33)
            image.Crop((0, last, 0, 32, 0, 32))
            mapper.SetInputData(image)
            return view.picture()
        half = up_to(16)
        self.assertLess(difference(clipped, half), difference(up_to(17), half))

    def test_too_many_clipping_planes_are_counted(self):
        view, mapper = show(phantom(8))
        for _ in range(17):
            mapper.AddClippingPlane(vtkPlane())
        self.assert_says(view, "17 clipping planes")

    def test_what_is_cropped_does_not_count(self):
        view, mapper = show()
        mapper.CroppingOn()
        mapper.SetCroppingRegionPlanes(5, 6, 5, 6, 5, 6)
        self.assert_empty(view.picture())
        self.assertEqual(mapper.GetVisibilityScore(), 0)

    def test_what_is_cropped_does_not_move_the_majorant(self):
        # The densest is a block that is neither important nor in front of what is.
        z, y, x = np.indices((12, 8, 16))
        scalars = np.where(x < 8, np.where(z < 5, 0.4, 0.3), np.where(x > 12, 1, 0)).ravel()
        image = image_of((16, 8, 12), Scalars=scalars,
                         Importance=((x < 8) & (z < 5)).ravel().astype(float))
        white = colors_of((0, 1, 1, 1), (1, 1, 1, 1))
        view, mapper = show(image, property_of(white, opacity_of((0, 0), (1, 0.9)), 1),
                            RestrictToView=0, LightWeight=0)
        view.camera.ParallelProjectionOn()
        view.look(0, 0)
        view.window.Render()
        whole = mapper.GetVisibilityScore()

        mapper.CroppingOn()
        mapper.SetCroppingRegionPlanes(-1, 10, -1, 10, -1, 12)
        view.window.Render()

        self.assert_fine(view)
        self.assertGreater(whole, mapper.GetBaseVisibilityScore())
        self.assertEqual(mapper.GetVisibilityScore(), whole)


class TestSeveralVolumes(MapperTest):
    def row_of_two(self, swapped, second_mapper=None):
        """A red volume in front of a blue one; `swapped`: added in the other order."""
        view = View()
        image = image_of((4, 4, 4), s=np.zeros(64), Importance=np.ones(64))
        mappers = [plain_mapper(), second_mapper or plain_mapper()]
        volumes = []
        for mapper, color in zip(mappers, ((1, 0, 0), (0, 0, 1))):
            mapper.SetInputData(image)
            volume = vtkVolume()
            volume.SetMapper(mapper)
            volume.SetProperty(gray_property(0.7, 1.0, color))
            volumes.append(volume)
        volumes[1].SetPosition(0.5, 0.5, -6)
        volumes[1].RotateY(20)
        for volume in reversed(volumes) if swapped else volumes:
            view.renderer.AddVolume(volume)
        view.renderer.ResetCamera()
        view.messages = caught(mappers[0])
        return view, volumes

    def test_are_drawn_from_back_to_front_whatever_their_order(self):
        pictures = [self.row_of_two(swapped)[0].picture() for swapped in (False, True)]
        save(pictures[0], "two volumes")
        np.testing.assert_array_equal(*pictures)
        red, _, blue = pictures[0][100, 100]
        self.assertGreater(red, 200)
        self.assertLess(blue, 40)

    def test_are_drawn_in_order_in_every_frame_and_from_every_side(self):
        views = [self.row_of_two(swapped)[0] for swapped in (False, True)]
        for angle in (0, 60, 60, 60, 60):
            pictures = []
            for view in views:
                view.camera.Azimuth(angle)
                view.renderer.ResetCameraClippingRange()
                pictures.append(view.picture())
            np.testing.assert_array_equal(*pictures)

    def test_are_drawn_in_order_in_parallel_projection(self):
        pictures = []
        for swapped in (False, True):
            view, _ = self.row_of_two(swapped)
            view.camera.ParallelProjectionOn()
            pictures.append(view.picture())
        np.testing.assert_array_equal(*pictures)
        self.assertGreater(pictures[0][100, 100, 0], 200)

    def test_one_that_is_out_of_view_is_drawn_when_it_comes_back(self):
        view, volumes = self.row_of_two(False)
        expected = view.picture()
        volumes[1].SetPosition(1000, 0, 0)
        view.window.Render()
        volumes[1].SetPosition(0.5, 0.5, -6)
        np.testing.assert_array_equal(view.picture(), expected)

    def test_three_in_a_row(self):
        pictures = []
        for order in ((0, 1, 2), (2, 1, 0), (1, 0, 2), (0, 2, 1)):
            view = View()
            image = image_of((3, 3, 3), s=np.zeros(27))
            for place in order:
                volume = view.add(image, gray_property(0.7, 1.0, np.eye(3)[place]), plain_mapper())
                volume.SetPosition(0.4 * place, 0.3 * place, -4 * place)
            view.renderer.ResetCamera()
            pictures.append(view.picture())
        for picture in pictures[1:]:
            np.testing.assert_array_equal(picture, pictures[0])

    def test_that_overlap_get_a_warning(self):
        view, volumes = self.row_of_two(False)
        volumes[1].SetPosition(0.5, 0.5, -2)
        self.assert_says(view, "overlap")

    def test_that_touch_or_are_hidden_get_none(self):
        view, volumes = self.row_of_two(False)
        volumes[1].SetOrientation(0, 0, 0)
        volumes[1].SetPosition(0, 0, -3)
        view.window.Render()
        volumes[1].SetPosition(0, 0, -1)
        volumes[1].VisibilityOff()
        view.window.Render()
        self.assert_fine(view)

    def test_boxes_of_turned_volumes_do_not_overlap_where_their_bounds_do(self):
        view, volumes = self.row_of_two(False)
        for volume, place in zip(volumes, ((0, 0, 0), (3.2, 0, 3.2))):
            volume.SetOrientation(0, 45, 0)
            volume.SetPosition(*place)
        volumes[1].SetPosition(3.5 * np.cos(np.pi / 4), 0, -3.5 * np.cos(np.pi / 4))
        bounds = [np.array(volume.GetBounds()).reshape(3, 2) for volume in volumes]
        self.assertTrue((np.minimum(bounds[0][:, 1], bounds[1][:, 1]) >
                         np.maximum(bounds[0][:, 0], bounds[1][:, 0])).all())
        view.window.Render()
        self.assert_fine(view)

    def test_of_another_mapper_get_a_warning_until_the_renderer_sorts(self):
        foreign = vtkFixedPointVolumeRayCastMapper()
        view, _ = self.row_of_two(False, foreign)
        self.assert_says(view, "SortBackToFront")
        Mapper.SortBackToFront(view.renderer)
        view.messages.clear()
        red, _, blue = view.picture()[100, 100]
        self.assertGreater(red, 200)
        self.assertLess(blue, 40)
        self.assert_fine(view)

    def test_sorting_works_without_any_culler(self):
        renderer = vtkRenderer()
        renderer.GetCullers().RemoveAllItems()
        Mapper.SortBackToFront(renderer)
        self.assertEqual(renderer.GetCullers().GetNumberOfItems(), 1)
        Mapper.SortBackToFront(renderer)
        self.assertEqual(renderer.GetCullers().GetNumberOfItems(), 1)


class TestOpaqueGeometry(MapperTest):
    """In front of a volume and inside it, while the volume is drawn with eight times fewer pixels
    along each axis."""

    def coarse(self, *actors, moving=True, visible=True):
        view, mapper = show(size=(240, 240), Optimization=Mapper.OFF, Shadows=0,
                            InteractiveFrameTime=1e-6)
        for actor in actors:
            view.renderer.AddActor(actor)
        view.volume.SetVisibility(visible)
        view.interact(moving)
        picture = view.picture()
        self.assert_fine(view)
        return picture

    def check_what_is_beside(self, actor):
        """Returns the pixels that the actor covers, and its coarse picture with the volume."""
        covered = np.any(self.coarse(actor, visible=False) != self.coarse(visible=False), axis=2)
        both = self.coarse(actor)
        save(both, self.id().rsplit(".", 1)[1])
        without = self.coarse()
        self.assertGreater(covered.sum(), 500)
        # Interpolated twice from the same pixels: a step of rounding.
        self.assertLessEqual(np.abs(both - without)[~covered].max(), 1)
        return covered, both

    def lines(self, radius):
        actor = actor_of(sphere((0, 0, 0), radius), color=(1, 1, 0))
        actor.GetProperty().SetRepresentationToWireframe()
        return actor

    def test_lines_around_the_volume_leave_nothing_beside_them(self):
        self.check_what_is_beside(self.lines(1.9))

    def test_lines_inside_leave_nothing_beside_them(self):
        self.check_what_is_beside(self.lines(0.6))

    def test_a_thick_thing_inside_has_no_halo_and_is_covered_as_in_a_still_picture(self):
        actor = actor_of(sphere((0, 0, 0), 0.5))
        covered, both = self.check_what_is_beside(actor)
        wrong = np.abs(both - self.coarse(actor, moving=False))[covered].mean()
        # No more than the volume alone differs between coarse and fine.
        expected = np.abs(self.coarse() - self.coarse(moving=False))[covered].mean()
        self.assertLessEqual(wrong, expected)


class TestSelection(MapperTest):
    def select(self, view, x, y, association=vtkDataObject.FIELD_ASSOCIATION_CELLS):
        selector = vtkHardwareSelector()
        selector.SetRenderer(view.renderer)
        selector.SetFieldAssociation(association)
        selector.SetArea(x, y, x, y)
        selection = selector.Select()
        return [selection.GetNode(i).GetProperties().Get(selection.GetNode(i).PROP())
                for i in range(selection.GetNumberOfNodes())]

    def test_the_volume_is_picked_where_it_is_seen(self):
        for association in (vtkDataObject.FIELD_ASSOCIATION_CELLS,
                            vtkDataObject.FIELD_ASSOCIATION_POINTS):
            view, _ = show()
            before = view.picture()
            self.assertEqual(self.select(view, 80, 80, association), [view.volume])
            self.assertEqual(self.select(view, 2, 2, association), [])
            np.testing.assert_array_equal(view.picture(), before)
            self.assert_fine(view)

    def test_the_volume_is_not_picked_where_it_is_empty(self):
        view, _ = show()
        picture = view.picture()
        row, column = 80, 80
        while np.abs(picture[row, column] - np.array(BACKGROUND) * 255).max() > 2:
            column += 1
        self.assertEqual(self.select(view, column + 1, row), [])

    def test_opaque_geometry_in_front_is_picked(self):
        view, _ = show()
        source = vtkSphereSource()
        source.SetCenter(*(0.5 * np.array(view.camera.GetPosition())))
        source.SetRadius(0.1)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(source.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        view.renderer.AddActor(actor)
        view.renderer.ResetCameraClippingRange()
        view.window.Render()
        self.assertEqual(self.select(view, 80, 80), [actor])


if __name__ == "__main__":
    unittest.main()
