# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The mapper round optimization and renderer: what a view shows in which state, what it costs while
# moving, what is said about what cannot be drawn.

import time
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import (vtkDataObject, vtkImageData, vtkPiecewiseFunction,
                                           vtkPlane, vtkPlaneCollection, vtkRectilinearGrid)
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import (vtkActor, vtkHardwareSelector, vtkLight,
                                         vtkPolyDataMapper, vtkRenderer, vtkVolume)
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper

from volume_views import (BACKGROUND, View, caught, colors_of, difference, gray_property, image_of,
                          opacity_of, phantom, phantom_property, plain_mapper, property_of, save,
                          values)

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper


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
        for share in (mapper.GetVisibleFraction(), mapper.GetBaseVisibleFraction()):
            self.assertTrue(0 <= share <= 1)

    def assert_empty(self, picture):
        np.testing.assert_allclose(picture - np.round(255 * np.array(BACKGROUND)), 0, atol=1)


class TestProperties(MapperTest):
    def test_every_property_is_set_and_got_and_counts_as_a_change(self):
        mapper = Mapper()
        for name, value in dict(
                ScalarComponent=1, ImportanceArray="g", ImportanceArrayAssociation=1,
                ImportanceComponent=2, UseImportanceFunction=1, Method=1, Optimization=1,
                PauseOptimization=1, RegularizationWeight=0.5, ViewWeight=2.0, LightWeight=3.0,
                Mode=1, Solver=1, MaximumIterations=3, IterationsPerLevel=(1, 2, 3),
                LearningRate=0.1, Tolerance=0.01, MaximumSeconds=1.5, Derivative=1, RayDensity=2.0,
                SkipUnneeded=0, RestrictToView=0, Backend=1, LightSource=1, LightType=1,
                LightPosition=(1.0, 2.0, 3.0), Shadows=0, ShadowStrength=0.5, Ambient=0.1,
                Anisotropy=0.1, Specular=0.2, SpecularPower=3.0, LightIntensity=2.0,
                SampleDistance=0.5, Jitter=1, InteractiveFrameTime=0.2, EaseTime=0.1,
                AdaptiveQuality=0, ProgressiveStill=1,
                ImportanceFunction=vtkPiecewiseFunction()).items():
            with self.subTest(name=name):
                before = mapper.GetMTime()
                getattr(mapper, "Set" + name)(value)
                self.assertEqual(getattr(mapper, "Get" + name)(), value)
                self.assertGreater(mapper.GetMTime(), before)
                self.assertIn(name + ":", str(mapper))
        before = mapper.GetMTime()
        mapper.GetImportanceFunction().AddPoint(0, 1)
        self.assertGreater(mapper.GetMTime(), before)

    def test_before_the_first_frame_there_is_nothing_to_report(self):
        mapper = Mapper()
        self.assert_sane(None, mapper)
        self.assertEqual((mapper.GetLightDescription(), mapper.GetBackendName(),
                          mapper.GetMessages()), ("", "", ""))
        mapper.ReleaseMemory()
        mapper.Reset()


class TestOptimization(MapperTest):
    def test_makes_more_of_the_importance_visible(self):
        view, mapper = show()
        picture = view.picture()
        save(picture, "optimized")

        self.assert_fine(view)
        self.assert_sane(view, mapper)
        self.assertGreater(mapper.GetVisibilityScore(), 1.2 * mapper.GetBaseVisibilityScore())
        self.assertTrue(mapper.GetConverged())
        self.assertGreater(mapper.GetIterations(), 0)
        self.assertIn("CPU", mapper.GetBackendName())
        mapper.SetMethod(Mapper.ORDINARY)
        ordinary = view.picture()
        save(ordinary, "ordinary")
        self.assertGreater(difference(picture, ordinary), 2)

    def test_off_shows_and_scores_the_base_extinction(self):
        view, mapper = show(Optimization=Mapper.OFF)
        off = view.picture()
        score, base = mapper.GetVisibilityScore(), mapper.GetBaseVisibilityScore()
        mapper.SetOptimization(Mapper.CONTINUOUS)
        view.window.Render()
        optimized_base = mapper.GetBaseVisibilityScore()
        mapper.SetMethod(Mapper.ORDINARY)

        self.assertEqual(score, base)
        self.assertGreater(score, 0)
        self.assertAlmostEqual(base, optimized_base, delta=1e-6 * base)
        np.testing.assert_array_equal(view.picture(), off)
        self.assert_fine(view)

    def test_without_weights_the_picture_is_the_ordinary_one(self):
        view, mapper = show(ViewWeight=0, LightWeight=0)
        nothing = view.picture()
        mapper.SetMethod(Mapper.ORDINARY)
        self.assertLess(difference(nothing, view.picture()), 0.1)

    def test_the_score_of_half_the_data_lengths_is_a_quarter(self):
        # S is an area; data coordinates count, not the volume's scale.
        image = phantom()
        image.SetSpacing(*(0.5 * np.array(image.GetSpacing())))
        image.SetOrigin(-0.5, -0.5, -0.5)
        half_property = phantom_property()
        half_property.SetScalarOpacityUnitDistance(0.025)
        views = [show(), show(image, half_property)]
        for view, _ in views:
            view.window.Render()
        scores = [mapper.GetVisibilityScore() for _, mapper in views]
        self.assertAlmostEqual(scores[1], scores[0] / 4, delta=1e-3 * scores[0])

    def test_a_still_frame_does_not_depend_on_what_was_shown_before(self):
        fresh, _ = show()
        expected = fresh.picture()
        view, mapper = show()
        position = view.camera.GetPosition()
        view.interact(True)
        for _ in range(4):
            view.camera.Azimuth(13)
            view.renderer.ResetCameraClippingRange()
            view.window.Render()
            self.assertFalse(mapper.GetConverged())
        view.camera.SetPosition(*position)
        view.renderer.ResetCameraClippingRange()
        view.interact(False)

        np.testing.assert_array_equal(view.picture(), expected)
        self.assertTrue(mapper.GetConverged())

    def test_another_camera_and_other_functions_are_followed(self):
        view, mapper = show()
        first = view.picture()
        score = mapper.GetVisibilityScore()
        view.camera.Azimuth(90)
        view.window.Render()
        self.assertNotEqual(mapper.GetVisibilityScore(), score)
        view.camera.Azimuth(-90)
        view.volume.GetProperty().SetScalarOpacity(opacity_of((0, 0), (1, 0.5)))
        view.window.Render()
        self.assertNotEqual(mapper.GetVisibilityScore(), score)
        view.volume.SetProperty(phantom_property())
        # The camera has gone there and back: it differs by rounding.
        self.assertLess(difference(view.picture(), first), 0.5)

    def test_changed_data_are_followed(self):
        image = phantom()
        view, mapper = show(image)
        first = view.picture()
        values(image, "Importance")[:] = 0
        image.GetPointData().GetArray("Importance").Modified()
        second = view.picture()
        self.assertEqual(mapper.GetVisibilityScore(), 0)
        self.assertGreater(difference(first, second), 1)
        values(image, "Scalars")[:] = 0
        image.GetPointData().GetArray("Scalars").Modified()
        self.assert_empty(view.picture())
        self.assert_fine(view)

    def test_separate_fields_for_camera_and_light(self):
        view, mapper = show()
        joint = view.picture()
        mapper.SetMode(Mapper.SEPARATE)
        separate = view.picture()

        self.assertGreater(difference(joint, separate), 0.05)
        self.assert_fine(view)
        self.assertTrue(mapper.GetConverged())

    def test_the_papers_solver(self):
        view, mapper = show(phantom(16), Solver=Mapper.ADAM, IterationsPerLevel=(4, 4, 8))
        view.window.Render()
        self.assertGreater(mapper.GetVisibilityScore(), mapper.GetBaseVisibilityScore())
        self.assert_fine(view)

    def test_importance_is_mapped_by_a_function(self):
        image = phantom()
        view, mapper = show(image, ImportanceArray="Scalars", UseImportanceFunction=1,
                            ImportanceFunction=opacity_of((0.6, 0), (0.8, 1)))
        view.window.Render()
        expected = mapper.GetVisibilityScore()
        self.assertGreater(expected, 0)

        mapped = np.interp(values(image, "Scalars"), (0.6, 0.8), (0, 1)).astype(np.float32)
        array = numpy_to_vtk(mapped, deep=1)
        array.SetName("mapped")
        image.GetPointData().AddArray(array)
        mapper.UseImportanceFunctionOff()
        mapper.SetImportanceArray("mapped")
        view.window.Render()
        self.assertAlmostEqual(mapper.GetVisibilityScore(), expected, delta=1e-4 * expected)

        # Without a name and without an array "Importance", it maps the scalars.
        image.GetPointData().RemoveArray("Importance")
        mapper.UseImportanceFunctionOn()
        mapper.SetImportanceArray("")
        view.window.Render()
        self.assertAlmostEqual(mapper.GetVisibilityScore(), expected, delta=1e-4 * expected)
        mapper.SetImportanceFunction(opacity_of((0.1, 0), (0.2, 1)))
        view.window.Render()
        self.assertNotEqual(mapper.GetVisibilityScore(), expected)
        self.assert_fine(view)

    def test_importance_of_cells(self):
        image = phantom()
        importance = values(image, "Importance").reshape(32, 32, 32)
        cells = importance[:-1, :-1, :-1].ravel()
        array = numpy_to_vtk(cells, deep=1)
        array.SetName("Importance")
        image.GetCellData().AddArray(array)
        view, mapper = show(image)
        view.window.Render()
        of_points = mapper.GetVisibilityScore()
        mapper.SetImportanceArrayAssociation(vtkDataObject.FIELD_ASSOCIATION_CELLS)
        view.window.Render()
        self.assertNotEqual(mapper.GetVisibilityScore(), of_points)
        self.assertGreater(mapper.GetVisibilityScore(), 0)
        self.assert_fine(view)


class TestOnceAndPause(MapperTest):
    def turned(self, view, angle=70):
        view.camera.Azimuth(angle)
        view.renderer.ResetCameraClippingRange()
        return view.picture()

    def test_once_keeps_the_extinction_of_the_first_still_frame(self):
        view, mapper = show(Optimization=Mapper.ONCE, LightSource=Mapper.OWN,
                            LightPosition=(3, 4, 5))
        first = view.picture()
        score = mapper.GetVisibilityScore()
        kept = self.turned(view)
        self.assertLess(mapper.GetVisibilityScore(), score)  # made for the first camera
        mapper.SetOptimization(Mapper.CONTINUOUS)
        self.assertGreater(difference(view.picture(), kept), 0.3)
        mapper.SetOptimization(Mapper.ONCE)
        view.camera.Azimuth(-70)
        mapper.Reset()
        self.assertLess(difference(view.picture(), first), 0.5)
        self.assert_fine(view)

    def test_once_shows_the_base_until_the_first_still_frame(self):
        view, mapper = show(Optimization=Mapper.ONCE, AdaptiveQuality=1)
        view.interact(True)
        view.window.Render()
        self.assertFalse(mapper.GetConverged())
        self.assertEqual(mapper.GetVisibilityScore(), 0)
        view.interact(False)
        view.window.Render()
        self.assertTrue(mapper.GetConverged())

    def test_once_is_renewed_by_reset_and_by_new_data_and_survives_hiding(self):
        view, mapper = show(Optimization=Mapper.ONCE)
        view.window.Render()
        score = mapper.GetVisibilityScore()
        self.turned(view)
        kept = mapper.GetVisibilityScore()
        view.volume.VisibilityOff()
        view.window.Render()
        view.volume.VisibilityOn()
        view.window.Render()
        self.assertAlmostEqual(mapper.GetVisibilityScore(), kept, delta=1e-9 * kept)
        mapper.Reset()
        view.window.Render()
        self.assertGreater(mapper.GetVisibilityScore(), kept)
        view.camera.Azimuth(-70)
        mapper.SetInputData(phantom())
        view.window.Render()
        self.assertAlmostEqual(mapper.GetVisibilityScore(), score, delta=1e-3 * score)

    def test_what_was_found_is_kept_while_the_ordinary_picture_is_shown(self):
        for optimization in (Mapper.CONTINUOUS, Mapper.ONCE):
            with self.subTest(optimization=optimization):
                view, mapper = show(Optimization=optimization, InteractiveFrameTime=10, EaseTime=0)
                view.window.Render()
                if optimization == Mapper.ONCE:
                    self.turned(view)
                found = view.picture()
                score = mapper.GetVisibilityScore()
                base = mapper.GetBaseVisibilityScore()
                mapper.SetMethod(Mapper.ORDINARY)
                view.window.Render()
                self.assertEqual(mapper.GetVisibilityScore(), base)
                self.assertTrue(mapper.GetConverged())
                mapper.SetMethod(Mapper.OPTIMIZED)
                # A moving frame shows what there is, and begins nothing that a still one ends.
                view.interact(True)
                view.window.Render()
                self.assertEqual(mapper.GetVisibilityScore(), score)
                view.interact(False)
                np.testing.assert_array_equal(view.picture(), found)

    def test_pause_keeps_what_is_shown(self):
        view, mapper = show()
        view.window.Render()
        score = mapper.GetVisibilityScore()
        mapper.PauseOptimizationOn()
        self.turned(view)
        kept = mapper.GetVisibilityScore()
        self.assertLess(kept, score)  # made for the first camera
        self.assertTrue(mapper.GetConverged())
        view.interact(True)
        view.window.Render()
        view.interact(False)
        self.assertEqual(mapper.GetVisibilityScore(), kept)
        mapper.PauseOptimizationOff()
        view.window.Render()
        self.assertGreater(mapper.GetVisibilityScore(), kept)


class TestViews(MapperTest):
    def test_two_views_with_one_mapper_have_states_of_their_own(self):
        alone, _ = show()
        expected = alone.picture()
        view, mapper = show()
        other = View()
        other.renderer.AddVolume(view.volume)
        other.look(-100, -30)
        first = other.picture()
        np.testing.assert_array_equal(view.picture(), expected)
        np.testing.assert_array_equal(other.picture(), first)
        iterations = mapper.GetIterations()
        # Nothing is left to do in either: the second frame is as fast as one without optimization.
        self.assertGreater(iterations, 0)
        np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)

    def test_two_renderers_in_a_window(self):
        view, _ = show()
        view.renderer.SetViewport(0, 0, 0.5, 1)
        right = vtkRenderer()
        right.SetViewport(0.5, 0, 1, 1)
        view.window.AddRenderer(right)
        right.AddVolume(view.volume)
        right.ResetCamera()
        picture = view.picture()
        self.assertGreater(picture[:, :80].std(), 3)
        self.assertGreater(picture[:, 80:].std(), 3)

    def test_one_mapper_in_two_volumes(self):
        view, mapper = show()
        view.camera.Zoom(0.5)
        first = view.picture()
        second = vtkVolume()
        second.SetMapper(mapper)
        second.SetProperty(phantom_property())
        second.SetPosition(2.5, 0, 0)
        view.renderer.AddVolume(second)
        both = view.picture()
        self.assert_fine(view)
        self.assertGreater(difference(both, first), 0.5)
        view.renderer.RemoveVolume(second)
        np.testing.assert_array_equal(view.picture(), first)

    def test_a_renderer_that_dies_takes_its_state_along(self):
        view, mapper = show()
        expected = view.picture()
        for _ in range(3):
            other = View()
            other.renderer.AddVolume(view.volume)
            other.look()
            other.window.Render()
            del other
        np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)

    def test_both_eyes_are_optimized_once(self):
        view, mapper = show()
        view.window.Render()
        mono = mapper.GetVisibilityScore()
        view.window.SetStereoTypeToAnaglyph()
        view.window.StereoRenderOn()
        view.window.Render()
        self.assertAlmostEqual(mapper.GetVisibilityScore(), mono, delta=1e-6 * mono)

    def test_tiles_are_optimized_for_the_whole_picture(self):
        from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
        view, mapper = show()
        view.window.Render()
        whole = mapper.GetVisibilityScore()
        scores = set()
        mapper.AddObserver("EndEvent", lambda *_: None)
        capture = vtkWindowToImageFilter()
        capture.SetInput(view.window)
        capture.SetScale(2)
        capture.ReadFrontBufferOff()
        view.window.AddObserver("EndEvent", lambda *_: scores.add(mapper.GetVisibilityScore()))
        capture.Update()
        for score in scores:
            self.assertAlmostEqual(score, whole, delta=1e-6 * whole)

    def test_memory_is_given_back_and_everything_made_again(self):
        view, mapper = show()
        expected = view.picture()
        for act in (mapper.ReleaseMemory, view.window.Finalize, view.volume.VisibilityOff):
            act()
            view.window.Render()
            view.volume.VisibilityOn()
            np.testing.assert_array_equal(view.picture(), expected)
        self.assert_fine(view)


class TestMoving(MapperTest):
    def move(self, view, frames=6):
        seconds = []
        view.interact(True)
        for _ in range(frames):
            view.camera.Azimuth(3)
            view.renderer.ResetCameraClippingRange()
            start = time.perf_counter()
            view.window.Render()
            seconds.append(time.perf_counter() - start)
        return seconds

    def test_frames_keep_to_their_time(self):
        # A frame that takes long at rest: a large picture of many short steps.
        view, mapper = show(phantom(64), size=(500, 500), SampleDistance=0.2)
        view.camera.Zoom(1.5)
        view.window.Render()
        view.camera.Azimuth(3)
        start = time.perf_counter()
        view.window.Render()
        still = time.perf_counter() - start
        mapper.SetInteractiveFrameTime(still / 6)
        seconds = self.move(view, 12)
        print(f"still {still:.2f} s, moving {np.median(seconds[4:]):.3f} s for {still / 6:.3f} s")
        # Other programs run on this machine, too.
        self.assertLess(np.median(seconds[4:]), 3 * still / 6)
        self.assert_fine(view)

    def test_a_moving_picture_is_like_a_still_one_in_the_large(self):
        view, mapper = show(EaseTime=0)
        view.window.Render()
        self.move(view, 3)
        moving = view.pixels()
        view.interact(False)
        still = view.picture()
        save(moving, "moving")
        save(still, "after moving")
        self.assertLess(difference(moving, still), 6)

    def test_without_adaptive_quality_moving_frames_are_like_still_ones(self):
        view, mapper = show(AdaptiveQuality=0)
        self.move(view, 2)
        moving = view.pixels()
        self.assertTrue(mapper.GetConverged())
        view.interact(False)
        np.testing.assert_array_equal(view.picture(), moving)

    def test_changes_ease_in(self):
        def first_step(ease):
            view, mapper = show(EaseTime=ease, InteractiveFrameTime=10)
            mapper.SetMethod(Mapper.ORDINARY)
            view.window.Render()
            view.interact(True)
            before = view.picture()
            mapper.SetMethod(Mapper.OPTIMIZED)
            return difference(view.picture(), before)
        self.assertLess(first_step(100.0), 0.3 * first_step(0))

    def test_a_converged_view_is_not_made_worse_by_moving_frames_without_movement(self):
        view, mapper = show(InteractiveFrameTime=10)
        still = view.picture()
        score = mapper.GetVisibilityScore()
        view.interact(True)
        # Shadows of moving frames are coarser.
        self.assertLess(difference(view.picture(), still), 1)
        self.assertEqual(mapper.GetVisibilityScore(), score)

    def test_a_change_of_the_property_that_is_none_of_its_functions_begins_nothing_anew(self):
        view, mapper = show(InteractiveFrameTime=10)
        view.window.Render()
        score = mapper.GetVisibilityScore()
        view.interact(True)
        view.volume.GetProperty().SetShade(True)
        view.volume.GetProperty().SetScalarOpacity(phantom_property().GetScalarOpacity())
        view.window.Render()
        self.assertEqual(mapper.GetVisibilityScore(), score)

    def test_still_frames_in_steps_end_at_the_same_picture(self):
        expected = show()[0].picture()
        view, mapper = show(ProgressiveStill=1, InteractiveFrameTime=0.001)
        frames = 0
        while True:
            view.window.Render()
            frames += 1
            if mapper.GetConverged():
                break
            self.assertLess(frames, 400)
        self.assertGreater(frames, 1)
        np.testing.assert_array_equal(view.picture(), expected)
        self.assertTrue(mapper.GetConverged())


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

    def test_the_tint_comes_from_the_light_and_the_brightness_from_the_property(self):
        view, mapper = show(Optimization=Mapper.OFF)
        view.renderer.AutomaticLightCreationOff()
        light = self.light(Position=(1, 1, 1), Intensity=0.5)
        view.renderer.AddLight(light)
        white = view.picture()
        light.SetIntensity(0.9)
        np.testing.assert_array_equal(view.picture(), white)
        light.SetColor(1, 0, 0)
        red = view.picture()
        self.assertLess(red[..., 2].sum(), white[..., 2].sum())
        light.SetColor(1, 1, 1)
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
        mapper.CroppingOff()

        def part(layers):
            """Picture and score of the points in the box and so many layers of points more."""
            image = phantom(33)
            image.Crop((8 - layers, 32, 0, 24 + layers, 12 - layers, 28 + layers))
            mapper.SetInputData(image)
            return view.picture(), mapper.GetVisibilityScore()
        smaller, smaller_score = part(0)
        larger, larger_score = part(1)
        save(smaller, "smaller")

        # Extinction fades out between the last point inside and the first outside: that is half a
        # layer of cells, whose effect is less than a whole layer's.
        self.assertLess(difference(cropped, smaller), difference(larger, smaller))
        self.assertLess(difference(cropped, larger), difference(larger, smaller))
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

    def test_what_is_cropped_does_not_count(self):
        view, mapper = show()
        mapper.CroppingOn()
        mapper.SetCroppingRegionPlanes(5, 6, 5, 6, 5, 6)
        self.assert_empty(view.picture())
        self.assertEqual(mapper.GetVisibilityScore(), 0)


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


class TestTranslucentGeometry(MapperTest):
    def add_sphere(self, view, *center):
        source = vtkSphereSource()
        source.SetCenter(*center)
        source.SetRadius(0.5)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(source.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetOpacity(0.5)
        view.renderer.AddActor(actor)
        view.renderer.ResetCameraClippingRange()

    def test_behind_the_volume_is_right(self):
        view, _ = show()
        self.add_sphere(view, *(-0.6 * np.array(view.camera.GetPosition())))
        view.window.Render()
        self.assert_fine(view)

    def test_in_front_and_inside_get_a_warning(self):
        for share in (0.5, 0):
            with self.subTest(share=share):
                view, _ = show()
                self.add_sphere(view, *(share * np.array(view.camera.GetPosition())))
                self.assert_says(view, "ranslucent")


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


class TestBadInput(MapperTest):
    """A message, no crash, no pixels that are not colours."""

    def test_a_camera_on_the_box_and_in_its_corners(self):
        for position in ((1, 0, 0), (1, 1, 1), (0, 0, 0), (1, 1, 0)):
            for focus in ((0, 0, 0), (0.3, 0.2, 0.1), (1, 1, 2)):
                if position == focus:
                    continue
                with self.subTest(position=position, focus=focus):
                    view, mapper = show()
                    view.camera.SetPosition(*position)
                    view.camera.SetFocalPoint(*focus)
                    view.camera.SetClippingRange(0.01, 10)
                    view.window.Render()
                    self.assert_fine(view)
                    self.assert_sane(view, mapper)

    def test_a_camera_at_its_focal_point(self):
        view, mapper = show()
        view.camera.SetPosition(1, 2, 3)
        view.camera.SetFocalPoint(1, 2, 3)
        view.window.Render()
        self.assert_sane(view, mapper)

    def test_a_view_up_along_the_view_direction(self):
        view, mapper = show()
        view.camera.SetViewUp(*np.subtract(view.camera.GetPosition(),
                                           view.camera.GetFocalPoint()))
        view.window.Render()
        self.assert_sane(view, mapper)

    def test_a_camera_far_away_and_one_that_looks_away(self):
        view, mapper = show()
        view.camera.SetPosition(1e6, 2e5, 3e5)
        view.camera.SetViewAngle(1e-4)
        view.renderer.ResetCameraClippingRange()
        self.assertGreater(view.picture().std(), 3)
        view.camera.SetFocalPoint(2e6, 0, 0)
        view.camera.SetClippingRange(1, 1e9)
        self.assert_empty(view.picture())
        self.assert_fine(view)

    def test_opacity_one_everywhere(self):
        view, mapper = show(volume_property=gray_property(1.0, 1.0))
        picture = view.picture()
        self.assert_fine(view)
        self.assert_sane(view, mapper)
        self.assertGreater(picture.std(), 3)

    def test_opacity_zero_everywhere(self):
        view, mapper = show(volume_property=gray_property(0.0, 1.0))
        self.assert_empty(view.picture())
        self.assert_fine(view)
        self.assert_sane(view, mapper)

    def test_unit_distance_zero(self):
        view, mapper = show()
        view.volume.GetProperty().SetScalarOpacityUnitDistance(0)
        self.assert_says(view, "unit distance", "0")
        self.assert_empty(view.pixels())
        self.assert_sane(view, mapper)
        view.volume.GetProperty().SetScalarOpacityUnitDistance(0.05)
        self.assertGreater(view.picture().std(), 3)
        self.assertEqual(mapper.GetMessages(), "")

    def test_missing_importance(self):
        view, mapper = show(ImportanceArray="Absent")
        self.assert_says(view, '"Absent"', "Scalars, Importance, BaseExtinction")
        self.assertGreater(view.pixels().std(), 3)
        self.assert_sane(view, mapper)
        self.assertIn('"Absent"', mapper.GetMessages())
        mapper.SetOptimization(Mapper.OFF)
        view.window.Render()
        self.assertEqual(mapper.GetMessages(), "")

    def test_importance_that_is_none_or_all(self):
        for value in (0, 1):
            image = phantom()
            values(image, "Importance")[:] = value
            view, mapper = show(image)
            self.assertGreater(view.picture().std(), 3)
            self.assert_fine(view)
            self.assert_sane(view, mapper)

    def test_a_missing_scalar_array(self):
        view, mapper = show()
        mapper.SelectScalarArray("Absent")
        mapper.SetScalarModeToUsePointFieldData()
        self.assert_says(view, '"Absent"', "Scalars, Importance, BaseExtinction")
        self.assert_empty(view.pixels())

    def test_four_components(self):
        image = image_of((8, 8, 8), rgba=np.random.default_rng(1).integers(
            0, 255, (512, 4)).astype(np.uint8), Importance=np.zeros(512))
        view, mapper = show(image, property_of(colors_of((0, 1, 0, 0), (255, 0, 0, 1)),
                                               opacity_of((0, 0), (500, 0.5)), 1.0))
        self.assert_says(view, '"rgba"', "4 components", "ScalarComponent")
        self.assertGreater(view.pixels().std(), 3)
        view.volume.GetProperty().IndependentComponentsOff()
        view.messages.clear()
        self.assert_says(view, '"rgba"', "4 dependent components")
        self.assert_empty(view.pixels())
        view.messages.clear()
        view.volume.GetProperty().IndependentComponentsOn()
        mapper.SetScalarComponent(7)
        self.assert_says(view, "ScalarComponent is 7")

    def test_nan_infinity_and_blanked_points_are_empty_with_one_warning(self):
        image = phantom()
        values(image, "Scalars")[:100] = np.nan
        values(image, "Scalars")[100:200] = np.inf
        values(image, "Importance")[5000:5010] = np.nan
        view, mapper = show(image)
        self.assert_says(view, "210 of 32768")
        self.assert_sane(view, mapper)

        image = phantom()
        image.AllocatePointGhostArray()
        from vtkmodules.util.numpy_support import vtk_to_numpy
        vtk_to_numpy(image.GetPointGhostArray())[:] = 2  # vtkDataSetAttributes::HIDDENPOINT
        view, mapper = show(image)
        self.assert_empty(view.picture())
        self.assert_fine(view)
        self.assertEqual(mapper.GetVisibilityScore(), 0)

    def test_everything_nan(self):
        view, mapper = show(image_of((4, 4, 4), s=np.full(64, np.nan), Importance=np.ones(64)))
        self.assert_says(view, "64 of 64")
        self.assert_empty(view.pixels())

    def test_flat_images(self):
        for shape in ((5, 5, 1), (1, 5, 5), (5, 1, 1), (1, 1, 1)):
            with self.subTest(shape=shape):
                count = int(np.prod(shape))
                view, mapper = show(image_of(shape, s=np.linspace(0, 1, count),
                                             Importance=np.ones(count)))
                self.assert_says(view, "{} x {} x {}".format(*shape))
                self.assert_empty(view.pixels())

    def test_the_smallest_volume(self):
        view, mapper = show(image_of((2, 2, 2), s=np.linspace(0, 1, 8), Importance=np.ones(8)),
                            gray_property(0.5, 0.2))
        self.assertGreater(view.picture().std(), 3)
        self.assert_fine(view)
        self.assert_sane(view, mapper)

    def test_no_points_and_no_input(self):
        view, mapper = show()
        mapper.SetInputData(vtkImageData())
        view.window.Render()
        mapper.RemoveAllInputConnections(0)
        view.window.Render()
        self.assert_empty(view.pixels())

    def test_another_kind_of_grid(self):
        from vtkmodules.vtkCommonCore import vtkDoubleArray
        grid = vtkRectilinearGrid()
        grid.SetDimensions(2, 2, 2)
        for axis in "XYZ":
            coordinates = vtkDoubleArray()
            coordinates.InsertNextValue(0)
            coordinates.InsertNextValue(1)
            getattr(grid, f"Set{axis}Coordinates")(coordinates)
        view = View()
        mapper = Mapper()
        view.add(grid, phantom_property(), mapper)
        view.renderer.ResetCamera()
        view.messages = caught(mapper)
        self.assert_says(view, "vtkRectilinearGrid", "vtkResampleToImage")

    def test_a_volume_that_is_scaled_flat(self):
        view, mapper = show()
        view.volume.SetScale(1, 1, 0)
        view.window.Render()
        self.assertEqual(len(view.messages), 1)
        self.assert_sane(view, mapper)

    def test_a_window_without_pixels(self):
        view, mapper = show()
        view.renderer.SetViewport(0.2, 0.2, 0.2, 0.2)
        self.assert_says(view, "0 x 0 pixels")
        self.assert_sane(view, mapper)
        view.window.SetSize(1, 1)
        view.renderer.SetViewport(0, 0, 1, 1)
        view.window.Render()

    def test_settings_that_make_no_sense_are_named(self):
        cases = dict(ViewWeight=-1, LightWeight=-2, RegularizationWeight=-3, RayDensity=0, Mode=7,
                     Solver=-1, Derivative=2, Backend=9, LightType=3, LightSource=2, Method=5,
                     Optimization=3, MaximumIterations=-1, Tolerance=-1, MaximumSeconds=-1,
                     ShadowStrength=1.5, Ambient=-0.5, Anisotropy=1, Specular=-1, SpecularPower=-2,
                     LightIntensity=-4, SampleDistance=0, InteractiveFrameTime=0, EaseTime=-1)
        for name, value in cases.items():
            with self.subTest(name=name):
                view, mapper = show(phantom(8), **{name: value})
                view.window.Render()
                view.window.Render()
                self.assertEqual(len(view.messages), 1, view.messages)
                self.assertIn(str(value), view.messages[0])
                self.assert_sane(view, mapper)

    def test_methods_of_later_versions(self):
        for method, name in ((2, "Viola"), (3, "Marchesin"), (4, "Ament")):
            view, mapper = show(phantom(16), Method=method)
            self.assert_says(view, name, "later")
            ordinary, _ = show(phantom(16), Method=Mapper.ORDINARY)
            np.testing.assert_array_equal(view.pixels(), ordinary.picture())

    def test_what_is_not_used_is_named(self):
        def gradient(view):
            view.volume.GetProperty().SetGradientOpacity(opacity_of((0, 0), (1, 1)))

        def two_dimensional(view):
            view.volume.GetProperty().SetTransferFunctionMode(1)

        def blend(view):
            view.volume.GetMapper().SetBlendModeToMaximumIntensity()

        def nothing(view):
            view.volume.GetProperty().SetScalarOpacity(vtkPiecewiseFunction())
        for act, word in ((gradient, "gradient opacity"), (two_dimensional, "two-dimensional"),
                          (blend, "blend mode"), (nothing, "no points")):
            with self.subTest(word=word):
                view, mapper = show(phantom(16))
                act(view)
                self.assert_says(view, word)

    def test_cuda_is_used_or_an_error(self):
        view, mapper = show(phantom(16), Backend=Mapper.CUDA)
        view.window.Render()
        if view.messages:
            self.assertEqual(len(view.messages), 1)
            self.assertIn("CUDA", view.messages[0])
        else:
            self.assertIn("CUDA", mapper.GetBackendName())

    def test_a_message_comes_again_after_it_was_settled(self):
        view, mapper = show(ImportanceArray="Absent")
        for name in ("Importance", "Absent"):
            view.window.Render()
            mapper.SetImportanceArray(name)
        view.window.Render()
        self.assertEqual(len(view.messages), 2)

    def test_a_message_about_an_error_is_not_repeated_while_the_camera_moves(self):
        view, mapper = show(ImportanceArray="Absent")
        for _ in range(5):
            view.camera.Azimuth(5)
            view.window.Render()
        self.assertEqual(len(view.messages), 1)


if __name__ == "__main__":
    unittest.main()
